// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Initial shapes from files: footprints with attributes.
//
//   GeoJSON  a shape a feature with polygons, a face a polygon, holes kept; properties are
//            attributes. Lines beside polygons in a feature belong to its shape; those of a file
//            without any polygon make one shape, "lines". A line is faces of two corners.
//   maps     OpenStreetMap, GeoPackage, FlatGeobuf, shapefiles, KML and DXF, read as GeoJSON
//   OBJ      a shape an object (o), or a group (g) where there are no objects, or the whole file
//   glTF     a shape a node with a mesh; its extras, Blender's custom properties, are attributes
//
// OBJ and glTF bring their texture coordinates and materials; triangles of glTF that lie in one
// plane, with one material and one mapping, are one polygon.
//
// Promises: coordinates are local metres with y up; every face has an area, but for lines; equal
// input gives equal shapes. What is wrong with one shape is a Diagnostic that names it, and the
// others are read.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "base/result.h"
#include "geom/mesh/mesh.h"
#include "io/importers/asset.h"
#include "scene/scene.h"
#include "shape/geo_frame.h"

namespace gable {

struct ShapeInput {
  std::string name;
  Mesh mesh;
  std::vector<AttributeValue> attributes;
  /// The feature's own id, as text; may be empty.
  std::string id;
  /// The feature of the file that it is, from 1; 0 where the file has none.
  uint64_t feature = 0;
  /// By face, or empty: a tag for it.
  std::vector<std::string> faceTags;
  /// By face, or empty: the width of the street that a line is the middle of, in metres, by the
  /// property `width` of the line; 0 where there is none.
  std::vector<double> streetWidths;
  /// Of the slots from 1 of the mesh, as Asset has them from 0; slot 0 is the shape's own material.
  std::vector<Material> materials;
  std::vector<std::string> groups;
};

struct ShapeFile {
  std::vector<ShapeInput> shapes;
  GeoOrigin geoOrigin;
  /// Where its metres lie on the Earth; null where nobody knows.
  std::shared_ptr<const GeoFrame> geo;
  Diagnostics diagnostics;
  /// Pictures that lie in the file itself, as Asset has them.
  std::map<std::string, std::string> textures;
};

/// Which features of a map become shapes.
struct FeatureFilter {
  /// Of formats with layers; may be empty where the file has one.
  std::string layer;
  /// A property that features must have, other than null and "no". Empty for all features; in files
  /// of OpenStreetMap for those with "building".
  std::string key;
  /// The value of the property; empty for any.
  std::string value;
};

/// By extension: .geojson .json .osm .pbf .gpkg .fgb .shp .kml .dxf .obj .gltf .glb .fbx .dae.
/// Codes: shapes-unknown, shapes-broken, shapes-empty, and those of maps and assets.
Result<ShapeFile> readShapes(std::string_view bytes, const AssetOptions& options,
                             const FeatureFilter& filter = {});
Result<ShapeFile> readGeoJsonShapes(std::string_view text, const std::string& path,
                                    const FeatureFilter& filter = {});
/// Takes shapes as they are read.
using ShapeSink = std::function<void(ShapeInput&&)>;

/// Whether streamShapes() reads it: GeoJSON, and the maps that GDAL reads.
bool isStreamed(const std::string& path);
/// The same shapes as readShapes() gives, one after the other: memory holds some hundred, whatever
/// the size of the map. The result has all but the shapes. A file that is no collection of features
/// is shapes-broken.
Result<ShapeFile> streamShapes(const AssetOptions& options, const FeatureFilter& filter,
                               const ShapeSink& sink);
/// The same for GeoJSON in a file; messages call it `path`.
Result<ShapeFile> streamGeoJsonShapes(const std::string& file, const std::string& path,
                                      const FeatureFilter& filter, const ShapeSink& sink);
Result<ShapeFile> readObjShapes(std::string_view text, const AssetOptions& options);
Result<ShapeFile> readGltfShapes(std::string_view bytes, const AssetOptions& options);

/// A rectangular lot: a corner at the origin, `width` along +x, `depth` to the north (-z), facing
/// up, the first edge on its south side.
ShapeInput lotShape(double width, double depth);
/// "30x40" or "12.5X8": two positive numbers in metres.
bool parseLot(std::string_view text, double& width, double& depth);

/// The number that a value means: a number itself, or a text such as "12", " 7.5 m" or "3,5".
bool numericValue(const PlainValue& v, double& out);

}  // namespace gable
