// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Values of maps are data, so one that the rules do not expect is told of and taken as it is, where
// one that the caller sets is refused.

#include "engine/outside_values.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/work.h"
#include "runtime/attribute_values.h"
#include "shape/feature_text.h"

namespace gable {

namespace {

struct Told {
  Diagnostics::Entry entry;
  size_t more = 0;
};

std::string nameOf(const InitialShape& shape, size_t index) {
  if (shape.feature > 0) return featureText(shape.feature, shape.identity, shape.name);
  if (!shape.identity.empty()) return "shape '" + shape.identity + "'";
  return "shape " + std::to_string(index + 1);
}

// The attributes that values can be given to, by name.
using Taking = std::unordered_multimap<std::string_view, const AttributeCode*>;
Taking takingOf(const Program& program) {
  Taking out;
  for (const AttributeCode& a : program.attributes) {
    if (takesValues(a)) out.emplace(a.name, &a);
  }
  return out;
}

// Bounds of those of imports are no business of a map: a property of its own may have their name.
bool isBounded(const AttributeCode& a) {
  const bool main = a.name.find('.') == std::string::npos;
  return main && std::ranges::any_of(a.annotations, [](const auto& n) {
           return n.name == "Range" || n.name == "Enum";
         });
}

const char* kindOf(ValueType type) {
  switch (type) {
    case ValueType::Float: return "a number";
    case ValueType::Bool: return "true or false";
    case ValueType::String: return "a text";
    default: return "an array";
  }
}

std::optional<Diagnostics::Entry> wrongOf(const AttributeCode& a, const Value& v, ValuePool& pool) {
  if (takesValue(a, v, pool)) return isBounded(a) ? outsideOf(a, v, pool) : std::nullopt;
  Diagnostics::Entry e;
  e.code = "attribute-type";
  e.message = "'" + a.name + "' is " + kindOf(a.type) + ", and '" + pool.str(v) + "' is none";
  e.hint = a.type == ValueType::Float
               ? "the value of the rules is used instead; write a number, or a length with its "
                 "unit, such as 12 ft"
               : "the value of the rules is used instead";
  return e;
}

}  // namespace

DiagnosticList outsideValues(std::span<const InitialShape> shapes, const Rules::Impl& rules) {
  const Taking taking = takingOf(rules.program);
  std::vector<Told> told;
  // By attribute and what is wrong with its values.
  std::map<std::pair<const AttributeCode*, std::string>, size_t> known;
  for (size_t i = 0; i < shapes.size(); ++i) {
    work();
    for (const auto& [name, value] : shapes[i].attributes) {
      const auto [begin, end] = taking.equal_range(name);
      for (auto at = begin; at != end; ++at) {
        std::optional<Diagnostics::Entry> wrong = wrongOf(*at->second, value, *rules.pool);
        if (!wrong) continue;
        const auto [place, fresh] = known.try_emplace({at->second, wrong->code}, told.size());
        if (!fresh) {
          ++told[place->second].more;
          continue;
        }
        wrong->severity = Severity::Warning;
        wrong->message += ", in " + nameOf(shapes[i], i);
        told.push_back({std::move(*wrong)});
      }
    }
  }
  DiagnosticList out;
  for (Told& t : told) {
    if (t.more == 1) t.entry.message += " and one more";
    if (t.more > 1) t.entry.message += " and " + std::to_string(t.more) + " more";
    out.push_back(diagnosticOf(t.entry, Sources{}));
  }
  return out;
}

}  // namespace gable
