// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What an editor wants to know of rule files while they are being written: mistakes and their
// remedies, what can be written here, what a name means and where else it stands.
//
//   gable::language::Workspace workspace({"/town"});
//   workspace.open("/town/rules/house.cga", text);
//   for (const auto& file : workspace.diagnostics("/town/rules/house.cga")) ...
//
// All notations have diagnostics, symbols, colours and folds; what a notation cannot offer is
// empty. Files are named by absolute paths; a text that is in no file has any other name, such as
// "untitled:1.cga". Open texts stand for the files of their names. Nothing is ever written,
// nothing throws. One thread at a time may use a workspace.
//
// `gable/lsp.h` serves the same through the language server protocol.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gable/diagnostic.h"
#include "gable/language_places.h"
#include "gable/rule_forms.h"
#include "gable/search.h"

namespace gable::language {

struct Place {
  std::string path;
  Range range;
  bool operator==(const Place&) const = default;
};

struct Edit {
  Range range;
  std::string text;
};

struct FileEdits {
  std::string path;
  std::vector<Edit> edits;
};

/// A part of a text that is replaced; without a range the whole text.
struct Change {
  std::optional<Range> range;
  std::string text;
};

/// A gable::Diagnostic with its place as editors count.
struct Diagnostic {
  gable::Diagnostic::Severity severity = gable::Diagnostic::Severity::Error;
  std::string code;
  Range range;
  std::string message, hint;
  bool operator==(const Diagnostic&) const = default;
};

struct FileDiagnostics {
  std::string path;
  std::vector<Diagnostic> diagnostics;
};

enum class NameKind : uint8_t {
  Rule,
  Leaf,
  Attribute,
  Constant,
  Function,
  Parameter,
  Import,
  Style,
  Operation,
  BuiltinFunction,
  ShapeAttribute,
  Selector,
  Annotation,
  Keyword,
  File,
  Color,
  Value,
};

struct Symbol {
  std::string name;
  /// Parameters, or the type and value of an attribute.
  std::string detail;
  NameKind kind = NameKind::Rule;
  std::string path;
  /// With annotations and the words before the name.
  Range range;
  Range nameRange;
};

struct Completion {
  std::string label;
  NameKind kind = NameKind::Rule;
  /// A signature, a type, a file name.
  std::string detail;
  /// One sentence, or empty.
  std::string summary;
  /// What is written in place of `range`; with `snippet` it has places to fill in: ${1:name}.
  std::string text;
  bool snippet = false;
  Range range;
  /// What the typed word is held against where it is not the label: a word that finds it.
  std::string filter;
  /// Lower is nearer to what is meant.
  uint32_t order = 0;
  /// The word as it was typed, which Enter shall keep.
  bool preselect = false;
  /// The path of the picture that is offered; empty for all else.
  std::string picture;
};

struct Completions {
  std::vector<Completion> items;
  /// There are more; ask again when more is typed.
  bool partial = false;
};

struct SignatureHelp {
  struct Parameter {
    /// Bytes of `label` that show it.
    uint32_t begin = 0, end = 0;
    std::string doc;
  };
  struct Signature {
    std::string label;
    std::string doc;
    std::vector<Parameter> parameters;
  };
  std::vector<Signature> signatures;
  uint32_t activeSignature = 0, activeParameter = 0;
};

struct Hover {
  Range range;
  /// Markdown.
  std::string text;
};

struct Color {
  Range range;
  /// 0 to 1.
  double red = 0, green = 0, blue = 0, alpha = 1;
};

struct Fold {
  uint32_t beginLine = 0, endLine = 0;
  enum class Kind : uint8_t { Code, Comment, Imports } kind = Kind::Code;
};

struct InlayHint {
  Position at;
  std::string label;
  /// The value of an attribute, behind what is written; else the name of a parameter, before it.
  bool value = false;
};

/// What a word is, for colouring it. Words of the text in its order.
struct Highlight {
  Range range;
  enum class Kind : uint8_t {
    Comment,
    Keyword,
    String,
    Number,
    Operator,
    Rule,
    Leaf,
    Operation,
    Function,
    Attribute,
    Parameter,
    Selector,
    Annotation,
    Namespace,
  } kind = Kind::Comment;
  bool declaration = false;
  bool constant = false;
  bool builtIn = false;
};

struct Action {
  std::string title;
  std::vector<FileEdits> edits;
  /// The code and place of what it mends; empty for none.
  std::string code;
  Range range;
  /// The one that is meant when no choice is asked for.
  bool preferred = false;
};

/// What a change of name would do, or why it cannot be.
struct Renaming {
  bool ok = false;
  std::string trouble;
  std::vector<FileEdits> edits;
};

/// Something built in that a search found.
struct Entry {
  std::string name;
  NameKind kind = NameKind::Operation;
  std::string summary;
};

class Workspace {
 public:
  /// `project`: the folder that texts and what they name are read in, and nothing outside of it;
  /// empty: of each text the folder that looks like its project. `search`: where else.
  explicit Workspace(std::vector<std::string> folders = {}, const std::string& project = {},
                     const SearchSettings& search = {});
  ~Workspace();
  Workspace(Workspace&&) noexcept;
  Workspace& operator=(Workspace&&) noexcept;

