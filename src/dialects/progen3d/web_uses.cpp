// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/progen3d/web_uses.h"

namespace gable::progen3d::web {

Uses::Uses(const Grammar& grammar) : g_(grammar) {
  std::map<std::string_view, std::set<std::string_view>> calls;
  for (const Rule& r : g_.rules) {
    for (const Variant& v : r.variants) {
      for (const Variant::Parameter& p : v.parameters) parameters_.insert(p.name);
      read(v.body, calls[r.name]);
      for (const uint32_t e : {v.repeat, v.weight}) {
        if (e != kNone) read(e);
      }
    }
  }
  for (const std::string_view name : redrawn_) {
    const auto at = drawn_.find(name);
    if (at != drawn_.end()) at->second.redrawn = true;
  }
  reach(calls);
}

void Uses::read(const Sequence& sequence, std::set<std::string_view>& calls) {
  for (const Statement& s : sequence) {
    for (const uint32_t a : s.arguments) read(a);
    hasSides_ =
        hasSides_ || s.kind == Statement::Kind::SideScale || s.kind == Statement::Kind::SideMove;
    if (s.kind == Statement::Kind::Call) {
      calls.insert(s.name);
      called_.insert(s.name);
    } else if (s.kind == Statement::Kind::Draw && s.arguments.empty()) {
      redrawn_.insert(s.name);
    } else if (s.kind == Statement::Kind::Draw) {
      Drawn& d = drawn_.try_emplace(s.name, Drawn{s.whole, false, false, s.nameSpan}).first->second;
      d.ofBothKinds = d.ofBothKinds || d.whole != s.whole;
    }
    read(s.body, calls);
    read(s.otherwise, calls);
  }
}

void Uses::read(uint32_t expression) {
  std::vector<uint32_t> open{expression};
  while (!open.empty()) {
    const Expression& e = g_.expressions[open.back()];
    open.pop_back();
    open.insert(open.end(), e.parts.begin(), e.parts.end());
    if (e.kind != Expression::Kind::Function || e.name != "rand" || e.parts.size() != 1) continue;
    const Expression& of = g_.expressions[e.parts[0]];
    if (of.kind == Expression::Kind::Name) redrawn_.insert(of.name);
  }
}

void Uses::reach(const std::map<std::string_view, std::set<std::string_view>>& calls) {
  if (g_.rules.empty()) return;
  std::vector<std::string_view> open{g_.rules[0].name};
  while (!open.empty()) {
    const std::string_view name = open.back();
    open.pop_back();
    if (!reachable_.insert(name).second) continue;
    const auto at = calls.find(name);
    if (at != calls.end()) open.insert(open.end(), at->second.begin(), at->second.end());
  }
}

void drawnIn(const Sequence& sequence, std::set<std::string_view>& names) {
  for (const Statement& s : sequence) {
    if (s.kind == Statement::Kind::Draw) names.insert(s.name);
    drawnIn(s.body, names);
    drawnIn(s.otherwise, names);
  }
}

}  // namespace gable::progen3d::web
