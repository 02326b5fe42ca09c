// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Effects (program/spec.h) that have to do with tags. Tags lie in the geometry, which sharing
// compares. Rules that cannot see those of boxes and rectangles work without them, so that parts
// which differ in nothing else are shared.
#pragma once

#include <string_view>

#include "program/spec.h"

namespace gable {

/// The names of tags. A function or an attribute that sees them declares it; an operation does so
/// unless it declares the other.
inline constexpr uint32_t kReadsTags = 1u << 17;
/// The operation may be given a shape without its tags: what it makes differs in tags alone.
inline constexpr uint32_t kIgnoresTags = 1u << 18;

constexpr uint32_t effectsOfOperation(uint32_t effects) {
  return (effects & kIgnoresTags) != 0 ? effects : effects | kReadsTags;
}

/// Of a rule and all that it reaches: whether it may see that tags differ.
constexpr bool seesTags(uint32_t effects) { return (effects & (kReadsTags | kReadsRegion)) != 0; }

constexpr uint32_t effectsOfFunction(uint32_t effects) {
  return seesTags(effects) ? effects : effects | kIgnoresTags;
}

/// Whether a selector looks for the tags of streets.
constexpr bool asksForStreets(std::string_view word) {
  return word.starts_with("street") || word == "noStreetSide";
}

/// Whether a selector looks for any tags: the edges of a roof are told by its bottom.
inline bool asksForTags(std::string_view word) {
  return asksForStreets(word) || namesRoofEdge(word);
}

}  // namespace gable
