// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// gable info: what a rule file or package offers, without running its rules further than the
// values of its attributes.

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "answer.h"
#include "commands.h"

namespace {

using Annotations = std::vector<gable::AttributeInfo::Annotation>;

/// Values of attributes need the beginning of a derivation, and no more.
constexpr uint64_t kMostShapes = 1000;
constexpr uint64_t kMostSteps = 1'000'000;

std::vector<gable::NamedValue> valuesOf(Inputs& inputs) {
  inputs.settings.importedAttributes = true;
  inputs.settings.limits.shapes = std::min(inputs.settings.limits.shapes, kMostShapes);
  inputs.settings.limits.steps = std::min(inputs.settings.limits.steps, kMostSteps);
  const gable::Model model = gable::derive(inputs.rules, inputs.shapes, inputs.settings);
  return inputs.shapes.size() > 0 ? model.attributes(0) : std::vector<gable::NamedValue>();
}

std::string textOf(const gable::RuleValue& value) {
  std::string out;
  gable::JsonWriter json(out);
  gable::writeValue(json, value);
  return out;
}

// "@Range(min=0, max=10) @Order(2)"
std::string textOf(const Annotations& annotations) {
  std::string out;
  for (const auto& n : annotations) {
    out += (out.empty() ? "@" : " @") + n.name;
    std::string list;
    for (const auto& [key, value] : n.arguments) {
      list += (list.empty() ? "" : ", ") + (key.empty() ? value : key + "=" + value);
    }
    if (!n.arguments.empty()) out += "(" + list + ")";
  }
  return out;
}

void row(const std::string& name, const std::string& what, const std::string& more = {}) {
  std::printf("  %-24s %s%s%s\n", name.c_str(), what.c_str(), more.empty() ? "" : "  ",
              more.c_str());
}

void title(const char* text, bool any) {
  if (any) std::printf("%s\n", text);
}

void printFiles(const gable::Rules& rules) {
  title("imports", !rules.imports().empty());
  for (const gable::ImportInfo& i : rules.imports()) {
    row(i.name, i.file.empty() ? "missing: " + i.path : i.file);
  }
  title("assets", !rules.assets().empty());
  for (const gable::AssetUse& a : rules.assets()) {
    row(a.path, a.file.empty() ? "missing" : a.file);
  }
}

// Names of imported files begin with the name of the import.
bool isImported(const std::string& name) { return name.find('.') != std::string::npos; }

// The line for what is not listed.
void printRest(size_t count) {
  if (count > 0) std::printf("  and %zu of imported files, which --all lists\n", count);
}

void printStartRules(const gable::Rules& rules, bool all) {
  const std::string first = rules.startRule().value_or(std::string());
  title("start rules", !first.empty());
  size_t rest = 0;
  for (const gable::RuleInfo& r : rules.rules()) {
    if (r.name != first && (!r.start || r.parameters > 0)) continue;
    if (!all && r.name != first && isImported(r.name)) {
      ++rest;
      continue;
    }
    const std::string place = r.file + ":" + std::to_string(r.line);
    row(r.name + (r.name == first ? " *" : ""), place, textOf(r.annotations));
  }
  printRest(rest);
}

std::string placeOf(const gable::RuleInfo& r) { return r.file + ":" + std::to_string(r.line); }

// The file's own first, then those of imports by file. What is imported twice is listed once: under
// the name of the first import.
std::vector<gable::RuleInfo> byFile(const std::vector<gable::RuleInfo>& all) {
  std::vector<gable::RuleInfo> out;
  std::set<std::pair<std::string, std::string>> known;
  for (const gable::RuleInfo& r : all) {
    const std::string last = r.name.substr(r.name.rfind('.') + 1);
    if (known.emplace(placeOf(r), last).second) out.push_back(r);
  }
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) {
    const bool ownA = !isImported(a.name), ownB = !isImported(b.name);
    return ownA != ownB ? ownA : !ownA && placeOf(a) < placeOf(b);
  });
  return out;
}

// What --start takes besides, and what gable trace may be asked for.
void printOtherRules(const gable::Rules& rules) {
  const std::string first = rules.startRule().value_or(std::string());
  std::vector<gable::RuleInfo> others;
  for (const gable::RuleInfo& r : rules.rules()) {
    const bool starts = r.name == first || (r.start && r.parameters == 0);
    if (!starts) others.push_back(r);
  }
  title("other rules", !others.empty());
  for (const gable::RuleInfo& r : byFile(others)) {
    const std::string count = r.parameters == 0   ? ""
                              : r.parameters == 1 ? "1 parameter"
                                                  : std::to_string(r.parameters) + " parameters";
    row(r.name, placeOf(r), count);
  }
}

void printAttributes(const gable::Rules& rules, const std::vector<gable::NamedValue>& values,
                     bool all) {
  title("attributes", !rules.attributes().empty());
  std::map<std::string_view, const gable::RuleValue*> known;
  for (const gable::NamedValue& v : values) known.emplace(v.name, &v.value);
  size_t rest = 0;
  for (const bool imported : {false, true}) {
    for (const gable::AttributeInfo& a : rules.attributes()) {
      if (isImported(a.name) != imported) continue;
      if (!all && imported) {
        ++rest;
        continue;
      }
      const auto value = known.find(a.name);
      row(a.name, a.type + (value == known.end() ? "" : " = " + textOf(*value->second)),
          textOf(a.annotations));
    }
  }
  printRest(rest);
}

void printInfo(const gable::Rules& rules, const std::vector<gable::NamedValue>& values, bool all) {
  if (!rules.description().empty()) std::printf("%s\n", rules.description().c_str());
  printStartRules(rules, all);
  if (all) printOtherRules(rules);
  printAttributes(rules, values, all);
  title("styles", rules.styles().size() > 1);
  for (size_t i = 0; rules.styles().size() > 1 && i < rules.styles().size(); ++i) {
    row(rules.styles()[i], "");
  }
  printFiles(rules);
}

void addMembers(const gable::Rules& rules, const std::vector<gable::NamedValue>& values) {
  if (!terminal().json) return;
  std::string out;
  gable::JsonWriter json(out);
  json.beginObject();
  gable::writeRuleFile(json, rules, values);
  json.endObject();
  answer().members(out);
}

}  // namespace

int runInfo(const InfoArguments& arguments) {
  Inputs inputs;
  if (const int status = readInputs(arguments.derive, inputs)) {
    if (status == kExitWrong) addMembers(inputs.rules, {});
    return status;
  }
  const std::vector<gable::NamedValue> values = valuesOf(inputs);
  addMembers(inputs.rules, values);
  if (!terminal().json) printInfo(inputs.rules, values, arguments.all);
  return kExitDone;
}
