// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// gable studio: finds the built page beside the program and serves it until Ctrl-C.

#include "gable/studio.h"

#include <cstdio>

#include "commands.h"
#include "folders.h"

int runStudioCommand(const StudioArguments& arguments) {
  gable::StudioSettings settings;
  settings.project = arguments.folder;
  settings.search = arguments.search;
  settings.port = static_cast<uint16_t>(arguments.port);
  settings.page = folderWith("index.html", {"../studio", "../share/gable/studio"});
  settings.examples = examplesFolder();
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
