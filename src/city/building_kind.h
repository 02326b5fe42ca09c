// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a building is, in one of a few words that rules choose a style by: from its tags, else from
// its size, its storeys, how much of it neighbours hide, and the use of the land around it. And the
// colours of its tags, as rules know colours.
#pragma once

#include <string>
#include <string_view>

#include "io/importers/map_features.h"

namespace gable {

struct BuildingSize {
  double area = 0;
  /// 0: unknown.
  double levels = 0;
  /// Of the length of its walls, what stands against neighbours.
  double attached = 0;
};

/// "house", "terrace", "apartments", "tower", "commercial", "public", "school", "church",
/// "industrial", "garage" or "shed". `landUse` is the value of `landuse` around it, or empty.
std::string_view buildingKindOf(const MapFeature& f, const BuildingSize& size,
                                std::string_view landUse);

/// A tag's colour as "#rrggbb": those of the form #rgb and #rrggbb, and the names of CSS, also
/// with - or _ within; empty for what is none.
std::string colourOfTag(std::string_view text);

}  // namespace gable
