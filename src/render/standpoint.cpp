// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A street view is searched, not computed: some hundred places in and around the scene are tried,
// those under a roof or against a wall dropped, and from each one a coarse picture is taken in
// every direction and marked for what makes a good photograph: walls over half of it, a quarter of
// sky, depth, two thirds of the walls in the sun, something near but nothing in the way, no wall at
// arm's length beside it, and the front of what stands alone.
//
// A place that is wide has ground of its own, which may be a hill: there the eye stands on it, away
// from its border, and looks along a street. Ground is told from roofs as surveys by laser tell it:
// on a roof both sides fall away, on a slope what one side loses the other one gains.

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
/// A third of the picture with walls nearer than this shows little of them.
constexpr float kClose = 10;
/// Just above the horizon.
constexpr int kHorizonRow = 4;

/// Of a place, in metres: how far its sides are looked for, and how much they may fall together.
constexpr double kAside[] = {5, 10, 20, 32};
constexpr double kFall = 0.8, kFallPerMetre = 0.04;
constexpr int kSides = 8;
/// The steepest ground that is looked at as such.
constexpr double kSteepest = 0.35;

/// The highest thing at (x, z); false where there is none.
bool topAt(const Subject& s, double x, double z, double& y, Hit& hit) {
  const double above = s.world.bounds.max.y + 1;
  Ray down;
  down.origin = toVec3f({x, above, z});
  down.direction = {0, -1, 0};
  if (!s.tracer.intersect(down, hit)) return false;
  y = above - static_cast<double>(hit.distance);
  return true;
}

/// What mirrors is water.
bool isWater(const Subject& s, const Hit& hit) {
  constexpr float kWet = 0.15f;
  const World& w = s.world;
  const Part& part = w.parts[hit.placement == kNone ? 0 : w.placements[hit.placement].part];
  const TriangleSet& set = hit.clear ? part.clear : part.solid;
  return w.materials[set.triangles[hit.triangle].material].meanRoughness < kWet;
}

/// Whether what lies at `foot` is the ground of a place and no roof.
bool groundOfPlace(const Subject& s, const Vec3& foot) {
  for (const double aside : kAside) {
    for (int k = 0; k < kSides; ++k) {
      const double a = 180.0 * k / kSides;
      double sum = 0;
      for (const double side : {-aside, aside}) {
        Hit hit;
        double y = foot.y;
        topAt(s, foot.x + side * sinDeg(a), foot.z + side * cosDeg(a), y, hit);
        sum += y - foot.y;
      }
      if (sum / 2 < -(kFall + kFallPerMetre * aside)) return false;
    }
  }
  return true;
}

