// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Texts, their trees, and what the analysis says of them. A tree is made once for a text; an
// analysis is made anew when a text that it has read is another, and kept until then.
//
// Promise: fresh() equals an analysis of the texts as they are, whatever was asked before.
#pragma once

#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostic.h"
#include "base/result.h"
#include "dialects/dialect.h"
#include "lang/sema/resolved.h"
#include "lang/token.h"
#include "lang/tree.h"
#include "language/files.h"
#include "language/text.h"
#include "program/spec.h"
#include "program/value.h"

namespace gable::language {

/// A text with its tokens; those of other notations have none.
struct Lexed {
  Text text;
  const Dialect* dialect = nullptr;
  lang::Tokens tokens;
  /// Of the lexer, and then of the parser; spans are of file 0.
  Diagnostics diagnostics;
};

/// The same with its tree, which of other notations is what they are lowered to.
struct Parsed : Lexed {
  lang::Tree tree;
};

/// A main file with all that it imports, analysed.
struct Snapshot {
  Sources sources;
  Diagnostics diagnostics;
  ValuePool values;
  lang::ResolvedProgram program;
  const Dialect* dialect = nullptr;

  struct Input {
    std::string path;
    uint64_t state;
  };
  /// A file that was looked for, whose text was not read.
  struct Looked {
    std::string written, importer;
    bool asset = false, found = false;
  };
  std::vector<Input> inputs;
  std::vector<Looked> looked;

  const std::string& path(uint32_t unit) const { return program.units[unit].path; }
  std::string_view text(uint32_t unit) const { return sources.text(program.units[unit].file); }
  const lang::Tree& tree(uint32_t unit) const { return *program.units[unit].tree; }
};

class Library {
 public:
  Library(const Catalogue& catalogue, std::unique_ptr<Files> files);
  ~Library();

  const Catalogue& catalogue() const { return catalogue_; }
  Files& files() { return *files_; }

  void open(const std::string& path, std::string text);
  bool change(const std::string& path, const std::vector<Change>& changes);
  void close(const std::string& path);
  bool isOpen(const std::string& path) const { return open_.count(path) != 0; }
  std::vector<std::string> openTexts() const;
  /// None when there is neither an open text nor a file.
  std::optional<std::string> content(const std::string& path);

  /// Null when there is no such text. A tenth of the time of parsed().
  std::shared_ptr<const Lexed> lexed(const std::string& path);
  /// Null when there is no such text.
  std::shared_ptr<const Parsed> parsed(const std::string& path);
  /// The analysis of the texts as they are; null when there is no such text, and when the analysis
  /// would take too long or too much memory: trouble() then says so.
  std::shared_ptr<const Snapshot> fresh(const std::string& path);
  /// The last analysis whatever has changed since, where there is one; else a fresh one.
  std::shared_ptr<const Snapshot> latest(const std::string& path);
  /// Why the last analysis came to no end; none when it did.
  const std::optional<Error>& trouble() const { return trouble_; }
  /// The file that an import means; empty when there is none.
  std::string locate(const std::string& written, const std::string& importer);
  /// Whether there is a model, a picture or the like by the path as rules write it.
  bool hasAsset(const std::string& written, const std::string& importer);

 private:
  class Loader;
  struct Open {
    Text text;
    uint64_t revision = 0;
  };
  struct Kept {
    std::string path;
    std::shared_ptr<const Snapshot> snapshot;
  };
  struct KeptTree {
    uint64_t state = 0;
    std::shared_ptr<const Lexed> lexed;
    /// Null while nobody has asked for it.
    std::shared_ptr<const Parsed> parsed;
  };

  uint64_t state(const std::string& path);
  KeptTree* kept(const std::string& path);
  bool holds(const Snapshot& snapshot);
  std::shared_ptr<const Snapshot> analyse(const std::string& path);
  std::list<Kept>::iterator find(const std::string& path);

  const Catalogue& catalogue_;
  std::unique_ptr<Files> files_;
  std::map<std::string, Open> open_;
  uint64_t revision_ = 0;
  /// Of the last analysis, and of what text it was.
  std::optional<Error> trouble_;
  std::string troublePath_;
  uint64_t troubleState_ = 0;
  std::list<Kept> snapshots_;  // the last used first
  std::map<std::string, KeptTree> trees_;
};

}  // namespace gable::language
