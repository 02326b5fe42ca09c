// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Roofs on each face of a shape. Hip, gable, shed and pyramid come from geom/skeleton/roof. The
// ridge roof is a prism over the face, cut by its two slopes: whatever the outline, what is below
// both planes is the roof.
#include <cmath>
#include <functional>
#include <limits>

#include "builtins/auto_tags.h"
#include "builtins/lists.h"
#include "builtins/ops/shared/face_plan.h"
#include "builtins/ops/shared/refit.h"
#include "geom/mesh/clip.h"
#include "geom/mesh/extrude.h"
#include "geom/mesh/face_plane.h"
#include "geom/skeleton/roof.h"
#include "math/trig.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// The arguments that all roofs begin with; `next` is the index of the first one after them.
struct Pitch {
  RoofPitch pitch;
  size_t next = 1;
};

Pitch pitchOf(const OpCall& call) {
  Pitch p;
  if (call.arg(0).type == ValueType::Float) {
    p.pitch = {RoofPitch::By::Angle, call.number(0)};
    return p;
  }
  const bool byHeight = call.is(0, "byHeight");
  p.pitch = {byHeight ? RoofPitch::By::Height : RoofPitch::By::Angle, call.number(1)};
  p.next = 2;
  return p;
}

// Turns a roof into faces of a mesh: the bottom first, as an extrusion has it.
class RoofMesh {
 public:
  RoofMesh(const Mesh& from, AutoTags& tags, bool tellsSides)
      : from_(from), tags_(tags), tellsSides_(tellsSides) {}

  void add(size_t face, const Frame& plan, const Roof& roof) {
    // Vertices that no face uses are no part of the result.
    std::vector<uint32_t> position(roof.vertices.size(), MeshBuilder::kNoPosition);
    for (const RoofFace& f : roof.faces) {
      for (const RoofLoop& loop : f.loops) {
        for (const uint32_t v : loop.vertices) {
          if (position[v] != MeshBuilder::kNoPosition) continue;
          const SkeletonVertex& at = roof.vertices[v];
          position[v] = builder_.addPosition(fromPlanFrame(plan, at.xy, at.height));
        }
      }
    }
    for (const bool bottom : {true, false}) {
      for (const RoofFace& f : roof.faces) {
        if ((f.role == RoofRole::Bottom) == bottom) addFace(face, f, position);
      }
    }
  }
  Mesh take() { return builder_.take(); }

 private:
  uint32_t tagsOf(size_t face, const RoofFace& f) {
    if (f.role == RoofRole::Bottom) return tags_.with(from_.faces[face].tags, "bottom");
    // Other faces stand on an edge and take its tags.
    const MeshLoop& loop = from_.loopsOf(face)[f.ring];
    const uint32_t edge =
        from_.edgeTags.empty() ? 0 : from_.edgeTags[loop.firstCorner + f.edge % loop.cornerCount];
    if (f.role == RoofRole::Slope) return tags_.with(edge, "top");
    if (!tellsSides_) return tags_.with(edge, "side");
    return tags_.with(edge, f.role == RoofRole::SideOuter ? "side.outer" : "side.inner");
  }

  void addFace(size_t face, const RoofFace& f, const std::vector<uint32_t>& position) {
    builder_.beginFace(from_.faces[face].materialSlot, tagsOf(face, f));
    for (const RoofLoop& loop : f.loops) {
      builder_.beginLoop();
      for (const uint32_t v : loop.vertices) builder_.addCorner(position[v]);
    }
  }

  const Mesh& from_;
  AutoTags& tags_;
  bool tellsSides_;
  MeshBuilder builder_;
};

// The direction of the new scope's y: the normal of the first face that has one.
Vec3 firstNormal(const Mesh& m) {
  for (size_t f = 0; f < m.faceCount(); ++f) {
    if (m.normal(f) != Vec3{}) return straightened(m.normal(f));
  }
  return {};
}

Status noFace(const OpCall& call) {
  return call.fail("no-geometry", "the shape has no face to put a roof on",
                   "insert a primitive or an asset first");
}

using MakeRoof = std::function<Roof(const Polygon&)>;

Status roofOnEachFace(OpCall& call, const MakeRoof& make, bool tellsSides) {
  Shape& s = call.shape();
  const MeshRef mesh = meshInScope(s);
  const Vec3 up = firstNormal(*mesh);
  if (up == Vec3{}) return noFace(call);
  AutoTags tags(call.services(), "roof");
  RoofMesh out(*mesh, tags, tellsSides);
  for (size_t f = 0; f < mesh->faceCount(); ++f) {
    if (mesh->normal(f) == Vec3{}) continue;
    const Frame plan = planFrame(*mesh, f);
    const Roof roof = make(facePolygon(*mesh, f, plan));
    if (!roof.status.ok()) return roof.status;
    out.add(f, plan, roof);
  }
  refit(s, out.take(), axesWithY(up, {1, 0, 0}));
  return {};
}

// Eaves and gable ends reach out, never in.
bool isOverhang(double v) { return v >= 0 && std::isfinite(v); }

