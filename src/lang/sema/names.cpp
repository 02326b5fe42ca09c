// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Look-up of names in modules. "a.b.c" enters the import `a`, there the import `b`, as long as the
// parts name imports; the rest is looked up as a whole, so that dotted names of built-ins and of
// the author's own work too.

#include <algorithm>

#include "lang/sema/analysis.h"

namespace gable::lang {

bool Analysis::isImport(ModuleId module, std::string_view name) const {
  const size_t dot = name.find('.');
  if (dot == std::string_view::npos) return false;
  return units_[program_.modules[module].unit].importNames.count(name.substr(0, dot)) != 0;
}

// True for names of imports that could not be read: nothing is said about those.
bool Analysis::inMissingImport(ModuleId module, std::string_view name) const {
  const auto [owner, rest] = enter(module, name);
  return isImport(owner, rest);
}

std::pair<ModuleId, std::string_view> Analysis::enter(ModuleId module,
                                                      std::string_view name) const {
  for (;;) {
    const size_t dot = name.find('.');
    if (dot == std::string_view::npos) return {module, name};
    const auto& imports = scopes_[module].imports;
    const auto at = imports.find(name.substr(0, dot));
    if (at == imports.end()) return {module, name};
    module = at->second;
    name.remove_prefix(dot + 1);
  }
}

std::string Analysis::hintOfImport(ModuleId module, std::string_view name) {
  const size_t dot = name.find('.');
  if (dot == std::string_view::npos || dot == 0) return {};
  const std::string_view alias = name.substr(0, dot);
  const auto& imports = scopes_[module].imports;
  const std::string nearest = near(alias, [&] {
    std::vector<std::string_view> names;
    for (const auto& [known, target] : imports) names.push_back(known);
    std::sort(names.begin(), names.end());
    return names;
  });
  if (!nearest.empty()) return "nothing is imported as " + quote(alias) + "; " + nearest;
  const std::string file = std::string(alias) + ".cga";
  const std::string bundled = bundledFile(file, program_.units[program_.modules[module].unit].path);
  return "nothing is imported as " + quote(alias) + "; write import " + std::string(alias) +
         " : \"" + (bundled.empty() ? file : bundled) + "\" above the rules";
}

namespace {

bool applies(const Tree& t, NodeId body, std::string_view rule) {
  std::vector<NodeId> open{body};
  while (!open.empty()) {
    const NodeId node = open.back();
    open.pop_back();
    if (node == kNoNode) continue;
    if (t.kind(node) == NodeKind::Apply && t.text(node) == rule) return true;
    for (const NodeId child : t.children(node)) open.push_back(child);
  }
  return false;
}

}  // namespace

// What stands in the place of an extension rule may apply that rule: `Ext --> MyExt` in the import
// and `extension MyExt --> imp.Ext`. There the name means the rule as the imported file has it.
bool Analysis::forwards(ModuleId owner, std::string_view name) const {
  const auto own = scopes_[owner].rules.find(name);
  const auto put = scopes_[owner].replaced.find(name);
  if (body_.rule == kNone || own == scopes_[owner].rules.end() ||
      put == scopes_[owner].replaced.end() || !program_.rules[own->second[0]].extension) {
    return false;
  }
  const RuleInfo& here = program_.rules[body_.rule];
  return std::any_of(put->second.begin(), put->second.end(), [&](RuleId id) {
    const RuleInfo& r = program_.rules[id];
    if (r.module != here.module) return false;
    const Tree& t = program_.tree(r.module);
    return id == body_.rule || (here.extension && applies(t, bodyOf(t, r.node), here.name));
  });
}

Analysis::RuleSet Analysis::rulesNamed(ModuleId module, std::string_view name) const {
  RuleSet set;
  const auto append = [&](const std::unordered_map<std::string_view, std::vector<RuleId>>& map,
                          std::string_view key) {
    const auto at = map.find(key);
    if (at != map.end()) set.rules.insert(set.rules.end(), at->second.begin(), at->second.end());
  };
  set.imported = isImport(module, name);
  append(scopes_[module].rules, set.imported ? name : std::string_view());
  const auto [owner, rest] = enter(module, name);
  if (!forwards(owner, rest)) append(scopes_[owner].replaced, rest);
  append(scopes_[owner].rules, rest);
  if (rest == "start" && set.rules.empty()) set.rules = scopes_[owner].startRules;
  for (const RuleId id : set.rules) look(UnitKind::Rule, id);
  return set;
}

std::vector<FunctionId> Analysis::functionsNamed(ModuleId module, std::string_view name) const {
  const auto [owner, rest] = enter(module, name);
  const auto at = scopes_[owner].functions.find(rest);
  if (at == scopes_[owner].functions.end()) return {};
  for (const FunctionId id : at->second) look(UnitKind::Function, id);
  return at->second;
}

bool Analysis::isKnownValue(std::string_view name) const {
  return std::find(body_.slots.begin(), body_.slots.end(), name) != body_.slots.end() ||
         attributeNamed(body_.module, name) != kNone ||
         !functionsNamed(body_.module, name).empty() || catalogue_.attribute(name) != nullptr ||
         catalogue_.function(name) != nullptr;
}

AttributeId Analysis::attributeNamed(ModuleId module, std::string_view name) const {
  const auto [owner, rest] = enter(module, name);
  const auto at = scopes_[owner].attributes.find(rest);
  if (at == scopes_[owner].attributes.end()) return kNone;
  look(UnitKind::Attribute, at->second);
  return at->second;
}

bool Analysis::ruleInAnyStyle(ModuleId module, std::string_view name) const {
  const auto [owner, rest] = enter(module, name);
  const uint32_t unit = program_.modules[owner].unit;
  const Tree& t = *program_.units[unit].tree;
  const std::vector<Declaration>& rules = units_[unit].rules;
  return std::any_of(rules.begin(), rules.end(),
                     [&, key = rest](const Declaration& d) { return t.text(d.node) == key; });
}

// Names for "did you mean", sorted so that the same one is proposed always.
std::vector<std::string_view> Analysis::ruleNames(ModuleId module) const {
  std::vector<std::string_view> names;
  for (const auto& [name, ids] : scopes_[module].rules) names.push_back(name);
  for (const OpSpec* op : catalogue_.operations) names.push_back(op->name);
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string_view> Analysis::valueNames(ModuleId module) const {
  std::vector<std::string_view> names = body_.slots;
  for (const auto& [name, ids] : scopes_[module].functions) names.push_back(name);
  for (const auto& [name, id] : scopes_[module].attributes) names.push_back(name);
  for (const FunctionSpec* f : catalogue_.functions) names.push_back(f->name);
  for (const AttributeSpec* a : catalogue_.attributes) names.push_back(a->name);
  std::sort(names.begin(), names.end());
  return names;
}

// A constant beside an imported attribute that keeps the attribute's own value, for importers whose
// replacement reads what it replaces: `attr x = imp.x * 2`.
AttributeId Analysis::ownValueOf(AttributeId attribute) {
  const auto known = ownValues_.find(attribute);
  if (known != ownValues_.end()) {
    look(UnitKind::Attribute, known->second);
    return known->second;
  }
  AttributeInfo a = program_.attributes[attribute];
  a.id = static_cast<AttributeId>(program_.attributes.size());
  a.constant = true;
  a.source = ValueSource::Own;
  a.valueModule = a.module;
  a.valueNode = bodyOf(program_.tree(a.module), a.node);
  a.from = kNone;
  a.annotations.hidden = true;
  const AttributeId id = a.id;
  program_.attributes.push_back(std::move(a));
  ownValues_[attribute] = id;
  look(UnitKind::Attribute, id);
  return id;
}

const DynamicImport* ResolvedProgram::dynamicImport(ModuleId module, NodeId node) const {
  const auto at =
      std::find_if(dynamicImports.begin(), dynamicImports.end(),
                   [&](const DynamicImport& d) { return d.module == module && d.node == node; });
  return at == dynamicImports.end() ? nullptr : &*at;
}

RuleId ResolvedProgram::findRule(std::string_view name, uint32_t paramCount) const {
  for (const RuleInfo& r : rules) {
    if (r.qualifiedName == name && r.paramCount == paramCount && !modules[r.module].dynamic) {
      return r.id;
    }
  }
  return kNone;
}

AttributeId ResolvedProgram::findAttribute(std::string_view name) const {
  for (const AttributeInfo& a : attributes) {
    if (a.qualifiedName == name && !modules[a.module].dynamic) return a.id;
  }
  return kNone;
}

}  // namespace gable::lang
