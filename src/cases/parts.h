// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Parts: the leaves of a scene where they stand, and which of them are near each other. Meshes stay
// shared; the triangles of a leaf are placed when they are asked for, those near a box alone.
// Metres, in the world.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "cases/triangle.h"
#include "geom/solid/box_tree.h"
#include "scene/scene.h"

namespace gable::cases {

struct Part {
  const Leaf* leaf = nullptr;
  Frame world;
  Box3 box;
};

class Parts {
 public:
  /// All leaves in the order of derivation, instances expanded; those without a triangle are left
  /// out. The scene must outlive the parts. O(n log n).
  explicit Parts(const Scene& scene);

  const Scene& scene() const { return scene_; }
  size_t size() const { return parts_.size(); }
  const Part& operator[](size_t i) const { return parts_[i]; }
  const std::string& name(size_t i) const { return scene_.names[parts_[i].leaf->name]; }
  const std::string& rule(size_t i) const { return scene_.sources[parts_[i].leaf->source].rule; }

  /// Calls visit(a, b), a < b, for parts whose boxes come as near as `gap`.
  template <class Visit>
  void forEachPair(double gap, Visit&& visit) const {
    for (uint32_t i = 0; i < parts_.size(); ++i) {
      tree_->query(grown(parts_[i].box, gap), [&](uint32_t k) {
        if (i < k) visit(i, k);
      });
    }
  }

  /// Appends the triangles of a part whose boxes meet a box.
  void trianglesNear(size_t part, const Box3& box, std::vector<Triangle>& out) const;
  /// The mesh of a part in the world.
  Mesh mesh(size_t part) const;

  /// The part encloses a volume.
  bool closed(size_t part) const { return formOf(part).closed; }
  /// Closed, and no face sees another part of it.
  bool convex(size_t part) const { return formOf(part).convex; }

  static Box3 grown(Box3 box, double by);

 private:
  /// Of a mesh in its own frame.
  struct Form {
    std::vector<std::array<uint32_t, 3>> triangles;
    /// By triangle: the slot of its material.
    std::vector<uint16_t> slots;
    /// Over the triangles, where there are many.
    std::unique_ptr<solid::BoxTree> tree;
    bool closed = false, convex = false;
  };

  const Form& formOf(size_t part) const { return forms_[parts_[part].leaf->mesh]; }
  static Form formOf(const Mesh& mesh);

  const Scene& scene_;
  std::vector<Form> forms_;
  std::vector<uint64_t> materials_;
  std::vector<Part> parts_;
  std::unique_ptr<solid::BoxTree> tree_;
};

/// Calls visit(a, b) for the triangles of two lists that come as near as `gap`, until it gives
/// true; gives true where it did.
template <class Visit>
bool forEachNear(const std::vector<Triangle>& as, const std::vector<Triangle>& bs, double gap,
                 Visit&& visit) {
  // So many pairs are sooner looked at than sorted.
  constexpr size_t kFew = 2000;
  if (as.size() * bs.size() <= kFew) {
    for (const Triangle& a : as) {
      const Box3 box = Parts::grown(boundsOf(a), gap);
      for (const Triangle& b : bs) {
        if (box.meets(boundsOf(b)) && visit(a, b)) return true;
      }
    }
    return false;
  }
  std::vector<Box3> boxes;
  for (const Triangle& b : bs) boxes.push_back(boundsOf(b));
  const solid::BoxTree tree(boxes);
  bool done = false;
  for (const Triangle& a : as) {
    tree.query(Parts::grown(boundsOf(a), gap), [&](uint32_t k) { done = done || visit(a, bs[k]); });
    if (done) return true;
  }
  return false;
}

}  // namespace gable::cases
