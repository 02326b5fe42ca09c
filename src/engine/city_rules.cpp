// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A rule of a city that has a slip in its name is called by nothing, and the shapes that it is
// meant for begin with the start rule; an attribute that has one is set by nothing, and keeps its
// default: nothing of that looks wrong, so it is told.

#include "engine/city_rules.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.h"
#include "base/work.h"
#include "city/plan.h"
#include "engine/footprint.h"
#include "engine/unused_properties.h"

namespace gable {

namespace {

constexpr size_t kMostNamed = 12;
// Short names are near to each other by chance.
constexpr size_t kShortest = 5;
// A property is common that one of so many buildings has.
constexpr size_t kCommon = 10;

// The rules that the plan asks for and the program lacks, with the number of shapes.
std::map<std::string, size_t> missingRules(const Shapes::Impl& shapes, const Program& program) {
  std::map<std::string, size_t> asked;
  for (const ShapeFootprint& f : shapes.footprints) {
    work();
    for (const AttributeValue& a : f.attributes) {
      if (namesStartRule(a)) ++asked[a.values[0].text];
    }
  }
  std::erase_if(asked, [&](const auto& r) { return program.findRule(r.first) >= 0; });
  return asked;
}

// Of the file itself: what it imports is made for others, too.
std::vector<const RuleCode*> uncalledRules(const Program& program) {
  std::vector<bool> called(program.rules.size(), false);
  for (const Instruction& i : program.code) {
    work();
    if (i.code == Code::RunRule || i.code == Code::CallRule) called[i.a] = true;
  }
  std::vector<const RuleCode*> out;
  const std::vector<std::string_view>& city = cityRules();
  for (size_t i = 0; i < program.rules.size(); ++i) {
    const RuleCode& r = program.rules[i];
    const bool own = r.qualifiedName.find('.') == std::string::npos;
    const bool starts = r.startRule || static_cast<int32_t>(i) == program.startRule;
    const bool byPlan =
        r.parameters.empty() &&
        std::binary_search(city.begin(), city.end(), std::string_view(r.qualifiedName));
    if (own && !called[i] && !starts && !byPlan) out.push_back(&r);
  }
  return out;
}

std::string counted(size_t n) { return n == 1 ? "1 shape" : std::to_string(n) + " shapes"; }

// "Lot (3), Water (1), ..".
std::string listed(const std::map<std::string, size_t>& missing) {
  std::string out;
  size_t told = 0;
  for (const auto& [name, count] : missing) {
    if (told++ == kMostNamed) return out + ", ..";
    out += (out.empty() ? "" : ", ") + name + " (" + std::to_string(count) + ')';
  }
  return out;
}

std::string startOf(const Program& program) {
  return program.startRule < 0
             ? std::string()
             : program.rules[static_cast<size_t>(program.startRule)].qualifiedName;
}

// What the map says of its shapes, as rules can write it: all of it, and what is said of many
// buildings. Maps have rare words that are near to any other.
struct Properties {
  std::set<std::string> all;
  std::vector<std::string> common;
};

Properties propertiesOf(const Shapes::Impl& shapes) {
  Properties out;
  std::map<std::string, size_t> counts;
  size_t buildings = 0;
  for (const ShapeFootprint& f : shapes.footprints) {
    work(f.attributes.size());
    const bool isBuilding =
        std::any_of(f.attributes.begin(), f.attributes.end(), [](const AttributeValue& a) {
          return namesStartRule(a) && a.values[0].text == "Building";
        });
    if (isBuilding) ++buildings;
    for (const AttributeValue& a : f.attributes) {
      const std::string name = identifierOf(a.name);
      out.all.insert(name);
      if (isBuilding) ++counts[name];
    }
  }
  for (const auto& [name, count] : counts) {
    if (count * kCommon >= buildings && name.size() >= kShortest) out.common.push_back(name);
  }
  return out;
}

// Own attributes that no shape sets, and that are spelt nearly as a property which none of them
// has.
void tellAttributes(const Shapes::Impl& shapes, const Program& program, Diagnostics& told) {
  const Properties properties = propertiesOf(shapes);
  std::vector<std::string_view> free;
  for (const std::string& p : properties.common) {
    if (program.findAttribute(p) < 0) free.push_back(p);
  }
  for (const AttributeCode& a : program.attributes) {
    const bool own = a.name.find('.') == std::string::npos;
    if (!own || a.constant || a.hidden || a.name.size() < kShortest) continue;
    if (properties.all.contains(a.name)) continue;
    const std::string meant = nearestName(a.name, free);
    // One letter: attributes have meanings of their own, such as has_paths beside has_parts.
    if (meant.empty() || editDistance(a.name, meant, 1) > 1) continue;
    told.warning("city-attribute", a.span,
                 "nothing in this map sets the attribute '" + a.name + "': no shape has it",
                 "did you mean '" + meant + "'?");
  }
}

}  // namespace

DiagnosticList cityRuleNotes(const Shapes::Impl& shapes, const Rules::Impl& rules) {
  if (!shapes.ofMap || !shapes.isWhole) return {};
  const Program& program = rules.program;
  std::map<std::string, size_t> missing = missingRules(shapes, program);
  const std::string start = startOf(program);
  Diagnostics told;
  size_t unused = 0;
  for (const RuleCode* r : uncalledRules(program)) {
    const std::string meant = nearestName(r->qualifiedName, cityRules());
    // Two rules of the plan are near each other in no case, so one of them is not meant here.
    const bool lacks = !meant.empty() && program.findRule(meant) < 0;
    if (!meant.empty() && !lacks) {
      told.warning("city-rule", r->span,
                   "a city calls no rule '" + r->qualifiedName + "': it begins with '" + meant +
                       "', which is there as well",
                   "did you mean '" + meant + "'?");
    } else if (lacks) {
      const auto at = missing.find(meant);
      const std::string instead =
          at == missing.end()
              ? std::string()
              : ", and " + counted(at->second) + " '" + meant + "' of the map " +
                    (at->second == 1 ? "begins" : "begin") + " with '" + start + "'";
      told.warning("city-rule", r->span,
                   "a city calls no rule '" + r->qualifiedName + "'" + instead,
                   "did you mean '" + meant + "'?");
      missing.erase(meant);
    } else if (unused++ < kMostNamed) {
      told.warning(
          "unused-rule", r->span, "nothing in this city calls the rule '" + r->qualifiedName + "'",
          "call it in a rule that a city begins with, such as Building or Lot, or take it out");
    }
  }
  if (!missing.empty()) {
    told.add({Severity::Note,
              "city-rules",
              Span{},
              "the rules have none for these shapes of the map, which begin with '" + start +
                  "': " + listed(missing),
              "write a rule of that name for what shall look otherwise; NIL makes nothing",
              {},
              {}});
  }
  tellAttributes(shapes, program, told);
  return listOf(told, rules.sources);
}

}  // namespace gable
