// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The geometries of the objects of a CityJSON file, as faces and lines. Coordinates are the file's:
// x east, y north, z up.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/json.h"
#include "math/vec.h"

namespace gable {

struct CityJsonFace {
  /// The outer ring and its holes.
  std::vector<std::vector<Vec3>> rings;
  /// The type of its semantic surface; lives as long as the file's tree.
  std::string_view meaning;
};

struct CityJsonBody {
  double lod = 0;
  std::vector<CityJsonFace> faces;
  /// Of lines and points.
  std::vector<std::vector<Vec3>> lines;
};

class CityJsonGeometry {
 public:
  using Skip = std::function<void(const std::string& reason)>;
  /// Reads the vertices. The tree must outlive this.
  explicit CityJsonGeometry(const JsonValue& root);

  /// The geometries of an object that have anything. What cannot be read is left out, and told.
  std::vector<CityJsonBody> of(const JsonValue& object, const Skip& skip) const;

 private:
  bool ring(const JsonValue& indices, const Skip& skip, std::vector<Vec3>& out) const;
  void addFace(const JsonValue& rings, std::string_view meaning, const Skip& skip,
               CityJsonBody& to) const;
  void addFaces(const JsonValue& boundaries, const JsonValue& semantics, int depth,
                const Skip& skip, CityJsonBody& to) const;
  std::vector<Vec3> vertices_;
};

/// The area of a ring times its normal.
Vec3 cityJsonNormal(const std::vector<Vec3>& ring);
/// A number, a bool (yes, no) or a text as text; empty for all else.
std::string cityJsonText(const JsonValue& v);
/// "EPSG:7415"; empty where the file does not say it.
std::string cityJsonSystem(const JsonValue& root);

}  // namespace gable
