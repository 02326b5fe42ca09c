// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Initial shapes: lots, polygons and files of footprints. Each shape gets an object frame near it,
// so that coordinates far from the origin lose nothing.

#include <cmath>

#include "base/files.h"
#include "engine/impl.h"
#include "geom/mesh/face_plane.h"
#include "geom/region/region.h"
#include "io/importers/shape_input.h"

namespace gable {

namespace {

constexpr uint64_t kLargestShapeFile = 2ull << 30;

// The frame stands, unturned, on a whole metre near the lower corner: offsets stay exact.
ShapeFootprint footprint(ShapeInput input) {
  ShapeFootprint f;
  f.name = std::move(input.name);
  f.id = std::move(input.id);
  f.attributes = std::move(input.attributes);
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

Shapes ofPolygon(const Polygon& p, const std::string& name) {
  auto impl = std::make_shared<Shapes::Impl>();
  MeshBuilder b;
  // Plan coordinates to the ground: x east, y north is -z.
  addFace(b, p, Frame::of({}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}));
  ShapeInput input;
  input.name = name;
  input.mesh = b.take();
  impl->footprints.push_back(footprint(std::move(input)));
  return Shapes(std::move(impl));
}

}  // namespace

Shapes Shapes::lot(double width, double depth) {
  return ofPolygon({{{0, 0}, {width, 0}, {width, depth}, {0, depth}}, {}}, "lot");
}

Shapes Shapes::polygon(const Ring& outer, const std::vector<Ring>& holes) {
  const auto ring = [](const Ring& r) {
    gable::Ring out;
    for (const auto& [x, y] : r) out.push_back({x, y});
    return out;
  };
  Polygon p{ring(outer), {}};
  for (const Ring& h : holes) p.holes.push_back(ring(h));
  orient(p);
  return ofPolygon(p, "polygon");
}

Shapes Shapes::load(const std::string& path) {
  Result<std::string> content = readFile(path, kLargestShapeFile);
  if (content.ok()) return parse(content.value(), path);
  auto impl = std::make_shared<Impl>();
  impl->found = false;
  impl->messages.push_back(errorMessage(content.error()));
  return Shapes(std::move(impl));
}

Shapes Shapes::parse(const std::string& content, const std::string& name) {
  auto impl = std::make_shared<Impl>();
  AssetOptions options;
  options.path = name;
  options.readFile = [](const std::string& path) { return readFile(path, kLargestShapeFile); };
  Result<ShapeFile> file = readShapes(content, options);
  if (!file.ok()) {
    impl->messages.push_back(errorMessage(file.error()));
    return Shapes(std::move(impl));
  }
  impl->geoOrigin = file->geoOrigin;
  for (ShapeInput& s : file->shapes) impl->footprints.push_back(footprint(std::move(s)));
  Diagnostics diagnostics = file->diagnostics;
  if (impl->footprints.empty() && !diagnostics.hasErrors()) {
    diagnostics.error("no-shapes", Span{}, "'" + name + "' holds no shape to derive",
                      "polygons, or faces of a model, become initial shapes");
  }
  impl->messages = toMessages(diagnostics, Sources{});
  return Shapes(std::move(impl));
}

Shapes Shapes::withNestedCut() const {
  auto impl = std::make_shared<Impl>(*impl_);
  cutNested(impl->footprints);
  return Shapes(std::move(impl));
}

size_t Shapes::size() const { return impl_->footprints.size(); }
bool Shapes::ok() const { return !hasErrors(impl_->messages); }
bool Shapes::found() const { return impl_->found; }
const Messages& Shapes::messages() const { return impl_->messages; }

}  // namespace gable
