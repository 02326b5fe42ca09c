// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Building envelopes on each face of a shape. The solid comes from geom/skeleton/envelope; here
// edges get their numbers, by the way that they look or one by one.
#include <algorithm>
#include <array>
#include <limits>

#include "base/work.h"
#include "builtins/auto_tags.h"
#include "builtins/lists.h"
#include "builtins/ops/shared/face_plan.h"
#include "builtins/ops/shared/refit.h"
#include "builtins/selection.h"
#include "geom/mesh/face_plane.h"
#include "geom/skeleton/envelope.h"
#include "shape/op_call.h"

namespace gable {

namespace {

enum class Up : uint8_t { Normal, World };

}  // namespace

template <>
struct WordsOf<Up> {
  static constexpr const char* text = "normal world.up";
};

namespace {

// Of the signatures each names some; the others keep what stands here.
struct Arguments {
  Up direction = Up::Normal;
  double maxHeight;
  double frontBaseHeight = 0, frontAngle = 90;
  double backBaseHeight = 0, backAngle = 90;
  std::optional<double> sideBaseHeight, sideAngle;
  double rightBaseHeight = 0, rightAngle = 90;
  double leftBaseHeight = 0, leftAngle = 90;
  Floats baseHeights, angles;
};

/// The numbers of each corner's edge.
class SideChoice {
 public:
  SideChoice(OpCall& call, const Arguments& args)
      : args_(args), directions_(call.services(), call.shape()) {}

  /// `number` counts face edges through all faces; `out` is where the edge looks.
  EnvelopeSide of(size_t number, const std::array<Vec3, 2>& edge, uint32_t tags,
                  const Vec3& out) const {
    if (args_.baseHeights.array != nullptr) return listed(number);
    const auto looks = [&](std::string_view word) {
      return selectsDirection(word, out, edge, tags, directions_);
    };
    if (looks("street.front")) return {args_.frontBaseHeight, args_.frontAngle};
    if (looks("street.back")) return {args_.backBaseHeight, args_.backAngle};
    if (args_.sideBaseHeight) return {*args_.sideBaseHeight, args_.sideAngle.value_or(90)};
    if (looks("street.right")) return {args_.rightBaseHeight, args_.rightAngle};
    return {args_.leftBaseHeight, args_.leftAngle};
  }

 private:
  EnvelopeSide listed(size_t number) const {
    EnvelopeSide s;
    const auto& heights = args_.baseHeights.array->numbers;
    const auto& angles = args_.angles.array->numbers;
    if (number < heights.size()) s.baseHeight = heights[number];
    if (number < angles.size()) s.angle = angles[number];
    return s;
  }

