// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Initial shapes: lots, polygons and files of footprints. Each shape gets an object frame near it,
// so that coordinates far from the origin lose nothing.

#include <algorithm>
#include <cmath>
#include <set>

#include "base/files.h"
#include "base/number.h"
#include "base/work.h"
#include "engine/file_search.h"
#include "engine/footprint.h"
#include "engine/guard.h"
#include "geom/mesh/face_plane.h"
#include "geom/region/clean.h"
#include "geom/region/region.h"

namespace gable {

ShapeFootprint footprint(ShapeInput input) {
  ShapeFootprint f;
  f.name = std::move(input.name);
  f.id = std::move(input.id);
  f.feature = input.feature;
  f.attributes = std::move(input.attributes);
  f.faceTags = std::move(input.faceTags);
  f.streetWidths = std::move(input.streetWidths);
  f.materials = std::move(input.materials);
  f.groups = std::move(input.groups);
  const Box3 box = input.mesh.bounds();
  Vec3 origin;
  if (!box.empty()) {
    for (size_t i = 0; i < 3; ++i) origin[i] = std::floor(box.min[i]);
  }
  // Shapes at the world's origin keep it.
  if (length(origin) < 100) origin = {};
  f.origin = Frame::moved(origin);
  f.mesh = transformed(input.mesh, {1, 1, 1}, Frame::moved(-origin));
  return f;
}

Frame groundFrame(double height) {
  return Frame::of({0, height, 0}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0});
}

AssetOptions shapeFileOptions(const std::string& path) {
  AssetOptions options;
  options.path = path;
  options.readFile = [folder = folderOf(path)](const std::string& wanted) -> Result<std::string> {
    const std::string found = FileSearch(folder, {}).inside(wanted);
    if (found.empty()) return Error{"file-missing", "there is no such file in the folder", {}};
    return readFile(found, kLargestShapeFile);
  };
  return options;
}

namespace {

/// Where a lot or a polygon of the caller's may lie: far beyond every map in metres.
constexpr double kMostCoordinate = 1e9;

bool usable(double v) { return std::fabs(v) <= kMostCoordinate; }

std::shared_ptr<Shapes::Impl> refused(const Error& e) {
  auto impl = std::make_shared<Shapes::Impl>();
  impl->diagnostics.push_back(diagnosticOf(e));
  return impl;
}

Error tooFar() {
  return {"shape-mesh", "a point of the polygon lies too far out",
          "coordinates are metres, at most 1e9 from the origin"};
}

Diagnostic warning(const char* code, const std::string& message, const std::string& hint) {
  return diagnosticOf({Severity::Warning, code, Span{}, message, hint, {}, {}}, Sources{});
}

// What an outline has that rules may make nothing of; empty where it is sound.
std::string mistakeOf(const Ring& ring) {
  const bool isOnALine = std::all_of(ring.begin(), ring.end(), [&](const Vec2& v) {
    return cross(ring[1] - ring[0], v - ring[0]) == 0;
  });
  if (isOnALine && signedArea(ring) == 0) return "the polygon has no area";
  return isSimple(ring) ? "" : "the outline of the polygon touches or crosses itself";
}

// Whether corners that are meant to be metres lie as those of a lot in degrees do.
bool mayBeDegrees(const Ring& ring) {
  constexpr double kLargestLot = 0.1, kMostLongitude = 180, kMostLatitude = 90;
  Vec2 low = ring.empty() ? Vec2{} : ring[0], high = low;
  for (const Vec2& v : ring) {
    if (!(std::fabs(v.x) <= kMostLongitude && std::fabs(v.y) <= kMostLatitude)) return false;
    low = {std::min(low.x, v.x), std::min(low.y, v.y)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y)};
  }
  return high.x - low.x < kLargestLot && high.y - low.y < kLargestLot;
}

