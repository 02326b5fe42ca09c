// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <cmath>

#include "builtins/auto_tags.h"
#include "builtins/lists.h"
#include "builtins/ops/shared/refit.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// The centre of gravity of a face, holes left out.
Vec3 centroid(const Mesh& m, size_t face) {
  const Vec3 normal = m.normal(face), origin = m.at(m.loopsOf(face)[0].firstCorner);
  Vec3 sum;
  double weight = 0;
  for (const MeshLoop& loop : m.loopsOf(face)) {
    for (uint32_t i = 0; i < loop.cornerCount; ++i) {
      const Vec3 a = m.at(loop.firstCorner + i) - origin;
      const Vec3 b = m.at(loop.firstCorner + (i + 1) % loop.cornerCount) - origin;
      const double area = dot(cross(a, b), normal);
      sum += (a + b) * (area / 3);
      weight += area;
    }
  }
  return weight != 0 ? origin + sum * (1 / weight) : origin;
}

// Copies a corner's position, uv coordinates and the tags of an edge.
struct Copier {
  const Mesh& from;
  MeshBuilder& to;

  void corner(uint32_t like, uint32_t position, uint32_t tags) const {
    const uint32_t made = to.addCorner(position, tags);
    for (int set = 0; set < from.setCount(); ++set) {
      if (from.hasUv(set)) to.setUv(made, set, from.set(set)[like]);
    }
  }
};

Mesh tapered(const Mesh& m, size_t face, const Vec3& apexAt, bool downward, AutoTags& tags) {
  MeshBuilder b;
  const MeshFace& source = m.faces[face];
  std::vector<uint32_t> map;
  b.copyFace(m, face, map, !downward);
  b.mesh().normals.clear();
  b.mesh().faces[0].tags = tags.with(source.tags, "bottom");
  const uint32_t apex = b.addPosition(apexAt);
  const Copier copy{m, b};
  for (const MeshLoop& loop : m.loopsOf(face)) {
    for (uint32_t i = 0; i < loop.cornerCount; ++i) {
      const uint32_t a = loop.firstCorner + i;
      const uint32_t c = loop.firstCorner + (i + 1) % loop.cornerCount;
      const uint32_t edge = m.edgeTagsAt(a);
      b.beginFace(source.materialSlot, tags.with(edge, "side"));
      b.beginLoop();
      const uint32_t from = downward ? c : a, to = downward ? a : c;
      copy.corner(from, map[m.corners[from]], edge);
      copy.corner(to, map[m.corners[to]], m.vertexTagsAt(m.corners[to]));
      copy.corner(from, apex, m.vertexTagsAt(m.corners[from]));
    }
  }
  return b.take();
}

struct Taper {
  double height;
};

Status applyTaper(OpCall& call, const Taper& args) {
  Shape& s = call.shape();
  const double height = args.height;
  if (!std::isfinite(height)) {
    return call.fail("extrude-distance", "the height to taper is not a finite number",
                     "check the expression for a division by zero");
  }
  const MeshRef mesh = meshInScope(s);
  size_t face = 0;
  while (face < mesh->faceCount() && mesh->normal(face) == Vec3{}) ++face;
  if (face == mesh->faceCount()) {
    return call.fail("no-geometry", "the shape has no face to taper",
                     "insert a primitive or an asset first");
  }
  const Vec3 normal = straightened(mesh->normal(face));
  AutoTags tags(call.services(), "taper");
  if (height == 0) return {};
  const Vec3 apex = centroid(*mesh, face) + normal * height;
  refit(s, tapered(*mesh, face, apex, height < 0, tags), axesWithY(normal, {1, 0, 0}), height < 0);
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&Taper::height>("height",
                          "The height of the point above the face, in metres; negative below it."),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    {"taper", "build", "Makes a pyramid over the first face, its point above the face's centre.",
     kSignatures, typed<applyTaper>},
};

}  // namespace

extern const OpList kOps_taper;
const OpList kOps_taper = kSpecs;

}  // namespace gable
