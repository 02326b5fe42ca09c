// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The examples that came with the program: a folder each, with a rule file of its name.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "studio/project_files.h"

namespace gable::studio {

class Gallery {
 public:
  explicit Gallery(const std::string& folder);
  /// JSON: name, title, text, notation, file, shapes, arguments of each.
  std::string list() const;
  /// PNG. Code: file-missing.
  Result<std::string> picture(const std::string& name) const;
  /// Copies an example into a folder of its name, or of the name and a number where there is one;
  /// gives that folder's path in the project. Rules that it imports come along; files that are
  /// there stay. All of it is copied, or nothing.
  Result<std::string> copyTo(ProjectFiles& files, const std::string& name) const;

 private:
  Result<bool> addMissing(const ProjectFiles& files, const std::string& folder,
                          std::vector<std::pair<std::string, std::string>>& to) const;
  std::string rulesOf(const std::string& name) const;
  ProjectFiles folder_;
  bool present_;
};

}  // namespace gable::studio
