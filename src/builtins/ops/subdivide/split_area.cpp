// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Sizes are areas: they are divided as lengths are, and each border is then put where so much of
// the area lies before it. The area before a border is a sum over the edges of the faces.
#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "builtins/lists.h"
#include "builtins/ops/subdivide/shared/parts.h"
#include "builtins/ops/subdivide/shared/slabs.h"
#include "builtins/ops/subdivide/shared/split_sizes.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// How much of a mesh lies before a plane square to an axis.
class AreaBefore {
 public:
  AreaBefore(const Mesh& m, Vec3 axis) {
    for (size_t f = 0; f < m.faceCount(); ++f) addFace(m, f, axis);
  }

  double total() const { return total_; }

  double at(double s) const {
    double sum = 0;
    for (const Edge& e : edges_) {
      work();
      const double from = std::min(e.a.x, s), to = std::min(e.b.x, s);
      if (from == to) continue;
      const double slope = (e.b.y - e.a.y) / (e.b.x - e.a.x);
      const double y0 = e.a.y + (from - e.a.x) * slope, y1 = e.a.y + (to - e.a.x) * slope;
      sum += e.scale * (to - from) * (y0 + y1) / 2;
    }
    return sum;
  }

  // Where the area before is `wanted`; the area grows with the position.
  double find(double wanted, double lo, double hi) const {
    for (int step = 0; step < 100 && lo < hi; ++step) {
      const double middle = (lo + hi) / 2;
      if (middle <= lo || middle >= hi) break;
      (at(middle) < wanted ? lo : hi) = middle;
    }
    return hi;
  }

 private:
  // Its area against the axis x counts `scale` times.
  struct Edge {
    Vec2 a, b;
    double scale;
  };

  void addFace(const Mesh& m, size_t f, const Vec3& axis) {
    const Vec3 normal = m.normal(f);
    const Vec3 along = axis - normal * dot(axis, normal);
    const double slope = length(along);
    // A face in a plane of cuts is nowhere in particular.
    if (slope < 1e-9) return;
    const Vec3 across = cross(normal, along * (1 / slope));
    total_ += m.area(f);
    for (const MeshLoop& loop : m.loopsOf(f)) {
      for (uint32_t i = 0; i < loop.cornerCount; ++i) {
        work();
        const Vec3 a = m.at(loop.firstCorner + i);
        const Vec3 b = m.at(loop.firstCorner + (i + 1) % loop.cornerCount);
        edges_.push_back(
            {{dot(axis, a), dot(across, a)}, {dot(axis, b), dot(across, b)}, -1 / slope});
      }
    }
  }

  std::vector<Edge> edges_;
  double total_ = 0;
};

enum class Adjust : uint8_t { Adjust, NoAdjust };

}  // namespace

template <>
struct WordsOf<Adjust> {
  static constexpr const char* text = "adjust noAdjust";
};

namespace {

struct SplitArea {
  Axis axis;
  Adjust adjust;
};

Status applySplitArea(OpCall& call, const SplitArea& args) {
  const Shape& s = call.shape();
  const Axis axis = args.axis;
  const auto a = static_cast<size_t>(axis);
  const double whole = std::fabs(s.size[a]);
  const MeshRef mesh = meshInScope(s);
  Vec3 direction;
  direction[a] = s.size[a] < 0 ? -1 : 1;
  const AreaBefore areas(*mesh, direction);
  if (!(whole > 1e-9) || !(areas.total() > 0)) {
    return flatAlong(call, axis);
  }
  SplitPieces byArea;
  const Status status = dividePattern(call.splitBlock(), areas.total(), byArea);
  if (!status.ok()) return status;
  SplitPieces pieces;
  double start = 0, reached = 0;
  for (const SplitPiece& p : byArea) {
    if (p.start > reached + 1e-9 * areas.total()) start = areas.find(p.start, start, whole);
    reached = p.start + p.size;
    const bool last = reached >= areas.total() * (1 - 1e-12);
    const double end = last ? whole : areas.find(reached, start, whole);
    pieces.push_back({start, end - start, p.slot});
    start = end;
  }
  emitSlabs(call, axis, pieces, args.adjust == Adjust::Adjust, false);
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&SplitArea::axis>("axis", "The scope axis along which to divide."),
    param<&SplitArea::adjust>(
        "adjustMode",
        "Whether a part's scope is fitted to its geometry, or parts fill the scope without gaps.",
        "adjust"),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    heavy({"splitArea", "subdivide", "Divides a flat shape into parts of given areas.", kSignatures,
           typed<applySplitArea>, BlockKind::Split, kForgetsOrigins}),
};

}  // namespace

extern const OpList kOps_split_area;
const OpList kOps_split_area = kSpecs;

}  // namespace gable
