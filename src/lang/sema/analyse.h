// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The analysis: loads imports, resolves every name, infers types, checks calls against the
// catalogue and reports every mistake. See resolved.h for what it yields.
//
// Names: within a successor a parameterless or called name is an operation if the catalogue has one
// with that many arguments, else a rule, else a leaf (warning). Soft operations give way to rules
// of the same name. Within an expression parameters and local variables come first, then functions,
// attributes and constants of the file, then built-in functions and shape attributes, then selector
// words. Where a selector is asked for, a word that is known as one wins over attributes.
#pragma once

#include <string>

#include "base/diagnostic.h"
#include "base/result.h"
#include "base/status.h"
#include "lang/sema/resolved.h"
#include "lang/tree.h"
#include "program/spec.h"
#include "program/value.h"

namespace gable::lang {

/// That there is no file of an imported path; the analysis goes on without it. Code:
/// import-not-found.
Error missingImport(const std::string& path);

/// Brings the texts of imported files; decides what a path means and what may be read.
class FileLoader {
 public:
  struct File {
    /// The same file always has the same path, so that cycles are seen.
    std::string path;
    std::string text;
  };
  virtual ~FileLoader() = default;
  /// `path` as written in the import of the file `importer` (a path that load returned, or the main
  /// file's).
  virtual Result<File> load(const std::string& path, const std::string& importer) = 0;
  /// Whether there is a file that rules can use as an asset, by the path as they write it.
  virtual bool exists(const std::string& path, const std::string& importer);
  /// The files that rules can use as assets, as the rules would write them.
  virtual std::vector<std::string> assets(const std::string& importer);
  /// What to write in the place of the name of a material that there is not.
  virtual std::string materialHint(const std::string& name);
  /// Fails where a tint of a material is brighter than that and does not come out.
  virtual Status takesTint(const std::string& material, const std::string& tint);
  /// The tree of a file that load gave: its notation may be another than this language's.
  virtual TreeRef parse(const Sources& sources, uint32_t file, Diagnostics& diagnostics);
  /// The files of the project that a folder such as "/gable/" names, as rules write them: with that
  /// folder before them. Empty for a folder that names none.
  virtual std::vector<std::string> filesIn(const std::string& folder, const std::string& importer);
};

struct AnalysisInput {
  /// The main file, parsed, and its path.
  TreeRef tree;
  std::string path;
  /// The style to derive; "" and "Default" are the same.
  std::string style;
  /// All rules of all modules count as reached; see ResolvedProgram.
  bool everything = false;
};

/// `loader` may be null: imports are then reported as missing. Texts of imported files are added to
/// `sources`.
ResolvedProgram analyse(AnalysisInput input, const Catalogue& catalogue, ValuePool& values,
                        FileLoader* loader, Sources& sources, Diagnostics& diagnostics);

}  // namespace gable::lang
