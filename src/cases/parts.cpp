// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A mesh is looked at once, however often it stands in the scene. A box of the world is brought
// into the frame of a mesh, where the box around it is searched for.

#include "cases/parts.h"

#include <cmath>

#include "base/work.h"
#include "cases/measure.h"
#include "geom/mesh/face_triangles.h"
#include "scene/flatten.h"

namespace gable::cases {
namespace {

// A mesh of more triangles is worth a tree.
constexpr size_t kMany = 24;
// Convexity is a question of each face to each position; of more than this it is not asked.
constexpr size_t kMostQuestions = 20000;
// Positions so near to a plane lie on it.
constexpr double kOnPlane = 1e-6;

bool isConvex(const Mesh& mesh) {
  if (mesh.faceCount() * mesh.positions.size() > kMostQuestions) return false;
  for (size_t face = 0; face < mesh.faceCount(); ++face) {
    if (mesh.loopsOf(face).size() > 1) return false;
    const Vec3 normal = mesh.normal(face), origin = mesh.at(mesh.loopsOf(face)[0].firstCorner);
    for (const Vec3& p : mesh.positions) {
      if (dot(p - origin, normal) > kOnPlane) return false;
    }
  }
  return true;
}

}  // namespace

Box3 Parts::grown(Box3 box, double by) {
  box.min = box.min - Vec3{by, by, by};
  box.max += {by, by, by};
  return box;
}

Parts::Form Parts::formOf(const Mesh& mesh) {
  work(1 + mesh.corners.size());
  Form form;
  FaceTriangulator triangulator;
  for (size_t face = 0; face < mesh.faceCount(); ++face) {
    triangulator.add(mesh, face, form.triangles);
    form.slots.resize(form.triangles.size(), mesh.faces[face].materialSlot);
  }
  std::vector<Box3> boxes;
  for (std::array<uint32_t, 3>& t : form.triangles) {
    for (uint32_t& corner : t) corner = mesh.corners[corner];
    boxes.push_back(boundsOf({{mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]}}));
  }
  if (form.triangles.size() > kMany) form.tree = std::make_unique<solid::BoxTree>(boxes);
  form.closed = mesh.faceCount() > 3 && isClosed(mesh) && volume(mesh) > 0;
  form.convex = form.closed && isConvex(mesh);
  return form;
}

Parts::Parts(const Scene& scene) : scene_(scene) {
  for (const Material& m : scene.materials) materials_.push_back(contentHash(m));
  for (const MeshRef& mesh : scene.meshes) forms_.push_back(formOf(*mesh));
  std::vector<Box3> boxes;
  forEachLeaf(scene, [&](const Leaf& leaf, const Frame& world) {
    if (forms_[leaf.mesh].triangles.empty()) return;
    Part part{&leaf, world, {}};
    for (const Vec3& p : scene.meshes[leaf.mesh]->positions) {
      part.box.include(world.point(scaled(p, leaf.scale)));
    }
    parts_.push_back(part);
    boxes.push_back(part.box);
  });
  tree_ = std::make_unique<solid::BoxTree>(boxes);
}

Mesh Parts::mesh(size_t part) const {
  const Part& p = parts_[part];
  return transformed(*scene_.meshes[p.leaf->mesh], p.leaf->scale, p.world);
}

void Parts::trianglesNear(size_t part, const Box3& box, std::vector<Triangle>& out) const {
  const Part& p = parts_[part];
  const Form& form = formOf(part);
  const Mesh& mesh = *scene_.meshes[p.leaf->mesh];
  const Vec3 scale = p.leaf->scale;
  const bool mirrored = scale.x * scale.y * scale.z < 0;
  const auto place = [&](uint32_t i) { return p.world.point(scaled(mesh.positions[i], scale)); };
  const auto add = [&](uint32_t k) {
    const std::array<uint32_t, 3>& t = form.triangles[k];
    Triangle placed{{place(t[0]), place(t[mirrored ? 2 : 1]), place(t[mirrored ? 1 : 2])}};
    const uint32_t material = materialIndexOf(scene_, *p.leaf, form.slots[k]);
    if (material < materials_.size()) placed.material = materials_[material];
    if (boundsOf(placed).meets(box)) out.push_back(placed);
  };
  if (!form.tree) {
    for (uint32_t k = 0; k < form.triangles.size(); ++k) add(k);
    return;
  }
  Box3 own;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner{i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                      i & 4 ? box.max.z : box.min.z};
    own.include(p.world.toLocal(corner));
  }
  for (size_t axis = 0; axis < 3; ++axis) {
    // A mesh without extent along an axis lies everywhere along it.
    const double by = scale[axis];
    const double a = by != 0 ? own.min[axis] / by : -INFINITY;
    const double b = by != 0 ? own.max[axis] / by : INFINITY;
    own.min[axis] = std::min(a, b);
    own.max[axis] = std::max(a, b);
  }
  form.tree->query(grown(own, kOnPlane), add);
}

}  // namespace gable::cases
