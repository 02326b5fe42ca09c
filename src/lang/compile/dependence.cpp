// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "lang/compile/dependence.h"

namespace gable::lang {

namespace {

constexpr uint32_t kUnshareable =
    kReadsWorld | kRandom | kReadsContext | kReadsPath | kReadsInitialShape;

// Adds what `from` uses to `to`; true when that was news.
bool include(Uses& to, const Uses& from) {
  const uint32_t effects = to.effects;
  const size_t attributes = to.attributes.size();
  // Whether the shape below is looked at matters to the rule itself alone.
  to.effects |= from.effects & ~uint32_t{kReadsPrevious};
  to.attributes.insert(from.attributes.begin(), from.attributes.end());
  return to.effects != effects || to.attributes.size() != attributes;
}

// Chaotic iteration to the least fixed point; sets only grow, so it ends.
void closeOver(std::vector<Uses>& all, const std::vector<Uses>& functions, bool callsRules) {
  for (bool changed = true; changed;) {
    changed = false;
    for (Uses& u : all) {
      const std::set<uint32_t> callees = u.functions;
      for (uint32_t f : callees) {
        if (&functions[f] != &u) changed |= include(u, functions[f]);
      }
      if (!callsRules) continue;
      const std::set<uint32_t> rules = u.rules;
      for (uint32_t r : rules) {
        if (&all[r] != &u) changed |= include(u, all[r]);
      }
    }
  }
}

}  // namespace

void closeDependence(Program& program, const std::vector<Uses>& rules,
                     const std::vector<Uses>& functions) {
  std::vector<Uses> functionUses = functions;
  closeOver(functionUses, functionUses, false);
  std::vector<Uses> ruleUses = rules;
  closeOver(ruleUses, functionUses, true);
  for (size_t i = 0; i < program.rules.size(); ++i) {
    RuleCode& code = program.rules[i];
    code.reads.effects = ruleUses[i].effects;
    code.reads.attributes.assign(ruleUses[i].attributes.begin(), ruleUses[i].attributes.end());
    code.shared = rules[i].branches && (ruleUses[i].effects & kUnshareable) == 0;
  }
}

}  // namespace gable::lang