std::shared_ptr<Shapes::Impl> ofPolygon(const Polygon& p, const std::string& name) {
  for (const auto& ring : p.holes) {
    for (const Vec2& v : ring) {
      if (!usable(v.x) || !usable(v.y)) return refused(tooFar());
    }
  }
  for (const Vec2& v : p.outer) {
    if (!usable(v.x) || !usable(v.y)) return refused(tooFar());
  }
  auto impl = std::make_shared<Shapes::Impl>();
  ShapeInput input;
  input.name = name;
  input.mesh = meshOf({p}, groundFrame());
  impl->footprints.push_back(footprint(std::move(input)));
  const std::string mistake = p.outer.size() < 3 ? std::string() : mistakeOf(p.outer);
  if (!mistake.empty()) {
    impl->diagnostics.push_back(
        warning("shape-mesh", mistake, "give the corners in order around the polygon"));
  }
  return impl;
}

// What is wrong with faces and holes given as numbers; empty when nothing is.
std::string meshMistake(const std::vector<std::array<double, 3>>& vertices,
                        const std::vector<std::vector<uint32_t>>& faces,
                        const std::vector<std::vector<uint32_t>>& holes) {
  for (size_t v = 0; v < vertices.size(); ++v) {
    for (const double d : vertices[v]) {
      if (!usable(d)) return "vertex " + std::to_string(v) + " lies too far out";
    }
  }
  for (size_t f = 0; f < faces.size(); ++f) {
    if (faces[f].size() < 3) return "face " + std::to_string(f) + " has fewer than three vertices";
    for (uint32_t v : faces[f]) {
      if (v >= vertices.size()) {
        return "face " + std::to_string(f) + " names vertex " + std::to_string(v) +
               ", which does not exist";
      }
    }
  }
  std::vector<bool> used(faces.size(), false);
  for (const std::vector<uint32_t>& list : holes) {
    for (uint32_t f : list) {
      if (f >= faces.size()) return "hole " + std::to_string(f) + " is no face";
      if (used[f]) return "face " + std::to_string(f) + " stands twice in the lists of holes";
      used[f] = true;
    }
  }
  return {};
}

void addLoop(MeshBuilder& b, const std::vector<uint32_t>& ring) {
  b.beginLoop();
  for (uint32_t v : ring) b.addCorner(v);
}

std::shared_ptr<Shapes::Impl> ofMesh(const std::vector<std::array<double, 3>>& vertices,
                                     const std::vector<std::vector<uint32_t>>& faces,
                                     const std::vector<std::vector<uint32_t>>& holes) {
  const std::string mistake = meshMistake(vertices, faces, holes);
  if (!mistake.empty()) return refused({"shape-mesh", mistake, "mend the lists of the mesh"});
  MeshBuilder b;
  std::vector<std::vector<uint32_t>> rings = faces;
  for (const auto& v : vertices) b.addPosition({v[0], v[1], v[2]});
  std::vector<const std::vector<uint32_t>*> holesOf(faces.size(), nullptr);
  std::vector<bool> isHole(faces.size(), false);
  const auto normalOf = [&](const std::vector<uint32_t>& ring) {
    Vec3 sum;
    for (size_t i = 0; i < ring.size(); ++i) {
      const auto& p = vertices[ring[i]];
      const auto& q = vertices[ring[(i + 1) % ring.size()]];
      sum += cross(Vec3{p[0], p[1], p[2]}, Vec3{q[0], q[1], q[2]});
    }
    return sum;
  };
  for (const std::vector<uint32_t>& list : holes) {
    if (list.empty()) continue;
    holesOf[list[0]] = &list;
    for (size_t k = 1; k < list.size(); ++k) {
      isHole[list[k]] = true;
      // Holes turn the other way than their face.
      std::vector<uint32_t>& ring = rings[list[k]];
      if (dot(normalOf(ring), normalOf(rings[list[0]])) > 0) std::reverse(ring.begin(), ring.end());
    }
  }
  for (size_t f = 0; f < faces.size(); ++f) {
    if (isHole[f]) continue;
    b.beginFace();
    addLoop(b, rings[f]);
    if (!holesOf[f]) continue;
    for (size_t k = 1; k < holesOf[f]->size(); ++k) addLoop(b, rings[(*holesOf[f])[k]]);
  }
  auto impl = std::make_shared<Shapes::Impl>();
  ShapeInput input;
  input.name = "mesh";
  input.mesh = b.take();
  impl->footprints.push_back(footprint(std::move(input)));
  return impl;
}

