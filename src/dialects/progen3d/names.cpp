// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/progen3d/names.h"

#include <algorithm>

namespace gable::progen3d {

namespace {

bool isKeyword(std::string_view s) {
  static constexpr std::string_view kWords[] = {
      "attr",  "const",     "style", "extends", "import", "version", "case",     "else",     "with",
      "start", "extension", "true",  "false",   "inline", "union",   "subtract", "intersect"};
  return std::find(std::begin(kWords), std::end(kWords), s) != std::end(kWords);
}

std::string identifier(std::string_view name) {
  static constexpr char kHex[] = "0123456789abcdef";
  std::string out;
  for (const char c : name) {
    const auto u = static_cast<unsigned char>(c);
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    if (letter || (c >= '0' && c <= '9')) {
      out += c;
    } else if (c == '.') {
      out += '_';
    } else {
      out += kHex[u >> 4];
      out += kHex[u & 15];
    }
  }
  if (out.empty() || (out[0] >= '0' && out[0] <= '9')) out.insert(out.begin(), '_');
  return out;
}

template <class Taken>
std::string fresh(std::string name, Taken taken) {
  while (taken(name)) name += '_';
  return name;
}

}  // namespace

Names::Names(const std::vector<std::string>& rules, const std::vector<std::string>& values,
             const Catalogue& catalogue) {
  for (const std::string& written : rules) {
    const std::string name = fresh(identifier(written), [&](const std::string& n) {
      return isKeyword(n) || catalogue.operation(n) || ruleNames_.count(n) > 0;
    });
    ruleNames_.insert(name);
    rules_.emplace(written, name);
  }
  for (const std::string& written : values) {
    if (values_.count(written) > 0) continue;
    const std::string name = fresh(identifier(written), [&](const std::string& n) {
      return isKeyword(n) || catalogue.isSelector(n) || n == "x" || n == "y" || n == "z" ||
             n == "a" || n == "b" || catalogue.function(n) || valueNames_.count(n) > 0;
    });
    valueNames_.insert(name);
    values_.emplace(written, name);
  }
}

namespace {

std::vector<std::string> rulesOf(const Grammar& grammar) {
  std::vector<std::string> out;
  for (const Rule& r : grammar.rules) out.emplace_back(r.name);
  return out;
}

// Variables, and the counts of the rules' turns.
std::vector<std::string> valuesOf(const Grammar& grammar) {
  std::vector<std::string> out;
  for (const Variable& v : grammar.variables) out.emplace_back(v.name);
  for (const Rule& r : grammar.rules) out.push_back(std::string(r.name) + "_count");
  return out;
}

}  // namespace

Names::Names(const Grammar& grammar, const Catalogue& catalogue)
    : Names(rulesOf(grammar), valuesOf(grammar), catalogue) {}

std::string Names::function(std::string_view name) const {
  return fresh(std::string(name), [&](const std::string& n) { return valueNames_.count(n) > 0; });
}

std::string Names::startRule() const {
  return fresh("Start", [&](const std::string& n) { return ruleNames_.count(n) > 0; });
}

}  // namespace gable::progen3d
