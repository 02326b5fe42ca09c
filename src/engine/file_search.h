// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// FileSearch: which file a path means that a rule writes, and which files may be read at all.
//
// A path "/a/b" counts from the project's root, then names a file of another project: `a` is the
// project's own folder, a library or a folder of the workspace. Other paths are looked up in
// `assets/`, in the root and beside the file that names them, all in the project of that file; then
// in the libraries. "/gable/a" is a file of what comes with Gable. Nothing else is ever read: no
// "..", no links that lead out; and nothing hidden, by a name that begins with a dot.
//
// Files of the own project are called by their path from its root, "rules/town.cga"; those of
// others by a path that begins with a slash, "/ESRI.lib/rules/x.cga".
//
// A package stands for a folder: its files are read from memory, and it is a workspace of its own.
//
// Any thread may call.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "engine/package.h"
#include "gable/search.h"

namespace gable {

class FileSearch {
 public:
  FileSearch(const std::string& root, const SearchSettings& settings,
             std::shared_ptr<const Package> package = nullptr);

  /// The project root for a rule file that names none: in a workspace the folder of the project,
  /// else the nearest folder above that holds a `rules` or an `assets` folder, else the file's own.
  static std::string rootFor(const std::string& ruleFile, const SearchSettings& settings);
  /// The same for a rule file in a package, which is "" or a folder of it.
  static std::string rootFor(const Package& package, const std::string& inner);
  /// What is wrong where a folder of the settings is not there; code: folder-missing.
  static std::optional<Error> missingFolder(const SearchSettings& settings);

  const std::string& root() const { return root_; }
  const SearchSettings& settings() const { return settings_; }
  const std::shared_ptr<const Package>& package() const { return package_; }
  /// The file on disk of a path; empty when there is none that may be read.
  std::string locate(std::string_view path, std::string_view fromFile) const;
  /// Where on disk that may be, in the order of looking; whether there is a file is not asked.
  std::vector<std::string> places(std::string_view path, std::string_view fromFile) const;
  /// The canonical path of a file on disk when it is a plain file that may be read, else empty.
  std::string inside(const std::string& candidate) const;
  /// The bytes of a file that inside() gave. Codes: those of readFile.
  Result<std::string> read(const std::string& file, uint64_t maxBytes) const;
  /// Whether a path on disk lies in one of the folders.
  bool covers(const std::string& path) const;
  /// What a file on disk is called; the path itself for one that lies in none of the folders.
  std::string projectPath(const std::string& file) const;
  /// All files of the own project as paths from its root, with a slash before them; sorted.
  const std::vector<std::string>& files() const { return listed(root_); }
  /// What the files are called that lie in a folder or below it: "/assets/", "/ESRI.lib/assets/".
  std::vector<std::string> filesIn(const std::string& folder) const;
  /// What the files are called, with a slash before them, that a query means (shape/file_query.h):
  /// those of the project of `fromFile`, and of others where the query can reach them; sorted. In a
  /// workspace each begins with the name of its project, else those of the own project do not.
  std::vector<std::string> search(std::string_view query, std::string_view fromFile) const;

 private:
  struct Library {
    std::string name;
    std::string path;
  };
  std::string_view inPackage(std::string_view path) const;
  std::string baseOf(std::string_view fromFile) const;
  const Library* libraryNamed(std::string_view name) const;
  const std::vector<std::string>& listed(const std::string& folder) const;
  std::string byName(std::string_view path) const;

  std::string root_;
  std::string rootName_;
  /// What files of the project begin with where they are listed: its path in the workspace.
  std::string rootPrefix_;
  SearchSettings settings_;
  std::shared_ptr<const Package> package_;
  /// Empty without one.
  std::string workspace_;
  std::vector<Library> libraries_;
  /// What comes with Gable: found by its name alone.
  std::optional<Library> bundled_;
  mutable std::mutex mutex_;
  mutable std::map<std::string, std::vector<std::string>> listings_;
};

}  // namespace gable