Status badOverhang(const OpCall& call) {
  return call.fail("roof-overhang", "the overhang of the roof is not a distance",
                   "give zero or a positive number");
}

Status applyHip(OpCall& call) {
  const Pitch p = pitchOf(call);
  const double overhang = call.number(p.next, 0);
  if (!isOverhang(overhang)) return badOverhang(call);
  const bool even = call.truth(p.next + 1, false);
  return roofOnEachFace(
      call, [&](const Polygon& polygon) { return hipRoof(polygon, p.pitch, overhang, even); },
      false);
}

Status applyGable(OpCall& call) {
  const Pitch p = pitchOf(call);
  GableOptions options;
  options.overhangX = call.number(p.next, 0);
  options.overhangY = call.number(p.next + 1, 0);
  options.even = call.truth(p.next + 2, false);
  if (!isOverhang(options.overhangX) || !isOverhang(options.overhangY)) return badOverhang(call);
  if (call.has(p.next + 3)) {
    const double edge = call.number(p.next + 3);
    if (!(std::fabs(edge) < 1e9)) {
      return call.fail("roof-edge", "the edge index is not a number of an edge",
                       "edges are counted from 0");
    }
    options.ridgeEdge = static_cast<int64_t>(edge);
  }
  return roofOnEachFace(
      call, [&](const Polygon& polygon) { return gableRoof(polygon, p.pitch, options); }, false);
}

Status applyShed(OpCall& call) {
  const Pitch p = pitchOf(call);
  const double edge = call.number(p.next, 0);
  if (!(std::fabs(edge) < 1e9)) {
    return call.fail("roof-edge", "the edge index is not a number of an edge",
                     "edges are counted from 0");
  }
  return roofOnEachFace(
      call,
      [&](const Polygon& polygon) {
        return shedRoof(polygon, p.pitch, static_cast<int64_t>(edge));
      },
      true);
}

Status applyPyramid(OpCall& call) {
  const Pitch p = pitchOf(call);
  return roofOnEachFace(
      call, [&](const Polygon& polygon) { return pyramidRoof(polygon, p.pitch); }, false);
}

// What is below a plane of a closed mesh; the face that closes it gets `tags`. Tags of other faces
// stay.
Mesh below(const Mesh& m, const Plane& plane, uint32_t tags, uint16_t slot) {
  CutOptions options;
  options.cap = true;
  options.capTags = tags;
  options.capSlot = slot;
  return std::move(cutByPlane(m, plane, options).back.mesh);
}

// One face, whose y is along the normal `up` after `axes`; x is the direction of the ridge.
Mesh ridgeRoof(const Mesh& m, size_t face, const Vec3& ridge, RoofPitch pitch, AutoTags& tags) {
  const Vec3 up = straightened(m.normal(face));
  const Vec3 across = cross(up, ridge);
  double lo = std::numeric_limits<double>::infinity(), hi = -lo, base = lo;
  for (const uint32_t p : m.cornersOf(m.loopsOf(face)[0])) {
    const double v = dot(across, m.positions[p]);
    lo = std::min(lo, v);
    hi = std::max(hi, v);
    base = std::min(base, dot(up, m.positions[p]));
  }
  const double half = (hi - lo) / 2;
  const double tangent =
      pitch.by == RoofPitch::By::Angle ? tanDeg(pitch.value) : pitch.value / half;
  MeshBuilder one;
  std::vector<uint32_t> map;
  one.copyFace(m, face, map);
  const Mesh single = one.take();
  ExtrudeOptions options;
  options.mode = ExtrudeMode::Along;
  options.direction = up;
  options.distance = half * tangent * 1.5;
  ExtrudeResult prism = extrude(single, options);
  for (size_t f = 0; f < prism.mesh.faceCount(); ++f) {
    const uint32_t first = prism.mesh.loopsOf(f)[0].firstCorner;
    const uint32_t edge = prism.mesh.edgeTags.empty() ? 0 : prism.mesh.edgeTags[first];
    uint32_t& to = prism.mesh.faces[f].tags;
    switch (prism.roles[f]) {
      case ExtrudeRole::Bottom: to = tags.with(m.faces[face].tags, "bottom"); break;
      case ExtrudeRole::SideOuter: to = tags.with(edge, "side.outer"); break;
      case ExtrudeRole::SideInner: to = tags.with(edge, "side.inner"); break;
      case ExtrudeRole::Top: break;
    }
  }
  const uint32_t top = tags.with(0, "top");
  const uint16_t slot = m.faces[face].materialSlot;
  // height <= (v - lo) * tangent, and the same from the other side.
  const Plane rising{up - across * tangent, base - lo * tangent};
  const Plane falling{up + across * tangent, base + hi * tangent};
  return below(below(prism.mesh, rising, top, slot), falling, top, slot);
}

