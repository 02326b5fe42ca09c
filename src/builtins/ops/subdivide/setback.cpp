// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// setback and its kin differ in how edges get their distances; what happens then is the same, and
// lies in ops/shared/set_back.
#include <algorithm>
#include <cmath>
#include <functional>

#include "base/work.h"
#include "builtins/lists.h"
#include "builtins/ops/shared/set_back.h"
#include "builtins/ops/subdivide/shared/components.h"
#include "builtins/ops/subdivide/shared/parts.h"
#include "builtins/selection.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// What uv selectors say about each corner's edge.
std::vector<uint8_t> uvSidesOf(const Mesh& m, const Components& edges, int set) {
  std::vector<uint8_t> sides(m.corners.size(), 0);
  if (!m.hasUv(set)) return sides;
  const auto& uvs = m.uvs[static_cast<size_t>(set)];
  Box2 box;
  for (const Vec2 uv : uvs) box.include(uv);
  const double same = 1e-6 * (1 + std::max(box.size().x, box.size().y));
  size_t at = 0;
  for (size_t f = 0; f < m.faceCount(); ++f) {
    const PatchPlane plane(m, f);
    for (; at < edges.list().size() && edges.list()[at].face == f; ++at) {
      work();
      const Component& c = edges.list()[at];
      const Vec3 out = plane.frame().toLocalDirection(c.z);
      const Vec2 d = plane.uvAlong(set, {out.x, out.y});
      uint8_t s = std::fabs(d.x) > std::fabs(d.y) ? (d.x < 0 ? kUvLeft : kUvRight)
                                                  : (d.y < 0 ? kUvBottom : kUvTop);
      const Vec2 a = uvs[c.corner], b = uvs[edges.edges().next(c.corner)];
      const auto both = [&](size_t axis, double v) {
        return std::fabs(a[axis] - v) <= same && std::fabs(b[axis] - v) <= same;
      };
      if (both(0, box.min.x)) s |= kUvMinU;
      if (both(0, box.max.x)) s |= kUvMaxU;
      if (both(1, box.min.y)) s |= kUvMinV;
      if (both(1, box.max.y)) s |= kUvMaxV;
      sides[c.corner] = s;
    }
  }
  return sides;
}

// The face edges of a shape and which item of the block each belongs to.
struct EdgeChoice {
  MeshRef mesh;
  Components edges;
  // By corner.
  std::vector<uint32_t> group;
  std::vector<double> distance;

  explicit EdgeChoice(MeshRef m)
      : mesh(std::move(m)),
        edges(*mesh, ComponentKind::FaceEdges),
        group(mesh->corners.size(), kNoGroup),
        distance(mesh->corners.size(), 0) {}
};

bool isRemainder(const OpCall& call, const SelectorItem& item) {
  return item.terms.size() == 1 && item.terms[0].kind == SelectorTerm::Kind::Word &&
         call.services().pool().text(item.terms[0].word) == "remainder";
}

void chooseEdges(const OpCall& call, const Shape& s, int uvSet, EdgeChoice& choice) {
  const Directions directions(call.services(), s);
  const std::vector<uint8_t> uvSides = uvSidesOf(*choice.mesh, choice.edges, uvSet);
  const auto count = static_cast<uint32_t>(choice.edges.list().size());
  for (uint32_t i = 0; i < call.selectors().size(); ++i) {
    const SelectorItem& item = call.selectors()[i];
    if (isRemainder(call, item)) continue;
    const Selector selector(item, call.services().pool(), directions);
    for (const Component& c : choice.edges.list()) {
      work();
      if (choice.group[c.corner] != kNoGroup) continue;
      Selectable what = c.what;
      what.uvSides = uvSides[c.corner];
      if (selector.matches(what, choice.edges, call.services().tags(), count)) {
        choice.group[c.corner] = i;
      }
    }
  }
}

// Gives polygons out: each as a shape, or all in one.
class Emitter {
 public:
  Emitter(OpCall& call, const Mesh& from) : call_(call), from_(from) {}

  void emit(const std::vector<PatchFace>& faces, const SelectorItem& item) {
    if (faces.empty()) return;
    if (item.op == SelectOperator::Each) {
      for (const PatchFace& f : faces) emitOne({&f, 1}, item.slot);
    } else {
      emitOne(faces, item.slot);
    }
  }

