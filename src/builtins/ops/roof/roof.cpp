// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Roofs on each face of a shape. Hip, gable, shed and pyramid come from geom/skeleton/roof. The
// ridge roof is a prism over the face, cut by its two slopes: whatever the outline, what is below
// both planes is the roof.
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "base/work.h"
#include "builtins/auto_tags.h"
#include "builtins/lists.h"
#include "builtins/ops/shared/face_plan.h"
#include "builtins/ops/shared/refit.h"
#include "geom/mesh/clip.h"
#include "geom/mesh/extrude.h"
#include "geom/mesh/face_plane.h"
#include "geom/mesh/origins.h"
#include "geom/skeleton/roof.h"
#include "math/trig.h"
#include "shape/op_call.h"

namespace gable {

namespace {

enum class By : uint8_t { Angle, Height };

}  // namespace

template <>
struct WordsOf<By> {
  static constexpr const char* text = "byAngle byHeight";
};

namespace {

// What all roofs take. A plain number is an angle.
struct Pitch {
  By by = By::Angle;
  double value;
};

RoofPitch pitchOf(const Pitch& args) {
  return {args.by == By::Height ? RoofPitch::By::Height : RoofPitch::By::Angle, args.value};
}

// Turns a roof into faces of a mesh: the bottom first, as an extrusion has it.
class RoofMesh {
 public:
  RoofMesh(const Mesh& from, AutoTags& tags, bool tellsSides)
      : from_(from), tags_(tags), tellsSides_(tellsSides) {}

  void add(size_t face, const Frame& plan, const Roof& roof) {
    findSources(face, plan, roof);
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
  // The corners of the face that the vertices of the roof are: where vertices come from is told by
  // them alone. New ones, of ridges and overhangs, come from nowhere.
  void findSources(size_t face, const Frame& plan, const Roof& roof) {
    sources_.assign(roof.vertices.size(), kNoSource);
    if (originLevels(from_) == 0) return;
    std::map<std::pair<double, double>, uint32_t> corners;
    for (const MeshLoop& loop : from_.loopsOf(face)) {
      for (uint32_t i = 0; i < loop.cornerCount; ++i) {
        work();
        const Vec3 at = plan.toLocal(from_.at(loop.firstCorner + i));
        corners.try_emplace({at.x, at.y}, loop.firstCorner + i);
      }
    }
    for (size_t v = 0; v < roof.vertices.size(); ++v) {
      work();
      const SkeletonVertex& at = roof.vertices[v];
      const auto corner = corners.find({at.xy.x, at.xy.y});
      if (at.height == 0 && corner != corners.end()) sources_[v] = corner->second;
    }
  }
  void addCorner(uint32_t position, uint32_t source) {
    const uint32_t corner = builder_.addCorner(position);
    if (source == kNoSource) return;
    for (int s = kUvSets; s < from_.setCount(); ++s) {
      if (from_.hasUv(s)) builder_.setUv(corner, s, from_.set(s)[source]);
    }
  }

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
      for (const uint32_t v : loop.vertices) addCorner(position[v], sources_[v]);
    }
  }