Shapes::Outline outlineOf(const ShapeFootprint& f) {
  Shapes::Outline out;
  out.name = f.id.empty() ? f.name : f.id;
  double largest = -1;
  for (size_t face = 0; face < f.mesh.faceCount(); ++face) {
    const double area = f.mesh.area(face);
    out.area += area;
    if (area <= largest || f.mesh.loopsOf(face).empty()) continue;
    largest = area;
    out.ring.clear();
    for (const uint32_t corner : f.mesh.cornersOf(f.mesh.loopsOf(face)[0])) {
      const Vec3 p = f.origin.point(f.mesh.positions[corner]);
      out.ring.emplace_back(p.x, -p.z);
    }
  }
  return out;
}

using Box = std::array<double, 4>;

std::string boxText(const Box& box) {
  std::string out;
  for (const double v : box) out += (out.empty() ? "" : ",") + shortestText(v);
  return out;
}

// The middle of a shape: in degrees where they are asked for and can be told, else in metres.
Vec2 middleOf(const ShapeFootprint& f, const GeoFrame* geo, bool degrees) {
  const Box3 box = f.mesh.bounds();
  if (box.empty()) return {};
  const Vec3 p = f.origin.point(0.5 * (box.min + box.max));
  if (!geo) return {p.x, -p.z};
  const GeoPlace place = geo->at({p.x, -p.z});
  if (degrees && place.degrees) return {place.degrees->longitude, place.degrees->latitude};
  return {place.x, place.y};
}

Error nothingWithin(const Box& box, const Box& all, size_t count) {
  return {"box-empty",
          "none of the " + std::to_string(count) + " shapes lies in the box " + boxText(box),
          "west,south,east,north; the middles of all lie in " + boxText(all)};
}

// One item, or as many as an array has places, all of one kind.
bool isWhole(const RuleValue& v) {
  if (!v.array) return v.items.size() == 1;
  if (v.items.size() != size_t{v.array->rows} * v.array->columns) return false;
  return std::all_of(v.items.begin(), v.items.end(), [&](const RuleValue::Scalar& item) {
    return item.index() == v.items[0].index();
  });
}

// The pictures that the materials of the shapes name: those that lie in the file, and those that
// can be read beside it.
TextureBytes texturesOf(ShapeFile& file, const FileReader& read) {
  constexpr uint64_t kMostBytes = 1ull << 29;
  const auto shared = [](std::string& bytes) {
    return std::make_shared<const std::string>(std::move(bytes));
  };
  TextureBytes all;
  for (auto& [name, bytes] : file.textures) all[name] = shared(bytes);
  std::set<std::string> missing;
  uint64_t held = 0;
  for (const ShapeInput& shape : file.shapes) {
    for (const Material& m : shape.materials) {
      for (const TextureMap& map : m.maps) {
        work();
        if (map.path.empty() || held > kMostBytes || all.count(map.path) > 0) continue;
        if (missing.count(map.path) > 0) continue;
        Result<std::string> bytes = read(map.path);
        if (bytes.ok()) {
          held += bytes->size();
          all[map.path] = shared(*bytes);
          continue;
        }
        missing.insert(map.path);
        file.diagnostics.warning(
            "shape-texture-missing", {},
            "the picture '" + map.path +
                "' of a shape's material is left out: " + bytes.error().message,
            "pictures lie beside the file of shapes or below its folder");
      }
    }
  }
  return all;
}

