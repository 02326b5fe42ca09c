// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Framing is exact: with the direction given, "this point lies within the frame" is a linear
// condition on the eye, so the nearest eye that has every point within is a maximum over points.

#include "render/viewpoint.h"

#include <limits>

#include "math/trig.h"

namespace gable::rt {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Half the width of 36 mm film over the focal length.
constexpr double lens(double focalMillimetres) { return 18 / focalMillimetres; }

/// Shares of the picture that the subject may take.
constexpr double kIsoFill = 0.77, kIsoHeightFill = 0.9, kFrontFill = 0.77, kTopFill = 0.88;
constexpr double kIsoPitch = 38;
/// Levels of the front view: where the ground meets the subject and where its top may reach.
constexpr double kGroundLine = 0.20, kTopLine = 0.78;
/// What the ground takes of the room that an elevation leaves, and the most of the picture.
constexpr double kGroundShare = 0.45, kHighestGround = 0.38;

struct Extents {
  double least = kInfinity, most = -kInfinity;
  void include(double v) {
    least = std::min(least, v);
    most = std::max(most, v);
  }
  double middle() const { return (least + most) / 2; }
  double size() const { return most - least; }
};

/// Axes of the camera against a point.
struct InView {
  double right, up, ahead;
};

InView inView(const Camera& c, const Vec3f& p) {
  const Vec3 v = toVec3(p);
  return {dot(c.right, v), dot(c.up, v), dot(c.forward, v)};
}

void frameParallel(Camera& camera, const std::vector<Vec3f>& points, double aspect) {
  Extents x, y, z;
  for (const Vec3f& p : points) {
    const InView v = inView(camera, p);
    x.include(v.right);
    y.include(v.up);
    z.include(v.ahead);
  }
  camera.parallel = true;
  camera.halfWidth = std::max({x.size(), y.size() * aspect, 0.1}) / (2 * kTopFill);
  camera.eye = camera.right * x.middle() + camera.up * y.middle() +
               camera.forward * (z.least - std::max(10.0, z.size()));
}

/// The same level, on a ground line: an elevation. What lies deeper is hidden by the ground.
void frameElevation(Camera& camera, const Subject& subject, double aspect) {
  Extents x, z;
  double top = subject.groundHeight;
  for (const Vec3f& p : subject.points) {
    const InView v = inView(camera, p);
    x.include(v.right);
    z.include(v.ahead);
    top = std::max(top, v.up);
  }
  const double height = top - subject.groundHeight;
  camera.parallel = true;
  camera.halfWidth =
      std::max({x.size() / kFrontFill, height * aspect / (kTopLine - kGroundLine), 0.1}) / 2;
  // A low wide subject has more below it, so that it does not lie at the foot of an empty picture.
  const double whole = 2 * camera.halfWidth / aspect;
  camera.horizon = std::clamp((1 - height / whole) * kGroundShare, kGroundLine, kHighestGround);
  camera.eye = camera.right * x.middle() + Vec3{0, subject.groundHeight, 0} +
               camera.forward * (z.least - std::max(10.0, z.size()));
}

/// Places the eye so that all points lie in the middle of the picture.
void frame(Camera& camera, const std::vector<Vec3f>& points, double aspect) {
  const double kx = kIsoFill * camera.halfWidth, ky = kIsoHeightFill * camera.halfWidth / aspect;
  double right = -kInfinity, left = -kInfinity, top = -kInfinity, bottom = -kInfinity;
  double nearest = kInfinity;
  for (const Vec3f& p : points) {
    const InView v = inView(camera, p);
    right = std::max(right, v.right - kx * v.ahead);
    left = std::max(left, -v.right - kx * v.ahead);
    top = std::max(top, v.up - ky * v.ahead);
    bottom = std::max(bottom, -v.up - ky * v.ahead);
    nearest = std::min(nearest, v.ahead);
  }
  const double ahead =
      std::min({-(right + left) / (2 * kx), -(top + bottom) / (2 * ky), nearest - 0.5});
  camera.eye = camera.right * ((right - left) / 2) + camera.up * ((top - bottom) / 2) +
               camera.forward * ahead;
}

/// The same for a level camera at a given height, with a rising front: the ground line and the top
/// line are kept, and the horizon falls where they put it.
void frameLevel(Camera& camera, const Subject& subject, double aspect, double eyeHeight) {
  const double kx = kFrontFill * camera.halfWidth;
  const double height = 2 * camera.halfWidth / aspect;
  // Lawns and pavements may run out of the picture; what stands on them may not.
  std::vector<Vec3f> points;
  for (const Vec3f& p : subject.points) {
    if (static_cast<double>(p.y) > subject.groundHeight + 0.6) points.push_back(p);
  }
  if (points.empty()) points = subject.points;
  double right = -kInfinity, left = -kInfinity, nearest = kInfinity;
  for (const Vec3f& p : points) {
    const InView v = inView(camera, p);
    right = std::max(right, v.right - kx * v.ahead);
    left = std::max(left, -v.right - kx * v.ahead);
    nearest = std::min(nearest, v.ahead);
  }
  const double widthAhead = std::min(-(right + left) / (2 * kx), nearest - 1);

  // For each horizon the top line gives one bound, the ground line another; the higher the horizon,
  // the tighter the first and the looser the second. Halving finds where they meet.
  const auto aheadFor = [&](double horizon, bool& topIsTighter) {
    double byTop = kInfinity, byGround = kInfinity;
    for (const Vec3f& p : points) {
      const InView v = inView(camera, p);
      const double above = std::max(0.0, v.up - eyeHeight);
      byTop = std::min(byTop, v.ahead - above / (height * (kTopLine - horizon)));
      byGround = std::min(byGround, v.ahead - (eyeHeight - subject.groundHeight) /
                                                  (height * (horizon - kGroundLine)));
    }
    topIsTighter = byTop < byGround;
    return std::min(byTop, byGround);
  };
  double lo = kGroundLine + 0.005, hi = kTopLine - 0.005;
  double ahead = -kInfinity;
  for (int i = 0; i < 30; ++i) {
    const double horizon = (lo + hi) / 2;
    bool topIsTighter = false;
    ahead = aheadFor(horizon, topIsTighter);
    (topIsTighter ? hi : lo) = horizon;
  }
  ahead = std::min(ahead, widthAhead);
  // A low wide subject leaves room above: its foot stays on the ground line.
  camera.horizon = kGroundLine + (eyeHeight - subject.groundHeight) / ((nearest - ahead) * height);
  camera.horizon = std::clamp(camera.horizon, 0.1, 0.6);
  camera.eye = camera.right * ((right - left) / 2) + Vec3{0, eyeHeight, 0} + camera.forward * ahead;
}

/// Lifts an eye that the framing put under the ground.
void keepAboveGround(Camera& camera, const Subject& subject) {
  camera.eye.y = std::max(camera.eye.y, subject.groundHeight + 1);
}

/// Lifts an eye that stands within the plan of a hill to above what is there.
void keepAboveHill(Camera& camera, const Subject& subject) {
  const double above = subject.world.bounds.max.y + 1;
  Ray down;
  down.origin = toVec3f({camera.eye.x, above, camera.eye.z});
  down.direction = {0, -1, 0};
  Hit hit;
  if (!subject.tracer.intersect(down, hit)) return;
  const double top = above - static_cast<double>(hit.distance);
  camera.eye.y = std::max(camera.eye.y, top + kEyeHeight);
}

/// A building that stands higher than half its plan is wide: seen from near, it would be cut.
bool isTower(const Subject& subject) {
  const Vec3 size = subject.world.subject.size();
  const double tall = subject.world.subject.max.y - subject.groundHeight;
  return !isPlace(subject) && std::max(size.x, size.z) < 2 * tall;
}

Camera standardCamera(const Subject& subject, const RenderOptions& options, const Vec3f& towardsSun,
                      double aspect) {
  const double given = options.fov ? tanDeg(std::clamp(*options.fov, 1.0, 150.0) / 2) : 0;
  const double toFront = subject.frontAzimuth + 180;
  const double tall = subject.world.subject.max.y - subject.groundHeight;
  switch (options.view) {
    case PictureView::Top: {
      Camera camera = cameraTowards(0, -90);
      frameParallel(camera, subject.points, aspect);
      return camera;
    }
    case PictureView::Front: {
      Camera camera = cameraTowards(toFront, 0);
      frameElevation(camera, subject, aspect);
      return camera;
    }
    case PictureView::Street: {
      Camera camera;
      const bool tower = isTower(subject);
      const double halfWidth =
          given > 0 ? given : lens(tall > 60 && !tower && !isPlace(subject) ? 20 : 26);
      if (!tower && findStandpoint(subject, towardsSun, halfWidth, aspect, camera)) return camera;
      camera = cameraTowards(toFront - 30, 0);
      camera.halfWidth = halfWidth;
      frameLevel(camera, subject, aspect, subject.groundHeight + kEyeHeight);
      keepAboveHill(camera, subject);
      return camera;
    }
    case PictureView::Iso: break;
  }
  Camera camera = cameraTowards(toFront - 34, -options.pitch.value_or(kIsoPitch));
  camera.halfWidth = given > 0 ? given : lens(60);
  frame(camera, subject.points, aspect);
  keepAboveGround(camera, subject);
  return camera;
}

}  // namespace

