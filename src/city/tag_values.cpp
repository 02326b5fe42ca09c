// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "city/tag_values.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "base/number.h"
#include "base/text.h"
#include "base/work.h"

namespace gable {
namespace {

constexpr double kFoot = 0.3048, kInch = 0.0254, kMile = 1609.344;
constexpr size_t kNamed = 5;

bool isDigit(char c) { return c >= '0' && c <= '9'; }

void dropSpace(std::string_view& text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
}

// Takes a number from the front. A comma is a decimal one, but for what may be a thousand.
std::optional<double> takeNumber(std::string_view& text) {
  size_t end = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
  const size_t first = end;
  const auto digits = [&] {
    const size_t begin = end;
    while (end < text.size() && isDigit(text[end])) ++end;
    return end - begin;
  };
  size_t count = digits();
  if (end < text.size() && (text[end] == '.' || text[end] == ',')) {
    const bool comma = text[end++] == ',';
    const size_t decimals = digits();
    if (comma && (decimals == 0 || decimals == 3 || count == 0)) return std::nullopt;
    count += decimals;
  }
  if (count == 0) return std::nullopt;
  std::string plain(text.substr(first, end - first));
  std::replace(plain.begin(), plain.end(), ',', '.');
  double value = 0;
  if (!parseNumber(plain, value)) return std::nullopt;
  const bool negative = text[0] == '-';
  text.remove_prefix(end);
  dropSpace(text);
  return negative ? -value : value;
}

struct Unit {
  std::string_view name;
  double metres;
};
// The signs of minutes and quotation marks are those that editors put for ' and ".
constexpr Unit kUnits[] = {{"m", 1},
                           {"metre", 1},
                           {"metres", 1},
                           {"meter", 1},
                           {"meters", 1},
                           {"cm", 0.01},
                           {"km", 1000},
                           {"mi", kMile},
                           {"mile", kMile},
                           {"miles", kMile},
                           {"ft", kFoot},
                           {"foot", kFoot},
                           {"feet", kFoot},
                           {"'", kFoot},
                           {"\xe2\x80\xb2", kFoot},
                           {"\xe2\x80\x99", kFoot},
                           {"in", kInch},
                           {"inch", kInch},
                           {"inches", kInch},
                           {"\"", kInch},
                           {"''", kInch},
                           {"\xe2\x80\xb3", kInch},
                           {"\xe2\x80\x9d", kInch}};

// Takes a unit from the front, up to the next number.
std::optional<double> takeUnit(std::string_view& text) {
  const auto end = std::find_if(text.begin(), text.end(), isDigit);
  std::string_view name = text.substr(0, static_cast<size_t>(end - text.begin()));
  text.remove_prefix(name.size());
  dropSpace(name);
  const Unit* unit = std::find_if(std::begin(kUnits), std::end(kUnits),
                                  [&](const Unit& u) { return equalButForCase(u.name, name); });
  return unit == std::end(kUnits) ? std::nullopt : std::optional(unit->metres);
}

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

std::optional<double> tagNumber(std::string_view text) {
  dropSpace(text);
  const std::optional<double> number = takeNumber(text);
  return text.empty() ? number : std::nullopt;
}

std::optional<double> tagMetres(std::string_view text) {
  dropSpace(text);
  const std::optional<double> number = takeNumber(text);
  if (!number || text.empty()) return number;
  const std::optional<double> unit = takeUnit(text);
  if (!unit) return std::nullopt;
  if (text.empty()) return *number * *unit;
  // Inches behind feet, also without their sign.
  if (*unit != kFoot) return std::nullopt;
  const std::optional<double> inches = takeNumber(text);
  if (!inches || *inches < 0 || *inches >= 12) return std::nullopt;
  const std::optional<double> small = text.empty() ? std::optional(kInch) : takeUnit(text);
  if (small != kInch || !text.empty()) return std::nullopt;
  return *number * kFoot + *inches * kInch;
}

bool isNumberTag(std::string_view key) { return numberTag(key) != nullptr; }

std::optional<std::string> plainTag(std::string_view key, std::string_view value) {
  const NumberTag* tag = numberTag(key);
  if (!tag) return std::string(value);
  const std::optional<double> number = tag->isLength ? tagMetres(value) : tagNumber(value);
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