 private:
  void emitOne(std::span<const PatchFace> faces, uint32_t slot) {
    Shape child = call_.shape();
    setPartMesh(child, call_.shape(), meshOfPatches(from_, faces), true);
    forgetFarTrimPlanes(child);
    call_.emit(std::move(child), slot, piece_++);
  }

  OpCall& call_;
  const Mesh& from_;
  uint32_t piece_ = 0;
};

Status setBackFaces(EdgeChoice& choice, SetBack& job) {
  for (size_t f = 0; f < choice.mesh->faceCount(); ++f) {
    work();
    if (choice.mesh->normal(f) == Vec3{}) continue;
    const Status status = job.addFace(f, choice.distance, choice.group);
    if (!status.ok()) return status;
  }
  return {};
}

Status noFace(const OpCall& call) {
  return call.fail("no-geometry", "the shape has no face whose edges could be set back",
                   "insert a primitive or an asset first");
}

Status badDistance(const OpCall& call) {
  return call.fail("setback-distance", "a setback distance is not a finite number",
                   "check the expression for a division by zero");
}

// The part that all of setback's forms have in common, once edges have groups and distances.
Status finish(OpCall& call, EdgeChoice& choice) {
  for (const double d : choice.distance) {
    if (!std::isfinite(d)) return badDistance(call);
  }
  SetBack job(*choice.mesh, call.services(), true);
  const Status status = setBackFaces(choice, job);
  if (!status.ok()) return status;
  Emitter out(call, *choice.mesh);
  for (uint32_t i = 0; i < call.selectors().size(); ++i) {
    const SelectorItem& item = call.selectors()[i];
    out.emit(isRemainder(call, item) ? job.remainders() : job.strips(i), item);
  }
  return {};
}

// From a list by face edge.
double listed(const Array& list, size_t index, double otherwise) {
  return index < list.numbers.size() ? list.numbers[index] : otherwise;
}

// One distance for all edges, or one for each.
struct Setback {
  double distance;
  std::optional<Floats> distances;
  double uvSet;
};

Status applySetback(OpCall& call, const Setback& args) {
  const auto uvSet = static_cast<int>(args.uvSet);
  EdgeChoice choice(meshInScope(call.shape()));
  if (choice.mesh->empty()) return noFace(call);
  chooseEdges(call, call.shape(), uvSet, choice);
  for (const Component& c : choice.edges.list()) {
    choice.distance[c.corner] =
        args.distances ? listed(*args.distances->array, c.what.index, 0) : args.distance;
  }
  return finish(call, choice);
}

// The area that remains when chosen edges are set back by their least distance plus `more`, at most
// by their greatest. Negative when it cannot be told.
struct Range {
  std::vector<double> least, most;
};

double remainderArea(const EdgeChoice& from, const Range& range, double more,
                     const Services& services, Status& status) {
  EdgeChoice choice(from.mesh);
  choice.group = from.group;
  for (size_t c = 0; c < choice.distance.size(); ++c) {
    choice.distance[c] = std::min(range.least[c] + more, range.most[c]);
  }
  SetBack job(*choice.mesh, services, false);
  status = setBackFaces(choice, job);
  if (!status.ok()) return -1;
  const std::vector<PatchFace> faces = job.remainders();
  return faces.empty() ? 0 : meshOfPatches(*choice.mesh, faces).area();
}

struct SetbackToArea {
  double area;
  std::optional<Floats> least, most;
  double uvSet;
};