/// The foot of somebody who stands at (x, z); false where there is no open ground.
bool openGround(const Subject& s, double x, double z, Vec3& foot) {
  const Box3& box = s.world.subject;
  const double tall = box.max.y - s.groundHeight;
  foot = {x, s.groundHeight, z};
  Hit hit;
  double y = 0;
  if (!topAt(s, x, z, y, hit)) return !isPlace(s);
  foot.y = std::max(y, s.groundHeight);
  const Vec3f n = normalized(hit.normal);
  if (!(std::abs(n.y) > 0.8f)) return false;
  if (isPlace(s)) return !isWater(s, hit) && groundOfPlace(s, foot);
  return foot.y < s.groundHeight + std::max(1.0, 0.3 * tall);
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

/// Metres to what stands beside somebody who looks ahead, above cars and hedges.
double widthBeside(const Subject& s, const Camera& camera) {
  constexpr double kAboveEye = 2.6, kWidest = 300;
  double widest = 0;
  for (const double side : {-1.0, 1.0}) {
    Ray ray;
    ray.origin = toVec3f(camera.eye + Vec3{0, kAboveEye, 0});
    ray.direction = toVec3f(normalized(camera.right * side + camera.forward * 0.4));
    Hit hit;
    const bool any = s.tracer.intersect(ray, hit);
    widest = std::max(widest, any ? static_cast<double>(hit.distance) : kWidest);
  }
  return std::min(widest, kWidest);
}

/// How much nearer than a few metres, or than a third of the street's width, what stands at one
/// side is, from 0 to 1: a front at arm's length fills a third of the picture and shows nothing.
double nearnessBeside(const Subject& s, const Camera& camera) {
  constexpr double kEnough = 6, kShare = 0.32;
  double least = kEnough * 4, width = 0;
  for (const double side : {-1.0, 1.0}) {
    Ray ray;
    ray.origin = toVec3f(camera.eye);
    ray.direction = toVec3f(normalized(camera.right * side + camera.forward * 0.3));
    ray.to = static_cast<float>(kEnough * 4);
    Hit hit;
    const bool any = s.tracer.intersect(ray, hit);
    const double distance = any ? static_cast<double>(hit.distance) : kEnough * 4;
    least = std::min(least, distance);
    width += distance;
  }
  return off(least / std::min(kEnough, kShare * width), 1, 1e9);
}

/// The share of the width in front of which something near stands, up to an eighth. Even a lamp
/// post parts the picture, and slips between the columns of the others.
double blockedAhead(const Subject& s, const Camera& camera, double aspect) {
  constexpr int kFine = 64;
  int blocked = 0;
  for (int k = 0; k < kFine; ++k) {
    const double x = (k + 0.5) / kFine;
    Ray ray = cameraRay(camera, aspect, x, kHorizon + 0.06);
    ray.to = std::abs(x - 0.5) < 0.25 ? 9 : 4.5f;
    Hit hit;
    blocked += s.tracer.intersect(ray, hit);
  }
  return std::min(static_cast<double>(blocked) / kFine, 0.125);
}

/// Of a place: how far from its middle, how wide the street and how short the look along it is.
double markInPlace(const Subject& s, const Camera& camera, double ahead) {
  if (!isPlace(s)) return 0;
  const Vec3 aside = camera.eye - s.world.subject.center(), size = s.world.subject.size();
  const double edge = 2 * std::max(std::abs(aside.x) / size.x, std::abs(aside.z) / size.z);
  return -6 * off(edge, 0, 0.6) - 1.5 * off(std::log2(std::max(ahead, 1.0)), 6, 40) -
         2 * off(std::log2(widthBeside(s, camera)), 0, 4.3);
}

/// How far somebody looks at the back of what stands alone, from 0 to 1.
double behind(const Subject& s, const Camera& camera) {
  if (isPlace(s)) return 0;
  const Vec3 front{sinDeg(s.frontAzimuth), 0, -cosDeg(s.frontAzimuth)};
  return std::max(0.0, dot(camera.forward, front));
}

double mark(const Subject& s, const Vec3f& towardsSun, const Camera& camera, double aspect) {
  const bool place = isPlace(s);
  const double footY = camera.eye.y - kEyeHeight;
  int sides[2] = {0, 0}, close[2] = {0, 0};
  int flat = 0, blank = 0;
  Vec3f last;
  Hit lastHit;
  int things = 0, sky = 0, inTheWay = 0, near = 0, lit = 0, walls = 0, cut = 0;
  double logSum = 0, logSquares = 0, ahead = 1000;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const Ray ray = cameraRay(camera, aspect, (column + 0.5) / kColumns, (row + 0.5) / kRows);
      Hit hit;
      if (!s.tracer.intersect(ray, hit)) {
        sky += ray.direction.y > 0;
        continue;
      }
      const Vec3f p = ray.origin + ray.direction * hit.distance;
      const bool looksAhead =
          row == kHorizonRow && column >= kColumns / 2 - 2 && column < kColumns / 2 + 2;
      if (looksAhead) ahead = std::min(ahead, static_cast<double>(hit.distance));
      if (static_cast<double>(p.y) < s.groundHeight + 0.5) continue;
      const bool flatThere = place && std::abs(normalized(hit.normal).y) > 0.8f;
      const double slope = 0.5 + kSteepest * static_cast<double>(hit.distance);
      if (flatThere && static_cast<double>(p.y) < footY + slope) continue;
      ++things;
      cut += row == kRows - 1;
      inTheWay += hit.distance < 2.6f;
      near += hit.distance >= 2.6f && hit.distance < 7;
      if (hit.distance < kClose && column < kColumns / 3) ++close[0];
      if (hit.distance < kClose && column >= kColumns - kColumns / 3) ++close[1];
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
      if (dot(n, towardsSun) < 0.05f) continue;
      Ray shadow;
      shadow.origin = p + n * 0.01f;
      shadow.direction = towardsSun;
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
         8 * off(inTheWay / all, 0, 0.02) - 24 * blockedAhead(s, camera, aspect) -
         2 * off(near / all, 0.02, 0.2) - 1.5 * off(litShare, 0.5, 0.8) +
         2.4 * std::min(depth, 1.5) - 4 * off(close[0] / third, 0, 0.3) -
         4 * off(close[1] / third, 0, 0.3) - 4 * off(sides[0] / third, 0.4, 1) -
         4 * off(sides[1] / third, 0.4, 1) -
         1.2 * off(static_cast<double>(cut) / kColumns, 0, 0.3) + markInPlace(s, camera, ahead) -
         3 * nearnessBeside(s, camera) - 3 * behind(s, camera);
}

struct Standpoint {
  double mark = -100;
  Camera camera;
};

struct Search {
  const Subject& subject;
  const Vec3f& towardsSun;
  double halfWidth, aspect;

  /// Looks from (x, z) in `count` directions, `step` degrees apart about `azimuth`, and keeps the
  /// best picture in `best`.
  void lookAround(double x, double z, double azimuth, double step, int count,
                  Standpoint& best) const {
    Vec3 foot;
    if (!openGround(subject, x, z, foot) || !roomAround(subject, foot)) return;
    const double tall = std::max(1.0, subject.world.subject.max.y - subject.groundHeight);
    const double raised = isPlace(subject) ? 0 : (foot.y - subject.groundHeight) / tall;
    for (int k = 0; k < count; ++k) {
      Camera c = cameraTowards(azimuth + (k - 0.5 * (count - 1)) * step, 0);
      c.eye = foot + Vec3{0, kEyeHeight, 0};
      c.halfWidth = halfWidth;
      c.horizon = kHorizon;
      const double m = mark(subject, towardsSun, c, aspect) - 2 * raised;
      if (m > best.mark) best = {m, c};
    }
  }
};

}  // namespace

bool findStandpoint(const Subject& s, const Vec3f& towardsSun, double halfWidth, double aspect,
                    Camera& camera) {
  const Box3& box = s.world.subject;
  const double tall = std::max(0.0, box.max.y - s.groundHeight);
  const double margin = isPlace(s) ? 0 : std::clamp(1.2 * tall, 8.0, 150.0);
  const Vec3 size = box.size();
  const Search search{s, towardsSun, halfWidth, aspect};

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
