// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Edges that run nearly along an axis get one coordinate for all of their points: the mean of their
// middles, weighted by length. Chains of such edges share it, so corners between an edge along one
// axis and an edge along the other become right angles.
#include <cmath>

#include "base/disjoint_sets.h"
#include "builtins/lists.h"
#include "builtins/ops/shared/face_plan.h"
#include "builtins/ops/subdivide/shared/parts.h"
#include "math/trig.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// Points that shall have the same coordinate.
class Levels {
 public:
  explicit Levels(size_t n) : sets_(n), sum_(n, 0), weight_(n, 0) {}
  void join(uint32_t a, uint32_t b, double level, double weight) {
    a = sets_.find(a);
    b = sets_.find(b);
    if (a > b) std::swap(a, b);
    if (a != b) {
      sets_.join(a, b);
      sum_[a] += sum_[b];
      weight_[a] += weight_[b];
    }
    sum_[a] += level * weight;
    weight_[a] += weight;
  }
  double of(uint32_t i, double otherwise) {
    i = sets_.find(i);
    return weight_[i] > 0 ? sum_[i] / weight_[i] : otherwise;
  }

 private:
  DisjointSets sets_;
  std::vector<double> sum_, weight_;
};

size_t nearestAxis(const Mesh& m) {
  Vec3 sum;
  for (size_t f = 0; f < m.faceCount(); ++f) {
    const Vec3 n = m.areaNormal(f);
    sum += Vec3{std::fabs(n.x), std::fabs(n.y), std::fabs(n.z)};
  }
  return sum.y >= sum.x && sum.y >= sum.z ? 1 : sum.z >= sum.x ? 2 : 0;
}

void rectify(Mesh& m, double angle) {
  const size_t axis = nearestAxis(m);
  const Frame view = axisFrame(axis, 1);
  const double tangent = tanDeg(angle);
  Levels x(m.positions.size()), y(m.positions.size());
  for (const MeshLoop& loop : m.loops) {
    for (uint32_t i = 0; i < loop.cornerCount; ++i) {
      const uint32_t a = m.corners[loop.firstCorner + i];
      const uint32_t b = m.corners[loop.firstCorner + (i + 1) % loop.cornerCount];
      const Vec3 from = view.toLocal(m.positions[a]), to = view.toLocal(m.positions[b]);
      const Vec3 d = to - from, middle = (from + to) * 0.5;
      const double dx = std::fabs(d.x), dy = std::fabs(d.y);
      // Exactly 45 degrees would be both.
      if (dy < dx && dy <= tangent * dx) y.join(a, b, middle.y, dx);
      if (dx < dy && dx <= tangent * dy) x.join(a, b, middle.x, dy);
    }
  }
  // Points move within the plane of the first face that they belong to.
  std::vector<bool> moved(m.positions.size(), false);
  for (size_t f = 0; f < m.faceCount(); ++f) {
    const Vec3 normal = m.normal(f);
    for (const MeshLoop& loop : m.loopsOf(f)) {
      for (const uint32_t p : m.cornersOf(loop)) {
        if (moved[p]) continue;
        moved[p] = true;
        const Vec3 old = m.positions[p], local = view.toLocal(old);
        Vec3 now = view.point({x.of(p, local.x), y.of(p, local.y), local.z});
        const double slope = dot(view.z, normal);
        if (std::fabs(slope) > 1e-6) now = now - view.z * (dot(now - old, normal) / slope);
        m.positions[p] = now;
      }
    }
  }
}

struct Rectify {
  double angle;
};

Status applyRectify(OpCall& call, const Rectify& args) {
  Shape& s = call.shape();
  const double angle = args.angle;
  if (s.geometry.kind != GeometryKind::Mesh) return {};
  Mesh mesh = *meshInScope(s);
  rectify(mesh, angle);
  setPartMesh(s, Shape(s), std::move(mesh), true);
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&Rectify::angle>("angle", "Edges that deviate by at most so many degrees are aligned.")
        .between(0, 45),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    {"rectify", "edit", "Turns edges that run nearly along the scope's axes to run along them.",
     kSignatures, typed<applyRectify>},
};

}  // namespace

extern const OpList kOps_rectify;
const OpList kOps_rectify = kSpecs;

}  // namespace gable