// The distance, up to `reach`, whose area is nearest to the wanted one. The area falls as the
// distance grows and is a polynomial between few breaks, so a secant finds it, or halving
// where that leads astray. Where even the ends do not reach it, the nearer end is the answer.
double distanceFor(double wanted, double reach, const std::function<double(double)>& areaAt) {
  struct At {
    double distance, excess;
  };
  const auto at = [&](double distance) { return At{distance, areaAt(distance) - wanted}; };
  At low = at(0);
  if (low.excess <= 0) return low.distance;
  At high = at(reach);
  if (high.excess >= 0) return high.distance;
  At best = low.excess < -high.excess ? low : high;
  At before = low, last = high;
  constexpr double kExact = 1e-15;
  for (int step = 0; step < 100 && std::fabs(best.excess) > kExact * wanted; ++step) {
    work();
    const double slope = (last.excess - before.excess) / (last.distance - before.distance);
    const auto isInside = [&](double d) { return d > low.distance && d < high.distance; };
    double next = last.distance - last.excess / slope;
    if (step % 4 == 3 || !isInside(next)) next = (low.distance + high.distance) / 2;
    if (!isInside(next)) break;
    before = last;
    last = at(next);
    (last.excess > 0 ? low : high) = last;
    if (std::fabs(last.excess) < std::fabs(best.excess)) best = last;
  }
  // A number with few digits, as authors think of one, is the answer where it is as good.
  for (const double digits : {1e9, 1e12}) {
    const At next = at(std::round(best.distance * digits) / digits);
    if (std::fabs(next.excess) <= std::fabs(best.excess)) return next.distance;
  }
  return best.distance;
}

Status applySetbackToArea(OpCall& call, const SetbackToArea& args) {
  const auto uvSet = static_cast<int>(args.uvSet);
  EdgeChoice choice(meshInScope(call.shape()));
  if (choice.mesh->empty()) return noFace(call);
  chooseEdges(call, call.shape(), uvSet, choice);
  const Box3 box = choice.mesh->bounds();
  const double reach = length(box.size());
  Range range{std::vector<double>(choice.distance.size(), 0),
              std::vector<double>(choice.distance.size(), reach)};
  for (const Component& c : choice.edges.list()) {
    if (args.least) range.least[c.corner] = listed(*args.least->array, c.what.index, 0);
    if (args.most) range.most[c.corner] = listed(*args.most->array, c.what.index, reach);
    if (!std::isfinite(range.least[c.corner]) || !std::isfinite(range.most[c.corner])) {
      return badDistance(call);
    }
  }
  Status status;
  const double more = distanceFor(args.area, reach, [&](double by) {
    return status.ok() ? remainderArea(choice, range, by, call.services(), status) : 0;
  });
  if (!status.ok()) return status;
  for (const Component& c : choice.edges.list()) {
    choice.distance[c.corner] = std::min(range.least[c.corner] + more, range.most[c.corner]);
  }
  return finish(call, choice);
}

// shapeL, shapeU and shapeO: widths by side of the scope; sides that are not given have no wing.
struct Wings {
  std::optional<double> front, right, back, left;
};

Status applyWings(OpCall& call, const Wings& args) {
  const std::pair<const char*, const std::optional<double>&> wings[] = {
      {"front", args.front}, {"right", args.right}, {"back", args.back}, {"left", args.left}};
  EdgeChoice choice(meshInScope(call.shape()));
  if (choice.mesh->empty()) return noFace(call);
  const Directions directions(call.services(), call.shape());
  for (const Component& c : choice.edges.list()) {
    for (const auto& [side, width] : wings) {
      if (!width || !selectsDirection(side, c.what.normal, {}, 0, directions)) continue;
      choice.group[c.corner] = 0;
      choice.distance[c.corner] = *width;
    }
    if (!std::isfinite(choice.distance[c.corner])) return badDistance(call);
  }
  SetBack job(*choice.mesh, call.services(), true);
  const Status status = setBackFaces(choice, job);
  if (!status.ok()) return status;
  Emitter out(call, *choice.mesh);
  for (const SelectorItem& item : call.selectors()) {
    out.emit(isRemainder(call, item) ? job.remainders() : job.strips(0), item);
  }
  return {};
}

constexpr const char* kDistanceDoc = "How far the selected edges are moved inward, in metres.";
constexpr const char* kUvDoc = "The uv set for selectors such as uv.left.";
constexpr ParamSpec kDistance[] = {
    param<&Setback::distance>("distance", kDistanceDoc),
    param<&Setback::uvSet>("uvSet", kUvDoc, "0").between(0, kUvSets - 1),
};
constexpr ParamSpec kDistances[] = {
    param<&Setback::distances>("distances",
                               "A distance for each face edge, in order; 0 where missing."),
    param<&Setback::uvSet>("uvSet", kUvDoc, "0").between(0, kUvSets - 1),
};
constexpr Signature kSetback[] = {{kDistance}, {kDistances}};

