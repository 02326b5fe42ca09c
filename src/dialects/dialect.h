// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The notations that Gable reads besides its own language. A dialect is a parser that lowers its
// text to the neutral tree of lang/tree.h; from there on nothing knows of it. Every node keeps its
// span in the dialect's text, so that messages and traces point there.
//
// Promises: any text gives a tree with a File root; mistakes are reported, all of them in one run,
// and what is right beside them is lowered all the same. A tree from a text without errors can be
// printed (lang/print.h) and parsed to the same tree.
//
// To add a dialect: a folder here with a README, and a line in dialect.cpp.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/diagnostic.h"
#include "lang/sema/analyse.h"
#include "lang/tree.h"
#include "program/spec.h"

namespace gable {

struct DialectInput {
  const Sources& sources;
  uint32_t file;
  /// What the tree may name: the names of a dialect's author must not clash with it.
  const Catalogue& catalogue;
  /// Brings other files that a text names; null where there are none.
  lang::FileLoader* loader = nullptr;
};

/// What to do about a diagnostic of the analysis or the derivation, in the words of a notation.
struct Remedy {
  std::string_view code;
  const char* hint;
};

/// A word of a notation, for editors.
struct DialectWord {
  const char* name;
  /// How it is written.
  const char* call;
  /// The operation that carries it out; null for none.
  const char* operation;
  /// One sentence; empty where the operation's own says it.
  const char* text;
  /// To write in its place, with places to fill in: ${1:X}; empty: the name.
  const char* snippet;
};

struct Dialect {
  /// What --dialect takes.
  const char* name;
  /// As its users call it.
  const char* title;
  /// With the dot, in lower case.
  std::span<const char* const> extensions;
  lang::Tree (*parse)(const DialectInput& input, Diagnostics& diagnostics);
  /// The text in canonical form, or as it is when it has mistakes.
  std::string (*format)(const Sources& sources, uint32_t file, Diagnostics& diagnostics);
  /// In place of the hints that speak Gable's own language.
  std::span<const Remedy> remedies = {};
  /// Seeds are signed whole numbers of 32 bits.
  bool wholeSeeds = false;
  /// What can be written, besides the author's own names; null where that is not told.
  std::span<const DialectWord> (*words)() = nullptr;
  /// Why values from outside have no effect on hidden attributes; null where they have.
  const char* hiddenReason = nullptr;
  /// In place of a hint that names words of Gable's own language and has no remedy.
  const char* guide = "";
  /// Words behind which a name is declared that is no rule: "fun Edge", "R floors".
  std::span<const char* const> declaring = {};
};

/// All dialects, by name.
std::span<const Dialect* const> dialects();
/// Null when there is none of that name.
const Dialect* dialectNamed(std::string_view name);
/// By the extension of a path, whatever its case; null for Gable's own language.
const Dialect* dialectOfPath(std::string_view path);

/// The diagnostics of a derivation with the notation's own hints; null is Gable's own language.
Diagnostics inWordsOf(const Dialect* dialect, const Diagnostics& diagnostics,
                      const Catalogue& catalogue);
/// The same for those of an analysis: of a file in `dialect`, and of other files by their paths.
/// An error that stands where the notation found one is left out: it only follows from that.
Diagnostics inWordsOf(const Dialect* dialect, uint32_t file, const Diagnostics& diagnostics,
                      const Sources& sources, const Catalogue& catalogue);
/// Whether a hint names an operation, a function or a keyword of Gable's own language that is no
/// word of the notation.
bool namesForeignWord(const Dialect& dialect, std::string_view hint, const Catalogue& catalogue);

}  // namespace gable