  const Arguments& args_;
  Directions directions_;
};

const char* roleName(const EnvelopeFace& f) {
  switch (f.role) {
    case EnvelopeRole::Base: return f.ring == 0 ? "side.base" : "side.inner";
    case EnvelopeRole::Slope: return "side.slope";
    case EnvelopeRole::Bottom: return "bottom";
    case EnvelopeRole::Top: break;
  }
  return "top";
}

// The plane on which a face is seen, with z the way up, through its highest point.
Frame planOf(const Mesh& m, size_t face, const Vec3& up) {
  if (up == straightened(m.normal(face))) return planFrame(m, face);
  Vec3 highest = m.at(m.loopsOf(face)[0].firstCorner);
  for (const MeshLoop& loop : m.loopsOf(face)) {
    for (const uint32_t p : m.cornersOf(loop)) {
      if (dot(up, m.positions[p]) > dot(up, highest)) highest = m.positions[p];
    }
  }
  return frameFromZ(highest, up, {1, 0, 0});
}

void addEnvelope(MeshBuilder& to, const Mesh& from, size_t face, const Frame& plan,
                 const Envelope& envelope, AutoTags& tags) {
  std::vector<uint32_t> position(envelope.vertices.size(), MeshBuilder::kNoPosition);
  for (const bool bottom : {true, false}) {
    for (const EnvelopeFace& f : envelope.faces) {
      if ((f.role == EnvelopeRole::Bottom) != bottom) continue;
      // Sides stand on an edge and take its tags, the others on the face.
      uint32_t source = from.faces[face].tags;
      if (f.role == EnvelopeRole::Base || f.role == EnvelopeRole::Slope) {
        const MeshLoop& loop = from.loopsOf(face)[f.ring];
        source = from.edgeTags.empty() ? 0 : from.edgeTags[loop.firstCorner + f.edge];
      }
      to.beginFace(from.faces[face].materialSlot, tags.with(source, roleName(f)));
      for (const auto& loop : f.loops) {
        to.beginLoop();
        for (const uint32_t v : loop) {
          work();
          if (position[v] == MeshBuilder::kNoPosition) {
            position[v] = to.addPosition(plan.point(envelope.vertices[v]));
          }
          to.addCorner(position[v]);
        }
      }
    }
  }
}

Status applyEnvelope(OpCall& call, const Arguments& args) {
  Shape& s = call.shape();
  const MeshRef mesh = meshInScope(s);
  const SideChoice choice(call, args);
  AutoTags tags(call.services(), "envelope");
  MeshBuilder out;
  Vec3 firstUp;
  size_t number = 0;
  for (size_t f = 0; f < mesh->faceCount(); ++f) {
    const Vec3 normal = straightened(mesh->normal(f));
    Vec3 up = normal;
    if (args.direction == Up::World) {
      up = straightened(s.scope.toLocalDirection(call.world().toLocalDirection({0, 1, 0})));
    }
    const bool stands = normal != Vec3{} && dot(normal, up) > 1e-6;
    const Frame plan = stands ? planOf(*mesh, f, up) : Frame{};
    std::vector<std::vector<EnvelopeSide>> sides;
    std::vector<std::vector<double>> floor;
    for (const MeshLoop& loop : mesh->loopsOf(f)) {
      auto& ring = sides.emplace_back();
      auto& depth = floor.emplace_back();
      for (uint32_t i = 0; i < loop.cornerCount; ++i) {
        work();
        const Vec3 a = mesh->at(loop.firstCorner + i);
        const Vec3 b = mesh->at(loop.firstCorner + (i + 1) % loop.cornerCount);
        ring.push_back(choice.of(number++, {a, b}, mesh->edgeTagsAt(loop.firstCorner + i),
                                 cross(b - a, normal)));
        depth.push_back(up == normal ? 0 : std::min(0.0, plan.toLocal(a).z));
      }
    }
    if (!stands) continue;
    const Envelope made = buildEnvelope(facePolygon(*mesh, f, plan), sides, args.maxHeight, floor);
    if (!made.status.ok()) return made.status;
    if (firstUp == Vec3{}) firstUp = up;
    addEnvelope(out, *mesh, f, plan, made, tags);
  }
  if (firstUp == Vec3{}) {
    return call.fail("no-geometry", "the shape has no face to put an envelope on",
                     "insert a primitive or an asset first");
  }
  refit(s, out.take(), axesWithY(firstUp, {1, 0, 0}));
  return {};
}

constexpr ParamSpec height(ParamSpec p) { return p.atLeast(0); }
constexpr ParamSpec angle(ParamSpec p) { return p.above(0).atMost(90); }

constexpr ParamSpec kDirection = param<&Arguments::direction>(
    "direction", "The way up: the normal of each face, or that of the world.");
constexpr ParamSpec kMaxHeight =
    param<&Arguments::maxHeight>("maxHeight", "Where all of it ends in a level top, in metres.")
        .above(0);
constexpr ParamSpec kFrontBase = height(
    param<&Arguments::frontBaseHeight>("frontBaseHeight", "The height of the walls at the front."));
constexpr ParamSpec kFrontAngle = angle(param<&Arguments::frontAngle>(
    "frontAngle", "The slope above the walls at the front, in degrees."));
constexpr ParamSpec kBackBase = height(
    param<&Arguments::backBaseHeight>("backBaseHeight", "The height of the walls at the back."));
constexpr ParamSpec kBackAngle = angle(param<&Arguments::backAngle>(
    "backAngle", "The slope above the walls at the back, in degrees."));
constexpr ParamSpec kSideBase = height(param<&Arguments::sideBaseHeight>(
    "sideBaseHeight", "The height of the walls at the right and the left."));
constexpr ParamSpec kSideAngle = angle(param<&Arguments::sideAngle>(
    "sideAngle", "The slope above the walls at the right and the left, in degrees."));

constexpr ParamSpec kFront[] = {kDirection, kMaxHeight, kFrontBase, kFrontAngle};
constexpr ParamSpec kFrontBack[] = {kDirection,  kMaxHeight, kFrontBase,
                                    kFrontAngle, kBackBase,  kBackAngle};
constexpr ParamSpec kThree[] = {kDirection, kMaxHeight, kFrontBase, kFrontAngle,
                                kBackBase,  kBackAngle, kSideBase,  kSideAngle};
constexpr ParamSpec kFour[] = {
    kDirection,
    kMaxHeight,
    kFrontBase,
    kFrontAngle,
    kBackBase,
    kBackAngle,
    height(param<&Arguments::rightBaseHeight>("rightBaseHeight",
                                              "The height of the walls at the right.")),
    angle(param<&Arguments::rightAngle>("rightAngle",
                                        "The slope above the walls at the right, in degrees.")),
    height(param<&Arguments::leftBaseHeight>("leftBaseHeight",
                                             "The height of the walls at the left.")),
    angle(param<&Arguments::leftAngle>("leftAngle",
                                       "The slope above the walls at the left, in degrees.")),
};
constexpr ParamSpec kPerEdge[] = {
    kDirection,
    kMaxHeight,
    param<&Arguments::baseHeights>("baseHeights",
                                   "The heights of the walls in the order of face edges; 0 where "
                                   "there are none left."),
    param<&Arguments::angles>("angles", "The slopes above them; 90 where there are none left."),
};
// Without a direction: files up to version 2012.
template <size_t N>
constexpr Signature undirected(const ParamSpec (&params)[N]) {
  return {std::span<const ParamSpec>(params).subspan(1)};
}
constexpr Signature kSignatures[] = {
    {kFront},           {kFrontBack},           {kThree},           {kFour},           {kPerEdge},
    undirected(kFront), undirected(kFrontBack), undirected(kThree), undirected(kFour),
};

constexpr OpSpec kSpecs[] = {
    heavy({"envelope", "roof",
           "Makes the volume in which a building may stand: walls over the edges of each face, and "
           "planes that lean inwards above them.",
           kSignatures, typed<applyEnvelope>, BlockKind::None, kReadsWorld | kReadsInitialShape}),
};

}  // namespace

extern const OpList kOps_envelope;
const OpList kOps_envelope = kSpecs;

}  // namespace gable
