// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What shines in a world: its emissive triangles in a tree, from which a surface draws one about in
// proportion to the light that it may give there. A town with ten thousand lit windows is as quick
// as a room with one lamp. Making it is O(n log n), drawing O(log n).
#pragma once

#include <functional>
#include <vector>

#include "math/box.h"
#include "render/world.h"

namespace gable::rt {

struct Emitter {
  Vec3f a, ab, ac;
  /// Its emission, with textures averaged.
  Vec3f emissive;
  uint32_t placement = kNone, triangle = 0;
  bool clear = false;
};

struct EmitterSample {
  Vec3f point, facet, emissive;
  /// By area.
  float density = 0;
};

class Emitters {
 public:
  /// What a triangle of a material shines in a world's placement, black where it does not; `middle`
  /// is that of its piece, `facet` its unit normal, both in the world.
  using Shine = std::function<Vec3f(const SurfaceMaterial& material, const Vec3f& middle,
                                    const Vec3f& facet)>;

  Emitters() = default;
  Emitters(const World& world, const Shine& shine);

  bool empty() const { return emitters_.empty(); }
  size_t size() const { return emitters_.size(); }
  /// Draws a point that may light `at`, a surface with that normal; false where none can.
  bool sample(const Vec3f& at, const Vec3f& normal, float pick, Vec2f u,
              EmitterSample& sample) const;

 private:
  /// Of emitters [first, first + count); children of a node with several stand at `left` and
  /// `left + 1`.
  struct Node {
    Vec3f min, max;
    float power = 0;
    /// The facets of its emitters are within the angle of that cosine about the axis.
    Vec3f axis;
    float spread = -1;
    uint32_t first = 0, count = 0, left = 0;
  };

  void addPart(const World& world, uint32_t placement, const Shine& shine);
  void build();
  void orient(Node& node) const;
  static float facing(const Node& node, const Vec3f& to, float squared, float radius);
  static float importance(const Node& node, const Vec3f& at, const Vec3f& normal);

  std::vector<Emitter> emitters_;
  std::vector<Node> nodes_;
};

}  // namespace gable::rt
