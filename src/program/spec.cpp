// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "program/spec.h"

#include <algorithm>

#include "base/number.h"

namespace gable {

namespace {

template <class T>
const T* find(std::span<const T* const> list, std::string_view name) {
  const auto at = std::lower_bound(list.begin(), list.end(), name, [](const T* a, auto n) {
    return std::string_view(a->name) < n;
  });
  return at != list.end() && (*at)->name == name ? *at : nullptr;
}

}  // namespace

size_t Signature::requiredCount() const {
  const auto required = static_cast<size_t>(std::count_if(
      params.begin(), params.end(), [](const ParamSpec& p) { return p.defaultText == nullptr; }));
  return variadic && required > 0 ? required - 1 : required;
}

const ParamSpec* Signature::paramAt(size_t index) const {
  if (index < params.size()) return &params[index];
  return variadic && !params.empty() ? &params.back() : nullptr;
}

std::string rangeText(const NumberRange& r) {
  if (r.any()) return {};
  const std::string least = shortestText(r.least), most = shortestText(r.most);
  if (r.most == NumberRange::kInfinite) return r.above ? "more than " + least : least + " or more";
  if (r.least == -NumberRange::kInfinite) return r.below ? "less than " + most : most + " or less";
  if (!r.above && !r.below) return least + " to " + most;
  return (r.above ? "more than " : "at least ") + least +
         (r.below ? " and less than " : " and at most ") + most;
}

std::string docText(const ParamSpec& param) {
  const std::string range = rangeText(param.range);
  return range.empty() ? param.doc : std::string(param.doc) + " Takes " + range + ".";
}

const PartSpec* OpSpec::part(std::string_view word) const {
  const auto at =
      std::find_if(parts.begin(), parts.end(), [&](const PartSpec& p) { return p.name == word; });
  return at == parts.end() ? nullptr : &*at;
}

const char* typeText(ParamType type) {
  switch (type) {
    case ParamType::Float: return "float";
    case ParamType::Bool: return "bool";
    case ParamType::String: return "string";
    case ParamType::Selector: return "selector";
    case ParamType::FloatArray: return "float[]";
    case ParamType::BoolArray: return "bool[]";
    case ParamType::StringArray: return "string[]";
    case ParamType::Size: return "size";
    case ParamType::FloatingSize: return "floating size";
    case ParamType::Drawn: return "drawn";
    case ParamType::DrawnList: return "drawn[]";
    case ParamType::Selection: return "selection";
    case ParamType::Any: break;
  }
  return "any";
}

bool fits(ValueType got, ParamType wanted) {
  const ValueType w = valueType(wanted);
  if (got == ValueType::Null || w == ValueType::Null || got == w) return true;
  return w == ValueType::Selector && got == ValueType::String;
}

uint32_t effectsOfValues(uint32_t effects, std::span<const Value> values, const ValuePool& pool) {
  bool worldNamed = false;
  for (const Value& v : values) {
    if (v.type != ValueType::Selector && v.type != ValueType::String) continue;
    // A selection written as text may name the world anywhere in it.
    const std::string_view text = pool.text(v.id);
    worldNamed = worldNamed || namesWorld(text) || text.find("world.") != std::string_view::npos;
  }
  return effectsOfCall(effects, worldNamed) | (worldNamed ? uint32_t{kReadsWorld} : 0u);
}

const OpSpec* Catalogue::operation(std::string_view name) const { return find(operations, name); }
const FunctionSpec* Catalogue::function(std::string_view name) const {
  return find(functions, name);
}
const AttributeSpec* Catalogue::attribute(std::string_view name) const {
  return find(attributes, name);
}
bool Catalogue::isSelector(std::string_view name) const {
  return std::any_of(selectors.begin(), selectors.end(),
                     [&](const SelectorSpec& s) { return s.name == name; });
}

}  // namespace gable
