// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/subdivide/shared/roof_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/work.h"
#include "builtins/ops/shared/refit.h"

namespace gable {

namespace {

constexpr uint32_t kNone = MeshEdge::kNone;
// The sine below which a face is upright and an edge level.
constexpr double kUpright = 1e-3;
constexpr double kFlatFold = 1e-6;

class Classifier {
 public:
  Classifier(const Mesh& m, const MeshEdges& edges, std::span<const Vec3> normals, const Vec3& up)
      : mesh_(m), edges_(edges), normals_(normals), up_(up), atEave_(m.positions.size(), false) {}

  std::vector<PlacedEdge> classify() {
    std::vector<PlacedEdge> out;
    for (const MeshEdge& e : edges_.edges()) {
      work();
      out.push_back(
          {RoofEdge::None, mesh_.corners[e.corner], mesh_.corners[edges_.next(e.corner)]});
    }
    for (size_t i = 0; i < out.size(); ++i) findEave(edges_.edges()[i], out[i]);
    for (size_t i = 0; i < out.size(); ++i) findInside(edges_.edges()[i], out[i]);
    return out;
  }

 private:
  // The corners at which faces of the roof have the edge.
  size_t roofCorners(const MeshEdge& e, std::array<uint32_t, 2>& corner) const {
    size_t n = 0;
    for (const uint32_t at : {e.corner, e.other}) {
      if (at != kNone && dot(up_, normals_[edges_.faceOf(at)]) > kUpright) corner[n++] = at;
    }
    return n;
  }
  double rise(const PlacedEdge& e) const {
    return dot(up_, mesh_.positions[e.to] - mesh_.positions[e.from]);
  }

  void findEave(const MeshEdge& e, PlacedEdge& out) {
    work();
    std::array<uint32_t, 2> corner{};
    if (roofCorners(e, corner) != 1) return;
    const double l = length(mesh_.positions[out.to] - mesh_.positions[out.from]);
    if (std::fabs(rise(out)) > kUpright * l) return;
    out = {RoofEdge::Eave, mesh_.corners[corner[0]], mesh_.corners[edges_.next(corner[0])]};
    atEave_[out.from] = atEave_[out.to] = true;
  }

  void findInside(const MeshEdge& e, PlacedEdge& out) const {
    work();
    std::array<uint32_t, 2> corner{};
    if (roofCorners(e, corner) != 2) return;
    // From the edge into the second face, against the first.
    const Vec3 along = normalized(mesh_.at(edges_.next(corner[1])) - mesh_.at(corner[1]));
    const Vec3 inward = cross(normals_[edges_.faceOf(corner[1])], along);
    const double fold = dot(inward, normals_[edges_.faceOf(corner[0])]);
    const bool begins = atEave_[out.from] || atEave_[out.to];
    out.what = fold > kFlatFold ? RoofEdge::Valley : begins ? RoofEdge::Hip : RoofEdge::Ridge;
    if (rise(out) < 0) std::swap(out.from, out.to);
  }

  const Mesh& mesh_;
  const MeshEdges& edges_;
  std::span<const Vec3> normals_;
  Vec3 up_;
  std::vector<bool> atEave_;
};

size_t eavesOf(const std::vector<PlacedEdge>& edges) {
  return static_cast<size_t>(std::count_if(
      edges.begin(), edges.end(), [](const PlacedEdge& e) { return e.what == RoofEdge::Eave; }));
}

}  // namespace

std::vector<PlacedEdge> roofEdges(const Mesh& m, const MeshEdges& edges,
                                  std::span<const Vec3> normals, std::span<const Vec3> ups) {
  std::vector<PlacedEdge> best;
  for (const Vec3& up : ups) {
    std::vector<PlacedEdge> next = Classifier(m, edges, normals, up).classify();
    if (best.empty() || eavesOf(next) > eavesOf(best)) best = std::move(next);
  }
  return best;
}

std::vector<Vec3> waysUp(OpCall& call, const Mesh& m) {
  const TagTable& tags = call.services().tags();
  Vec3 slopes;
  double area = 0;
  for (size_t f = 0; f < m.faceCount(); ++f) {
    work();
    const uint32_t set = m.faces[f].tags;
    if (tags.has(set, "roof.bottom") && m.normal(f) != Vec3{}) return {-straightened(m.normal(f))};
    if (tags.has(set, "roof.top")) {
      slopes += m.areaNormal(f);
      area += length(m.areaNormal(f));
    }
  }
  const Vec3 world = call.services().world().toLocalDirection({0, 1, 0});
  std::vector<Vec3> ups{{0, 1, 0}, straightened(call.shape().scope.toLocalDirection(world))};
  // A single slope tells nothing.
  if (length(slopes) > 0 && length(slopes) < (1 - kUpright) * area) {
    ups.push_back(straightened(slopes));
  }
  return ups;
}

}  // namespace gable
