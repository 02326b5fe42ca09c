// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The initial shapes of a derivation: lots, footprints.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gable/diagnostic.h"
#include "gable/limits.h"
#include "gable/value.h"

namespace gable {

/// Which features of a map (GeoJSON, OpenStreetMap, GeoPackage, FlatGeobuf, shapefile, KML, DXF)
/// become shapes.
struct FeatureSelection {
  /// Of a file with several layers.
  std::string layer;
  /// A property that features must have, such as "landuse", other than null and "no". Empty for all
  /// features; in files of OpenStreetMap for those with "building".
  std::string key;
  /// The value of the property; empty for any.
  std::string value;
};

class Shapes {
 public:
  /// A rectangle: a corner at the origin, `width` along +x, `depth` along -z, facing up.
  static Shapes lot(double width, double depth);
  /// An upright rectangle, as the front of a house is: `width` along +x, `height` along +y, facing
  /// south (+z). Its axes are those of a wall that comp(f) gives.
  static Shapes face(double width, double height);
  using Ring = std::vector<std::pair<double, double>>;
  /// A polygon in plan coordinates (x east, y north), counter-clockwise, with holes. A ring may
  /// repeat its first point at its end.
  static Shapes polygon(const Ring& outer, const std::vector<Ring>& holes = {});
  /// Faces over vertices in metres (y up). `holes` names holes by lists of face numbers: the first
  /// is the face that has them, the others are its holes.
  static Shapes mesh(const std::vector<std::array<double, 3>>& vertices,
                     const std::vector<std::vector<uint32_t>>& faces,
                     const std::vector<std::vector<uint32_t>>& holes = {});
  /// By extension: .geojson .json; .osm .pbf where gable-maps is built; .gpkg .fgb .shp .kml .dxf
  /// where GDAL's programs are installed; .obj .gltf .glb; .fbx .dae where gable-convert is built.
  static Shapes load(const std::string& path, const FileLimits& limits = {},
                     const FeatureSelection& selection = {});
  /// The same for a file's content in memory; `name` gives the extension.
  static Shapes parse(const std::string& content, const std::string& name,
                      const FileLimits& limits = {}, const FeatureSelection& selection = {});

  /// The same with footprints cut out of larger ones that they lie in or overlap, so that buildings
  /// in courts do not stand in their neighbours.
  Shapes withNestedCut(const FileLimits& limits = {}) const;

  /// The shapes of all, one after the other. A place on the Earth is that of the first that has
  /// one.
  static Shapes joined(const std::vector<Shapes>& all);
  /// The same with values for attributes of rules, by shape; more of them than shapes are left out.
  /// A value takes the place of one of the same name.
  Shapes withAttributes(const std::vector<std::vector<NamedValue>>& byShape) const;

  /// Some of the shapes, by index; their draws stay those that they have among all. Numbers that
  /// name no shape are left out.
  Shapes only(const std::vector<size_t>& indices) const;

  /// Those with their middle in a box: west, south, east, north in degrees where the shapes have a
  /// place on the Earth, else in the metres of their file. Their draws stay as with only().
  Shapes within(const std::array<double, 4>& box) const;

  /// A shape in plan: the outer ring of its largest face, its name, the area of its faces.
  struct Outline {
    std::string name;
    Ring ring;
    double area = 0;
  };
  Outline outline(size_t shape) const;

  size_t size() const;
  bool ok() const;
  /// False when the file itself could not be read.
  bool found() const;
  const DiagnosticList& diagnostics() const;

  struct Impl;
  explicit Shapes(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  const Impl& impl() const { return *impl_; }

 private:
  std::shared_ptr<const Impl> impl_;
};

}  // namespace gable
