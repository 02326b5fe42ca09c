// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/dialect.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "base/text.h"
#include "dialects/gbbg/gbbg.h"
#include "dialects/park/park.h"
#include "dialects/progen3d/progen3d.h"

namespace gable {

std::span<const Dialect* const> dialects() {
  // One line a dialect, by name.
  static const Dialect* const kAll[] = {&kGbbgDialect, &kParkDialect, &kProgen3d};
  return kAll;
}

const Dialect* dialectNamed(std::string_view name) {
  for (const Dialect* d : dialects()) {
    if (name == d->name) return d;
  }
  return nullptr;
}

const Dialect* dialectOfPath(std::string_view path) {
  const std::string lower = lowerCase(path);
  for (const Dialect* d : dialects()) {
    for (const char* extension : d->extensions) {
      if (lower.ends_with(extension)) return d;
    }
  }
  return nullptr;
}

namespace {

// Keywords that a hint names in quotes or with what follows them, and signs of rules.
constexpr std::string_view kKeywords[] = {"attr",    "const",  "import",    "style", "extends",
                                          "version", "inline", "otherwise", "NIL",   "split",
                                          "local",   "do",     "repeat",    "comp"};
constexpr std::string_view kSigns[] = {"-->", "@", "gable format", ".cga"};

bool isPartOfName(char c) {
  return c == '_' || c == '.' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
         (c >= 'A' && c <= 'Z');
}

bool isWordOf(const Dialect& dialect, std::string_view word) {
  if (!dialect.words) return false;
  for (const DialectWord& w : dialect.words()) {
    if (equalButForCase(w.name, word)) return true;
  }
  return false;
}

void translate(const Dialect& dialect, Diagnostics::Entry& d, const Catalogue& catalogue) {
  for (const Remedy& r : dialect.remedies) {
    if (r.code == d.code) d.hint = r.hint;
  }
  // The words of an argument are those that the notation hands on.
  const bool word = d.code == "unknown-selector" && d.hint.starts_with("did you mean '");
  if (word || !namesForeignWord(dialect, d.hint, catalogue)) return;
  d.hint = dialect.guide;
  d.fix.reset();
}

}  // namespace

bool namesForeignWord(const Dialect& dialect, std::string_view hint, const Catalogue& catalogue) {
  for (const std::string_view sign : kSigns) {
    if (hint.find(sign) != hint.npos) return true;
  }
  for (size_t at = 0; at < hint.size();) {
    size_t end = at;
    while (end < hint.size() && isPartOfName(hint[end])) ++end;
    if (end == at) {
      ++at;
      continue;
    }
    const std::string_view word = hint.substr(at, end - at);
    const bool quoted = at > 0 && hint[at - 1] == '\'';
    const bool called = end < hint.size() && hint[end] == '(';
    // Keywords stand alone as well: "otherwise : ...".
    const bool opens = hint.substr(end).starts_with(" :") || hint.substr(end).starts_with(" {");
    at = end;
    if ((!quoted && !called && !opens) || isWordOf(dialect, word)) continue;
    const bool keyword =
        std::find(std::begin(kKeywords), std::end(kKeywords), word) != std::end(kKeywords);
    if (keyword || catalogue.operation(word) || catalogue.function(word) ||
        catalogue.attribute(word)) {
      return true;
    }
  }
  return false;
}

Diagnostics inWordsOf(const Dialect* dialect, const Diagnostics& diagnostics,
                      const Catalogue& catalogue) {
  if (!dialect) return diagnostics;
  Diagnostics out;
  for (Diagnostics::Entry d : diagnostics.all()) {
    translate(*dialect, d, catalogue);
    out.add(std::move(d));
  }
  return out;
}

Diagnostics inWordsOf(const Dialect* dialect, uint32_t file, const Diagnostics& diagnostics,
                      const Sources& sources, const Catalogue& catalogue) {
  Diagnostics out;
  // Where the notation itself has found an error: it reports first.
  std::set<std::pair<uint32_t, uint32_t>> found;
  for (Diagnostics::Entry d : diagnostics.all()) {
    const Dialect* own = d.span.file == file ? dialect
                         : d.span.valid()    ? dialectOfPath(sources.path(d.span.file))
                                             : nullptr;
    if (own && d.severity == Severity::Error) {
      if (!found.insert({d.span.file, d.span.begin}).second) continue;
    }
    if (own) translate(*own, d, catalogue);
    out.add(std::move(d));
  }
  return out;
}

}  // namespace gable
