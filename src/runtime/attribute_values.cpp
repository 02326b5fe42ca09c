// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/attribute_values.h"

#include <optional>

#include "base/measure.h"
#include "base/number.h"

namespace gable {

namespace {

// What the attribute of a shape may be, when a rule attribute of type `wanted` takes it.
bool convert(const Value& v, ValueType wanted, const ValuePool& pool, Value& out) {
  if (wanted == ValueType::Null || v.type == wanted) {
    out = v;
    return true;
  }
  if (wanted == ValueType::Float && v.type == ValueType::String) {
    const std::string_view text = pool.text(v.id);
    double number = 0;
    const std::optional<double> metres =
        parseNumber(text, number) ? std::optional(number) : writtenMetres(text);
    if (metres) out = Value::of(*metres);
    return metres.has_value();
  }
  if (wanted == ValueType::Float && v.type == ValueType::Bool) {
    out = Value::of(v.number);
    return true;
  }
  if (wanted == ValueType::Bool && v.type == ValueType::Float) {
    out = Value::of(v.number != 0);
    return true;
  }
  if (wanted == ValueType::Bool && v.type == ValueType::String) {
    const std::string_view text = pool.text(v.id);
    if (text != "true" && text != "false") return false;
    out = Value::of(text == "true");
    return true;
  }
  return false;
}

}  // namespace

bool takesValues(const AttributeCode& a) { return !a.constant && a.propagatesFrom < 0; }

void AttributeValues::begin() { slots_.assign(slots_.size(), Slot{}); }

bool takesValue(const AttributeCode& attribute, const Value& value, const ValuePool& pool) {
  Value taken;
  return convert(value, attribute.type, pool, taken);
}

void AttributeValues::give(const Given& values, const Program& program, const ValuePool& pool) {
  for (const auto& [name, value] : values) {
    for (uint32_t a = 0; a < program.attributes.size(); ++a) {
      const AttributeCode& attribute = program.attributes[a];
      if (!takesValues(attribute) || attribute.name != name) continue;
      Value taken;
      if (convert(value, attribute.type, pool, taken)) set(a, taken);
    }
  }
}

AttributeValues AttributeValues::known() const {
  AttributeValues out = *this;
  for (uint32_t a = 0; a < out.slots_.size(); ++a) out.giveUpEvaluation(a);
  return out;
}

std::vector<uint64_t> AttributeValues::hashes() const {
  std::vector<uint64_t> out(slots_.size(), 0);
  for (uint32_t a = 0; a < out.size(); ++a) {
    if (isKnown(a)) out[a] = value(a).hash() | 1;
  }
  return out;
}

}  // namespace gable
