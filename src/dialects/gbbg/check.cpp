// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/gbbg/check.h"

#include <set>

#include "base/text.h"
#include "dialects/proposal.h"

namespace gable::gbbg {

namespace {

constexpr std::string_view kStart = "START";
constexpr std::string_view kEmpty = "EMPTY";

std::string quote(std::string_view s) { return "'" + std::string(s) + "'"; }

class Checker {
 public:
  Checker(const Grammar& grammar, Diagnostics& diagnostics)
      : grammar_(grammar), diagnostics_(diagnostics), broken_(diagnostics.hasErrors()) {}

  Vocabulary run() {
    for (const Statement& s : grammar_.statements) {
      if (s.kind == StatementKind::Rule) addRule(s.rule);
      if (s.kind == StatementKind::Select) out_.selection = s.selection;
    }
    for (const Statement& s : grammar_.statements) {
      for (const ShapeLine& line : s.shapes) declare(line);
    }
    for (const Statement& s : grammar_.statements) {
      for (const Start& start : s.starts) {
        out_.starts.push_back(&start);
        reached_.insert(start.symbol.text);
        symbol(start.symbol);
      }
      if (s.kind == StatementKind::Rule) addSuccessors(s.rule);
    }
    if (out_.starts.empty()) reached_.emplace(kStart);
    for (const Statement& s : grammar_.statements) {
      for (const AssetLine& line : s.assets) addAsset(line);
    }
    checkStart();
    for (SymbolInfo& s : out_.symbols) checkSymbol(s);
    return std::move(out_);
  }

 private:
  SymbolInfo& symbol(const Symbol& s) {
    const auto [it, fresh] = out_.index.emplace(s.text, out_.symbols.size());
    if (fresh) {
      SymbolInfo info;
      info.name = s.text;
      info.span = s.span;
      if (s.text == kEmpty) {
        info.terminal = info.declared = true;
        info.dimensions = Dimensions::Empty;
      }
      out_.symbols.push_back(std::move(info));
    }
    return out_.symbols[it->second];
  }

  void addRule(const Rule& r) { symbol(r.predecessor).rules.push_back(&r); }

  void declare(const ShapeLine& line) {
    SymbolInfo& s = symbol(line.symbol);
    if (s.declared) {
      diagnostics_.warning("gbbg-duplicate-shape", line.symbol.span,
                           quote(line.symbol.text) + " is declared before; the first line counts",
                           "remove this one");
      return;
    }
    s.declared = true;
    s.terminal = line.terminal || line.dimensions == Dimensions::Empty;
    s.dimensions = line.dimensions;
    s.preferred = line.preferred;
  }

  void addSuccessors(const Rule& r) {
    for (const Slot& slot : r.slots) {
      for (const Possibility& p : slot.possibilities) {
        symbol(p.symbol);
        reached_.insert(p.symbol.text);
      }
    }
  }

  void addAsset(const AssetLine& line) {
    SymbolInfo* s = out_.find(line.symbol.text);
    if (!s && broken_) return;
    if (!s) {
      const std::string nearest = near(line.symbol.text, names());
      diagnostics_.warning("gbbg-unknown-symbol", line.symbol.span,
                           "no shape of this grammar is " + quote(line.symbol.text),
                           meaning(nearest));
      propose(diagnostics_, line.symbol.span, line.symbol.text, nearest);
      return;
    }
    if (!s->terminal) {
      diagnostics_.warning("gbbg-not-terminal", line.symbol.span,
                           quote(line.symbol.text) + " is no terminal shape; its asset is not used",
                           "declare it: 'terminal " + line.symbol.text + "'");
      return;
    }
    if (s->asset) {
      diagnostics_.warning("gbbg-duplicate-asset", line.symbol.span,
                           quote(line.symbol.text) + " has an asset before; the first one counts",
                           "remove this line");
      return;
    }
    s->asset = &line;
  }

  void checkStart() {
    if (broken_ || !out_.starts.empty() || out_.find(kStart)) return;
    diagnostics_.error("gbbg-no-start", {grammar_.file, 0, 0},
                       "the grammar has no shape to begin with",
                       "add 'axiom NAME size (30, 30, 30)', or a rule for START");
  }

  void checkSymbol(SymbolInfo& s) {
    if (s.terminal && !s.rules.empty()) {
      for (const Rule* r : s.rules) {
        diagnostics_.warning("gbbg-terminal-rule", r->predecessor.span,
                             quote(s.name) + " is a terminal shape, so this rule never applies",
                             "declare it with 'shape' instead of 'terminal', or remove the rule");
      }
      s.rules.clear();
    }
    const bool reached = reached_.count(s.name) > 0;
    if (!broken_ && !s.rules.empty() && !reached && s.name != kStart) {
      const std::string nearest = near(s.name, reachedNames());
      diagnostics_.warning("gbbg-unknown-predecessor", s.rules[0]->predecessor.span,
                           "nothing becomes " + quote(s.name) + ", so this rule never applies",
                           meaning(nearest));
      propose(diagnostics_, s.rules[0]->predecessor.span, s.name, nearest);
    }
    if (!broken_ && s.rules.empty() && !s.terminal && reached) {
      const std::string nearest = near(s.name, namesWithMeaning());
      diagnostics_.warning(
          "gbbg-no-rule", s.span,
          "there is no rule for the non-terminal shape " + quote(s.name) + "; it stays as it is",
          nearest.empty() ? "write a rule for it, or declare it: 'terminal " + s.name + "'"
                          : meaning(nearest));
      propose(diagnostics_, s.span, s.name, nearest);
    }
    if (out_.selection != Selection::First) return;
    for (size_t i = 1; i < s.rules.size(); ++i) {
      diagnostics_.warning("duplicate-rule", s.rules[i]->predecessor.span,
                           quote(s.name) + " has a rule before; the first one counts",
                           "write 'select random' to draw one, or remove this one");
    }
  }

  // Looking for the nearest name takes time: not for more mistakes than anyone reads.
  std::string near(std::string_view name, const std::vector<std::string_view>& known) {
    return ++hints_ > 100 ? std::string() : nearestName(name, known);
  }
  std::vector<std::string_view> names() const {
    std::vector<std::string_view> list;
    for (const SymbolInfo& s : out_.symbols) list.emplace_back(s.name);
    return list;
  }
  // Of shapes that end there or have rules.
  std::vector<std::string_view> namesWithMeaning() const {
    std::vector<std::string_view> list;
    for (const SymbolInfo& s : out_.symbols) {
      if (s.terminal || !s.rules.empty()) list.emplace_back(s.name);
    }
    return list;
  }
  std::vector<std::string_view> reachedNames() const { return {reached_.begin(), reached_.end()}; }

  const Grammar& grammar_;
  Diagnostics& diagnostics_;
  /// Statements are missing, so nothing is said of what they may have held.
  bool broken_;
  Vocabulary out_;
  int hints_ = 0;
  /// What the axiom or a rule makes.
  std::set<std::string, std::less<>> reached_;
};

}  // namespace

Vocabulary checked(const Grammar& grammar, Diagnostics& diagnostics) {
  return Checker(grammar, diagnostics).run();
}

}  // namespace gable::gbbg
