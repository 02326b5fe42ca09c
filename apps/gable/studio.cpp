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
  settings.page = studioPage();
  settings.examples = examplesFolder();
  if (settings.page.empty()) {
    return fail(kExitFile, "the studio's page is not there; './run studio' builds it");
  }
  const gable::StudioResult result =
      gable::runStudio(settings, *cancelFlag(), [](const std::string& url) {
        std::printf("%s\n", url.c_str());
        std::fflush(stdout);
      });
  print(result.diagnostics);
  return result.ok ? kExitDone : kExitFile;
}
