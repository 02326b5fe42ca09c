// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/shape_input.h"

#include <algorithm>

#include "base/files.h"
#include "base/number.h"
#include "base/temporary_folder.h"
#include "geom/mesh/cleanup.h"
#include "io/importers/city_json_sequence.h"
#include "io/importers/converted.h"
#include "io/importers/gltf_meshes.h"
#include "io/importers/map_file.h"
#include "io/importers/shape_parts.h"

namespace gable {
namespace {

// Single precision at the size of a block, in metres, and what it does to directions, in degrees.
constexpr double kSamePlace = 1e-4;
constexpr double kSamePlane = 0.05;

}  // namespace

Result<ShapeFile> readGltfShapes(std::string_view bytes, const AssetOptions& options) {
  Result<GltfFile> file = GltfFile::open(bytes, options);
  if (!file.ok()) return file.error();
  ShapeFile out;
  uint64_t dropped = 0;
  Asset held;
  const std::vector<GltfMaterial> materials = readGltfMaterials(*file, options, held);
  out.textures = std::move(held.textures);
  uint64_t read = 0;
  for (const GltfPlacement& p : file->shown().placements) {
    Asset part;
    GltfMeshes meshes(*file, materials, part, options.zUp);
    const bool fits = meshes.add(p, 0);
    read += meshes.work();
    if (!fits || read > GltfMeshes::kMostWork) {
      return Error{
          "shapes-broken", "'" + options.path + "' shows more triangles than can be read", {}};
    }
    dropped += meshes.dropped();
    ShapeInput shape;
    shape.mesh = meshes.take();
    shape.mesh.normals.clear();
    takeMaterials(shape, std::move(part));
    // Footprints come as triangles; what lies in one plane is one polygon again.
    mergePositions(shape.mesh, kSamePlace);
    mergeCoplanarFaces(shape.mesh, kSamePlane);
    removeCollinearVertices(shape.mesh, kSamePlane);
    dropDegenerateFaces(shape.mesh, 0);
    if (shape.mesh.empty()) continue;
    shape.name = p.name.empty() ? stemOf(options.path) : p.name;
    if (p.extras) {
      for (const JsonValue::Member& member : p.extras->members()) addAttribute(member, shape);
    }
    out.shapes.push_back(std::move(shape));
  }
  noteDropped(out, dropped);
  if (out.shapes.empty()) return emptyShapes(options.path);
  turnFootprintsUp(out);
  return out;
}

namespace {

Result<ShapeFile> readMapShapes(std::string_view bytes, const AssetOptions& options,
                                FeatureFilter filter) {
  if (filter.key.empty() && isOpenStreetMap(options.path)) filter.key = "building";
  Result<std::string> text = mapAsGeoJson(bytes, options, filter.layer);
  return text.ok() ? readGeoJsonShapes(*text, options.path, filter) : text.error();
}

std::optional<Error> layerMistake(const std::string& path, const FeatureFilter& filter) {
  if (filter.layer.empty() || (isMap(path) && !isOpenStreetMap(path))) return std::nullopt;
  return Error{"shapes-layer", "'" + path + "' has no layers", "leave out --layer"};
}

}  // namespace

Result<ShapeFile> readShapes(std::string_view bytes, const AssetOptions& options,
                             const FeatureFilter& filter) {
  const std::string extension = extensionOf(options.path);
  const bool isGeoJson =
      extension == "geojson" || extension == "json" || isCityJsonSequence(options.path);
  if (auto e = layerMistake(options.path, filter)) return *e;
  if (!filter.key.empty() && !isMap(options.path) && !isGeoJson) {
    return Error{"shapes-layer", "'" + options.path + "' has no properties to choose by",
                 "leave out --only"};
  }
  if (isGeoJson) {
    return readGeoJsonShapes(bytes, options.path, filter);
  }
  if (isMap(options.path)) return readMapShapes(bytes, options, filter);
  if (extension == "obj") return readObjShapes(bytes, options);
  if (isConvertible(options.path)) {
    Result<ConvertedModel> model = convertModel(bytes, options);
    return model.ok() ? readObjShapes(model->obj, model->options) : model.error();
  }
  if (extension == "gltf" || extension == "glb") return readGltfShapes(bytes, options);
  return Error{"shapes-unknown", "'" + options.path + "' is no file of shapes that can be read",
               "use GeoJSON, CityJSON, OpenStreetMap, GeoPackage, FlatGeobuf, a shapefile, KML, "
               "DXF, OBJ or glTF"};
}

bool isStreamed(const std::string& path) {
  const std::string extension = extensionOf(path);
  return extension == "geojson" || extension == "json" || (isMap(path) && !isOpenStreetMap(path));
}

Result<ShapeFile> streamShapes(const AssetOptions& options, const FeatureFilter& filter,
                               const ShapeSink& sink) {
  if (auto e = layerMistake(options.path, filter)) return *e;
  if (!isMap(options.path)) {
    return streamGeoJsonShapes(options.path, options.path, filter, sink);
  }
  const TemporaryFolder folder;
  if (folder.path().empty()) {
    return Error{"file-unwritable",
                 "no temporary folder can be made to convert '" + options.path + "'",
                 "make room where TMPDIR says, or /tmp"};
  }
  const Result<std::string> file = mapAsGeoJsonFile(options.path, filter.layer, folder.path());
  if (!file.ok()) return file.error();
  return streamGeoJsonShapes(file.value(), options.path, filter, sink);
}

ShapeInput lotShape(double width, double depth) {
  ShapeInput out;
  out.name = "lot";
  MeshBuilder b;
  std::vector<uint32_t> ring;
  for (const Vec2 p : {Vec2{0, 0}, Vec2{width, 0}, Vec2{width, depth}, Vec2{0, depth}}) {
    ring.push_back(b.addPosition(fromPlan(p)));
  }
  b.addPolygon(ring);
  out.mesh = b.take();
  return out;
}

bool parseLot(std::string_view text, double& width, double& depth) {
  const size_t mark = text.find_first_of("xX");
  double w = 0, d = 0;
  if (mark == std::string_view::npos || !parseNumber(text.substr(0, mark), w) ||
      !parseNumber(text.substr(mark + 1), d) || !(w > 0) || !(d > 0) || w > 1e6 || d > 1e6) {
    return false;
  }
  width = w;
  depth = d;
  return true;
}

bool numericValue(const PlainValue& v, double& out) {
  if (v.kind == PlainValue::Kind::Number) {
    out = v.number;
    return true;
  }
  if (v.kind == PlainValue::Kind::Bool) return false;
  std::string text = v.text;
  const auto trim = [&] {
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.pop_back();
    const size_t first = text.find_first_not_of(" \t");
    text.erase(0, std::min(first, text.size()));
  };
  trim();
  if (!text.empty() && text.back() == 'm') text.pop_back();
  trim();
  std::replace(text.begin(), text.end(), ',', '.');
  return parseNumber(text, out);
}

}  // namespace gable