  static constexpr uint32_t kNoSource = 0xffffffff;
  const Mesh& from_;
  AutoTags& tags_;
  bool tellsSides_;
  /// By vertex of the roof at work.
  std::vector<uint32_t> sources_;
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

bool isEdgeIndex(double v) { return std::fabs(v) < 1e9; }

Status badEdge(const OpCall& call) {
  return call.fail("roof-edge", "the edge index is not a number of an edge",
                   "edges are counted from 0");
}

struct Hip : Pitch {
  double overhang;
  bool even;
};

Status applyHip(OpCall& call, const Hip& args) {
  return roofOnEachFace(
      call,
      [&](const Polygon& polygon) {
        return hipRoof(polygon, pitchOf(args), args.overhang, args.even);
      },
      false);
}

struct Gable : Pitch {
  double overhangX, overhangY;
  bool even;
  std::optional<double> index;
};

Status applyGable(OpCall& call, const Gable& args) {
  if (args.index && !isEdgeIndex(*args.index)) return badEdge(call);
  GableOptions options;
  options.overhangX = args.overhangX;
  options.overhangY = args.overhangY;
  options.even = args.even;
  if (args.index) options.ridgeEdge = static_cast<int64_t>(*args.index);
  return roofOnEachFace(
      call, [&](const Polygon& polygon) { return gableRoof(polygon, pitchOf(args), options); },
      false);
}

struct Shed : Pitch {
  double index;
};

Status applyShed(OpCall& call, const Shed& args) {
  if (!isEdgeIndex(args.index)) return badEdge(call);
  return roofOnEachFace(
      call,
      [&](const Polygon& polygon) {
        return shedRoof(polygon, pitchOf(args), static_cast<int64_t>(args.index));
      },
      true);
}

Status applyPyramid(OpCall& call, const Pitch& args) {
  return roofOnEachFace(
      call, [&](const Polygon& polygon) { return pyramidRoof(polygon, pitchOf(args)); }, false);
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

Status applyRidge(OpCall& call, const Pitch& args) {
  Shape& s = call.shape();
  const RoofPitch pitch = pitchOf(args);
  if (pitch.by == RoofPitch::By::Angle && pitch.value >= 90) {
    return call.fail("roof-pitch", "the angle of a roof is less than 90 degrees",
                     "give an angle between 0 and 90 degrees, or a height");
  }
  const MeshRef mesh = meshInScope(s);
  const Vec3 up = firstNormal(*mesh);
  if (up == Vec3{}) return noFace(call);
  AutoTags tags(call.services(), "roof");
  Mesh out;
  for (size_t f = 0; f < mesh->faceCount(); ++f) {
    if (mesh->normal(f) == Vec3{}) continue;
    const Frame axes = axesWithY(straightened(mesh->normal(f)), {1, 0, 0});
    append(out, ridgeRoof(*mesh, f, axes.x, pitch, tags));
  }
  for (auto& set : out.uvs) set.clear();
  refit(s, std::move(out), axesWithY(up, {1, 0, 0}));
  return {};
}

constexpr const char* kAngleDoc = "The slope of the roof planes, in degrees.";
constexpr const char* kByDoc = "What the value means: the slope, or the height of the top.";
constexpr const char* kValueDoc = "The slope in degrees, or the height in metres.";
constexpr const char* kEvenDoc = "Makes ridges level; faces may then be bent.";
constexpr const char* kEavesDoc =
    "How far the eaves reach out, down the slope; below 0, how far above the edge the slope ends.";
constexpr const char* kVergesDoc =
    "How far the slopes reach out over the gable ends, along the ridge; below 0, how far behind.";
constexpr const char* kEdgeDoc = "The edge to which the roof is turned, counted from 0.";

constexpr ParamSpec kAngle[] = {param<&Pitch::value>("angle", kAngleDoc).above(0).below(90)};
constexpr ParamSpec kValue[] = {
    param<&Pitch::by>("valueType", kByDoc),
    param<&Pitch::value>("value", kValueDoc).above(0),
};
constexpr ParamSpec kOverhang = param<&Hip::overhang>("overhang", kEavesDoc, "0");
constexpr ParamSpec kEven = param<&Hip::even>("even", kEvenDoc, "false");
constexpr ParamSpec kHipByAngle[] = {kAngle[0], kOverhang, kEven};
constexpr ParamSpec kHipByValue[] = {kValue[0], kValue[1], kOverhang, kEven};

constexpr ParamSpec kGableRest[] = {
    param<&Gable::overhangX>("overhangX", kEavesDoc, "0"),
    param<&Gable::overhangY>("overhangY", kVergesDoc, "0"),
    param<&Gable::even>("even", kEvenDoc, "false"),
    param<&Gable::index>("index", "The edge that the ridge runs along; for a single convex face.",
                         "none"),
};
constexpr ParamSpec kGableByAngle[] = {kAngle[0], kGableRest[0], kGableRest[1], kGableRest[2],
                                       kGableRest[3]};
constexpr ParamSpec kGableByValue[] = {kValue[0],     kValue[1],     kGableRest[0],
                                       kGableRest[1], kGableRest[2], kGableRest[3]};

constexpr ParamSpec kShedIndex = param<&Shed::index>("index", kEdgeDoc, "0");
constexpr ParamSpec kShedByAngle[] = {kAngle[0], kShedIndex};
constexpr ParamSpec kShedByValue[] = {kValue[0], kValue[1], kShedIndex};

constexpr Signature kHip[] = {{kHipByAngle}, {kHipByValue}};
constexpr Signature kGable[] = {{kGableByAngle}, {kGableByValue}};
constexpr Signature kShed[] = {{kShedByAngle}, {kShedByValue}};
constexpr Signature kPyramid[] = {{kAngle}, {kValue}};
constexpr Signature kRidge[] = {{kAngle}, {kValue}};

constexpr OpSpec kSpecs[] = {
    heavy({"roofHip", "roof", "Puts a hip roof on each face: a slope rises from every edge.", kHip,
           typed<applyHip>}),
    heavy({"roofGable", "roof",
           "Puts a gable roof on each face: slopes at the eaves, upright ends.", kGable,
           typed<applyGable>}),
    heavy({"roofShed", "roof", "Puts a shed roof on each face: one slope that rises from an edge.",
           kShed, typed<applyShed>}),
    heavy({"roofPyramid", "roof", "Joins the edges of each face to a point above its middle.",
           kPyramid, typed<applyPyramid>}),
    heavy({"roofRidge", "roof",
           "Puts two slopes on each face that meet in one ridge along the scope's x.", kRidge,
           typed<applyRidge>}),
};

}  // namespace

extern const OpList kOps_roof;
const OpList kOps_roof = kSpecs;

}  // namespace gable
