// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A street view is searched, not computed: some hundred places in and around the scene are tried,
// those under a roof or against a wall dropped, and from each one a coarse picture is taken in
// every direction and marked for what makes a good photograph: walls over half of it, a quarter of
// sky, depth, two thirds of the walls in the sun, something near but nothing in the way.

#include "math/trig.h"
#include "render/viewpoint.h"

namespace gable::rt {

namespace {

/// The camera is shifted up: the horizon lies at this share of the height.
constexpr double kHorizon = 0.31;
constexpr int kPlaces = 640, kDirections = 24;
/// The best places are looked at once more, with so many steps about each.
constexpr size_t kRefined = 8;
constexpr int kSteps = 16;
constexpr int kColumns = 20, kRows = 12;

/// The foot of somebody who stands at (x, z); false where there is no open ground.
bool openGround(const Subject& s, double x, double z, Vec3& foot) {
  const Box3& box = s.world.bounds;
  const double tall = box.max.y - s.groundHeight;
  Ray down;
  down.origin = toVec3f({x, box.max.y + 1, z});
  down.direction = {0, -1, 0};
  foot = {x, s.groundHeight, z};
  Hit hit;
  if (!s.tracer.intersect(down, hit)) return true;
  const double y = box.max.y + 1 - static_cast<double>(hit.distance);
  foot.y = std::max(y, s.groundHeight);
  const Vec3f n = normalized(hit.normal);
  return std::abs(n.y) > 0.8f && foot.y < s.groundHeight + std::max(1.0, 0.3 * tall);
}

bool roomAround(const Subject& s, const Vec3& foot) {
  for (const double height : {0.6, kEyeHeight}) {
    for (int k = 0; k < 12; ++k) {
      const double a = 30.0 * k;
      Ray ray;
      ray.origin = toVec3f(foot + Vec3{0, height, 0});
      ray.direction = toVec3f({sinDeg(a), 0, cosDeg(a)});
      ray.to = 1.3f;
      Hit hit;
      if (s.tracer.intersect(ray, hit)) return false;
    }
  }
  return true;
}

/// How far a share lies outside its wanted range.
double off(double share, double lo, double hi) {
  return share < lo ? lo - share : share > hi ? share - hi : 0;
}

double mark(const Subject& s, const Light& light, const Camera& camera, double aspect) {
  int sides[2] = {0, 0};
  int flat = 0, blank = 0;
  Vec3f last;
  Hit lastHit;
  int things = 0, sky = 0, inTheWay = 0, near = 0, lit = 0, walls = 0, cut = 0;
  double logSum = 0, logSquares = 0;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const Ray ray = cameraRay(camera, aspect, (column + 0.5) / kColumns, (row + 0.5) / kRows);
      Hit hit;
      if (!s.tracer.intersect(ray, hit)) {
        sky += ray.direction.y > 0;
        continue;
      }
      const Vec3f p = ray.origin + ray.direction * hit.distance;
      if (static_cast<double>(p.y) < s.groundHeight + 0.5) continue;
      ++things;
      cut += row == kRows - 1;
      inTheWay += hit.distance < 2.6f;
      near += hit.distance >= 2.6f && hit.distance < 7;
      const double l = std::log2(static_cast<double>(std::max(hit.distance, 0.5f)));
      logSum += l;
      logSquares += l * l;
      Vec3f n = normalized(hit.normal);
      if (dot(n, ray.direction) > 0) n = -n;
      // Crowns and other round things turn from column to column, walls do not.
      const bool goesOn = column > 0 && dot(n, last) > 0.99f;
      last = n;
      // One triangle from column to column: a bare wall, however sunlit.
      blank += goesOn && hit.triangle == lastHit.triangle && hit.placement == lastHit.placement;
      lastHit = hit;
      if (std::abs(n.y) > 0.4f) continue;
      ++walls;
      if (goesOn) {
        ++flat;
        if (column < kColumns / 3) ++sides[0];
        if (column >= kColumns - kColumns / 3) ++sides[1];
      }
      if (dot(n, light.sunDirection) < 0.05f) continue;
      Ray shadow;
      shadow.origin = p + n * 0.01f;
      shadow.direction = light.sunDirection;
      lit += s.tracer.visibility(shadow) > 0.5f;
    }
  }
  if (things == 0) return -100;
  const double all = kRows * kColumns, third = kRows * (kColumns / 3);
  const double mean = logSum / things;
  const double depth = std::sqrt(std::max(0.0, logSquares / things - mean * mean));
  const double litShare = walls > 0 ? static_cast<double>(lit) / walls : 0;
  return -6 * off(things / all, 0.5, 0.68) - 4 * off(flat / all, 0.3, 0.6) -
         3 * off((things - walls) / all, 0, 0.1) - 3 * off((walls - flat) / all, 0, 0.16) -
         6 * off(blank / all, 0, 0.08) - 3 * off(sky / all, 0.16, 0.32) -
         8 * off(inTheWay / all, 0, 0.02) - 2 * off(near / all, 0.02, 0.2) -
         1.5 * off(litShare, 0.5, 0.8) + 2.4 * std::min(depth, 1.5) -
         4 * off(sides[0] / third, 0.4, 1) - 4 * off(sides[1] / third, 0.4, 1) -
         1.2 * off(static_cast<double>(cut) / kColumns, 0, 0.3);
}

