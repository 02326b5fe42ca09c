// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A hierarchy of lights in the manner of Conty Estevez and Kulla 2018, Importance Sampling of Many
// Lights with Adaptive Tree Splitting: boxes with the sum of their power and a cone about their
// facets, halved in the middle of the longer side. On the way down each child is taken by its power
// over the squared distance to its box, by how far the surface faces the box and the cone the
// surface.

#include "render/emitters.h"

#include <algorithm>

#include "base/work.h"

namespace gable::rt {

namespace {

constexpr float kLeastArea = 1e-6f;
/// Lamps shine to both sides, but most are closed bodies, whose own fronts hide what their backs
/// send: a back is drawn so much less often.
constexpr float kBack = 0.2f;

float areaOf(const Emitter& e) { return length(cross(e.ab, e.ac)) / 2; }
Vec3f middleOf(const Emitter& e) { return e.a + (e.ab + e.ac) * (1.0f / 3); }

void include(Vec3f& min, Vec3f& max, const Vec3f& p) {
  min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
  max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
}

Vec3f facetOf(const Emitter& e) { return normalized(cross(e.ab, e.ac)); }

float sineOf(float cosine) { return std::sqrt(std::max(0.0f, 1 - cosine * cosine)); }
/// The cosine of an angle less another, or of 0 where the other is larger.
float cosineOfRest(float cosine, float otherCosine) {
  if (cosine >= otherCosine) return 1;
  return cosine * otherCosine + sineOf(cosine) * sineOf(otherCosine);
}

float along(const Vec3f& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

}  // namespace

Emitters::Emitters(const World& world, const Shine& shine) {
  addPart(world, kNone, shine);
  for (uint32_t i = 0; i < world.placements.size(); ++i) addPart(world, i, shine);
  if (!emitters_.empty()) build();
}

void Emitters::addPart(const World& world, uint32_t placement, const Shine& shine) {
  const Placement* const p = placement == kNone ? nullptr : &world.placements[placement];
  const Part& part = world.parts[p ? p->part : 0];
  const auto direction = [&](const Vec3f& d) {
    return p ? p->x * d.x + p->y * d.y + p->z * d.z : d;
  };
  const auto point = [&](const Vec3f& d) { return p ? direction(d) + p->origin : d; };
  for (const bool clear : {false, true}) {
    const TriangleSet& set = part.set(clear);
    for (uint32_t t = 0; t < set.triangles.size(); ++t) {
      const TriangleSet::Triangle& triangle = set.triangles[t];
      const SurfaceMaterial& material = world.materials[triangle.material];
      if (maxOf(material.emissive) <= 0 && !material.pane) continue;
      work();
      Emitter e;
      e.a = point(set.positions[triangle.corners[0]]);
      e.ab = point(set.positions[triangle.corners[1]]) - e.a;
      e.ac = point(set.positions[triangle.corners[2]]) - e.a;
      if (!(areaOf(e) > kLeastArea)) continue;
      e.emissive =
          shine(material, point(part.pieces[triangle.piece].middle), normalized(cross(e.ab, e.ac)));
      if (maxOf(e.emissive) <= 0) continue;
      e.placement = placement;
      e.triangle = t;
      e.clear = clear;
      emitters_.push_back(e);
    }
  }
}

void Emitters::build() {
  nodes_.push_back({});
  nodes_[0].count = static_cast<uint32_t>(emitters_.size());
  for (size_t n = 0; n < nodes_.size(); ++n) {
    Node node = nodes_[n];
    work(node.count);
    node.min = node.max = middleOf(emitters_[node.first]);
    Vec3f least = node.min, most = node.max;
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Emitter& e = emitters_[i];
      for (const Vec3f& c : {e.a, e.a + e.ab, e.a + e.ac}) include(node.min, node.max, c);
      include(least, most, middleOf(e));
      node.power += areaOf(e) * luminance(e.emissive);
    }
    orient(node);
    if (node.count > 1) {
      const Vec3f size = most - least;
      const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
      const auto begin = emitters_.begin() + node.first;
      const uint32_t half = node.count / 2;
      // Equal places keep their order, so the tree is the same everywhere.
      std::stable_sort(begin, begin + node.count, [&](const Emitter& a, const Emitter& b) {
        return along(middleOf(a), axis) < along(middleOf(b), axis);
      });
      node.left = static_cast<uint32_t>(nodes_.size());
      Node left, right;
      left.first = node.first;
      left.count = half;
      right.first = node.first + half;
      right.count = node.count - half;
      nodes_.push_back(left);
      nodes_.push_back(right);
    }
    nodes_[n] = node;
  }
}

void Emitters::orient(Node& node) const {
  Vec3f sum;
  const auto begin = emitters_.begin() + node.first, end = begin + node.count;
  for (auto e = begin; e != end; ++e) {
    sum += cross(e->ab, e->ac) * luminance(e->emissive);
  }
  if (!(length(sum) > 0)) return;
  node.axis = normalized(sum);
  node.spread = 1;
  for (auto e = begin; e != end; ++e) {
    node.spread = std::min(node.spread, dot(node.axis, facetOf(*e)));
  }
}

/// The largest cosine at which an emitter of a node may stand to a surface that lies `-to` from the
/// middle of its box, of half a diagonal `radius`; less of it for backs.
float Emitters::facing(const Node& node, const Vec3f& to, float squared, float radius) {
  if (node.spread <= -1 || squared <= radius * radius) return 1;
  const float width = std::sqrt(1 - radius * radius / squared);
  const float cosine = std::clamp(-dot(node.axis, to) / std::sqrt(squared), -1.0f, 1.0f);
  const auto most = [&](float c) {
    return std::max(0.0f, cosineOfRest(cosineOfRest(c, node.spread), width));
  };
  return std::max(most(cosine), kBack * most(-cosine));
}

float Emitters::importance(const Node& node, const Vec3f& at, const Vec3f& normal) {
  const Vec3f middle = (node.min + node.max) * 0.5f, half = (node.max - node.min) * 0.5f;
  const Vec3f to = middle - at;
  // The box lies below the surface's plane.
  const float reach =
      std::abs(normal.x) * half.x + std::abs(normal.y) * half.y + std::abs(normal.z) * half.z;
  const float height = dot(normal, to) + reach;
  if (height <= 0) return 0;
  const float radius = length(half);
  const float squared = std::max(dot(to, to), radius * radius);
  // Of far boxes the cosine is known well enough to count.
  const float cosine = std::min(1.0f, height / std::sqrt(std::max(squared, 1e-12f)));
  return node.power * cosine * facing(node, to, squared, radius) / std::max(squared, 1e-4f);
}

bool Emitters::sample(const Vec3f& at, const Vec3f& normal, float pick, Vec2f u,
                      EmitterSample& sample) const {
  if (nodes_.empty()) return false;
  const Node* node = &nodes_[0];
  float chance = 1;
  while (node->count > 1) {
    const Node &left = nodes_[node->left], &right = nodes_[node->left + 1];
    const float a = importance(left, at, normal), b = importance(right, at, normal);
    if (!(a + b > 0)) return false;
    const float share = a / (a + b);
    if (pick < share) {
      node = &left;
      chance *= share;
      pick = std::min(pick / share, 0.99999994f);
    } else {
      node = &right;
      chance *= 1 - share;
      pick = std::min((pick - share) / (1 - share), 0.99999994f);
    }
  }
  const Emitter& e = emitters_[node->first];
  const float r = std::sqrt(u.x);
  sample.point = e.a + e.ab * (r * (1 - u.y)) + e.ac * (r * u.y);
  sample.facet = facetOf(e);
  sample.emissive = e.emissive;
  sample.density = chance / areaOf(e);
  return true;
}

}  // namespace gable::rt
