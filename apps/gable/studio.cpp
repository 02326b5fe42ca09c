// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// gable studio: finds the built page beside the program and serves it until Ctrl-C.

#include "gable/studio.h"

#include <cstdio>
#include <filesystem>

#include "commands.h"

namespace {

namespace fs = std::filesystem;

/// The first folder that holds `file`, as seen from the program: in a build, then installed.
std::string folderWith(const char* file, const std::initializer_list<const char*>& folders) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const char* folder : folders) {
    const fs::path candidate = program / folder;
    if (fs::exists(candidate / file, error)) return fs::weakly_canonical(candidate, error).string();
  }
  return {};
}

}  // namespace

int runStudioCommand(const StudioArguments& arguments) {
  gable::StudioSettings settings;
  settings.project = arguments.folder;
  settings.search = arguments.search;
  settings.port = static_cast<uint16_t>(arguments.port);
  settings.page = folderWith("index.html", {"../studio", "../share/gable/studio"});
  settings.examples = folderWith("README.md", {"../../examples", "../share/gable/examples"});
  if (settings.page.empty()) {
    std::fputs("gable: the studio's page is not there; './run studio' builds it\n", stderr);
    return kExitFile;
  }
  const gable::StudioResult result =
      gable::runStudio(settings, *cancelFlag(), [](const std::string& url) {
        std::printf("%s\n", url.c_str());
        std::fflush(stdout);
      });
  print(result.diagnostics);
  return result.ok ? kExitDone : kExitFile;
}