struct Standpoint {
  double mark = -100;
  Camera camera;
};

struct Search {
  const Subject& subject;
  const Light& light;
  double halfWidth, aspect;

  /// Looks from (x, z) in `count` directions, `step` degrees apart about `azimuth`, and keeps the
  /// best picture in `best`.
  void lookAround(double x, double z, double azimuth, double step, int count,
                  Standpoint& best) const {
    Vec3 foot;
    if (!openGround(subject, x, z, foot) || !roomAround(subject, foot)) return;
    const double tall = std::max(1.0, subject.world.bounds.max.y - subject.groundHeight);
    const double raised = (foot.y - subject.groundHeight) / tall;
    for (int k = 0; k < count; ++k) {
      Camera c = cameraTowards(azimuth + (k - 0.5 * (count - 1)) * step, 0);
      c.eye = foot + Vec3{0, kEyeHeight, 0};
      c.halfWidth = halfWidth;
      c.horizon = kHorizon;
      const double m = mark(subject, light, c, aspect) - 2 * raised;
      if (m > best.mark) best = {m, c};
    }
  }
};

}  // namespace

bool findStandpoint(const Subject& s, const Light& light, double halfWidth, double aspect,
                    Camera& camera) {
  const Box3& box = s.world.bounds;
  const double tall = std::max(0.0, box.max.y - s.groundHeight);
  const double margin = std::clamp(1.2 * tall, 8.0, 150.0);
  const Vec3 size = box.size();
  const Search search{s, light, halfWidth, aspect};

  std::vector<Standpoint> found(kPlaces);
  for (int i = 0; i < kPlaces; ++i) {
    // The two-dimensional golden sequence (Roberts 2018) fills the plan evenly.
    const double u = std::fmod(0.5 + 0.7548776662466927 * i, 1.0);
    const double v = std::fmod(0.5 + 0.5698402909980532 * i, 1.0);
    search.lookAround(box.min.x - margin + u * (size.x + 2 * margin),
                      box.min.z - margin + v * (size.z + 2 * margin), s.frontAzimuth,
                      360.0 / kDirections, kDirections, found[static_cast<size_t>(i)]);
  }
  // A few steps to the side of the best places often clear a tree or open a street.
  std::stable_sort(found.begin(), found.end(),
                   [](const Standpoint& a, const Standpoint& b) { return a.mark > b.mark; });
  Standpoint best = found[0];
  for (size_t f = 0; f < kRefined && found[f].mark > -50; ++f) {
    const Camera& c = found[f].camera;
    const double azimuth = atan2Deg(c.forward.x, -c.forward.z);
    for (int i = 1; i <= kSteps; ++i) {
      const double r = 6 * std::sqrt(static_cast<double>(i) / kSteps);
      search.lookAround(c.eye.x + r * sinDeg(137.5 * i), c.eye.z + r * cosDeg(137.5 * i), azimuth,
                        4, 7, best);
    }
  }
  camera = best.camera;
  return best.mark > -50;
}

}  // namespace gable::rt
