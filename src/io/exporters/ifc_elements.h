// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The numbered lines of an IFC file that elements are made of: shapes of triangles with their
// styles, placements, properties.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/files.h"
#include "io/exporters/triangle_cache.h"
#include "scene/scene.h"

namespace gable {

using StepId = uint64_t;

/// The data section of a STEP file.
class StepFile {
 public:
  explicit StepFile(const std::string& path) : out_(path) {}
  /// Text outside of the numbered lines.
  void raw(const std::string& text) { out_.append(text); }
  /// A number for a line that is written later.
  StepId reserve() { return ++last_; }
  /// Writes "#7=TEXT;" and gives 7.
  StepId add(const std::string& text);
  void put(StepId id, const std::string& text);
  bool failed() const { return out_.failed(); }
  Result<uint64_t> finish() { return out_.finish(); }

 private:
  FileWriter out_;
  StepId last_ = 0;
};

/// "#7".
std::string stepRef(StepId id);
/// "(#1,#2)".
std::string stepList(const std::vector<StepId>& ids);

/// Triangles gathered leaf by leaf, by material. Points are whole hundredths of a millimetre, each
/// once for a material; triangles without an area in them are left out.
class IfcShape {
 public:
  IfcShape(const Scene& scene, TriangleCache& triangles) : scene_(scene), triangles_(triangles) {}
  /// A leaf at `world`, in a frame whose y axis points up.
  void add(const Leaf& leaf, const Frame& world);
  uint64_t triangleCount() const { return count_; }
  /// Equal for shapes that are written as the same lines; different for others, as far as hashes
  /// go.
  std::array<uint64_t, 2> hash() const;
  /// In the frame of the shape, z up.
  const Box3& box() const { return box_; }
  /// By index into Scene::materials, ascending; kNoMaterial for none.
  struct Part {
    std::vector<std::array<int64_t, 3>> points;
    std::vector<std::array<uint32_t, 3>> triangles;
    std::map<std::array<int64_t, 3>, uint32_t> known;
  };
  const std::map<uint32_t, Part>& parts() const { return parts_; }
  void clear();

 private:
  const Scene& scene_;
  TriangleCache& triangles_;
  std::map<uint32_t, Part> parts_;
  std::vector<Vec3> placed_;
  Box3 box_;
  uint64_t count_ = 0;
};

/// Writes shapes, and each style and material once.
class IfcShapeWriter {
 public:
  /// `body`: the context of representations.
  IfcShapeWriter(const Scene& scene, StepFile& file, StepId body)
      : scene_(scene), file_(file), body_(body) {}
  /// An IfcShapeRepresentation of a shape that has triangles.
  StepId representation(const IfcShape& shape);
  /// An IfcProductDefinitionShape of it, which all elements of equal shapes share.
  StepId definition(const IfcShape& shape);
  /// An IfcMaterial of a material of the scene; 0 for none.
  StepId material(uint32_t material);

 private:
  StepId faceSet(const IfcShape::Part& part);
  StepId style(uint32_t material);
  const Scene& scene_;
  StepFile& file_;
  StepId body_;
  std::map<uint32_t, StepId> styles_, materials_;
  std::map<std::array<uint64_t, 2>, StepId> definitions_;
};

/// Writes placements. The directions of one facade are those of many elements.
class IfcAxesWriter {
 public:
  explicit IfcAxesWriter(StepFile& file) : file_(file) {}
  /// An IfcAxis2Placement3D of a frame whose y axis points up.
  StepId axes(const Frame& frame);

 private:
  StepId direction(const Vec3& v);
  StepFile& file_;
  std::map<std::string, StepId> directions_;
};

/// An IfcPropertySet of attributes, of equal names the first; 0 where there are none.
StepId ifcProperties(StepFile& file, const std::string& guid,
                     const std::vector<AttributeValue>& attributes);

}  // namespace gable
