// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/progen3d/uses.h"

#include <algorithm>

namespace gable::progen3d {

namespace {

/// What a number of turns that is no constant is taken for.
constexpr double kUnknownTurns = 8;
/// Recursion makes no estimate grow beyond this.
constexpr double kManyBodies = 1e6;

}  // namespace

Uses::Uses(const Grammar& grammar) : g_(grammar), entries_(grammar.rules.size()) {
  for (const Expression& e : g_.expressions) {
    if (e.kind == Expression::Kind::Name) names_.insert(std::string(e.name));
  }
  for (size_t r = 0; r < g_.rules.size(); ++r) readCalls(r);
  spread();
}

const Uses::Entry& Uses::of(std::string_view rule) const { return entries_[g_.ruleIndex.at(rule)]; }

bool Uses::mayBind(std::string_view rule, std::string_view variable) const {
  return of(rule).bound.count(variable) > 0;
}

void Uses::readCalls(size_t index) {
  const Rule& rule = g_.rules[index];
  Entry& e = entries_[index];
  if (rule.repeat != kNone) {
    const Expression& turns = g_.expressions[rule.repeat];
    e.turns = turns.kind == Expression::Kind::Number ? std::max(0.0, turns.number) : kUnknownTurns;
  }
  e.random = rule.probability != kNone;
  for (const Rule::Draw& d : rule.draws) {
    const Variable* v = g_.variable(d.name);
    if (!v) continue;
    e.bound.insert(d.name);
    e.random = e.random || v->min != v->max;
  }
  for (const Section* s : {&rule.start, &rule.body, &rule.end, &rule.alternate}) {
    for (const Step& step : *s) {
      if (step.kind == Step::Kind::Insert) e.own += 1;
      for (const uint32_t a : step.arguments) {
        std::vector<uint32_t> open{a};
        while (!open.empty()) {
          const Expression& x = g_.expressions[open.back()];
          open.pop_back();
          e.random = e.random || x.kind == Expression::Kind::Draw;
          for (const uint32_t part : {x.left, x.right}) {
            if (part != kNone) open.push_back(part);
          }
        }
      }
      if (step.kind != Step::Kind::Call) continue;
      const auto at = g_.ruleIndex.find(step.name);
      if (at == g_.ruleIndex.end()) continue;
      e.calls.push_back(at->second);
      entries_[at->second].called = true;
    }
  }
}

// To the least fixed point: sets grow, and estimates are bounded by the number of rounds.
void Uses::spread() {
  if (!entries_.empty()) entries_[0].reachable = true;
  for (bool changed = true; changed;) {
    changed = false;
    for (Entry& e : entries_) {
      for (const size_t c : e.calls) {
        Entry& callee = entries_[c];
        const size_t before = callee.bound.size();
        if (&callee != &e) callee.bound.insert(e.bound.begin(), e.bound.end());
        changed = changed || callee.bound.size() != before;
        if (e.reachable && !callee.reachable) changed = callee.reachable = true;
        if (callee.random && !e.random) changed = e.random = true;
      }
    }
  }
  constexpr int kRounds = 12;
  for (int round = 0; round < kRounds; ++round) {
    for (Entry& e : entries_) {
      double bodies = e.own;
      for (const size_t c : e.calls) bodies += entries_[c].bodies;
      e.bodies = std::min(kManyBodies, bodies * e.turns);
    }
  }
}

}  // namespace gable::progen3d
