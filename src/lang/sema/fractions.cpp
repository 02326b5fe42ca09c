// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "lang/sema/fractions.h"

#include <algorithm>

namespace gable::lang {

namespace {

constexpr std::string_view kColor[] = {"red", "green", "blue", "opacity"};
constexpr std::string_view kColorHsvo[] = {"saturation", "value", "opacity"};
constexpr std::string_view kRamp[] = {"value"};
constexpr std::string_view kChance[] = {"probability"};
constexpr std::string_view kMaterial[] = {
    "material.ambient.b",         "material.ambient.g",    "material.ambient.r",
    "material.color.a",           "material.color.b",      "material.color.g",
    "material.color.r",           "material.metallic",     "material.opacity",
    "material.opacitymap.cutoff", "material.reflectivity", "material.roughness",
    "material.specular.b",        "material.specular.g",   "material.specular.r"};

const Fractions kFractions[] = {
    {"color", kColor},
    {"colorHSVOToHex", kColorHsvo},
    {"colorHSVToHex", std::span(kColorHsvo).first(2)},
    {"colorRGBOToHex", kColor},
    {"colorRGBToHex", std::span(kColor).first(3)},
    {"colorRamp", kRamp},
    {"p", kChance},
    {"set", kMaterial},
};

}  // namespace

std::span<const Fractions> fractions() { return kFractions; }

bool isFraction(std::string_view callee, std::string_view parameter) {
  for (const Fractions& f : kFractions) {
    if (f.callee != callee) continue;
    return std::find(f.parameters.begin(), f.parameters.end(), parameter) != f.parameters.end();
  }
  return false;
}

}  // namespace gable::lang
