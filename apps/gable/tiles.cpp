// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// gable tiles: rules and shapes as a folder of 3D Tiles.

#include "tiles.h"

#include <cstdio>
#include <filesystem>

#include "folders.h"
#include "json/tiles_json.h"

namespace {

/// Where the page that shows tiles lies; empty, with a message, where it is not built.
std::string viewerFolder() {
  const std::string from =
      folderWith("viewer.js", {"../studio/viewer", "../share/gable/studio/viewer"});
  if (from.empty()) {
    std::fputs("gable: the page for --viewer is not built; ./run studio builds it\n", stderr);
  }
  return from;
}

/// Whether the page may be put there: it may be from before, and nothing else of that name.
bool mayHoldViewer(const std::string& folder) {
  std::error_code error;
  if (!std::filesystem::exists(folder + "index.html", error)) return true;
  std::string before;
  if (!readText(folder + "index.html", before)) return false;
  if (before.find("name=\"generator\" content=\"Gable\"") != std::string::npos) return true;
  std::fprintf(stderr, "gable: '%sindex.html' is a page of another program; remove it first\n",
               folder.c_str());
  return false;
}

int writeViewer(const std::string& from, const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  for (const char* name : {"viewer.js", "index.html"}) {
    std::string text;
    if (!readText(from + "/" + name, text)) return kExitFile;
    if (const int status = writeText(folder + name, text)) return status;
  }
  return kExitDone;
}

}  // namespace

std::string tileFolder(const std::string& output) {
  constexpr std::string_view kTileset = "tileset.json";
  if (output.ends_with('/')) return output;
  if (output == kTileset) return "./";
  if (output.ends_with("/" + std::string(kTileset))) {
    return output.substr(0, output.size() - kTileset.size());
  }
  std::error_code error;
  return std::filesystem::is_directory(output, error) ? output + "/" : std::string();
}

int writeTileFolder(const gable::Rules& rules, const gable::Shapes& shapes,
                    const std::string& folder, const gable::DeriveSettings& settings,
                    const TileArguments& arguments, const LimitArguments& limits,
                    gable::TileResult& result) {
  // Before what takes long.
  std::string viewer;
  if (arguments.viewer) {
    viewer = viewerFolder();
    if (viewer.empty() || !mayHoldViewer(folder)) return kExitFile;
  }
  ProgressLine progress("writing tiles");
  gable::TileSettings tiles;
  tiles.derive = settings;
  tiles.derive.progress = progress.callback();
  tiles.triangles = arguments.triangles;
  tiles.limits = fileLimits(limits);
  // Places take what time they take.
  if (!limits.maxSeconds) tiles.limits.seconds.reset();
  result = gable::writeTiles(rules, shapes, folder, tiles);
  print(result.diagnostics);
  for (const std::string& line : result.prints) std::fprintf(stderr, "%s\n", line.c_str());
  if (result.end != gable::End::Done) return kExitLimit;
  if (result.ok) return arguments.viewer ? writeViewer(viewer, folder) : kExitDone;
  for (const gable::Diagnostic& d : result.diagnostics) {
    if (d.code == "attribute-value") return kExitUsage;
    if (d.code == "tiles-folder" || d.code.starts_with("file-")) return kExitFile;
  }
  return statusOf(result.diagnostics, kExitWrong);
}

int runTiles(const TilesArguments& arguments) {
  const double begin = secondsNow();
  std::string folder = tileFolder(arguments.output);
  if (folder.empty()) folder = arguments.output + "/";
  Inputs inputs;
  if (const int status = readInputs(arguments.derive, inputs)) return status;
  gable::TileResult result;
  if (const int status = writeTileFolder(inputs.rules, inputs.shapes, folder, inputs.settings,
                                         arguments.tiles, arguments.derive.limits, result)) {
    return status;
  }
  if (arguments.stats.empty()) return kExitDone;
  gable::RunFigures figures;
  figures.parseSeconds = inputs.rules.parseSeconds();
  figures.totalSeconds = secondsNow() - begin;
  figures.peakBytes = peakBytes();
  return writeText(arguments.stats, gable::tilesJson(result, figures));
}
