// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rule files: reading, analysing, formatting, and converting them from other notations.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gable/diagnostic.h"
#include "gable/limits.h"
#include "gable/search.h"

namespace gable {

struct LoadSettings {
  /// The folder that rules may read from. Absent: the folder of the workspace that the rule file
  /// lies in, else the nearest folder above the rule file that holds a `rules` or an `assets`
  /// folder, else the rule file's own.
  std::optional<std::string> project;
  /// The notation: "cga", "gbbg", "park", ... Absent: by the file's extension.
  std::optional<std::string> dialect;
  /// One of styles(); absent: "Default".
  std::optional<std::string> style;
  SearchSettings search;
  /// Texts that stand for files of the project while they are being edited, by project path
  /// ("rules/windows.cga").
  std::vector<std::pair<std::string, std::string>> overlay;
  /// Rules of the same project as they were before: assets that they have read are not read again,
  /// nor are changes of their files seen, and models made by them are of use to
  /// DeriveSettings::before. May be null.
  const class Rules* before = nullptr;
  FileLimits limits;
};

struct AttributeInfo {
  std::string name;
  /// "float", "bool", "string", "float[]", ...
  std::string type;
  bool hidden = false;
  /// Annotations as name and arguments: {"Range", {{"min","0"},{"max","10"}}}. Each @Handle is one
  /// of them, with its arguments as they are written.
  struct Annotation {
    std::string name;
    std::vector<std::pair<std::string, std::string>> arguments;
  };
  std::vector<Annotation> annotations;
};

struct RuleInfo {
  std::string name;
  size_t parameters = 0;
  /// Marked as one to start with, by @StartRule or as its notation has it.
  bool start = false;
  std::string file;
  uint32_t line = 0;
  bool hidden = false;
  /// What the start shape is expected to be (InPolygon, ...), and the like.
  std::vector<AttributeInfo::Annotation> annotations;
};

/// An import of the rule file, or of one that it imports.
struct ImportInfo {
  /// With the imports around it: "house.window".
  std::string name;
  /// As it is written.
  std::string path;
  /// The file that was read; empty where there is none.
  std::string file;
};

/// A file that rules name as a model, a picture or a table. Paths that they compute are not known
/// before they run.
struct AssetUse {
  /// As it is written, and in which rule file.
  std::string path, from;
  /// The file that is meant; empty where there is none.
  std::string file;
  bool operator==(const AssetUse&) const = default;
};

/// A rule file with all it imports, compiled.
class Rules {
 public:
  /// Reads, parses, analyses and compiles. The diagnostics of all stages are collected.
  static Rules load(const std::string& path, const LoadSettings& settings = {});
  /// The same for text that is in memory; `path` names it in diagnostics and places it in the
  /// project.
  static Rules parse(const std::string& text, const std::string& path,
                     const LoadSettings& settings = {});

  /// No errors: the rules can be derived.
  bool ok() const;
  /// False when the file itself could not be read.
  bool found() const;
  const DiagnosticList& diagnostics() const;
  std::vector<AttributeInfo> attributes() const;
  std::vector<RuleInfo> rules() const;
  std::vector<ImportInfo> imports() const;
  /// Each file that is named, once, in the order of the text.
  const std::vector<AssetUse>& assets() const;
  /// What the rule file says of itself (@RuleFileDescription).
  const std::string& description() const;
  /// "Default", the styles that the rule file declares, and those that its imports offer
  /// ("windows.Gothic").
  const std::vector<std::string>& styles() const;
  /// The rule that a derivation starts with unless told otherwise.
  std::optional<std::string> startRule() const;
  double parseSeconds() const;
  /// A listing of the compiled program; empty when there is none.
  std::string disassembly() const;

  struct Impl;
  explicit Rules(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  const Impl& impl() const { return *impl_; }
  const std::shared_ptr<const Impl>& shared() const { return impl_; }

 private:
  std::shared_ptr<const Impl> impl_;
};

/// Writes a package with the rule files that the rules import and the assets of their projects:
/// .rpk (which is 7z) or .zip, by the extension of `path`. The same files give the same bytes.
/// Codes: package-kind, package-too-large, archive-unwritable, file-unwritable, and those of
/// reading.
struct Packed {
  bool ok = false;
  uint64_t files = 0;
  uint64_t bytes = 0;
  DiagnosticList diagnostics;
};
Packed pack(const Rules& rules, const std::string& path, const FileLimits& limits = {});

/// Rule text in canonical form. Text with mistakes comes back unchanged, with diagnostics.
struct Formatted {
  std::string text;
  DiagnosticList diagnostics;
};
Formatted format(const std::string& text, const std::string& path, const FileLimits& limits = {});

/// Rule text of another notation as text of Gable's own language. Both derive to the same model.
/// Text of Gable's own language comes back formatted; with mistakes the text is empty.
struct Converted {
  std::string text;
  DiagnosticList diagnostics;
};
Converted convert(const std::string& text, const std::string& path,
                  const LoadSettings& settings = {});

}  // namespace gable
