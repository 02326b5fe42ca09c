// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A file that is imported in ten places is ten modules, whose attributes may have other values.
// Nothing else of them differs where no rules are put in the place of theirs: the types of one, the
// original, are those of all, its copies, and are worked out once.

#include <utility>

#include "lang/sema/analysis.h"

namespace gable::lang {

// With all its imports made. Those may differ in styles that are chosen by path.
void Analysis::chooseOriginal(ModuleId module) {
  Module& m = program_.modules[module];
  std::vector<uint32_t> key{m.unit};
  bool plain = scopes_[module].replaced.empty();
  for (const Declaration& d : units_[m.unit].imports) {
    const auto import = scopes_[module].imports.find(program_.tree(module).text(d.node));
    const bool missing = import == scopes_[module].imports.end();
    key.push_back(missing ? kNone : program_.modules[import->second].original);
    plain = plain && (missing || scopes_[import->second].plain);
  }
  scopes_[module].plain = plain;
  if (!plain) return;
  m.original = originals_.emplace(std::pair(m.style, std::move(key)), module).first->second;
  if (m.original == module) return;
  const Module& from = program_.modules[m.original];
  for (uint32_t i = 0; i < m.ruleCount; ++i) copyType(UnitKind::Rule, from.firstRule + i, module);
  for (uint32_t i = 0; i < m.functionCount; ++i) {
    copyType(UnitKind::Function, from.firstFunction + i, module);
  }
  for (uint32_t i = 0; i < m.attributeCount; ++i) {
    copyType(UnitKind::Attribute, from.firstAttribute + i, module);
  }
  copies_[m.original].push_back(module);
}

// From a declaration of the module's original to its own.
void Analysis::copyType(UnitKind kind, uint32_t id, ModuleId to) {
  const Module& m = program_.modules[to];
  const Module& from = program_.modules[m.original];
  switch (kind) {
    case UnitKind::Rule:
      program_.rules[id - from.firstRule + m.firstRule].paramTypes = program_.rules[id].paramTypes;
      break;
    case UnitKind::Function: {
      FunctionInfo& f = program_.functions[id - from.firstFunction + m.firstFunction];
      f.paramTypes = program_.functions[id].paramTypes;
      f.result = program_.functions[id].result;
      break;
    }
    case UnitKind::Attribute: {
      const AttributeId own = id - from.firstAttribute + m.firstAttribute;
      program_.attributes[own].type = program_.attributes[id].type;
      break;
    }
  }
}

// The types of a unit that has been walked, to those of the copies of its module.
void Analysis::spread(size_t unit) {
  const auto id = static_cast<uint32_t>(unit / kUnitKinds);
  const auto kind = static_cast<UnitKind>(unit % kUnitKinds);
  const ModuleId module = kind == UnitKind::Rule       ? program_.rules[id].module
                          : kind == UnitKind::Function ? program_.functions[id].module
                                                       : program_.attributes[id].module;
  const auto copies = copies_.find(module);
  if (copies == copies_.end() || !isDeclaration(kind, id, module)) return;
  for (const ModuleId copy : copies->second) copyType(kind, id, copy);
}

// Not a rule that an import puts in the place of another, nor a value kept beside an attribute.
bool Analysis::isDeclaration(UnitKind kind, uint32_t id, ModuleId module) const {
  const Module& m = program_.modules[module];
  switch (kind) {
    case UnitKind::Rule: return id >= m.firstRule && id - m.firstRule < m.ruleCount;
    case UnitKind::Function: return id >= m.firstFunction && id - m.firstFunction < m.functionCount;
    case UnitKind::Attribute:
      return id >= m.firstAttribute && id - m.firstAttribute < m.attributeCount;
  }
  return false;
}

// The unit whose types count for one: that of the original. An attribute with the value of an
// import's brackets has its own walk, since the value is checked there.
size_t Analysis::originalOf(size_t unit) const {
  const auto id = static_cast<uint32_t>(unit / kUnitKinds);
  const auto kind = static_cast<UnitKind>(unit % kUnitKinds);
  const auto in = [&](ModuleId module, uint32_t Module::*first) {
    const Module& m = program_.modules[module];
    if (m.original == module || !isDeclaration(kind, id, module)) return unit;
    return unitOf(kind, id - m.*first + program_.modules[m.original].*first);
  };
  if (kind == UnitKind::Rule) return in(program_.rules[id].module, &Module::firstRule);
  if (kind == UnitKind::Function) return in(program_.functions[id].module, &Module::firstFunction);
  const AttributeInfo& a = program_.attributes[id];
  return a.source == ValueSource::Override ? unit : in(a.module, &Module::firstAttribute);
}

}  // namespace gable::lang
