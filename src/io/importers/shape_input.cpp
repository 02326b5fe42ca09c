// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/shape_input.h"

#include <algorithm>

#include "base/files.h"
#include "base/number.h"
#include "base/work.h"
#include "geom/mesh/cleanup.h"
#include "io/importers/face_filter.h"
#include "io/importers/gltf_meshes.h"
#include "io/importers/obj_file.h"

namespace gable {
namespace {

// Single precision at the size of a block, in metres, and what it does to directions, in degrees.
constexpr double kSamePlace = 1e-4;
constexpr double kSamePlane = 0.05;

std::string stemOf(const std::string& path) {
  const std::string name = fileNameOf(path);
  return name.substr(0,
                     name.size() - (extensionOf(name).empty() ? 0 : extensionOf(name).size() + 1));
}

Error empty(const std::string& path) {
  return {"shapes-empty", "'" + path + "' has no polygon that could be an initial shape", {}};
}

void noteDropped(ShapeFile& out, uint64_t faces) {
  if (faces == 0) return;
  out.diagnostics.warning("shape-face-dropped", {},
                          std::to_string(faces) + " faces without area are left out");
}

std::string firstBadLine(const ObjFile& file) {
  return "line " + std::to_string(file.firstBadLine) + ": " + file.firstBadReason;
}

void noteBadLines(ShapeFile& out, const ObjFile& file) {
  if (file.badLines == 0) return;
  out.diagnostics.warning("shape-line-broken", {},
                          std::to_string(file.badLines) +
                              " lines of the file cannot be read; the first is " +
                              firstBadLine(file));
}

// An OBJ file without a face: which line is to blame, or what it has in the place of faces.
Error withoutFaces(const ObjFile& file, const std::string& path, uint64_t dropped) {
  Error error = empty(path);
  if (file.badLines > 0) {
    error.message += "; " + firstBadLine(file);
    error.hint = "mend the line; a polygon is written 'f 1 2 3', with vertices 'v x y z' before it";
  } else if (dropped > 0) {
    error.message += ": its " + std::to_string(dropped) + " faces have no area";
    error.hint = "give them corners that do not lie on one line";
  } else if (file.lines > 0) {
    error.message += ": it has lines ('l') and no faces ('f')";
    error.hint = "close the outline and save it as a polygon";
  } else {
    error.message +=
        ": it has " + std::to_string(file.positions.size()) + " vertices and no faces ('f')";
    error.hint = "a polygon is written 'f 1 2 3', with vertices 'v x y z' before it";
  }
  return error;
}

// A footprint that faces the ground would be built downward. Its outer ring is clockwise as seen
// from above, which says nothing about what was meant; GeoJSON's rings are turned as well.
void turnFootprintsUp(ShapeFile& out) {
  constexpr double kLevel = 0.99;
  size_t turned = 0;
  for (ShapeInput& shape : out.shapes) {
    bool down = shape.mesh.faceCount() > 0;
    for (size_t f = 0; down && f < shape.mesh.faceCount(); ++f) {
      down = shape.mesh.normal(f).y < -kLevel;
    }
    if (!down) continue;
    MeshBuilder builder;
    std::vector<uint32_t> map(shape.mesh.positions.size(), MeshBuilder::kNoPosition);
    for (size_t f = 0; f < shape.mesh.faceCount(); ++f) {
      work();
      builder.copyFace(shape.mesh, f, map, true);
    }
    shape.mesh = builder.take();
    ++turned;
  }
  if (turned == 0) return;
  out.diagnostics.warning("shape-turned", {},
                          std::to_string(turned) +
                              (turned == 1 ? " footprint faces" : " footprints face") +
                              " the ground and " + (turned == 1 ? "is" : "are") + " turned over",
                          "write the corners counter-clockwise as seen from above");
}

}  // namespace

Result<ShapeFile> readObjShapes(std::string_view text, const std::string& path) {
  const ObjFile file = parseObj(text);
  const bool byObject = !file.objects.empty();
  const std::vector<std::string>& names = byObject ? file.objects : file.groups;
  // Faces by part, parts in the order of their first face.
  std::vector<std::vector<uint32_t>> faces;
  std::vector<uint32_t> partOf(names.size() + 1, ObjCorner::kNone), nameOf;
  for (uint32_t f = 0; f < file.faces.size(); ++f) {
    const uint32_t raw = byObject ? file.faces[f].object : file.faces[f].group;
    const auto name = static_cast<uint32_t>(std::min<size_t>(raw, names.size()));
    if (partOf[name] == ObjCorner::kNone) {
      partOf[name] = static_cast<uint32_t>(faces.size());
      faces.emplace_back();
      nameOf.push_back(name);
    }
    faces[partOf[name]].push_back(f);
  }
  ShapeFile out;
  uint64_t dropped = 0;
  std::vector<uint32_t> positions;
  for (size_t part = 0; part < faces.size(); ++part) {
    work(1 + faces[part].size());
    // Numbers of its own, so that many parts of one long list of positions stay linear.
    std::vector<uint32_t> used;
    for (const uint32_t f : faces[part]) {
      for (uint32_t i = 0; i < file.faces[f].cornerCount; ++i) {
        used.push_back(file.corners[file.faces[f].firstCorner + i].position);
      }
    }
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::vector<Vec3> points;
    for (const uint32_t p : used) points.push_back(file.positions[p]);
    FaceFilter filter(points, false);
    for (const uint32_t f : faces[part]) {
      positions.clear();
      for (uint32_t i = 0; i < file.faces[f].cornerCount; ++i) {
        const uint32_t p = file.corners[file.faces[f].firstCorner + i].position;
        const auto at = std::lower_bound(used.begin(), used.end(), p);
        positions.push_back(static_cast<uint32_t>(at - used.begin()));
      }
      if (!filter.accept(positions)) continue;
      filter.builder().beginFace();
      filter.builder().beginLoop();
      for (const uint32_t i : filter.kept()) {
        filter.builder().addCorner(filter.position(positions[i]));
      }
    }
    dropped += filter.dropped();
    ShapeInput shape;
    shape.name = nameOf[part] < names.size() ? names[nameOf[part]] : stemOf(path);
    shape.mesh = filter.builder().take();
    if (!shape.mesh.empty()) out.shapes.push_back(std::move(shape));
  }
  noteDropped(out, dropped);
  noteBadLines(out, file);
  if (out.shapes.empty()) return withoutFaces(file, path, dropped);
  turnFootprintsUp(out);
  return out;
}

Result<ShapeFile> readGltfShapes(std::string_view bytes, const AssetOptions& options) {
  Result<GltfFile> file = GltfFile::open(bytes, options);
  if (!file.ok()) return file.error();
  ShapeFile out;
  uint64_t dropped = 0;
  const std::vector<GltfMaterial> noMaterials;
  uint64_t read = 0;
  for (const GltfPlacement& p : file->placements()) {
    Asset scratch;
    GltfMeshes meshes(*file, noMaterials, scratch, options.zUp);
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
    for (auto& uv : shape.mesh.uvs) uv.clear();
    // Footprints come as triangles; what lies in one plane is one polygon again.
    mergePositions(shape.mesh, kSamePlace);
    mergeCoplanarFaces(shape.mesh, kSamePlane);
    removeCollinearVertices(shape.mesh, kSamePlane);
    dropDegenerateFaces(shape.mesh, 0);
    if (shape.mesh.empty()) continue;
    shape.name = p.name.empty() ? stemOf(options.path) : p.name;
    out.shapes.push_back(std::move(shape));
  }
  noteDropped(out, dropped);
  if (out.shapes.empty()) return empty(options.path);
  turnFootprintsUp(out);
  return out;
}

Result<ShapeFile> readShapes(std::string_view bytes, const AssetOptions& options) {
  const std::string extension = extensionOf(options.path);
  if (extension == "geojson" || extension == "json") {
    return readGeoJsonShapes(bytes, options.path);
  }
  if (extension == "obj") return readObjShapes(bytes, options.path);
  if (extension == "gltf" || extension == "glb") return readGltfShapes(bytes, options);
  return Error{"shapes-unknown", "'" + options.path + "' is no file of shapes that can be read",
               "use GeoJSON, OBJ or glTF"};
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