  // --- Texts ---
  void open(const std::string& path, std::string text);
  /// False when the text is not open.
  bool change(const std::string& path, const std::vector<Change>& changes);
  void close(const std::string& path);
  bool isOpen(const std::string& path) const;
  std::vector<std::string> openTexts() const;
  /// As it is open, else as it is on disk; empty when there is none.
  std::string text(const std::string& path) const;
  void setFolders(std::vector<std::string> folders);
  const std::vector<std::string>& folders() const;
  /// Files may have changed on disk: lists of files are made anew.
  void refresh();

  // --- The whole text; all but diagnostics and rename are answered for a text with mistakes too
  // ---
  /// The mistakes of an open text and of the files that it imports.
  std::vector<FileDiagnostics> diagnostics(const std::string& path);
  std::vector<Symbol> symbols(const std::string& path);
  std::vector<Highlight> highlights(const std::string& path);
  std::vector<Color> colors(const std::string& path);
  /// How a colour may be written in the place of the one that stands at its range.
  std::vector<std::string> colorTexts(const std::string& path, const Color& color);
  std::vector<Fold> folds(const std::string& path);
  std::vector<InlayHint> inlayHints(const std::string& path, const Range& range);
  /// What the attributes that a text declares are in the shape that was derived last; hints show
  /// it.
  void setValues(const std::string& path, std::map<std::string, std::string> values);
  /// Edits that put a text into canonical form; nothing for one with mistakes.
  std::vector<Edit> format(const std::string& path);

  // --- A place in it ---
  /// Answered from the last analysis, so that it is there at once while one types.
  Completions complete(const std::string& path, Position at);
  SignatureHelp signatureHelp(const std::string& path, Position at);
  std::optional<Hover> hover(const std::string& path, Position at);
  std::vector<Place> definition(const std::string& path, Position at);
  std::vector<Place> references(const std::string& path, Position at, bool withDeclaration);
  /// What is written as the value of an attribute, by the name that it has seen from a text:
  /// "window.sill" for one of an import; none where it has no value.
  std::optional<Place> attributeValue(const std::string& path, const std::string& name);
  /// Where in the same text the name at a place stands.
  std::vector<Range> occurrences(const std::string& path, Position at);
  /// The name that can be changed there; none: it cannot.
  std::optional<Place> renamable(const std::string& path, Position at);
  Renaming rename(const std::string& path, Position at, const std::string& name);
  std::vector<Action> actions(const std::string& path, const Range& range);

  // --- Rules as forms ---
  /// `rule`: the name of the one that is looked at; empty: the first.
  TextForm form(const std::string& path, const std::string& rule);
  /// Edits that make a rule of GBBG say what a form says, word by word; none when there is no such
  /// rule, or it cannot be read.
  std::optional<std::vector<Edit>> formEdits(const std::string& path, const std::string& rule,
                                             const BoxRule& box);

  // --- The project ---
  /// Rules, attributes and functions of all rule files whose names have the letters of `query`.
  std::vector<Symbol> projectSymbols(const std::string& query);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A rule of GBBG as it is written, with as many successors as it needs.
std::string boxRuleText(const BoxRule& box);

/// The reference page of something built in, as Markdown; empty when there is none of that name.
std::string referencePage(const std::string& name);

/// What is built in, by name, by what it does or by an everyday word: "cut" finds split.
std::vector<Entry> search(const std::string& words);

}  // namespace gable::language
