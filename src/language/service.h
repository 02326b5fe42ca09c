// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The questions of an editor, each answered from a text, its tree or an analysis. Paths are
// canonical here; gable/language.h says what the answers mean.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gable/language.h"
#include "language/cursor.h"
#include "language/library.h"
#include "language/names.h"

namespace gable::language {

/// The declarations of a text in its order.
std::vector<Symbol> symbolsOf(const Parsed& parsed, const std::string& path);
std::vector<Color> colorsOf(const Parsed& parsed);
std::vector<std::string> colorTextsOf(const Parsed& parsed, const Color& color);
std::vector<Fold> foldsOf(const Parsed& parsed);
std::vector<InlayHint> inlayHintsOf(const Parsed& parsed, const Snapshot& snapshot, Range range,
                                    const Catalogue& catalogue);
/// What attributes have been set to, where it is not what is written.
std::vector<InlayHint> valueHintsOf(const Parsed& parsed, const Range& range,
                                    const std::map<std::string, std::string>& values);
std::vector<Highlight> highlightsOf(const Parsed& parsed, const Snapshot& snapshot,
                                    const Catalogue& catalogue);
std::vector<Edit> formatEdits(const Parsed& parsed, const std::string& path);

Completions completionsAt(Library& library, const std::string& path, const Lexed& lexed,
                          uint32_t offset);
SignatureHelp signatureHelpAt(Library& library, const std::string& path, const Lexed& lexed,
                              uint32_t offset);
std::optional<Hover> hoverAt(Library& library, const std::string& path, const Parsed& parsed,
                             uint32_t offset);

std::vector<Place> definitionAt(Library& library, const std::string& path, uint32_t offset);
/// `files` are those in which to look besides what the text itself imports.
std::vector<Place> referencesAt(Library& library, const std::string& path, uint32_t offset,
                                bool withDeclaration, const std::vector<std::string>& files);
std::optional<Place> renamableAt(Library& library, const std::string& path, uint32_t offset);
Renaming renameAt(Library& library, const std::string& path, uint32_t offset,
                  const std::string& name, const std::vector<std::string>& files);
std::vector<Action> actionsOf(const Snapshot& snapshot, const Text& text, uint32_t begin,
                              uint32_t end);

/// `name` of a declaration with parameters in brackets.
std::string headText(const lang::Tree& tree, lang::NodeId declaration);

/// A symbol and how its declaration reads, for one declaration of a tree.
struct Declared {
  NameKind kind;
  std::string_view word;
  lang::NodeId node;
};
std::vector<Declared> declaredIn(const lang::Tree& tree);

/// What a word of another notation does, in a sentence.
std::string wordText(const DialectWord& word, const Catalogue& catalogue);

/// The texts of the pages of the reference, by name of what is built in.
std::string pageOf(std::string_view name);

/// Everyday words that lead to something built in.
struct Alias {
  const char* word;
  const char* name;
};
std::span<const Alias> aliases();

}  // namespace gable::language
