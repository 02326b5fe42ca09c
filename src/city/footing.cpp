// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Leaves are looked at one by one: boxes around boxes of turned parts would grow with each level.
#include "city/footing.h"

#include <algorithm>

#include "scene/flatten.h"

namespace gable {
namespace {

// Parts that begin no higher above the lowest one are feet.
constexpr double kFootHigh = 0.35;
// What lies on the ground ends no higher above it, and is at least so wide.
constexpr double kLyingHigh = 0.25, kLyingWide = 0.7;

Box3 placed(const Box3& box, const Vec3& scale, const Frame& at) {
  Box3 out;
  if (box.empty()) return out;
  for (unsigned k = 0; k < 8; ++k) {
    const Vec3 p{k & 1 ? box.max.x : box.min.x, k & 2 ? box.max.y : box.min.y,
                 k & 4 ? box.max.z : box.min.z};
    out.include(at.point({p.x * scale.x, p.y * scale.y, p.z * scale.z}));
  }
  return out;
}

}  // namespace

Footings::Footings(const Scene& scene)
    : scene_(scene),
      counts_(prototypeLeafCounts(scene)),
      meshes_(scene.meshes.size()),
      known_(scene.prototypes.size()) {}

const Footing& Footings::of(uint32_t prototype) {
  std::optional<Footing>& known = known_[prototype];
  if (!known) {
    const bool isSmall = counts_[prototype] <= kMostLeaves;
    known = isSmall ? measured(scene_.prototypes[prototype]) : Footing{};
  }
  return *known;
}

Footing Footings::measured(const Prototype& p) {
  Footing to;
  parts_.clear();
  forEachLeaf(scene_, p, Frame(), [&](const Leaf& leaf, const Frame& at) {
    parts_.push_back(placed(boundsOf(leaf.mesh), leaf.scale, at));
    to.box.include(parts_.back());
  });
  for (const Box3& part : parts_) {
    if (part.empty() || part.min.y > to.box.min.y + kFootHigh) continue;
    to.foot.include(part);
    const Vec3 size = part.size();
    const bool isLow = part.max.y < to.box.min.y + kLyingHigh;
    to.lies = to.lies || (isLow && std::max(size.x, size.z) > kLyingWide);
  }
  return to;
}

const Box3& Footings::boundsOf(uint32_t mesh) {
  std::optional<Box3>& box = meshes_[mesh];
  if (!box) box = scene_.meshes[mesh]->bounds();
  return *box;
}

}  // namespace gable
