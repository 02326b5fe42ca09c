// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "program/program.h"

#include <algorithm>

namespace gable {

void Program::indexNames() {
  rulesByName_.clear();
  attributesByName_.clear();
  for (uint32_t i = 0; i < rules.size(); ++i) {
    if (!rules[i].parameters.empty()) continue;
    int32_t& qualified = rulesByName_[rules[i].qualifiedName].qualified;
    if (qualified < 0) qualified = static_cast<int32_t>(i);
    rulesByName_[std::string(pool->text(rules[i].name))].alike.push_back(i);
  }
  for (uint32_t i = 0; i < attributes.size(); ++i) {
    attributesByName_.try_emplace(attributes[i].name, i);
  }
}

int32_t Program::findRule(std::string_view name) const {
  const auto at = rulesByName_.find(name);
  if (at == rulesByName_.end()) return -1;
  const NamedRules& named = at->second;
  return named.qualified >= 0 ? named.qualified : static_cast<int32_t>(named.alike[0]);
}

std::vector<uint32_t> Program::rulesAlike(std::string_view name) const {
  const auto at = rulesByName_.find(name);
  return at == rulesByName_.end() ? std::vector<uint32_t>() : at->second.alike;
}

int32_t Program::findAttribute(std::string_view name) const {
  const auto at = attributesByName_.find(name);
  return at == attributesByName_.end() ? -1 : static_cast<int32_t>(at->second);
}

int32_t Program::ruleAt(uint32_t instruction) const {
  const auto next =
      std::upper_bound(rules.begin(), rules.end(), instruction,
                       [](uint32_t at, const RuleCode& rule) { return at < rule.entry; });
  return static_cast<int32_t>(next - rules.begin()) - 1;
}

}  // namespace gable