// The compiler evaluates the distance for each edge and hands over a list.
constexpr ParamSpec kEachDistance[] = {
    param<&Setback::distances, ParamType::Float>("distance",
                                                 "The distance of an edge, worked out on it."),
    kDistance[1],
};
constexpr Signature kPerEdge[] = {{kEachDistance}, {kDistances}};

constexpr const char* kAreaDoc = "The area that shall remain, in square metres.";
constexpr ParamSpec kArea[] = {
    param<&SetbackToArea::area>("area", kAreaDoc).above(0),
    param<&SetbackToArea::uvSet>("uvSet", kUvDoc, "0").between(0, kUvSets - 1),
};
constexpr ParamSpec kAreaLeast[] = {
    param<&SetbackToArea::area>("area", kAreaDoc).above(0),
    param<&SetbackToArea::least>("minDistances", "The least distance of each face edge."),
    param<&SetbackToArea::uvSet>("uvSet", kUvDoc, "0").between(0, kUvSets - 1),
};
constexpr ParamSpec kAreaRange[] = {
    param<&SetbackToArea::area>("area", kAreaDoc).above(0),
    param<&SetbackToArea::least>("minDistances", "The least distance of each face edge."),
    param<&SetbackToArea::most>("maxDistances", "The greatest distance of each face edge."),
    param<&SetbackToArea::uvSet>("uvSet", kUvDoc, "0").between(0, kUvSets - 1),
};
constexpr Signature kToArea[] = {{kArea}, {kAreaLeast}, {kAreaRange}};

constexpr ParamSpec kFront = param<&Wings::front>("frontWidth", "The depth of the front wing.");
constexpr ParamSpec kRight = param<&Wings::right>("rightWidth", "The width of the right wing.");
constexpr ParamSpec kBack = param<&Wings::back>("backWidth", "The depth of the back wing.");
constexpr ParamSpec kLeft = param<&Wings::left>("leftWidth", "The width of the left wing.");
constexpr ParamSpec kLParams[] = {kFront, kLeft};
constexpr ParamSpec kUParams[] = {kFront, kRight, kLeft};
constexpr ParamSpec kOParams[] = {kFront, kRight, kBack, kLeft};
constexpr Signature kLSignatures[] = {{kLParams}};
constexpr Signature kUSignatures[] = {{kUParams}};
constexpr Signature kOSignatures[] = {{kOParams}};

constexpr uint32_t kEffects = kReadsWorld | kReadsWorldByWord | kForgetsOrigins;
constexpr PartSpec kRemainder[] = {{"remainder", "What the strips leave of the face."}};
constexpr PartSpec kWingParts[] = {{"shape", "The wings."},
                                   {"remainder", "What they leave of the face."}};
constexpr OpSpec kSpecs[] = {
    withFaces(heavy({"setback", "subdivide",
                     "Moves selected edges of each face inward and gives out the strips.", kSetback,
                     typed<applySetback>, BlockKind::Selectors, kEffects, kRemainder})),
    withFaces(heavy({"setbackPerEdge", "subdivide",
                     "As setback, with a distance that is worked out for each edge.", kPerEdge,
                     typed<applySetback>, BlockKind::Selectors, kEffects, kRemainder})),
    withFaces(heavy({"setbackToArea", "subdivide",
                     "As setback, by such a distance that a given area remains.", kToArea,
                     typed<applySetbackToArea>, BlockKind::Selectors, kEffects, kRemainder})),
    heavy({"shapeL", "subdivide", "Gives out an L of a front and a left wing, and what remains.",
           kLSignatures, typed<applyWings>, BlockKind::Selectors, kForgetsOrigins, kWingParts}),
    heavy({"shapeU", "subdivide",
           "Gives out a U of a front, a right and a left wing, and what remains.", kUSignatures,
           typed<applyWings>, BlockKind::Selectors, kForgetsOrigins, kWingParts}),
    heavy({"shapeO", "subdivide", "Gives out a ring of four wings, and what remains.", kOSignatures,
           typed<applyWings>, BlockKind::Selectors, kForgetsOrigins, kWingParts}),
};

}  // namespace

extern const OpList kOps_setback;
const OpList kOps_setback = kSpecs;

}  // namespace gable
