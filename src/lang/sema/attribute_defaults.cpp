// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Values of attributes that their own @Range or @Enum leaves out. Forms would move them, so the
// model that a form shows is not the one that the file describes. Those that an import or a call
// gives in brackets as well.

#include <algorithm>
#include <set>

#include "base/number.h"
#include "base/text.h"
#include "lang/sema/analysis.h"

namespace gable::lang {

namespace {

// As an annotation writes it.
std::string spelled(const Value& v, const ValuePool& pool) {
  if (v.type == ValueType::Bool) return v.truth() ? "true" : "false";
  return v.type == ValueType::String ? std::string(pool.text(v.id)) : shortestText(v.number);
}

std::string textOf(const EnumValue& v) { return v.isNumber ? shortestText(v.number) : v.text; }

}  // namespace

void Analysis::checkDefault(NodeId node, const AttributeInfo& a) {
  if (tree().kind(node) == NodeKind::Array) {
    for (const NodeId row : tree().children(node)) {
      for (const NodeId item : tree().children(row)) checkDefault(item, a);
    }
    return;
  }
  const Value v = module().constantAt(node);
  if (v.type == ValueType::Null) return;
  const Annotations& notes = a.annotations;
  const std::string value = spelled(v, values_);
  const RangeNote range = notes.range.value_or(RangeNote());
  const bool ranged = range.restricted && range.min < range.max && v.type == ValueType::Float;
  if (ranged && (v.number < range.min || v.number > range.max)) {
    warning("attribute-outside", tree().span(node),
            quote(a.name) + " is " + value + ", and its '@Range' is from " +
                shortestText(range.min) + " to " + shortestText(range.max),
            "change one of them, or write 'restricted=false' where the range is a suggestion");
  }
  if (!notes.choices || !notes.choices->restricted) return;
  std::vector<std::string> allowed;
  for (const EnumValue& e : notes.choices->values) {
    if (e.isNumber == (v.type == ValueType::Float)) allowed.push_back(textOf(e));
  }
  if (allowed.empty() || std::find(allowed.begin(), allowed.end(), value) != allowed.end()) return;
  std::string list;
  for (const std::string& e : allowed) list += (list.empty() ? "" : ", ") + e;
  const std::vector<std::string_view> names(allowed.begin(), allowed.end());
  std::string hint = didYouMean(value, names);
  if (hint.empty()) hint = "add it to the list, or write 'restricted=false' there";
  warning("attribute-outside", tree().span(node),
          quote(a.name) + " is " + quote(value) + ", and its '@Enum' has: " + list,
          std::move(hint));
}

// @Enum(valuesAttr = name)
void Analysis::checkValuesAttribute(const AttributeInfo& a) {
  const auto& choices = a.annotations.choices;
  if (!choices || choices->valuesAttribute.empty()) return;
  if (attributeNamed(a.module, choices->valuesAttribute) != kNone) return;
  std::vector<std::string_view> names;
  for (const auto& [name, id] : scopes_[a.module].attributes) names.push_back(name);
  std::sort(names.begin(), names.end());
  warning("bad-annotation", nameSpan(tree(), a.node),
          "the '@Enum' of " + quote(a.name) + " takes its values from " +
              quote(choices->valuesAttribute) + ", which is no attribute",
          didYouMean(choices->valuesAttribute, names));
}

void Analysis::checkDefaults(ModuleId firstModule) {
  // Files that are imported more than once are told about once.
  std::set<std::pair<uint32_t, NodeId>> known;
  for (const AttributeInfo& a : program_.attributes) {
    if (a.module < firstModule || a.constant || a.edgeMap) continue;
    const Module& m = program_.modules[a.module];
    if (!known.emplace(m.unit, a.node).second) continue;
    body_ = {};
    body_.module = a.module;
    checkDefault(bodyOf(tree(), a.node), a);
    checkValuesAttribute(a);
  }
  const auto checkGiven = [&](ModuleId module, NodeId value, const AttributeInfo& a) {
    if (!known.emplace(program_.modules[module].unit, value).second) return;
    body_ = {};
    body_.module = module;
    checkDefault(value, a);
  };
  for (const AttributeInfo& a : program_.attributes) {
    if (a.module < firstModule || a.source != ValueSource::Override) continue;
    checkGiven(a.valueModule, a.valueNode, a);
  }
  for (const DynamicImport& d : program_.dynamicImports) {
    if (d.module < firstModule) continue;
    for (const DynamicImport::Given& given : d.given) {
      checkGiven(d.module, given.value, program_.attributes[given.attribute]);
    }
  }
}

}  // namespace gable::lang
