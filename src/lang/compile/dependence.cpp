// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "lang/compile/dependence.h"

namespace gable::lang {

namespace {

constexpr uint32_t kUnshareable = kReadsWorld | kRandom | kReadsContext | kReadsPath | kLabels |
                                  kReadsInitialShape | kAsksForRoom;

// Adds what `from` uses to `to`; true when that was news.
bool include(Uses& to, const Uses& from) {
  const uint32_t effects = to.effects;
  const size_t attributes = to.attributes.size();
  // Whether the shape below is looked at matters to the rule itself alone.
  to.effects |= from.effects & ~uint32_t{kReadsPrevious};
  to.attributes.insert(from.attributes.begin(), from.attributes.end());
  return to.effects != effects || to.attributes.size() != attributes;
}

// Rules, functions and initialisers of attributes, as they use each other.
struct Units {
  std::vector<Uses> rules, functions, initialisers;

  bool includeUsed(Uses& to) const {
    bool changed = false;
    const auto add = [&](const std::set<uint32_t>& used, const std::vector<Uses>& from) {
      for (const uint32_t u : used) {
        if (&from[u] != &to) changed |= include(to, from[u]);
      }
    };
    // What is included does not change which units are used.
    add(to.functions, functions);
    add(to.initialisers, initialisers);
    add(to.rules, rules);
    return changed;
  }

  // Chaotic iteration to the least fixed point; sets only grow, so it ends.
  void close() {
    for (bool changed = true; changed;) {
      changed = false;
      for (std::vector<Uses>* all : {&functions, &initialisers, &rules}) {
        for (Uses& u : *all) changed |= includeUsed(u);
      }
    }
  }
};

}  // namespace

void closeDependence(Program& program, const std::vector<Uses>& rules,
                     const std::vector<Uses>& functions, const std::vector<Uses>& initialisers) {
  Units units{rules, functions, initialisers};
  units.close();
  for (size_t i = 0; i < program.rules.size(); ++i) {
    RuleCode& code = program.rules[i];
    const Uses& uses = units.rules[i];
    code.reads.effects = uses.effects;
    code.reads.attributes.assign(uses.attributes.begin(), uses.attributes.end());
    code.shared = rules[i].branches && (uses.effects & kUnshareable) == 0;
  }
}

}  // namespace gable::lang
