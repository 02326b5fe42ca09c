// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/gbbg/names.h"

#include <algorithm>

namespace gable::gbbg {

namespace {

// The words of Gable's language that cannot name a rule everywhere.
constexpr std::string_view kWords[] = {"attr",      "case",  "const",    "else",   "extends",
                                       "extension", "false", "import",   "inline", "intersect",
                                       "start",     "style", "subtract", "true",   "union",
                                       "version",   "with"};

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

bool Names::usable(const std::string& name) const {
  return taken_.count(name) == 0 && !catalogue_.operation(name) &&
         std::find(std::begin(kWords), std::end(kWords), name) == std::end(kWords);
}

std::string Names::fresh(const std::string& wanted) {
  std::string base;
  for (const char c : wanted) base += isLetter(c) || isDigit(c) ? c : '_';
  if (base.empty() || isDigit(base[0])) base.insert(0, "_");
  std::string name = base;
  if (!usable(name)) name = base + "_";
  for (int n = 2; !usable(name); ++n) name = base + "_" + std::to_string(n);
  taken_.insert(name);
  return name;
}

const std::string& Names::of(const std::string& symbol) {
  const auto found = given_.find(symbol);
  if (found != given_.end()) return found->second;
  return given_.emplace(symbol, fresh(symbol)).first->second;
}

}  // namespace gable::gbbg
