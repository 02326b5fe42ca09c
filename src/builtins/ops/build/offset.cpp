// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Inward, an offset is a setback of all edges. Outward, the ground around the face is set back from
// it: the outer ring within a frame that stands still, and what lies within each hole. The frame
// ends corners so sharp that they would reach farther than ten times the distance.
#include <algorithm>
#include <cmath>
#include <deque>

#include "builtins/auto_tags.h"
#include "builtins/lists.h"
#include "builtins/ops/shared/patchwork.h"
#include "builtins/ops/shared/set_back.h"
#include "builtins/ops/subdivide/shared/parts.h"
#include "geom/skeleton/skeleton.h"
#include "shape/op_call.h"

namespace gable {

namespace {

constexpr double kReach = 10;

struct Offset {
  std::vector<PatchFace> inside, border;
};

// Grows one face outward.
class Growth {
 public:
  Growth(const Mesh& m, size_t face, double distance, const AutoTags& tags)
      : mesh_(m), distance_(distance), tags_(tags), plane_(m, face) {
    const Polygon& p = plane_.polygon();
    for (size_t r = 0; r <= p.holes.size(); ++r) {
      const Ring& ring = r == 0 ? p.outer : p.holes[r - 1];
      first_.push_back(static_cast<uint32_t>(plane_.points.size()));
      for (size_t i = 0; i < ring.size(); ++i) plane_.addCorner(plane_.cornerOf(r, i), ring[i]);
    }
    inputCount_ = static_cast<uint32_t>(plane_.points.size());
  }

  Status run() {
    for (size_t r = 0; r < first_.size(); ++r) {
      const Status status = growRing(r);
      if (!status.ok()) return status;
    }
    return {};
  }

  void add(Offset& out) {
    const uint32_t tags = mesh_.faces[plane_.face()].tags;
    for (Patch& p : patchesOf(outline_, plane_.points)) {
      out.inside.push_back({&plane_, std::move(p), tags});
    }
    for (PatchFace& f : border_) out.border.push_back(std::move(f));
  }

 private:
  const Ring& ring(size_t r) const {
    return r == 0 ? plane_.polygon().outer : plane_.polygon().holes[r - 1];
  }
  uint32_t edgeTags(uint32_t corner) const { return mesh_.edgeTagsAt(corner); }

  // The ground beside ring r as a polygon; the ring, turned round, is its hole or its outer ring.
  Polygon groundOf(size_t r) const {
    Ring turned = ring(r);
    std::reverse(turned.begin() + 1, turned.end());
    if (r > 0) return {turned, {}};
    const Box2 box = bounds(turned);
    const double reach = kReach * distance_;
    const Vec2 lo = box.min - Vec2{reach, reach}, hi = box.max + Vec2{reach, reach};
    return {{lo, {hi.x, lo.y}, hi, {lo.x, hi.y}}, {turned}};
  }

  Status growRing(size_t r) {
    const Polygon ground = groundOf(r);
    const auto n = static_cast<uint32_t>(ring(r).size());
    std::vector<std::vector<double>> weights;
    if (r == 0) weights.emplace_back(4, 0.0);
    weights.emplace_back(n, distance_);
    const Skeleton skeleton = buildSkeleton(ground, weights, 1);
    if (!skeleton.status.ok()) return skeleton.status;
    // Point k of the turned ring is point (n - k) % n of the face's.
    const uint32_t frame = r == 0 ? 4 : 0;
    std::vector<uint32_t> number;
    for (uint32_t v = 0; v < skeleton.vertices.size(); ++v) {
      if (v >= frame && v < frame + n) {
        number.push_back(first_[r] + (n - (v - frame)) % n);
      } else {
        number.push_back(static_cast<uint32_t>(plane_.points.size()));
        plane_.points.push_back(skeleton.vertices[v].xy);
      }
    }
    for (uint32_t i = 0; i < n; ++i) {
      const uint32_t corner = plane_.cornerOf(r, i);
      outline_.push_back({first_[r] + i, first_[r] + (i + 1) % n, edgeTags(corner), 4 * corner});
    }
    for (const SkeletonFace& f : skeleton.faces) {
      if (f.ring != weights.size() - 1 || f.step || f.loop.empty()) continue;
      addStrip(f, number, plane_.cornerOf(r, (n - f.edge - 1) % n));
    }
    return {};
  }

