// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The files of the one folder that a studio may read and write.
//
// Promises, each with a test:
// 1. Nothing outside of the folder is read or written: no "..", no absolute path, no link out.
// 2. Names that begin with a dot cannot be named; the folder `.gable` is the studio's own.
// 3. Only kinds of files that a project is made of are written.
// 4. A file is replaced whole or not at all, and the version before is kept in .gable/previous.
// 5. Files that belong together are made all or none.
// 6. Who writes says which version was read; where the file is another by now, nothing is written.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"

namespace gable::studio {

struct ProjectFile {
  /// Below the folder, with '/'.
  std::string path;
  uint64_t bytes = 0;
  /// Changes with the content: size and time of the last change.
  std::string stamp;
};

class ProjectFiles {
 public:
  explicit ProjectFiles(const std::string& root);

  bool ok() const { return !root_.empty(); }
  const std::string& root() const { return root_; }
  /// Sorted by path, hidden ones left out, at most kMostFiles.
  std::vector<ProjectFile> list() const;
  static constexpr size_t kMostFiles = 5000;

  /// Codes: path-outside, file-missing, file-unreadable, file-too-large.
  Result<std::string> read(const std::string& path) const;
  /// What identifies a content: 16 hexadecimal digits; "none" for a file that is not there.
  std::string version(const std::string& path) const;
  static std::string versionOf(const std::string& content);
  /// `expected`: the version that is replaced; empty: whatever is there. Gives the new version.
  /// Codes: path-outside, kind-refused, version-differs, file-unwritable.
  Result<std::string> write(const std::string& path, const std::string& content,
                            const std::string& expected);
  /// Makes files that are not there yet, by path and content: all of them, or none.
  /// Codes: path-outside, kind-refused, version-differs, file-unwritable.
  Result<uint64_t> create(const std::vector<std::pair<std::string, std::string>>& files);
  /// Whether files like this one are written at all.
  static bool writes(const std::string& path);
  /// What a file said before it was last written.
  Result<std::string> previous(const std::string& path) const;

  /// Unsaved text of a file, kept until it is saved or dropped.
  Result<std::string> recovery(const std::string& path) const;
  Result<uint64_t> keepRecovery(const std::string& path, const std::string& content);
  void dropRecovery(const std::string& path);

  /// The path on disk of a file that the studio keeps for itself.
  Result<std::string> ownPlace(const std::string& name) const { return own("", name); }
  /// The path on disk of a project path that is inside; it need not exist.
  Result<std::string> place(const std::string& path) const;

 private:
  Result<std::string> own(const char* folder, const std::string& path) const;
  std::string root_;
};

/// Whether the text is a path that may name a file of a project at all.
bool plainPath(const std::string& path);

}  // namespace gable::studio
