// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// gable studio: finds the built page beside the program and serves it until Ctrl-C.

#include "gable/studio.h"

#include <cctype>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <utility>

#include "commands.h"
#include "folders.h"
#include "memory.h"

namespace {

namespace fs = std::filesystem;

// The folder to serve, and the file in it that the page opens with; empty for none.
std::pair<std::string, std::string> projectOf(const std::string& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return {path, {}};
  const fs::path file = fs::weakly_canonical(path, error);
  const fs::path project = gable::projectFolder(path);
  return {project.string(), file.lexically_relative(project).generic_string()};
}

std::string escaped(const std::string& path) {
  std::string out;
  for (const char c : path) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                       std::string_view("-_.~/").find(c) != std::string_view::npos;
    char code[4];
    std::snprintf(code, sizeof code, "%%%02X",
                  static_cast<unsigned>(static_cast<unsigned char>(c)));
    out += plain ? std::string(1, c) : std::string(code);
  }
  return out;
}

}  // namespace

int runStudioCommand(const StudioArguments& arguments) {
  keepMemory();
  gable::StudioSettings settings;
  const auto [project, file] = projectOf(arguments.folder);
  const std::string address = file.empty() ? std::string() : "#file=" + escaped(file);
  settings.project = project;
  settings.search = arguments.search;
  settings.port = static_cast<uint16_t>(arguments.port);
  settings.page = studioPage();
  settings.examples = examplesFolder();
  if (settings.page.empty()) {
    return fail(kExitFile, "the studio's page is not there; './run studio' builds it");
  }
  const gable::StudioResult result =
      gable::runStudio(settings, *cancelFlag(), [&](const std::string& url) {
        std::printf("%s%s\n", url.c_str(), address.c_str());
        std::fflush(stdout);
      });
  print(result.diagnostics);
  return result.ok ? kExitDone : kExitFile;
}
