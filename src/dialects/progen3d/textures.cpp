// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/progen3d/textures.h"

#include <cstddef>

namespace gable::progen3d {

namespace {

struct Stuff {
  std::string_view word;
  const char* picture;
};
// Longer words before those that they begin with.
constexpr Stuff kStuffs[] = {{"concrete", "00_concrete"},
                             {"cement", "00_concrete"},
                             {"plaster", "01_plaster"},
                             {"bricks", "02_brick"},
                             {"brick", "02_brick"},
                             {"oak", "03_oak"},
                             {"wood", "03_oak"},
                             {"sandstone", "04_sandstone"},
                             {"sand", "04_sandstone"},
                             {"ashlar", "05_ashlar"},
                             {"stone", "05_ashlar"},
                             {"rooftiles", "06_roof_tiles"},
                             {"roof", "06_roof_tiles"},
                             {"slate", "07_slate"},
                             {"marble", "08_marble"},
                             {"granite", "09_granite"},
                             {"rock", "09_granite"},
                             {"planks", "10_planks"},
                             {"steel", "11_steel"},
                             {"metal", "11_steel"},
                             {"walnut", "12_walnut"},
                             {"corrugated", "13_corrugated"},
                             {"copper", "14_copper"},
                             {"driftwood", "15_driftwood"},
                             {"floortiles", "16_floor_tiles"},
                             {"tiles", "16_floor_tiles"},
                             {"tile", "16_floor_tiles"},
                             {"ceramic", "16_floor_tiles"},
                             {"stucco", "17_stucco"},
                             {"grass", "18_grass"},
                             {"gravel", "19_gravel"},
                             {"asphalt", "20_asphalt"},
                             {"cobblestone", "21_cobblestone"},
                             {"cobble", "21_cobblestone"},
                             {"glass", "22_glass"},
                             {"linen", "23_linen"},
                             {"fabric", "23_linen"},
                             {"cloth", "23_linen"},
                             {"plastic", ""},
                             {"paint", ""}};

struct Tint {
  std::string_view word;
  const char* color;
};
constexpr Tint kTints[] = {
    {"white", "#ffffff"},  {"black", "#303030"}, {"grey", "#9a9a9a"},   {"gray", "#9a9a9a"},
    {"red", "#c8483c"},    {"green", "#5f9f4a"}, {"blue", "#4a78c0"},   {"yellow", "#e0c64a"},
    {"orange", "#e08a3c"}, {"brown", "#8a6040"}, {"purple", "#8058a8"}, {"pink", "#e0a0b0"},
    {"cyan", "#58b8c0"},   {"beige", "#d8c8a4"}, {"gold", "#d8b13c"},   {"silver", "#c8ccd0"}};

struct Sheen {
  std::string_view word;
  double roughness;
};
constexpr Sheen kSheens[] = {{"rough", 0.9},  {"matte", 0.9},      {"matt", 0.9},
                             {"smooth", 0.4}, {"polished", 0.15},  {"shiny", 0.2},
                             {"glossy", 0.2}, {"reflective", 0.1}, {"dull", 0.8}};

struct Clarity {
  std::string_view word;
  double opacity;
};
constexpr Clarity kClarities[] = {
    {"semitransparent", 0.5}, {"transparent", 0.25}, {"translucent", 0.6}, {"opaque", 1}};

/// The word of a table that the rest of a name begins with, cut off it; null when there is none.
template <class Word, size_t N>
const Word* taken(const Word (&table)[N], std::string_view& rest) {
  for (const Word& w : table) {
    if (!rest.starts_with(w.word)) continue;
    rest.remove_prefix(w.word.size());
    return &w;
  }
  return nullptr;
}

}  // namespace

std::optional<NamedTexture> namedTexture(std::string_view name) {
  std::string letters;
  for (const char c : name) {
    if (c >= 'A' && c <= 'Z')
      letters += static_cast<char>(c + 32);
    else if (c >= 'a' && c <= 'z')
      letters += c;
  }
  NamedTexture out;
  std::string_view rest = letters;
  while (!rest.empty()) {
    if (const Stuff* stuff = taken(kStuffs, rest)) {
      if (*stuff->picture) out.path = std::string("builtin:textures/") + stuff->picture + ".png";
    } else if (const Tint* tint = taken(kTints, rest)) {
      out.color = tint->color;
    } else if (const Clarity* clarity = taken(kClarities, rest)) {
      out.opacity = clarity->opacity;
    } else if (const Sheen* sheen = taken(kSheens, rest)) {
      out.roughness = sheen->roughness;
    } else {
      return std::nullopt;
    }
  }
  if (letters.empty()) return std::nullopt;
  return out;
}

}  // namespace gable::progen3d
