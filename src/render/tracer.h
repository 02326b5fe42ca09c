// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Tracer: where rays meet a world. Any number of threads may ask at once.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "render/world.h"

namespace gable::rt {

struct Ray {
  Vec3f origin;
  float from = 0;
  /// Need not be unit; distances count in its length.
  Vec3f direction;
  float to = 1e30f;
};

struct Hit {
  float distance = 0;
  /// Not unit, in world coordinates, on the triangle's front.
  Vec3f normal;
  /// Barycentric coordinates of the second and third corner.
  float u = 0, v = 0;
  /// Index into World::placements, or kNone for part 0.
  uint32_t placement = kNone;
  uint32_t triangle = 0;
  bool clear = false;
};

class Tracer {
 public:
  /// Keeps a reference to the world and shares its vertices. O(n log n). The meter of the thread
  /// can stop it.
  explicit Tracer(const World& world);
  ~Tracer();
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  /// The nearest hit.
  bool intersect(const Ray& ray, Hit& hit) const;
  /// The nearest hit, and of faces that coincide there the one that looks at the ray, and of these
  /// the last in path order: what was laid on a face shows.
  bool intersectOrdered(const Ray& ray, Hit& hit) const;
  /// The share of light that gets along the ray: 0 behind something solid.
  float visibility(const Ray& ray) const;

  // Several rays at once, kMostTogether at most: faster where they run side by side. A ray whose
  // `to` is not above its `from` meets nothing.
  static constexpr size_t kMostTogether = 16;
  /// As intersectOrdered; bit i of the result: ray i met something.
  uint32_t intersectTogether(std::span<const Ray> rays, Hit* hits) const;
  void visibilityTogether(std::span<const Ray> rays, float* shares) const;

  /// Whether a point lies within something closed: along the direction more faces are left than
  /// entered.
  bool isInside(const Vec3f& point, const Vec3f& direction) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The share of light that passes straight through a triangle of a `clear` set, at the barycentric
/// coordinates of the second and third corner; `placement` as in Hit.
float clearness(const World& world, const TriangleSet& set, uint32_t triangle, uint32_t placement,
                float u, float v);

/// Asks for what surfaceAt() reads of a triangle, so that it is there by then: its record first,
/// and what that points at. Of several hits first one, then the other for all of them.
void fetchTriangle(const World& world, const Hit& hit);
void fetchCorners(const World& world, const Hit& hit);

/// What lies at a hit, seen along the ray's direction. Details finer than `width`, in metres, need
/// not be seen; with kNoDetails only the light that it sends around counts.
constexpr float kNoDetails = 1e30f;
Surface surfaceAt(const World& world, const Hit& hit, const Ray& ray, float width);

}  // namespace gable::rt