bool isPlace(const Subject& subject) {
  constexpr double kLeastSide = 120;
  const Vec3 size = subject.world.subject.size();
  return std::min(size.x, size.z) >= kLeastSide;
}

double frontAzimuthOf(const World& world) {
  // Wall angles count from +z (south) towards +x (east).
  const double turn = world.wallAgreement > 0.35 ? world.wallAngle : 0;
  return 180 - turn;
}

Camera cameraTowards(double azimuth, double pitch) {
  Camera c;
  const Vec3 flat{sinDeg(azimuth), 0, -cosDeg(azimuth)};
  c.right = {cosDeg(azimuth), 0, sinDeg(azimuth)};
  c.forward = flat * cosDeg(pitch) + Vec3{0, sinDeg(pitch), 0};
  c.up = flat * -sinDeg(pitch) + Vec3{0, cosDeg(pitch), 0};
  return c;
}

Camera chooseCamera(const Subject& subject, const RenderOptions& options, const Vec3f& towardsSun) {
  const double aspect = static_cast<double>(options.width) / std::max(1u, options.height);
  if (!options.eye && !options.target) return standardCamera(subject, options, towardsSun, aspect);

  const Vec3 target =
      options.target ? *options.target - subject.world.origin : subject.world.subject.center();
  Camera camera;
  if (options.eye) {
    camera.eye = *options.eye - subject.world.origin;
    camera.halfWidth = lens(options.view == PictureView::Street ? 26 : 40);
  } else {
    camera = standardCamera(subject, options, towardsSun, aspect);
    if (camera.parallel) {
      camera.eye = target + camera.forward * dot(camera.forward, camera.eye - target);
      camera.horizon = 0.5;
      return camera;
    }
    camera.horizon = 0.5;
  }
  if (options.fov) camera.halfWidth = tanDeg(std::clamp(*options.fov, 1.0, 150.0) / 2);
  const Vec3 d = target - camera.eye;
  if (!(length(d) > 0) || !isFinite(d)) return camera;
  const double flat = std::sqrt(d.x * d.x + d.z * d.z);
  const Camera turned = cameraTowards(flat > 0 ? atan2Deg(d.x, -d.z) : 0, atan2Deg(d.y, flat));
  camera.right = turned.right;
  camera.up = turned.up;
  camera.forward = turned.forward;
  return camera;
}

Ray cameraRay(const Camera& c, double aspect, double x, double y) {
  const double a = (2 * x - 1) * c.halfWidth;
  const double b = 2 * (y - c.horizon) * c.halfWidth / aspect;
  Ray ray;
  if (c.parallel) {
    ray.origin = toVec3f(c.eye + c.right * a + c.up * b);
    ray.direction = toVec3f(c.forward);
  } else {
    ray.origin = toVec3f(c.eye);
    ray.direction = toVec3f(normalized(c.forward + c.right * a + c.up * b));
  }
  return ray;
}

}  // namespace gable::rt
