// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The storeys of a building. Those that cityStorey names begin where most of what stands in them
// does. The others divide the height up to the eaves evenly: by the number of storeys that the
// building is known to have, else so that each is about three metres high. Of two that begin at
// one height the named one counts.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/exporters/city_faces.h"
#include "io/exporters/city_kinds.h"

namespace gable {

struct IfcStorey {
  std::string name;
  /// Metres above the zero of the scene.
  double elevation = 0;
  /// The value of cityStorey, in CityParts::text(); 0 for none.
  uint32_t named = 0;
};

/// How many storeys attributes or reports say that a building has; 0 where they say nothing.
double storeyCountOf(const std::vector<AttributeValue>& known);

/// Takes the leaves of one building, one by one, and tells its storeys.
class IfcStoreys {
 public:
  IfcStoreys(CityFaces& faces, const CityParts& parts) : faces_(faces), parts_(parts) {}
  void clear();
  void add(const Leaf& leaf, const Frame& world, const CityPart& part);
  const Box3& bounds() const { return bounds_; }
  /// Finds the storeys of what was added. `count`: of storeyCountOf().
  void divide(double count);
  /// Sorted by elevation. Empty where nothing was added.
  const std::vector<IfcStorey>& all() const { return all_; }
  /// The index of the storey of an element.
  size_t of(const CityPart& part, const Box3& box) const;
  /// Where walls end: above it are the roof and gables.
  double eaves();

 private:
  // By foot in steps of five centimetres, the widths of what stands there.
  using Feet = std::map<int64_t, double>;
  void addUpright(const Leaf& leaf, const Frame& world);
  double elevationOf(const Feet& feet) const;
  void addEven(double count);
  void nameEven();

  CityFaces& faces_;
  const CityParts& parts_;
  Box3 bounds_;
  // Where the width of upright faces changes, and by how much.
  std::vector<std::pair<double, double>> widths_;
  // By the value of cityStorey: of walls and floors, and of all.
  std::map<uint32_t, Feet> walls_, anything_;
  std::vector<IfcStorey> all_;
};

}  // namespace gable
