// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/progen3d/textures.h"

#include <cstddef>

#include "base/text.h"

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
                             {"paint", ""},
                             {"basalt", "09_granite"},
                             {"aluminium", "11_steel"},
                             {"aluminum", "11_steel"},
                             {"titanium", "11_steel"},
                             {"chrome", "11_steel"},
                             {"iron", "11_steel"},
                             {"ice", "22_glass"},
                             {"water", ""},
                             {"soil", "19_gravel"},
                             {"surface", ""}};

struct Tint {
  std::string_view word;
  const char* color;
};
constexpr Tint kTints[] = {
    {"white", "#ffffff"},  {"black", "#303030"}, {"grey", "#9a9a9a"},   {"gray", "#9a9a9a"},
    {"red", "#c8483c"},    {"green", "#5f9f4a"}, {"blue", "#4a78c0"},   {"yellow", "#e0c64a"},
    {"orange", "#e08a3c"}, {"brown", "#8a6040"}, {"purple", "#8058a8"}, {"pink", "#e0a0b0"},
    {"cyan", "#58b8c0"},   {"beige", "#d8c8a4"}, {"gold", "#d8b13c"},   {"silver", "#c8ccd0"},
    {"bronze", "#8a6238"}, {"teal", "#3a8a88"},  {"tan", "#c8a878"},    {"dark", "#5a5652"}};

struct Sheen {
  std::string_view word;
  double roughness;
};
constexpr Sheen kSheens[] = {
    {"rough", 0.9},     {"matte", 0.9},   {"matt", 0.9},     {"smooth", 0.4},
    {"polished", 0.15}, {"shiny", 0.2},   {"glossy", 0.2},   {"reflective", 0.1},
    {"dull", 0.8},      {"brushed", 0.5}, {"satin", 0.45},   {"metallic", 0.3},
    {"aged", 0.8},      {"rusty", 0.9},   {"cracked", 0.95}, {"raw", 0.7}};

struct Clarity {
  std::string_view word;
  double opacity;
};
constexpr Clarity kClarities[] = {{"semitransparent", 0.5}, {"transparent", 0.25},
                                  {"translucent", 0.6},     {"opaque", 1},
                                  {"clear", 0.25},          {"frosted", 0.6}};

// Names of the web language that their words do not tell.
struct Preset {
  std::string_view name;
  /// Without one the colour alone.
  const char* picture;
  const char* color;
  double opacity, roughness, metallic;
};
constexpr Preset kPresets[] = {
    {"redbrickwall", "02_brick", "", 1, 0.9, 0},
    {"blueceramictile", "16_floor_tiles", "#5f8fd0", 1, 0.3, 0},
    {"oxidizedcopper", "14_copper", "", 1, 0.7, 0},
    {"agedbronze", "", "#7a5632", 1, 0.6, 0.8},
    {"shinygold", "", "#e0bc4c", 1, 0.2, 1},
    {"tarnishedsilver", "", "#b4b6b8", 1, 0.5, 0.9},
    {"tintedgreenglass", "", "#6fae84", 0.35, 0.05, 0},
    {"stainedblueglass", "", "#3f5fc0", 0.45, 0.05, 0},
    {"redabs", "", "#d8302c", 1, 0.35, 0},
    {"bluepvc", "", "#2c44c8", 1, 0.35, 0},
    {"translucentpoly", "", "#e6e6e6", 0.5, 0.3, 0},
    {"freshgrass", "18_grass", "", 1, 0.95, 0},
    {"drygrass", "18_grass", "#d8c070", 1, 0.95, 0},
    {"desertsand", "04_sandstone", "", 1, 0.95, 0},
    {"muddysoil", "19_gravel", "#7a5638", 1, 0.95, 0},
    {"pinewood", "10_planks", "#e0bc84", 1, 0.7, 0},
    {"mahoganywood", "12_walnut", "#c07058", 1, 0.5, 0},
    {"cherrywood", "12_walnut", "#c88068", 1, 0.5, 0},
    {"maplewood", "03_oak", "#f0dcb4", 1, 0.5, 0},
    {"iceblock", "", "#cfe8ff", 0.5, 0.1, 0},
    {"moltenlava", "09_granite", "#e0481c", 1, 0.8, 0},
    {"deepwater", "", "#2c5cc0", 0.6, 0.05, 0},
    {"snowpowder", "", "#f6f8fc", 1, 0.95, 0},
    {"fluffycloud", "", "#f0f2f6", 1, 1, 0},
    {"mosspatch", "18_grass", "#8fae6a", 1, 1, 0},
    {"claysoil", "", "#a05a3c", 1, 0.95, 0},
    {"rustymetal", "11_steel", "#b06a44", 1, 0.9, 0.3},
    {"carbonfiber", "23_linen", "#2c2c2e", 1, 0.35, 0},
    {"circuitboard", "16_floor_tiles", "#3c9a4c", 1, 0.5, 0},
    {"glowingpanel", "", "#58d8f8", 0.8, 0.2, 0},
    {"hazardstripe", "", "#e0c02c", 1, 0.5, 0},
    {"steelgrid", "16_floor_tiles", "#70747c", 1, 0.4, 0.6},
    {"chromesurface", "", "#e4e6ea", 1, 0.08, 1},
};

NamedTexture ofPreset(const Preset& p) {
  NamedTexture out;
  if (*p.picture) out.path = std::string("builtin:textures/") + p.picture + ".png";
  out.color = p.color;
  out.opacity = p.opacity;
  out.roughness = p.roughness;
  out.metallic = p.metallic;
  return out;
}

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
    const char low = lowerCase(c);
    if (low >= 'a' && low <= 'z') letters += low;
  }
  for (const Preset& p : kPresets) {
    if (p.name == letters) return ofPreset(p);
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
