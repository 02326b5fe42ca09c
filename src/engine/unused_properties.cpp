// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Maps have many properties that no rule reads, so one is told of only where it looks like a slip.

#include "engine/unused_properties.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <string_view>

#include "base/text.h"
#include "engine/footprint.h"
#include "shape/edge_attributes.h"

namespace gable {

namespace {

// Short names are near to each other by chance.
constexpr size_t kShortest = 5;
constexpr size_t kMostNotes = 8;
/// A file with more names than people give has them from a program, which does not misspell.
constexpr size_t kMostNames = 400;

// "roof_angle", "Roof-Angle" and "roofAngle" alike.
std::string letters(std::string_view name) {
  std::string out = lowerCase(name);
  std::erase_if(out, [](char c) { return c == '_' || c == '-' || c == ' '; });
  return out;
}

std::set<std::string_view> propertiesOf(const Shapes::Impl& shapes) {
  std::set<std::string_view> names;
  for (const ShapeFootprint& f : shapes.footprints) {
    for (const AttributeValue& a : f.attributes) {
      const bool ofEdges = EdgeAttributes::isNamed(a.name, a.rows > 0);
      if (!ofEdges && a.name != kStartRuleAttribute) names.insert(a.name);
      if (names.size() > kMostNames) return {};
    }
  }
  return names;
}

// What shapes can set in the main file.
std::vector<std::string_view> attributesOf(const Rules::Impl& rules) {
  std::vector<std::string_view> out;
  for (const AttributeCode& a : rules.program.attributes) {
    const bool main = a.name.find('.') == std::string::npos;
    if (main && !a.constant && !a.hidden) out.push_back(a.name);
  }
  return out;
}

// `unset`: the attributes that no property sets. What differs in its capitals alone is a slip also
// where another shape has it right.
std::string nearAttribute(const std::string& name, const std::vector<std::string_view>& attributes,
                          const std::vector<std::string_view>& unset) {
  const std::string plain = letters(name);
  for (const std::string_view attribute : attributes) {
    if (letters(attribute) == plain) return std::string(attribute);
  }
  return name.size() < kShortest ? std::string() : nearestName(name, unset);
}

}  // namespace

std::string identifierOf(std::string name) {
  for (char& c : name) {
    const bool fits = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '_' || c == '.';
    if (!fits) c = '_';
  }
  return name;
}

DiagnosticList unusedProperties(const Shapes::Impl& shapes, const Rules::Impl& rules) {
  if (shapes.ofMap) return {};
  const std::set<std::string_view> properties = propertiesOf(shapes);
  std::set<std::string> names;
  for (const std::string_view name : properties) names.insert(identifierOf(std::string(name)));
  const std::vector<std::string_view> attributes = attributesOf(rules);
  std::vector<std::string_view> unset;
  std::copy_if(attributes.begin(), attributes.end(), std::back_inserter(unset),
               [&](std::string_view a) { return !names.contains(std::string(a)); });
  DiagnosticList notes;
  for (const std::string_view property : properties) {
    const std::string name = identifierOf(std::string(property));
    const bool reaches = rules.program.findAttribute(name) >= 0 || rules.open.count(name) > 0;
    const std::string near = reaches ? std::string() : nearAttribute(name, attributes, unset);
    if (near.empty() || notes.size() == kMostNotes) continue;
    notes.push_back(
        diagnosticOf({Severity::Note,
                      "unused-property",
                      Span{},
                      "the property '" + std::string(property) +
                          "' of the shapes sets nothing: the rules have no such attribute",
                      "did you mean '" + near + "'?",
                      {},
                      {}},
                     Sources{}));
  }
  return notes;
}

}  // namespace gable
