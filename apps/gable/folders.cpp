// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "folders.h"

#include <filesystem>

std::string folderWith(const char* file, const std::initializer_list<const char*>& folders) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const char* folder : folders) {
    const fs::path candidate = program / folder;
    if (fs::exists(candidate / file, error)) return fs::weakly_canonical(candidate, error).string();
  }
  return {};
}

std::string studioPage() {
  return folderWith("index.html", {"../studio", "../share/gable/studio"});
}

std::string examplesFolder() {
  return folderWith("rules/city.cga", {"../share/gable/examples", "../../examples"});
}
