// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// `use "file"` puts the statements of another grammar in its place. The tree has one file, so what
// comes from there has the place of the statement, and its mistakes are told there.

#include "dialects/gbbg/gbbg.h"

#include <set>
#include <string>
#include <utility>

#include "dialects/gbbg/check.h"
#include "dialects/gbbg/lower.h"
#include "dialects/gbbg/parser.h"
#include "dialects/gbbg/print.h"

namespace gable {

namespace {

using gbbg::Grammar;
using gbbg::Statement;
using gbbg::StatementKind;

// A grammar that uses more files than this is a mistake.
constexpr size_t kMaxFiles = 200;

class Expander {
 public:
  Expander(const DialectInput& input, Diagnostics& diagnostics)
      : input_(input), diagnostics_(diagnostics) {
    used_.insert(input.sources.path(input.file));
  }

  Grammar run(Grammar grammar) {
    Grammar out;
    // Files wait on a stack of their own instead of the machine's.
    struct Open {
      Grammar grammar;
      size_t next = 0;
      std::string path;
      Span place;
    };
    std::vector<Open> open;
    open.push_back({std::move(grammar), 0, input_.sources.path(input_.file), {}});
    while (!open.empty()) {
      Open& top = open.back();
      if (top.next == top.grammar.statements.size()) {
        open.pop_back();
        continue;
      }
      Statement s = std::move(top.grammar.statements[top.next++]);
      if (s.kind != StatementKind::Use) {
        out.statements.push_back(std::move(s));
        continue;
      }
      Open next;
      next.place = top.place.valid() ? top.place : s.span;
      if (load(s.path, top.path, next.place, next.grammar, next.path)) {
        open.push_back(std::move(next));
      }
    }
    return out;
  }

 private:
  bool load(const std::string& path, const std::string& from, Span place, Grammar& out,
            std::string& found) {
    const auto fail = [&](std::string message, std::string hint) {
      diagnostics_.error("gbbg-use", place, std::move(message), std::move(hint));
      return false;
    };
    if (!input_.loader)
      return fail("no other files can be used here", "put the rules into this one");
    if (used_.size() >= kMaxFiles) {
      return fail("this grammar uses more than " + std::to_string(kMaxFiles) + " files",
                  "put some of them together");
    }
    Result<lang::FileLoader::File> file = input_.loader->load(path, from);
    if (!file.ok()) return fail(file.error().message, file.error().hint);
    // A file counts once, however often it is used.
    if (!used_.insert(file->path).second) return false;
    found = file->path;
    Sources sources;
    const uint32_t number = sources.add(file->path, file->text);
    Diagnostics inner;
    out = gbbg::parse(sources.text(number), number, inner);
    for (const Diagnostics::Entry& d : inner.all()) {
      const LineColumn at = sources.locate(number, d.span.begin);
      diagnostics_.add({d.severity,
                        d.code,
                        place,
                        file->path + ":" + std::to_string(at.line) + ":" +
                            std::to_string(at.column) + ": " + d.message,
                        d.hint,
                        {}});
    }
    move(out, place);
    return true;
  }

  static void move(Grammar& grammar, Span place) {
    for (Statement& s : grammar.statements) {
      s.span = place;
      for (auto& start : s.starts) start.symbol.span = place;
      for (auto& shape : s.shapes) shape.symbol.span = place;
      for (auto& asset : s.assets) asset.symbol.span = place;
      s.rule.predecessor.span = s.rule.opSpan = place;
      for (auto& slot : s.rule.slots) {
        slot.span = place;
        for (auto& p : slot.possibilities) p.symbol.span = place;
      }
    }
  }

  const DialectInput& input_;
  Diagnostics& diagnostics_;
  std::set<std::string> used_;
};

lang::Tree parseGbbg(const DialectInput& input, Diagnostics& diagnostics) {
  const std::string_view text = input.sources.text(input.file);
  Grammar grammar = gbbg::parse(text, input.file, diagnostics);
  grammar = Expander(input, diagnostics).run(std::move(grammar));
  gbbg::Vocabulary vocabulary = gbbg::checked(grammar, diagnostics);
  return gbbg::lower(grammar, vocabulary, input.catalogue, input.file,
                     static_cast<uint32_t>(text.size()));
}

std::string formatGbbg(const Sources& sources, uint32_t file, Diagnostics& diagnostics) {
  const std::string_view text = sources.text(file);
  const Grammar grammar = gbbg::parse(text, file, diagnostics);
  return diagnostics.hasErrors() ? std::string(text) : gbbg::print(grammar);
}

constexpr const char* kExtensions[] = {".gbbg"};
// Names that are no rules.
constexpr const char* kDeclaring[] = {"shape", "terminal"};

constexpr Remedy kRemedies[] = {
    {"endless-rule", "let one of the shapes be terminal: 'terminal NAME'"},
    {"recursion-too-deep", "let one of the shapes be terminal: 'terminal NAME'"},
    {"split-too-many", "give the successor a larger preferred size: 'shape NAME [3, 3, 0]'"},
    {"too-many-children", "give the successor a larger preferred size: 'shape NAME [3, 3, 0]'"},
    {"too-many-shapes", "let the recursion end in a terminal shape, or raise --max-shapes"},
};

}  // namespace

const Dialect kGbbgDialect = {
    "gbbg",    "GBBG", kExtensions, parseGbbg, formatGbbg,
    kRemedies, true,   gbbg::words, nullptr,   "see the guide to GBBG, docs/guide/gbbg.md",
    kDeclaring};

}  // namespace gable