Status applyRidge(OpCall& call) {
  Shape& s = call.shape();
  const Pitch p = pitchOf(call);
  const bool angle = p.pitch.by == RoofPitch::By::Angle;
  if (!(p.pitch.value > 0) || (angle && p.pitch.value >= 90) || !std::isfinite(p.pitch.value)) {
    return call.fail("roof-pitch",
                     "the roof's angle is not within 0 and 90 or its height not positive",
                     "give an angle between 0 and 90 degrees or a positive height");
  }
  const MeshRef mesh = meshInScope(s);
  const Vec3 up = firstNormal(*mesh);
  if (up == Vec3{}) return noFace(call);
  AutoTags tags(call.services(), "roof");
  Mesh out;
  for (size_t f = 0; f < mesh->faceCount(); ++f) {
    if (mesh->normal(f) == Vec3{}) continue;
    const Frame axes = axesWithY(straightened(mesh->normal(f)), {1, 0, 0});
    append(out, ridgeRoof(*mesh, f, axes.x, p.pitch, tags));
  }
  for (auto& set : out.uvs) set.clear();
  refit(s, std::move(out), axesWithY(up, {1, 0, 0}));
  return {};
}

constexpr const char* kByWords = "byAngle byHeight";
constexpr const char* kAngleDoc = "The slope of the roof planes, in degrees.";
constexpr const char* kByDoc = "What the value means: the slope, or the height of the top.";
constexpr const char* kValueDoc = "The slope in degrees, or the height in metres.";
constexpr const char* kEvenDoc = "Makes ridges level; faces may then be bent.";
constexpr const char* kEdgeDoc = "The edge to which the roof is turned, counted from 0.";

constexpr ParamSpec kHipByAngle[] = {
    {"angle", ParamType::Float, kAngleDoc},
    {"overhang", ParamType::Float, "How far the eaves reach out, down the slope.", "0"},
    {"even", ParamType::Bool, kEvenDoc, "false"},
};
constexpr ParamSpec kHipByValue[] = {
    {"valueType", ParamType::Selector, kByDoc, nullptr, kByWords},
    {"value", ParamType::Float, kValueDoc},
    {"overhang", ParamType::Float, "How far the eaves reach out, down the slope.", "0"},
    {"even", ParamType::Bool, kEvenDoc, "false"},
};
constexpr ParamSpec kGableByAngle[] = {
    {"angle", ParamType::Float, kAngleDoc},
    {"overhangX", ParamType::Float, "How far the eaves reach out, down the slope.", "0"},
    {"overhangY", ParamType::Float, "How far the gable ends reach out, along the ridge.", "0"},
    {"even", ParamType::Bool, kEvenDoc, "false"},
    {"index", ParamType::Float, "The edge that the ridge runs along; for a single convex face.",
     "-1"},
};
constexpr ParamSpec kGableByValue[] = {
    {"valueType", ParamType::Selector, kByDoc, nullptr, kByWords},
    {"value", ParamType::Float, kValueDoc},
    {"overhangX", ParamType::Float, "How far the eaves reach out, down the slope.", "0"},
    {"overhangY", ParamType::Float, "How far the gable ends reach out, along the ridge.", "0"},
    {"even", ParamType::Bool, kEvenDoc, "false"},
    {"index", ParamType::Float, "The edge that the ridge runs along; for a single convex face.",
     "-1"},
};
constexpr ParamSpec kShedByAngle[] = {
    {"angle", ParamType::Float, kAngleDoc},
    {"index", ParamType::Float, kEdgeDoc, "0"},
};
constexpr ParamSpec kShedByValue[] = {
    {"valueType", ParamType::Selector, kByDoc, nullptr, kByWords},
    {"value", ParamType::Float, kValueDoc},
    {"index", ParamType::Float, kEdgeDoc, "0"},
};
constexpr ParamSpec kAngle[] = {{"angle", ParamType::Float, kAngleDoc}};
constexpr ParamSpec kValue[] = {
    {"valueType", ParamType::Selector, kByDoc, nullptr, kByWords},
    {"value", ParamType::Float, kValueDoc},
};
constexpr Signature kHip[] = {{kHipByAngle}, {kHipByValue}};
constexpr Signature kGable[] = {{kGableByAngle}, {kGableByValue}};
constexpr Signature kShed[] = {{kShedByAngle}, {kShedByValue}};
constexpr Signature kPyramid[] = {{kAngle}, {kValue}};
constexpr Signature kRidge[] = {{kAngle}, {kValue}};

constexpr OpSpec kSpecs[] = {
    heavy({"roofHip", "roof", "Puts a hip roof on each face: a slope rises from every edge.", kHip,
           applyHip}),
    heavy({"roofGable", "roof",
           "Puts a gable roof on each face: slopes at the eaves, upright ends.", kGable,
           applyGable}),
    heavy({"roofShed", "roof", "Puts a shed roof on each face: one slope that rises from an edge.",
           kShed, applyShed}),
    heavy({"roofPyramid", "roof", "Joins the edges of each face to a point above its middle.",
           kPyramid, applyPyramid}),
    heavy({"roofRidge", "roof",
           "Puts two slopes on each face that meet in one ridge along the scope's x.", kRidge,
           applyRidge}),
};

}  // namespace

extern const OpList kOps_roof;
const OpList kOps_roof = kSpecs;

}  // namespace gable
