// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The files that a workspace reads: handed in, since which file an import means is the engine's
// knowledge. Paths are absolute and canonical, so that one file has one name.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"

namespace gable::language {

class Files {
 public:
  virtual ~Files() = default;
  /// The one name of a path; the path itself where it leads to no file.
  virtual std::string canonical(const std::string& path) = 0;
  /// Where the file may be that an import of `importer` names, the likeliest first.
  virtual std::vector<std::string> places(const std::string& written,
                                          const std::string& importer) = 0;
  /// True for a plain file of the project of `importer`.
  virtual bool readable(const std::string& path, const std::string& importer) = 0;
  virtual Result<std::string> read(const std::string& path) = 0;
  /// Changes when the file does; 0 when there is none.
  virtual uint64_t stamp(const std::string& path) = 0;
  /// The folder that the rules of a file may read from.
  virtual std::string root(const std::string& path) = 0;
  /// Rule files of all notations below a folder, sorted; hidden folders are left out.
  virtual std::vector<std::string> ruleFiles(const std::string& folder) = 0;
  /// Models, pictures and tables that rules of `path` can name, as they would write them.
  virtual std::vector<std::string> assets(const std::string& path) = 0;
  /// What was listed is listed anew.
  virtual void refresh() = 0;
  /// The files of the project that a folder such as "/gable/" names, with that folder before them.
  virtual std::vector<std::string> filesIn(const std::string& folder, const std::string& path) {
    (void)folder, (void)path;
    return {};
  }
};

}  // namespace gable::language
