// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Values of maps are data, so one that the rules do not expect is told of and taken as it is, where
// one that the caller sets is refused.

#include "engine/outside_values.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/work.h"

namespace gable {

namespace {

struct Told {
  Diagnostics::Entry entry;
  size_t more = 0;
};

std::string nameOf(const InitialShape& shape, size_t index) {
  if (!shape.identity.empty()) return "shape '" + shape.identity + "'";
  return "shape " + std::to_string(index + 1);
}

// The attributes that bound their values, by name. Those of imports are no business of a map: a
// property of its own may have their name.
std::unordered_map<std::string_view, const AttributeCode*> boundedOf(const Program& program) {
  std::unordered_map<std::string_view, const AttributeCode*> out;
  for (const AttributeCode& a : program.attributes) {
    const bool bounded = std::ranges::any_of(
        a.annotations, [](const auto& n) { return n.name == "Range" || n.name == "Enum"; });
    const bool main = a.name.find('.') == std::string::npos;
    if (bounded && main && !a.constant) out.emplace(a.name, &a);
  }
  return out;
}

}  // namespace

DiagnosticList outsideValues(std::span<const InitialShape> shapes, const Rules::Impl& rules) {
  const auto bounded = boundedOf(rules.program);
  if (bounded.empty()) return {};
  std::vector<Told> told;
  std::unordered_map<const AttributeCode*, size_t> known;
  for (size_t i = 0; i < shapes.size(); ++i) {
    work();
    for (const auto& [name, value] : shapes[i].attributes) {
      const auto at = bounded.find(name);
      if (at == bounded.end()) continue;
      std::optional<Diagnostics::Entry> outside = outsideOf(*at->second, value, *rules.pool);
      if (!outside) continue;
      const auto [place, fresh] = known.try_emplace(at->second, told.size());
      if (!fresh) {
        ++told[place->second].more;
        continue;
      }
      outside->severity = Severity::Warning;
      outside->message += ", in " + nameOf(shapes[i], i);
      told.push_back({std::move(*outside)});
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