  void addStrip(const SkeletonFace& f, const std::vector<uint32_t>& number, uint32_t corner) {
    std::vector<PatchEdge> edges;
    const auto addLoop = [&](const std::vector<uint32_t>& loop) {
      for (size_t i = 0; i < loop.size(); ++i) {
        const uint32_t from = number[loop[i]], to = number[loop[(i + 1) % loop.size()]];
        // What starts at a vertex of the face takes the tags of the vertex.
        const bool side = (from < inputCount_) != (to < inputCount_);
        const uint32_t vertex = std::min(from, to);
        const uint32_t tags = !side                              ? edgeTags(corner)
                              : vertex < plane_.pointTags.size() ? plane_.pointTags[vertex]
                                                                 : 0;
        edges.push_back({from, to, tags, 4 * corner + 2});
      }
    };
    addLoop(f.loop);
    for (const auto& hole : f.holes) addLoop(hole);
    outline_.insert(outline_.end(), edges.begin(), edges.end());
    const uint32_t tags = tags_.merged(mesh_.faces[plane_.face()].tags, edgeTags(corner));
    for (Patch& p : patchesOf(std::move(edges), plane_.points)) {
      border_.push_back({&plane_, std::move(p), tags, true});
    }
  }

  const Mesh& mesh_;
  double distance_;
  const AutoTags& tags_;
  PatchPlane plane_;
  uint32_t inputCount_ = 0;
  std::vector<uint32_t> first_;
  std::vector<PatchEdge> outline_;
  std::vector<PatchFace> border_;
};

enum class Keep : uint8_t { All, Inside, Border };

}  // namespace

template <>
struct WordsOf<Keep> {
  static constexpr const char* text = "all inside border";
};

namespace {

struct OffsetArguments {
  double distance;
  Keep keep;
};

Mesh assembled(const Mesh& from, Offset& offset, Keep keep) {
  std::vector<PatchFace> faces;
  if (keep != Keep::Border) faces = std::move(offset.inside);
  if (keep != Keep::Inside) {
    for (PatchFace& f : offset.border) faces.push_back(std::move(f));
  }
  return meshOfPatches(from, faces);
}

Status applyOffset(OpCall& call, const OffsetArguments& args) {
  Shape& s = call.shape();
  const double distance = args.distance;
  if (!std::isfinite(distance)) {
    return call.fail("offset-distance", "the distance to offset by is not a finite number",
                     "check the expression for a division by zero");
  }
  const MeshRef mesh = meshInScope(s);
  const AutoTags tags(call.services(), "offset");
  SetBack inward(*mesh, call.services(), false);
  std::deque<Growth> outward;
  Offset offset;
  const std::vector<double> distances(mesh->corners.size(), -distance);
  const std::vector<uint32_t> group(mesh->corners.size(), 0);
  bool any = false;
  for (size_t f = 0; f < mesh->faceCount(); ++f) {
    if (mesh->normal(f) == Vec3{}) continue;
    any = true;
    Status status;
    if (distance > 0) {
      outward.emplace_back(*mesh, f, distance, tags);
      status = outward.back().run();
    } else {
      status = inward.addFace(f, distances, group);
    }
    if (!status.ok()) return status;
  }
  if (!any) {
    return call.fail("no-geometry", "the shape has no face to offset",
                     "insert a primitive or an asset first");
  }
  for (Growth& g : outward) g.add(offset);
  if (distance <= 0) {
    offset.inside = inward.remainders();
    offset.border = inward.stripOfEachEdge();
  }
  Mesh result = assembled(*mesh, offset, args.keep);
  // Where no face is left inside, the shape stays as it was, as in CityEngine.
  if (result.faceCount() > 0) setPartMesh(s, Shape(s), std::move(result), true);
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&OffsetArguments::distance>("distance",
                                      "How far, in metres: inward where negative, else outward."),
    param<&OffsetArguments::keep>(
        "keepFaces",
        "Whether to keep the offset polygons, the border between them and the face, or both.",
        "all"),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    heavy({"offset", "build", "Moves the outline of each face inward or outward.", kSignatures,
           typed<applyOffset>, BlockKind::None, kLeavesOccluder}),
};

}  // namespace

extern const OpList kOps_offset;
const OpList kOps_offset = kSpecs;

}  // namespace gable
