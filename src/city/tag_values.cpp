// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "city/tag_values.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "base/measure.h"
#include "base/number.h"
#include "base/text.h"
#include "base/work.h"

namespace gable {
namespace {

constexpr size_t kNamed = 5;

struct NumberTag {
  std::string_view key;
  bool isLength;
  double low, high;
};
// What is beyond these bounds is a slip.
constexpr NumberTag kNumberTags[] = {
    {"height", true, 0, 1000},          {"min_height", true, 0, 1000},
    {"roof:height", true, 0, 300},      {"width", true, 0, 500},
    {"building:levels", false, 0, 199}, {"building:min_level", false, 0, 199},
    {"roof:levels", false, 0, 30},      {"lanes", false, 0, 30},
    {"layer", false, -20, 20}};

const NumberTag* numberTag(std::string_view key) {
  const NumberTag* tag = std::find_if(std::begin(kNumberTags), std::end(kNumberTags),
                                      [&](const NumberTag& t) { return t.key == key; });
  return tag == std::end(kNumberTags) ? nullptr : tag;
}

// What a place is made from; shorter names are too near to others.
constexpr std::string_view kKnown[] = {"addr:housenumber",
                                       "addr:street",
                                       "amenity",
                                       "barrier",
                                       "bridge",
                                       "building",
                                       "building:colour",
                                       "building:levels",
                                       "building:material",
                                       "building:min_level",
                                       "building:part",
                                       "covered",
                                       "entrance",
                                       "height",
                                       "highway",
                                       "landuse",
                                       "leaf_type",
                                       "leisure",
                                       "location",
                                       "min_height",
                                       "natural",
                                       "railway",
                                       "roof:colour",
                                       "roof:direction",
                                       "roof:height",
                                       "roof:levels",
                                       "roof:material",
                                       "roof:orientation",
                                       "roof:shape",
                                       "sidewalk",
                                       "surface",
                                       "tunnel",
                                       "waterway",
                                       "width"};

std::string withoutSigns(std::string_view key) {
  std::string out = lowerCase(key);
  std::replace_if(
      out.begin(), out.end(), [](char c) { return c == '_' || c == '-' || c == ' '; }, ':');
  return out;
}

// The known name that a key is a slip of: one letter, or other signs, or another case.
std::string_view meantBy(std::string_view key) {
  constexpr size_t kLongest = 40, kLong = 12;
  if (key.size() < 4 || key.size() > kLongest) return {};
  if (std::find(std::begin(kKnown), std::end(kKnown), key) != std::end(kKnown)) return {};
  const std::string plain = withoutSigns(key);
  for (const std::string_view known : kKnown) {
    const size_t limit = known.size() >= kLong ? 2 : 1;
    const std::string other = withoutSigns(known);
    if (plain[0] == other[0] && editDistance(plain, other, limit) <= limit) return known;
  }
  return {};
}

}  // namespace

bool isNumberTag(std::string_view key) { return numberTag(key) != nullptr; }

std::optional<std::string> plainTag(std::string_view key, std::string_view value) {
  const NumberTag* tag = numberTag(key);
  if (!tag) return std::string(value);
  const std::optional<double> number = tag->isLength ? writtenMetres(value) : writtenNumber(value);
  if (!number || *number < tag->low || *number > tag->high) return std::nullopt;
  return shortestText(*number);
}

std::vector<MapDoubt> doubtsOf(const std::vector<MapFeature>& features) {
  // Of names that are in order nothing is kept but that they are.
  std::map<std::string_view, MapDoubt> names, values;
  for (const MapFeature& f : features) {
    for (const auto& [key, value] : f.tags) {
      work();
      const auto [name, fresh] = names.try_emplace(key);
      if (fresh) name->second.meant = meantBy(key);
      MapDoubt* doubt = name->second.meant.empty() ? nullptr : &name->second;
      if (!doubt && !plainTag(key, value)) doubt = &values[key];
      if (!doubt) continue;
      ++doubt->count;
      if (doubt->first.size() < kNamed) doubt->first.emplace_back(f.id, value);
    }
  }
  std::vector<MapDoubt> out;
  for (auto* list : {&names, &values}) {
    for (auto& [key, doubt] : *list) {
      if (doubt.count == 0) continue;
      doubt.key = key;
      out.push_back(std::move(doubt));
    }
  }
  return out;
}

}  // namespace gable
