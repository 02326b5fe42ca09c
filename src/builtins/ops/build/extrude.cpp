// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A rectangle becomes a box by arithmetic; all else is geom/mesh/extrude with tags and a scope.
#include <cmath>

#include "builtins/auto_tags.h"
#include "builtins/lists.h"
#include "builtins/ops/shared/refit.h"
#include "geom/mesh/extrude.h"
#include "geom/mesh/topology.h"
#include "shape/op_call.h"

namespace gable {

namespace {

struct Extrude {
  Word type{"face.normal"};
  double distance;
};

// The mode and, for those with one, the direction in scope coordinates.
ExtrudeOptions optionsOf(const OpCall& call, const Extrude& args, const Shape& s) {
  ExtrudeOptions options;
  options.distance = args.distance;
  options.direction = {0, 0, 1};
  if (args.type == "face.normal") return options;
  const std::string_view type = args.type.text;
  if (type == "vertex.normal") {
    options.mode = ExtrudeMode::VertexNormal;
    return options;
  }
  options.mode = type == "world.up.flatTop" ? ExtrudeMode::FlatTop : ExtrudeMode::Along;
  const bool world = type.starts_with("world.");
  const std::string_view axis = world ? type.substr(6) : type;
  Vec3 d{0, 1, 0};
  if (axis == "x") d = {1, 0, 0};
  if (axis == "z") d = {0, 0, 1};
  if (world) d = s.scope.toLocalDirection(call.world().toLocalDirection(d));
  options.direction = straightened(d);
  return options;
}

const char* roleName(ExtrudeRole role) {
  switch (role) {
    case ExtrudeRole::Bottom: return "bottom";
    case ExtrudeRole::SideOuter: return "side.outer";
    case ExtrudeRole::SideInner: return "side.inner";
    case ExtrudeRole::Top: break;
  }
  return "top";
}

// A rectangle that is extruded along its normal, upward: a box, without a mesh.
bool extrudeToBox(Shape& s, const ExtrudeOptions& options, AutoTags& tags) {
  const bool flat = s.geometry.kind == GeometryKind::QuadXz;
  if (!flat && s.geometry.kind != GeometryKind::QuadXy) return false;
  const double depth = flat ? s.size.z : s.size.y;
  if (hasEdgeTags(s.geometry)) return false;
  if (s.geometry.uv || s.size.x <= 0 || depth <= 0 || options.distance <= 0) return false;
  if ((flat ? s.size.y : s.size.z) < 0) return false;
  const bool along = options.mode == ExtrudeMode::Along || options.mode == ExtrudeMode::FlatTop;
  const Vec3 normal = flat ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  if (along && options.direction != normal) return false;
  const uint32_t face = s.geometry.tags[flat ? kSideTop : kSideFront];
  if (!flat) {
    // The wall's upper edge becomes the back of the box.
    const Frame lying = Frame::of({0, s.size.y, 0}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0});
    s.scope = s.scope * lying;
  }
  s.size = {s.size.x, options.distance, depth};
  const uint32_t side = tags.with(0, "side.outer");
  s.geometry = primitive(GeometryKind::Box, side);
  s.geometry.order = BoxOrder::Extruded;
  s.geometry.tags[kSideBottom] = tags.with(face, "bottom");
  s.geometry.tags[kSideTop] = tags.with(face, "top");
  return true;
}

// The y axis of the new scope, in coordinates of the old one.
Vec3 upOf(const Mesh& m, const ExtrudeOptions& options) {
  if (options.mode == ExtrudeMode::VertexNormal && !m.corners.empty()) {
    const Vec3 n = vertexNormals(m)[m.corners[0]];
    if (n != Vec3{}) return straightened(n);
    if (!m.normals.empty() && m.normals[0] != Vec3{}) return straightened(m.normals[0]);
  }
  if (options.mode == ExtrudeMode::FaceNormal || options.mode == ExtrudeMode::VertexNormal) {
    for (size_t f = 0; f < m.faceCount(); ++f) {
      if (m.normal(f) != Vec3{}) return straightened(m.normal(f));
      if (!m.normals.empty()) return straightened(m.normals[m.loopsOf(f)[0].firstCorner]);
    }
  }
  return options.direction;
}

Status applyExtrude(OpCall& call, const Extrude& args) {
  Shape& s = call.shape();
  const ExtrudeOptions options = optionsOf(call, args, s);
  if (!std::isfinite(options.distance)) {
    return call.fail("extrude-distance", "the distance to extrude is not a finite number",
                     "check the expression for a division by zero");
  }
  AutoTags tags(call.services(), "extrude");
  if (extrudeToBox(s, options, tags)) return {};
  const MeshRef mesh = meshInScope(s);
  if (mesh->empty()) {
    return call.fail("no-geometry", "the shape has no geometry to extrude",
                     "insert a primitive or an asset first");
  }
  const Vec3 up = upOf(*mesh, options);
  ExtrudeResult made = extrude(*mesh, options);
  for (size_t f = 0; f < made.mesh.faceCount(); ++f) {
    const bool side =
        made.roles[f] == ExtrudeRole::SideOuter || made.roles[f] == ExtrudeRole::SideInner;
    // Sides stand on an edge and take its tags, the others on a face.
    const uint32_t edgeTags = made.mesh.edgeTagsAt(made.mesh.loopsOf(f)[0].firstCorner);
    const uint32_t from = side ? edgeTags : mesh->faces[made.faceSource[f]].tags;
    made.mesh.faces[f].tags = tags.with(from, roleName(made.roles[f]));
  }
  refit(s, std::move(made.mesh), axesWithY(up, {1, 0, 0}), options.distance < 0);
  return {};
}

constexpr ParamSpec kDistance[] = {
    param<&Extrude::distance>("distance", "How far, in metres; negative to the other side."),
};
constexpr ParamSpec kTyped[] = {
    param<&Extrude::type>(
        "extrusionType",
        "The direction: the normals of faces or of vertices, straight up in the world (with a "
        "level "
        "top if wanted), or an axis of the world or the scope.",
        nullptr,
        "face.normal vertex.normal world.up world.up.flatTop world.x world.y world.z x y z"),
    param<&Extrude::distance>("distance", "How far, in metres; negative to the other side."),
};
constexpr Signature kSignatures[] = {{kDistance}, {kTyped}};

constexpr OpSpec kSpecs[] = {
    {"extrude", "build", "Makes a solid by moving each face and joining it to where it was.",
     kSignatures, typed<applyExtrude>, BlockKind::None, kReadsWorld | kReadsWorldByWord},
};

}  // namespace

extern const OpList kOps_extrude;
const OpList kOps_extrude = kSpecs;

}  // namespace gable
