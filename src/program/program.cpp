// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "program/program.h"

#include <algorithm>

namespace gable {

int32_t Program::findRule(std::string_view name) const {
  int32_t byBareName = -1;
  for (size_t i = 0; i < rules.size(); ++i) {
    if (!rules[i].parameters.empty()) continue;
    if (rules[i].qualifiedName == name) return static_cast<int32_t>(i);
    if (byBareName < 0 && pool->text(rules[i].name) == name) byBareName = static_cast<int32_t>(i);
  }
  return byBareName;
}

int32_t Program::findAttribute(std::string_view name) const {
  for (size_t i = 0; i < attributes.size(); ++i) {
    if (attributes[i].name == name) return static_cast<int32_t>(i);
  }
  return -1;
}

int32_t Program::ruleAt(uint32_t instruction) const {
  const auto next =
      std::upper_bound(rules.begin(), rules.end(), instruction,
                       [](uint32_t at, const RuleCode& rule) { return at < rule.entry; });
  return static_cast<int32_t>(next - rules.begin()) - 1;
}

}  // namespace gable