std::shared_ptr<Shapes::Impl> parsed(const std::string& content, const std::string& name,
                                     const FeatureSelection& selection) {
  const AssetOptions options = shapeFileOptions(name);
  Result<ShapeFile> file =
      readShapes(content, options, {selection.layer, selection.key, selection.value});
  if (!file.ok()) return refused(file.error());
  auto impl = std::make_shared<Shapes::Impl>();
  impl->textures = texturesOf(*file, options.readFile);
  impl->geoOrigin = file->geoOrigin;
  impl->geo = file->geo;
  for (ShapeInput& s : file->shapes) impl->footprints.push_back(footprint(std::move(s)));
  Diagnostics diagnostics = file->diagnostics;
  if (impl->footprints.empty() && !diagnostics.hasErrors()) {
    diagnostics.error("no-shapes", Span{}, "'" + name + "' holds no shape to derive",
                      "polygons, or faces of a model, become initial shapes");
  }
  impl->diagnostics = listOf(diagnostics, Sources{});
  return impl;
}

}  // namespace

Shapes Shapes::lot(double width, double depth) {
  return Shapes(guarded<Impl>([&] {
    return ofPolygon({{{0, 0}, {width, 0}, {width, depth}, {0, depth}}, {}}, "lot");
  }));
}

Shapes Shapes::face(double width, double height) {
  return Shapes(guarded<Impl>([&] {
    auto impl =
        ofMesh({{0, 0, 0}, {width, 0, 0}, {width, height, 0}, {0, height, 0}}, {{0, 1, 2, 3}}, {});
    for (ShapeFootprint& f : impl->footprints) {
      f.name = "face";
      f.upright = true;
    }
    return impl;
  }));
}

Shapes Shapes::polygon(const Ring& outer, const std::vector<Ring>& holes) {
  return Shapes(guarded<Impl>(Task("making a polygon", {}, {}), [&] {
    const auto ring = [](const Ring& r) {
      gable::Ring out;
      for (const auto& [x, y] : r) out.push_back({x, y});
      // In many formats a ring repeats its first point at the end.
      while (out.size() > 1 && out.front() == out.back()) out.pop_back();
      return out;
    };
    Polygon p{ring(outer), {}};
    for (const Ring& h : holes) p.holes.push_back(ring(h));
    orient(p);
    std::shared_ptr<Impl> impl = ofPolygon(p, "polygon");
    if (mayBeDegrees(p.outer)) {
      impl->diagnostics.push_back(warning(
          "shape-degrees",
          "the polygon is smaller than ten centimetres: its corners may be longitudes and "
          "latitudes",
          "give metres: project the corners first, as Shapes.of_frame does in Python, or load them "
          "from a GeoJSON file, which is in degrees"));
    }
    return impl;
  }));
}

Shapes Shapes::mesh(const std::vector<std::array<double, 3>>& vertices,
                    const std::vector<std::vector<uint32_t>>& faces,
                    const std::vector<std::vector<uint32_t>>& holes) {
  return Shapes(
      guarded<Impl>(Task("making a mesh", {}, {}), [&] { return ofMesh(vertices, faces, holes); }));
}

Shapes Shapes::load(const std::string& path, const FileLimits& limits,
                    const FeatureSelection& selection) {
  return Shapes(guarded<Impl>(Task("reading", path, limits), [&] {
    Result<std::string> content = readFile(path, kLargestShapeFile);
    if (content.ok()) return parsed(content.value(), path, selection);
    auto impl = refused(content.error());
    impl->found = false;
    return impl;
  }));
}

Shapes Shapes::parse(const std::string& content, const std::string& name, const FileLimits& limits,
                     const FeatureSelection& selection) {
  return Shapes(guarded<Impl>(Task("reading", name, limits),
                              [&] { return parsed(content, name, selection); }));
}

Shapes Shapes::withNestedCut(const FileLimits& limits) const {
  return Shapes(guarded<Impl>(Task("cutting nested footprints", {}, limits), [&] {
    auto impl = std::make_shared<Impl>(*impl_);
    cutNested(impl->footprints);
    return impl;
  }));
}

