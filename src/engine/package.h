// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Package: a project in one file, a rule package (.rpk, which is 7z) or a .zip. It stands for a
// folder: "x.rpk/rules/main.cga" is a file in it. Its files are in memory; nothing is unpacked.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "io/archive/archive_files.h"

namespace gable {

class Package {
 public:
  /// Codes: those of readArchive and of readFile.
  static Result<std::shared_ptr<const Package>> open(const std::string& path);
  /// A package with a rule file in it: "x.rpk/rules/main.cga", or "x.rpk" and nothing. The package
  /// is empty for a path of another form.
  struct Place {
    std::string package, inner;
  };
  static Place placeOf(const std::string& path);

  /// Canonical; it is the path of the folder that the package stands for.
  const std::string& path() const { return path_; }
  /// Null where there is none.
  const std::string* find(std::string_view inner) const;
  /// All paths below a folder of the package ("" for all), with a slash before them; sorted.
  std::vector<std::string> list(std::string_view folder) const;
  bool hasFolder(std::string_view inner) const;
  /// The rule file that is meant by the package alone: the only one, or the only one that has the
  /// name of its compiled rules, or that no other imports, or that has the package's name. Codes:
  /// package-empty, package-compiled, package-ambiguous.
  Result<std::string> mainFile() const;

 private:
  Package(std::string path, ArchiveFiles files)
      : path_(std::move(path)), files_(std::move(files)) {}

  std::string path_;
  ArchiveFiles files_;
};

}  // namespace gable
