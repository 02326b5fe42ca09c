// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "tiles_viewer.h"

#include <cstdio>
#include <filesystem>

#include "folders.h"
#include "tiles.h"

namespace {

/// Whether the page may be put there: it may be from before, and nothing else of that name.
bool mayHoldViewer(const std::string& folder) {
  std::error_code error;
  if (!std::filesystem::exists(folder + "index.html", error)) return true;
  std::string before;
  if (!readText(folder + "index.html", before)) return false;
  if (before.find("name=\"generator\" content=\"Gable\"") != std::string::npos) return true;
  fail(kExitFile, "'" + folder + "index.html' is a page of another program; remove it first");
  return false;
}

}  // namespace

int ViewerPage::find(const std::string& folder) {
  folder_ = folder;
  from_ = folderWith("viewer.js", {"../studio/viewer", "../share/gable/studio/viewer"});
  if (from_.empty()) {
    return fail(kExitFile, "the page for --viewer is not built; ./run studio builds it");
  }
  return mayHoldViewer(folder) ? kExitDone : kExitFile;
}

int ViewerPage::findOrTell(const std::string& folder) {
  if (!folderWith("viewer.js", {"../studio/viewer", "../share/gable/studio/viewer"}).empty())
    return find(folder);
  note(
      "the page for --viewer is not built, so the tiles get none; ./run studio builds it, and "
      "gable tiles viewer " +
      folder + " adds it then");
  return kExitDone;
}

int ViewerPage::write() const {
  if (from_.empty()) return kExitDone;
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  for (const char* name : {"viewer.js", "index.html"}) {
    std::string text;
    if (!readText(from_ + "/" + name, text)) return kExitFile;
    if (const int status = writeText(folder_ + name, text)) return status;
  }
  return kExitDone;
}

int runTilesViewer(const std::string& output) {
  const std::string folder = asFolder(output);
  std::error_code error;
  if (!std::filesystem::exists(folder + "tileset.json", error)) {
    return fail(kExitFile,
                "there is no tileset in '" + folder + "'; gable tiles and gable city make one");
  }
  ViewerPage page;
  if (const int status = page.find(folder)) return status;
  return page.write();
}
