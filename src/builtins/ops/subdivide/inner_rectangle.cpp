// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A face is seen along the scope axis that is nearest to its normal; in that view the largest
// rectangle is found, and lifted back into the plane of the face.
#include <algorithm>
#include <cmath>

#include "builtins/lists.h"
#include "builtins/ops/shared/face_plan.h"
#include "builtins/ops/shared/patchwork.h"
#include "builtins/ops/subdivide/shared/parts.h"
#include "geom/region/boolean.h"
#include "geom/region/clean.h"
#include "geom/region/inner_rectangle.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// A face seen along an axis of the scope.
class View {
 public:
  View(const Mesh& m, size_t face) : mesh_(m), plane_(m, face) {
    normal_ = m.normal(face);
    size_t axis = 0;
    for (size_t a = 1; a < 3; ++a) {
      if (std::fabs(normal_[a]) > std::fabs(normal_[axis])) axis = a;
    }
    view_ = axisFrame(axis, normal_[axis] > 0 ? 1 : -1);
    at_ = m.at(m.loopsOf(face)[0].firstCorner);
    bool outer = true;
    for (const MeshLoop& loop : m.loopsOf(face)) {
      Ring ring;
      for (const uint32_t p : m.cornersOf(loop)) ring.push_back(seen(m.positions[p]));
      if (outer) {
        polygon_.outer = std::move(ring);
      } else {
        polygon_.holes.push_back(std::move(ring));
      }
      outer = false;
    }
  }

  const Polygon& polygon() const { return polygon_; }
  size_t face() const { return plane_.face(); }

  void add(MeshBuilder& b, const Polygon& p) const {
    const MeshFace& f = mesh_.faces[plane_.face()];
    b.beginFace(f.materialSlot, f.tags);
    addLoop(b, p.outer);
    for (const Ring& hole : p.holes) addLoop(b, hole);
  }

 private:
  Vec2 seen(const Vec3& p) const {
    const Vec3 local = view_.toLocalDirection(p);
    return {local.x, local.y};
  }
  Vec3 lifted(Vec2 q) const {
    const Vec3 flat = view_.direction({q.x, q.y, dot(view_.z, at_)});
    return flat - view_.z * (dot(flat - at_, normal_) / dot(view_.z, normal_));
  }
  void addLoop(MeshBuilder& b, const Ring& ring) const {
    b.beginLoop();
    for (const Vec2 q : ring) {
      const Vec3 p = lifted(q);
      const uint32_t corner = b.addCorner(b.addPosition(p));
      const Vec3 local = plane_.frame().toLocal(p);
      for (int set = 0; set < kUvSets; ++set) {
        if (mesh_.hasUv(set)) b.setUv(corner, set, plane_.uvAt(set, {local.x, local.y}));
      }
    }
  }

  const Mesh& mesh_;
  PatchPlane plane_;
  Polygon polygon_;
  Vec3 normal_, at_;
  Frame view_;
};

struct Parts {
  std::vector<std::pair<size_t, Polygon>> rectangles, remainders;
};

// Leftovers thinner than this share of the face are what the search left at its edges.
constexpr double kSliver = 1e-5;

Polygon rectangleIn(const View& view, bool byEdge) {
  const OrientedRect found =
      byEdge ? largestInnerRectByEdge(view.polygon()) : largestInnerRect(view.polygon());
  const double whole = area(view.polygon());
  if (!(found.area() > kSliver * whole)) return {};
  // A face that is the rectangle is taken as it is, to the last bit.
  if (found.area() > (1 - kSliver) * whole && view.polygon().holes.empty()) {
    Ring ring = view.polygon().outer;
    dropCollinear(ring, 1e-9 * std::sqrt(whole));
    if (ring.size() == 4) return {ring, {}};
  }
  return {found.ring(), {}};
}

Status findParts(const OpCall& call, const Mesh& m, bool byEdge, std::vector<View>& views,
                 Parts& parts) {
  for (size_t f = 0; f < m.faceCount(); ++f) {
    if (m.normal(f) != Vec3{}) views.emplace_back(m, f);
  }
  if (views.empty()) {
    return call.fail("no-geometry", "the shape has no face to find a rectangle in",
                     "insert a primitive or an asset first");
  }
  for (size_t v = 0; v < views.size(); ++v) {
    const Polygon rectangle = rectangleIn(views[v], byEdge);
    const double whole = area(views[v].polygon());
    Region rest{views[v].polygon()};
    if (!rectangle.outer.empty()) {
      parts.rectangles.emplace_back(v, rectangle);
      rest = subtract(rest, {rectangle});
    }
    for (Polygon& p : rest) {
      if (area(p) > kSliver * whole) parts.remainders.emplace_back(v, std::move(p));
    }
  }
  return {};
}

Mesh meshOfParts(const std::vector<View>& views,
                 std::span<const std::pair<size_t, Polygon>> parts) {
  MeshBuilder b;
  for (const auto& [view, polygon] : parts) views[view].add(b, polygon);
  return b.take();
}

struct InnerRectangle {
  Word alignment;
};

Status applyInnerRectangle(OpCall& call, const InnerRectangle& args) {
  const MeshRef mesh = meshInScope(call.shape());
  std::vector<View> views;
  Parts parts;
  const Status status = findParts(call, *mesh, args.alignment == "edge", views, parts);
  if (!status.ok()) return status;
  uint32_t piece = 0;
  const auto emit = [&](std::span<const std::pair<size_t, Polygon>> some, uint32_t slot) {
    Shape child = call.shape();
    setPartMesh(child, call.shape(), meshOfParts(views, some), true);
    forgetFarTrimPlanes(child);
    call.emit(std::move(child), slot, piece++);
  };
  for (const SelectorItem& item : call.selectors()) {
    const bool remainder = item.terms.size() == 1 &&
                           item.terms[0].kind == SelectorTerm::Kind::Word &&
                           call.services().pool().text(item.terms[0].word) == "remainder";
    const auto& list = remainder ? parts.remainders : parts.rectangles;
    if (item.op == SelectOperator::Each) {
      for (const auto& one : list) emit({&one, 1}, item.slot);
    } else if (!list.empty()) {
      emit(list, item.slot);
    }
  }
  return {};
}

Status applyInnerRect(OpCall& call) {
  Shape& s = call.shape();
  const MeshRef mesh = meshInScope(s);
  std::vector<View> views;
  Parts parts;
  const Status status = findParts(call, *mesh, /*byEdge=*/false, views, parts);
  if (!status.ok()) return status;
  setPartMesh(s, Shape(s), meshOfParts(views, parts.rectangles), true);
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&InnerRectangle::alignment>(
        "alignment",
        "Whether the rectangle lies along the scope's axes or along an edge of the face.", nullptr,
        "scope edge"),
};
constexpr Signature kSignatures[] = {{kParams}};
constexpr Signature kNone[] = {{}};

constexpr PartSpec kParts[] = {{"shape", "The largest rectangle inside."},
                               {"remainder", "What it leaves of the face."}};
constexpr OpSpec kSpecs[] = {
    heavy({"innerRectangle", "subdivide",
           "Gives out the largest rectangle in each face, and what remains.", kSignatures,
           typed<applyInnerRectangle>, BlockKind::Selectors, kForgetsOrigins, kParts}),
    heavy({"innerRect", "subdivide",
           "Replaces each face by the largest rectangle in it along the scope.", kNone,
           applyInnerRect}),
};

}  // namespace

extern const OpList kOps_inner_rectangle;
const OpList kOps_inner_rectangle = kSpecs;

}  // namespace gable
