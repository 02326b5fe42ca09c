// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What an initial shape became, sorted into the objects of a city model.
#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "io/exporters/city_faces.h"
#include "io/exporters/city_kinds.h"
#include "io/exporters/plan.h"
#include "io/exporters/root_parts.h"

namespace gable {

/// The kind that an initial shape gives to leaves that say nothing themselves: by its attribute
/// cityPart, or by a name of one word such as Carriageway. Land says nothing, since a house stands
/// on a lot, and names of several words are those of things: Park Road may be a house.
CityKind kindOfShape(const std::string& name, const std::vector<AttributeValue>& attributes);

/// What an initial shape is called: its name, unless that is of a kind of things and its id goes on
/// from there. Then it is the id, such as "Street/way/7", and of buildings only the rest, "way/7":
/// several shapes may be of one thing of a map.
std::string titleOfShape(const std::string& name, const std::vector<AttributeValue>& attributes);

/// The kind of a shape, or Land where nothing of a building stands on its ground.
CityKind kindOrLand(const Scene& scene, RootParts& parts, const Root& root, CityKind kind);

struct PlacedPart {
  PlannedLeaf planned;
  CityKind kind = CityKind::Unknown;
  /// Of windows, doors and what stands for itself: leaves of one number belong together.
  uint32_t run = 0;
};

/// A city object: all that is equal in this.
struct CityObjectKey {
  /// Unknown for buildings and their parts.
  CityKind kind = CityKind::Unknown;
  /// The value of cityObject, in CityParts::text().
  uint32_t object = 0;
  uint32_t run = 0;
  friend bool operator<(const CityObjectKey& a, const CityObjectKey& b) {
    return std::tie(a.kind, a.object, a.run) < std::tie(b.kind, b.object, b.run);
  }
};

struct CityObjectContent {
  CityObjectKey key;
  std::vector<PlacedPart> parts;
};

/// A prototype that is a city object.
struct CityInstance {
  CityPart part;
  uint32_t prototype = 0;
  Frame world;
};

struct CityContent {
  std::vector<Frame> placements;
  /// In the order in which they first come.
  std::vector<CityObjectContent> objects;
  std::vector<CityInstance> instances;
};

/// O(n log n) in the leaves of the shape, instances expanded.
CityContent cityContentOf(const Scene& scene, RootParts& parts, CityFaces& faces, const Root& root,
                          CityKind kindOfShape);

}  // namespace gable
