// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Where rules may read files besides their own project.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace gable {

/// Nothing outside of the project and of these folders is ever read.
struct SearchSettings {
  /// A folder of projects: rules name a file of another one as "/Project/rules/windows.cga".
  std::optional<std::string> workspace;
  /// Folders of further projects, such as "/usr/share/ESRI.lib" for "/ESRI.lib/rules/x.cga";
  /// "NAME=FOLDER" gives one another name. Relative paths are looked for in them last.
  std::vector<std::string> libraries;
  /// The folder of what comes with Gable: rules and models that are called
  /// "/gable/rules/trees.cga". Nothing else leads there. A library of the name `gable` takes its
  /// place.
  std::optional<std::string> bundled;
  /// What is nowhere under its path is looked for by its file name alone, without regard to case,
  /// below the project and the folders above. Of several files the one whose folders are most
  /// alike is taken, then the first in the order of the alphabet.
  bool byName = false;

  bool operator==(const SearchSettings&) const = default;
};

/// The folder of the project that a rule file belongs to, as all commands find it: the one in the
/// workspace, else the nearest folder above that has one `rules` or `assets` in it, else the file's
/// own. Absolute, without symbolic links.
std::string projectFolder(const std::string& ruleFile, const SearchSettings& settings = {});

}  // namespace gable