Shapes Shapes::only(const std::vector<size_t>& indices) const {
  return Shapes(guarded<Impl>([&] {
    auto impl = std::make_shared<Impl>();
    impl->found = impl_->found;
    impl->diagnostics = impl_->diagnostics;
    impl->geoOrigin = impl_->geoOrigin;
    impl->textures = impl_->textures;
    impl->geo = impl_->geo;
    impl->terrain = impl_->terrain;
    impl->ofMap = impl_->ofMap;
    impl->isWhole = false;
    for (const size_t i : indices) {
      if (i >= impl_->footprints.size()) continue;
      ShapeFootprint f = impl_->footprints[i];
      if (f.index < 0) f.index = static_cast<int64_t>(i);
      impl->footprints.push_back(std::move(f));
    }
    return impl;
  }));
}

Shapes Shapes::within(const std::array<double, 4>& box) const {
  return Shapes(guarded<Impl>([&] {
    const auto& [west, south, east, north] = box;
    const bool degrees = std::max(std::fabs(west), std::fabs(east)) <= 180 &&
                         std::max(std::fabs(south), std::fabs(north)) <= 90;
    Box all{1e300, 1e300, -1e300, -1e300};
    std::vector<size_t> inside;
    for (size_t i = 0; i < impl_->footprints.size(); ++i) {
      const Vec2 p = middleOf(impl_->footprints[i], impl_->geo.get(), degrees);
      all = {std::min(all[0], p.x), std::min(all[1], p.y), std::max(all[2], p.x),
             std::max(all[3], p.y)};
      if (p.x >= west && p.x <= east && p.y >= south && p.y <= north) inside.push_back(i);
    }
    auto impl = std::make_shared<Impl>(only(inside).impl());
    if (inside.empty() && !impl_->footprints.empty()) {
      impl->diagnostics.push_back(diagnosticOf(nothingWithin(box, all, impl_->footprints.size())));
    }
    return impl;
  }));
}

Shapes Shapes::joined(const std::vector<Shapes>& all) {
  return Shapes(guarded<Impl>([&] {
    auto impl = std::make_shared<Impl>();
    for (const Shapes& shapes : all) {
      const Impl& from = shapes.impl();
      impl->found = impl->found && from.found;
      impl->diagnostics.insert(impl->diagnostics.end(), from.diagnostics.begin(),
                               from.diagnostics.end());
      if (!impl->geoOrigin.present) impl->geoOrigin = from.geoOrigin;
      impl->textures.insert(from.textures.begin(), from.textures.end());
      for (ShapeFootprint f : from.footprints) {
        f.index = -1;
        impl->footprints.push_back(std::move(f));
      }
    }
    return impl;
  }));
}

Shapes Shapes::withAttributes(const std::vector<std::vector<NamedValue>>& byShape) const {
  return Shapes(guarded<Impl>([&] {
    auto impl = std::make_shared<Impl>(*impl_);
    const size_t count = std::min(byShape.size(), impl->footprints.size());
    for (size_t i = 0; i < count; ++i) {
      std::vector<AttributeValue>& attributes = impl->footprints[i].attributes;
      for (const NamedValue& given : byShape[i]) {
        if (!isWhole(given.value)) {
          impl->diagnostics.push_back(diagnosticOf(
              Error{"attribute-value", "the value for '" + given.name + "' is no value of rules",
                    "give one item, or an array of rows times columns items of one kind"}));
          continue;
        }
        std::erase_if(attributes, [&](const AttributeValue& a) { return a.name == given.name; });
        attributes.push_back(attributeValueOf(given));
      }
    }
    return impl;
  }));
}

Shapes::Outline Shapes::outline(size_t shape) const {
  return guardedValue<Outline>([&] {
    return shape < impl_->footprints.size() ? outlineOf(impl_->footprints[shape]) : Outline{};
  });
}

size_t Shapes::size() const { return impl_->footprints.size(); }
bool Shapes::ok() const { return !hasErrors(impl_->diagnostics); }
bool Shapes::found() const { return impl_->found; }
const DiagnosticList& Shapes::diagnostics() const { return impl_->diagnostics; }

}  // namespace gable
