// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "city/building_kind.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/text.h"

namespace gable {
namespace {

using Words = std::pair<std::string_view, std::string_view>;

// What `building` says of the kind. Those that are missing here say nothing of it.
constexpr Words kBuildings[] = {{"house", "house"},
                                {"detached", "house"},
                                {"semidetached_house", "house"},
                                {"bungalow", "house"},
                                {"farm", "house"},
                                {"cabin", "house"},
                                {"villa", "house"},
                                {"static_caravan", "house"},
                                {"terrace", "terrace"},
                                {"apartments", "apartments"},
                                {"dormitory", "apartments"},
                                {"commercial", "commercial"},
                                {"retail", "commercial"},
                                {"office", "commercial"},
                                {"supermarket", "commercial"},
                                {"hotel", "commercial"},
                                {"mall", "commercial"},
                                {"civic", "public"},
                                {"public", "public"},
                                {"government", "public"},
                                {"hospital", "public"},
                                {"train_station", "public"},
                                {"transportation", "public"},
                                {"museum", "public"},
                                {"fire_station", "public"},
                                {"stadium", "public"},
                                {"grandstand", "public"},
                                {"sports_hall", "public"},
                                {"sports_centre", "public"},
                                {"palace", "public"},
                                {"castle", "public"},
                                {"school", "school"},
                                {"kindergarten", "school"},
                                {"university", "school"},
                                {"college", "school"},
                                {"church", "church"},
                                {"chapel", "church"},
                                {"cathedral", "church"},
                                {"basilica", "church"},
                                {"monastery", "apartments"},
                                {"mosque", "church"},
                                {"temple", "church"},
                                {"synagogue", "church"},
                                {"religious", "church"},
                                {"shrine", "shed"},
                                {"industrial", "industrial"},
                                {"warehouse", "industrial"},
                                {"hangar", "industrial"},
                                {"factory", "industrial"},
                                {"manufacture", "industrial"},
                                {"barn", "industrial"},
                                {"farm_auxiliary", "industrial"},
                                {"stable", "industrial"},
                                {"cowshed", "industrial"},
                                {"sty", "industrial"},
                                {"greenhouse", "industrial"},
                                {"depot", "industrial"},
                                {"parking", "commercial"},
                                {"garage", "garage"},
                                {"garages", "garage"},
                                {"carport", "garage"},
                                {"shed", "shed"},
                                {"hut", "shed"},
                                {"kiosk", "shed"},
                                {"toilets", "shed"},
                                {"service", "shed"},
                                {"bunker", "shed"},
                                {"container", "shed"},
                                {"guardhouse", "shed"},
                                {"transformer_tower", "shed"}};
constexpr Words kAmenities[] = {
    {"place_of_worship", "church"}, {"school", "school"},  {"kindergarten", "school"},
    {"university", "school"},       {"college", "school"}, {"townhall", "public"},
    {"hospital", "public"},         {"theatre", "public"}, {"library", "public"},
    {"courthouse", "public"},       {"police", "public"},  {"fire_station", "public"},
    {"community_centre", "public"}, {"toilets", "shed"}};

// The names of CSS that walls and roofs have, and some that maps use besides.
constexpr Words kColours[] = {{"aliceblue", "f0f8ff"},     {"antiquewhite", "faebd7"},
                              {"beige", "f5f5dc"},         {"bisque", "ffe4c4"},
                              {"black", "000000"},         {"blue", "0000ff"},
                              {"brown", "a52a2a"},         {"burlywood", "deb887"},
                              {"cadetblue", "5f9ea0"},     {"chocolate", "d2691e"},
                              {"coral", "ff7f50"},         {"cornsilk", "fff8dc"},
                              {"cream", "fffdd0"},         {"crimson", "dc143c"},
                              {"cyan", "00ffff"},          {"darkblue", "00008b"},
                              {"darkbrown", "5c4033"},     {"darkgray", "a9a9a9"},
                              {"darkgreen", "006400"},     {"darkgrey", "a9a9a9"},
                              {"darkkhaki", "bdb76b"},     {"darkorange", "ff8c00"},
                              {"darkred", "8b0000"},       {"darksalmon", "e9967a"},
                              {"darkslategray", "2f4f4f"}, {"darkslategrey", "2f4f4f"},
                              {"dimgray", "696969"},       {"dimgrey", "696969"},
                              {"firebrick", "b22222"},     {"floralwhite", "fffaf0"},
                              {"gainsboro", "dcdcdc"},     {"gold", "ffd700"},
                              {"goldenrod", "daa520"},     {"gray", "808080"},
                              {"green", "008000"},         {"grey", "808080"},
                              {"honeydew", "f0fff0"},      {"indianred", "cd5c5c"},
                              {"ivory", "fffff0"},         {"khaki", "f0e68c"},
                              {"lavender", "e6e6fa"},      {"lemonchiffon", "fffacd"},
                              {"lightblue", "add8e6"},     {"lightbrown", "b5651d"},
                              {"lightcoral", "f08080"},    {"lightgoldenrodyellow", "fafad2"},
                              {"lightgray", "d3d3d3"},     {"lightgreen", "90ee90"},
                              {"lightgrey", "d3d3d3"},     {"lightpink", "ffb6c1"},
                              {"lightsalmon", "ffa07a"},   {"lightslategray", "778899"},
                              {"lightyellow", "ffffe0"},   {"linen", "faf0e6"},
                              {"maroon", "800000"},        {"mediumseagreen", "3cb371"},
                              {"midnightblue", "191970"},  {"mistyrose", "ffe4e1"},
                              {"moccasin", "ffe4b5"},      {"navajowhite", "ffdead"},
                              {"navy", "000080"},          {"oldlace", "fdf5e6"},
                              {"olive", "808000"},         {"olivedrab", "6b8e23"},
                              {"orange", "ffa500"},        {"orangered", "ff4500"},
                              {"palegoldenrod", "eee8aa"}, {"palegreen", "98fb98"},
                              {"papayawhip", "ffefd5"},    {"peachpuff", "ffdab9"},
                              {"peru", "cd853f"},          {"pink", "ffc0cb"},
                              {"plum", "dda0dd"},          {"powderblue", "b0e0e6"},
                              {"purple", "800080"},        {"red", "ff0000"},
                              {"rosybrown", "bc8f8f"},     {"royalblue", "4169e1"},
                              {"saddlebrown", "8b4513"},   {"salmon", "fa8072"},
                              {"sandybrown", "f4a460"},    {"seagreen", "2e8b57"},
                              {"seashell", "fff5ee"},      {"sienna", "a0522d"},
                              {"silver", "c0c0c0"},        {"skyblue", "87ceeb"},
                              {"slateblue", "6a5acd"},     {"slategray", "708090"},
                              {"slategrey", "708090"},     {"snow", "fffafa"},
                              {"steelblue", "4682b4"},     {"tan", "d2b48c"},
                              {"teal", "008080"},          {"thistle", "d8bfd8"},
                              {"tomato", "ff6347"},        {"turquoise", "40e0d0"},
                              {"violet", "ee82ee"},        {"wheat", "f5deb3"},
                              {"white", "ffffff"},         {"whitesmoke", "f5f5f5"},
                              {"yellow", "ffff00"},        {"yellowgreen", "9acd32"}};

template <size_t N>
std::string_view find(const Words (&words)[N], std::string_view word) {
  const auto at = std::find_if(std::begin(words), std::end(words),
                               [&](const Words& w) { return w.first == word; });
  return at == std::end(words) ? std::string_view() : at->second;
}

constexpr double kShedArea = 28, kHouseArea = 420, kTerraceArea = 260, kHallArea = 250;
constexpr double kTowerLevels = 13;

}  // namespace

std::string_view buildingKindOf(const MapFeature& f, const BuildingSize& size,
                                std::string_view landUse) {
  const std::string_view said = find(kBuildings, f.tag("building"));
  const bool dwelling = said == "apartments" || said == "commercial" || said.empty();
  if (dwelling && size.levels >= kTowerLevels) return "tower";
  if (!said.empty()) return said;
  const std::string_view amenity = find(kAmenities, f.tag("amenity"));
  if (!amenity.empty()) return amenity;
  const std::string_view history = f.tag("historic");
  if (history == "castle" || history == "palace" || history == "monument" ||
      f.tag("tourism") == "museum") {
    return "public";
  }
  if (!f.tag("tourism").empty() || !f.tag("office").empty()) return "commercial";
  if (size.area < kShedArea) return "shed";
  if (landUse == "garages") return "garage";
  const bool works = landUse == "industrial" || landUse == "railway" || landUse == "farmyard";
  if (works && size.area > kHallArea) return "industrial";
  if (size.levels > 4) return "apartments";
  if (size.attached > 0.25 && size.area < kTerraceArea) return "terrace";
  if (size.attached < 0.25 && size.area < kHouseArea && size.levels <= 3) return "house";
  if (landUse == "retail" || landUse == "commercial") return "commercial";
  return "apartments";
}

std::string colourOfTag(std::string_view text) {
  std::string plain;
  for (const char c : text) {
    if (c != '-' && c != '_' && c != ' ') plain += lowerCase(c);
  }
  if (!plain.empty() && plain[0] == '#') {
    const bool digits = std::all_of(plain.begin() + 1, plain.end(), [](char c) {
      return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
    });
    if (!digits) return {};
    if (plain.size() == 4) {
      return {'#', plain[1], plain[1], plain[2], plain[2], plain[3], plain[3]};
    }
    return plain.size() == 7 ? plain : std::string();
  }
  const std::string_view digits = find(kColours, plain);
  return digits.empty() ? std::string() : '#' + std::string(digits);
}

}  // namespace gable
