// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A cut is a half-space without anything in it: each ray is shortened to what is left. Where a ray
// enters what is left inside something closed, that is a cut face. Whether it is closed there is
// counted along many directions, most of which must agree, since rules leave gaps. Where they do
// not, under a roof that is a slab or behind bars that are, the way into what is closed decides.

#include "render/stage.h"

#include <algorithm>
#include <vector>

#include "math/trig.h"
#include "render/sampler.h"

namespace gable::rt {

namespace {

constexpr Vec3f kClay{0.70f, 0.67f, 0.63f}, kClayGround{0.58f, 0.555f, 0.525f};
/// A shade darker, or fronts of clay would have no windows.
constexpr Vec3f kClayPane{0.40f, 0.39f, 0.375f};
constexpr Vec3f kCutSolid{0.045f, 0.04f, 0.04f}, kCutSoil{0.26f, 0.19f, 0.13f};

/// A room behind panes: this wide and high.
constexpr float kRoom = 3.8f, kStorey = 3.1f;
/// Panes of larger pieces belong to the room that they are at, not to that of their middle.
constexpr float kLargePane = 8;

/// A smooth random value in [-1, 1] over the plane, with features of about one unit.
float smoothNoise(float x, float z, uint32_t seed) {
  const float fx = std::floor(x), fz = std::floor(z);
  const auto corner = [&](int i, int j) {
    const uint32_t cx = static_cast<uint32_t>(static_cast<int64_t>(fx) + i);
    const uint32_t cz = static_cast<uint32_t>(static_cast<int64_t>(fz) + j);
    return static_cast<float>(mix32(cx + mix32(cz + seed)) >> 8) * 0x1p-23f - 1;
  };
  const float tx = x - fx, tz = z - fz;
  const float sx = tx * tx * (3 - 2 * tx), sz = tz * tz * (3 - 2 * tz);
  return (corner(0, 0) * (1 - sx) + corner(1, 0) * sx) * (1 - sz) +
         (corner(0, 1) * (1 - sx) + corner(1, 1) * sx) * sz;
}

/// Soil is nowhere of one tone: a few percent over metres, finer ones near the camera only.
float groundTone(const Vec3f& p, float distance) {
  float tone = 1 + 0.05f * smoothNoise(p.x / 19, p.z / 19, 1);
  const float fine = 60 / (60 + distance);
  tone += fine * 0.04f * smoothNoise(p.x / 2.3f, p.z / 2.3f, 2);
  // Below a thousandth nobody sees it.
  constexpr float kLeast = 0.14f;
  if (fine > kLeast) tone += fine * fine * 0.05f * smoothNoise(p.x / 0.31f, p.z / 0.31f, 3);
  return tone;
}

/// Shortens a ray to what is not cut away; false where nothing is left of it. `entry`: where it
/// crosses the plane on its way in, else below 0.
bool shorten(const Stage& stage, Ray& ray, float& entry) {
  entry = -1;
  if (!stage.cut) return true;
  const float beyond = stage.cut->beyond(ray.origin);
  const float towards = dot(stage.cut->normal, ray.direction);
  if (beyond > 0) {
    if (towards >= 0) return false;
    entry = -beyond / towards;
    ray.from = std::max(ray.from, entry);
  } else if (towards > 0) {
    ray.to = std::min(ray.to, -beyond / towards);
  }
  return ray.from < ray.to;
}

/// Whether most level rays from a point leave a body there. Directions that no wall of a house runs
/// along, and none down: houses have no undersides. Most bodies are closed at their sides, whatever
/// covers them: a roof with an underside counts for nothing on the way up, since a ray enters it
/// before it leaves it. So they are as good as level, not quite, lest all run within one face.
/// Panes that stand back behind their wall leave slits, through which few of the directions get.
bool isWalledIn(const Stage& stage, const Vec3f& p) {
  constexpr int kAside = 9;
  int aside = 0;
  for (int k = 0; k < kAside; ++k) {
    const double a = 15 + 360.0 * k / kAside;
    const double rise = 0.00007 * (k % 3) - 0.00006;
    aside += stage.tracer.isInside(p, toVec3f(normalized(Vec3{sinDeg(a), rise, cosDeg(a)})));
  }
  return 2 * aside > kAside;
}

/// What is met first, all around a point.
struct Around {
  static constexpr int kRays = 32;
  /// Rays that meet nothing, the ground left out, and those that meet a face from behind.
  int gaps = 0, backs = 0;
  /// Points on the way to the latter.
  std::vector<Vec3f> ways;
};

Around lookAround(const Stage& stage, const Vec3f& p) {
  Around around;
  for (int k = 0; k < Around::kRays; ++k) {
    // Even over the sphere: the golden spiral.
    const double y = 1 - 2 * (k + 0.5) / Around::kRays, flat = std::sqrt(1 - y * y);
    Ray ray;
    ray.origin = p;
    ray.direction = toVec3f({flat * cosDeg(137.50776 * k), y, flat * sinDeg(137.50776 * k)});
    Hit hit;
    if (!stage.tracer.intersect(ray, hit)) {
      around.gaps += !(stage.ground && y < 0);
    } else if (dot(hit.normal, ray.direction) > 0) {
      ++around.backs;
      around.ways.push_back(p + ray.direction * (0.6f * hit.distance));
    }
  }
  return around;
}

/// Whether what is cut at a point is something's inside.
bool isSolid(const Stage& stage, const Vec3f& p) {
  const Vec3f start = p - stage.cut->normal * 1e-3f;
  // In a room only fronts of faces are seen, or almost.
  constexpr int kMostInRooms = 1, kMostGaps = 2;
  const Around around = lookAround(stage, start);
  if (around.backs <= kMostInRooms) return false;
  if (isWalledIn(stage, start)) return true;
  // Terrain may be closed nowhere but above.
  int above = 0;
  for (const Vec3f& d :
       {Vec3f{0.63f, 0.71f, 0.21f}, Vec3f{-0.27f, 0.89f, 0.58f}, Vec3f{-0.52f, 0.97f, -0.61f}}) {
    above += stage.tracer.isInside(start, normalized(d));
  }
  if (above == 3) return true;
  // Without a way out, but with a free way into a body: under a roof of slabs, or between the
  // closed bars of windows.
  return around.gaps <= kMostGaps &&
         std::any_of(around.ways.begin(), around.ways.end(),
                     [&](const Vec3f& way) { return isWalledIn(stage, way); });
}

void makeCut(const Stage& stage, const Ray& ray, float distance, const Vec3f& base,
             Surface& surface) {
  surface = Surface();
  surface.point = ray.origin + ray.direction * distance;
  surface.facet = surface.normal = stage.cut->normal;
  surface.base = base;
  surface.isCut = true;
}

/// Where it is not looked at, its tone is the mean one.
void makeGround(const Stage& stage, const Ray& ray, float t, bool sharp, Surface& surface) {
  surface = Surface();
  surface.point = ray.origin + ray.direction * t;
  surface.point.y = stage.groundHeight;
  surface.facet = surface.normal = {0, 1, 0};
  surface.base = stage.clay ? kClayGround
                            : stage.light.groundAlbedo * (sharp ? groundTone(surface.point, t) : 1);
  surface.isGround = true;
}

/// The endless ground, before what is found at `distance`.
bool meetGround(const Stage& stage, const Ray& ray, bool found, bool sharp, float& distance,
                Surface& surface) {
  if (!stage.ground || stage.block) return false;
  // Of an elevation the ground is what lies below its line.
  if (sharp && stage.parallel && ray.origin.y < stage.groundHeight) {
    makeGround(stage, ray, ray.from, false, surface);
    distance = ray.from;
    return true;
  }
  if (ray.direction.y >= 0) return false;
  const float t = (stage.groundHeight - ray.origin.y) / ray.direction.y;
  // What lies on the ground, within 3 mm, wins over it.
  const float lead = 0.003f / -ray.direction.y;
  if (!(t > ray.from && t < ray.to && (!found || t + lead < distance))) return false;
  makeGround(stage, ray, t, sharp, surface);
  distance = t;
  return true;
}

/// The block of soil that stands for the ground of a section.
bool meetBlock(const Stage& stage, const Ray& ray, float entry, bool found, bool sharp,
               float& distance, Surface& surface) {
  if (!stage.ground || !stage.block) return false;
  const Vec3f min = stage.block->min, max = stage.block->max;
  float from = -1e30f, to = 1e30f;
  int face = -1;
  for (int k = 0; k < 3; ++k) {
    const auto of = [k](const Vec3f& v) { return k == 0 ? v.x : k == 1 ? v.y : v.z; };
    const float inverse = 1 / of(ray.direction);
    float a = (of(min) - of(ray.origin)) * inverse, b = (of(max) - of(ray.origin)) * inverse;
    if (a > b) std::swap(a, b);
    if (a > from) {
      from = a;
      face = k;
    }
    to = std::min(to, b);
  }
  if (!(from < to) || to <= ray.from) return false;
  if (entry >= 0 && entry >= from && entry < to) {
    makeCut(stage, ray, entry, kCutSoil, surface);
    distance = entry;
    return true;
  }
  const float lead = face == 1 ? 0.003f / std::max(1e-6f, std::abs(ray.direction.y)) : 0;
  if (!(from > ray.from && from < ray.to && (!found || from + lead < distance))) return false;
  makeGround(stage, ray, from, sharp, surface);
  if (face != 1) {
    surface.point = ray.origin + ray.direction * from;
    surface.base = kCutSoil;
    const float side = (face == 0 ? ray.direction.x : ray.direction.z) > 0 ? -1.0f : 1.0f;
    surface.facet = surface.normal = face == 0 ? Vec3f{side, 0, 0} : Vec3f{0, 0, side};
  }
  distance = from;
  return true;
}

void makeClay(Surface& s) {
  s.base = s.pane ? kClayPane : kClay;
  s.emissive = {};
  s.metallic = 0;
  s.roughness = 0.9f;
  s.facing = 0.04f;
  s.transmission = 0;
  s.clearWater = 0;
  if (s.pane || s.matter == Matter::Water) s.opacity = 1;
}

}  // namespace

Vec3f offsetFrom(const Vec3f& point, const Vec3f& facet, const Vec3f& direction) {
  const float most = std::max(std::abs(point.x), std::max(std::abs(point.y), std::abs(point.z)));
  const float by = 2e-4f + 1e-6f * most;
  return point + facet * (dot(facet, direction) < 0 ? -by : by);
}

namespace {

/// What light in its window adds to a pane.
void lightRoom(const Stage& stage, const Hit& hit, Surface& surface) {
  const Placement* const p =
      hit.placement == kNone ? nullptr : &stage.world.placements[hit.placement];
  const Part& part = stage.world.parts[p ? p->part : 0];
  const Piece& piece = part.pieces[part.set(hit.clear).triangles[hit.triangle].piece];
  Vec3f middle = piece.middle;
  if (p) middle = p->origin + p->x * middle.x + p->y * middle.y + p->z * middle.z;
  if (piece.size > kLargePane) middle = surface.point;
  surface.emissive += roomLight(stage.litRooms, middle, surface.facet);
}

/// How wide a pixel is at a distance; what is not looked at has no details.
float widthAt(const Stage& stage, bool sharp, float distance) {
  if (!sharp) return kNoDetails;
  return stage.parallel ? stage.pixel : stage.pixel * distance;
}

/// The nearest thing along a ray that has been shortened, of what it met among triangles (null:
/// nothing) and what the stage adds to them.
bool nearest(const Stage& stage, const Ray& ray, float entry, const Hit* hit, bool sharp,
             Surface& surface, float& distance) {
  if (hit) distance = hit->distance;
  if (entry >= 0) {
    const Vec3f p = ray.origin + ray.direction * entry;
    // Below a house without an underside all counts as its inside: there, soil is what is cut.
    const bool under = stage.ground && p.y < stage.groundHeight;
    const bool soil = under && !stage.block;
    if (soil || (!under && isSolid(stage, p))) {
      makeCut(stage, ray, entry, soil ? kCutSoil : kCutSolid, surface);
      distance = entry;
      return true;
    }
  }
  if (meetBlock(stage, ray, entry, hit != nullptr, sharp, distance, surface)) return true;
  if (meetGround(stage, ray, hit != nullptr, sharp, distance, surface)) return true;
  if (!hit) return false;
  surface = surfaceAt(stage.world, *hit, ray, widthAt(stage, sharp, hit->distance));
  if (stage.clay) {
    makeClay(surface);
  } else if (surface.pane && stage.litRooms > 0) {
    lightRoom(stage, *hit, surface);
  }
  return true;
}

/// A ray that meets nothing.
constexpr Ray kNoRay{{0, 0, 0}, 0, {0, 0, 1}, 0};

}  // namespace

bool meet(const Stage& stage, const Ray& whole, bool ordered, Surface& surface, float& distance) {
  Ray ray = whole;
  float entry = -1;
  if (!shorten(stage, ray, entry)) return false;
  Hit hit;
  const bool found =
      ordered ? stage.tracer.intersectOrdered(ray, hit) : stage.tracer.intersect(ray, hit);
  return nearest(stage, ray, entry, found ? &hit : nullptr, ordered, surface, distance);
}

uint32_t meetTogether(const Stage& stage, std::span<const Ray> whole, Surface* surfaces,
                      float* distances) {
  Ray rays[Tracer::kMostTogether];
  float entries[Tracer::kMostTogether];
  Hit hits[Tracer::kMostTogether];
  for (size_t i = 0; i < whole.size(); ++i) {
    rays[i] = whole[i];
    if (!shorten(stage, rays[i], entries[i])) rays[i] = kNoRay;
  }
  const uint32_t found = stage.tracer.intersectTogether({rays, whole.size()}, hits);
  for (size_t i = 0; i < whole.size(); ++i) {
    if (found >> i & 1) fetchTriangle(stage.world, hits[i]);
  }
  for (size_t i = 0; i < whole.size(); ++i) {
    if (found >> i & 1) fetchCorners(stage.world, hits[i]);
  }
  uint32_t met = 0;
  for (size_t i = 0; i < whole.size(); ++i) {
    if (!(rays[i].from < rays[i].to)) continue;
    const Hit* const hit = found >> i & 1 ? &hits[i] : nullptr;
    if (nearest(stage, rays[i], entries[i], hit, true, surfaces[i], distances[i])) met |= 1u << i;
  }
  return met;
}

float visibility(const Stage& stage, const Ray& whole) {
  Ray ray = whole;
  float entry = -1;
  return shorten(stage, ray, entry) ? stage.tracer.visibility(ray) : 1.0f;
}

void visibilityTogether(const Stage& stage, std::span<const Ray> whole, float* shares) {
  Ray rays[Tracer::kMostTogether];
  for (size_t i = 0; i < whole.size(); ++i) {
    rays[i] = whole[i];
    float entry = -1;
    if (!shorten(stage, rays[i], entry)) rays[i] = kNoRay;
  }
  stage.tracer.visibilityTogether({rays, whole.size()}, shares);
}

Vec3f roomLight(float share, const Vec3f& middle, const Vec3f& facet) {
  if (std::abs(facet.y) > 0.5f) return {};
  // The same room for both sides of a pane.
  const float side = facet.x + 0.5f * facet.z < 0 ? -1.0f : 1.0f;
  const Vec3f n = normalized(Vec3f{facet.x, 0, facet.z} * side);
  const auto cell = [](float v) {
    return static_cast<uint32_t>(static_cast<int64_t>(std::floor(v)));
  };
  const uint32_t room =
      mix32(cell((middle.x * n.z - middle.z * n.x) / kRoom) +
            mix32(cell(middle.y / kStorey) + mix32(cell(dot(middle, n) / kRoom + 0.37f))));
  const auto draw = [room](uint32_t k) { return drawnBy(room, k); };
  if (draw(1) >= share) return {};
  const Vec3f warm = mix({1, 0.56f, 0.22f}, {1, 0.75f, 0.46f}, draw(2));
  const Vec3f colour = draw(3) < 0.07f ? Vec3f{0.62f, 0.76f, 1} : warm;
  return colour * (0.06f + 0.21f * draw(4) * draw(4));
}

}  // namespace gable::rt
