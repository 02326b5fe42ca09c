// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What stands behind the public class. Its constructor is the engine's, which knows the catalogue
// and the files.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gable/language.h"
#include "language/library.h"

namespace gable::language {

struct Workspace::Impl {
  Impl(const Catalogue& catalogue, std::unique_ptr<Files> files,
       std::vector<std::string> workspaceFolders)
      : library(catalogue, std::move(files)), folders(std::move(workspaceFolders)) {}

  /// The one name of a path, and back: as the caller has opened it.
  std::string key(const std::string& path);
  std::string shown(const std::string& key) const;
  /// Files that may use what `key` declares.
  std::vector<std::string> filesFor(const std::string& key);

  Library library;
  std::vector<std::string> folders;
  /// Of open texts: as they were opened, to their one name, and back.
  std::map<std::string, std::string> keys, names;
  /// By text: what its attributes are in the shape that was derived last.
  std::map<std::string, std::map<std::string, std::string>> values;
};

/// Everything built in whose name, summary or everyday words fit, the best first.
std::vector<Entry> searchIn(const Catalogue& catalogue, const std::string& words);

}  // namespace gable::language
