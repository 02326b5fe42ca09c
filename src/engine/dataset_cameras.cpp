// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The cameras of a data set. All of them begin with the camera of View::Iso, which is framed on the
// model and stands outside of it.

#include "base/random.h"
#include "engine/dataset.h"
#include "math/trig.h"

namespace gable {

namespace {

/// What is drawn, as a part of the address.
enum Draw : uint64_t { kTurn = 1, kPitch, kSunElevation, kSunAzimuth, kAcross, kUp, kZoom };

/// Degrees that cameras look down: the roofs are seen, and the fronts.
constexpr double kLowOrbit = 15, kHighOrbit = 45, kLowSample = 8, kHighSample = 60;
/// Suns that light fronts and give shadows.
constexpr double kLowSun = 15, kHighSun = 65;
/// Within this share of the picture around its middle lies what a sampled camera looks at, and so
/// many times nearer its lens brings it.
constexpr double kAimShare = 0.5, kMostZoom = 2.5;

uint64_t addressOf(double seed, uint64_t camera) {
  return hashCombine(hashCombine(hashBytes("dataset"), hashDouble(seed)), camera);
}

// Aims the camera of a picture at a part of it, by shares of half its sides from the middle, with a
// lens that brings it so many times nearer.
void aim(PictureSettings& p, const PictureData::Pose& pose, double right, double above,
         double zoom) {
  const double aspect = static_cast<double>(p.width) / p.height;
  const double across = right * pose.halfWidth, up = above * pose.halfWidth / aspect;
  PictureSettings::Camera camera;
  camera.eye = pose.eye;
  for (size_t k = 0; k < 3; ++k) {
    camera.target[k] = pose.eye[k] + pose.forward[k] + across * pose.right[k] + up * pose.up[k];
  }
  p.camera = camera;
  p.fieldOfView = 2 * atanDeg(pose.halfWidth / zoom);
  p.turn = 0;
}

}  // namespace

PictureSettings pictureOf(const PictureMaker& maker, const DatasetSettings& settings, double seed,
                          uint32_t camera) {
  PictureSettings p = settings.picture;
  p.view = View::Iso;
  p.camera.reset();
  p.layers = true;
  const uint64_t all = addressOf(seed, 0), own = addressOf(seed, camera + 1);
  if (!p.sun && !p.sunTime) {
    p.sun = {randomIn(hashCombine(own, kSunElevation), kLowSun, kHighSun),
             randomIn(hashCombine(own, kSunAzimuth), 0, 360)};
  }
  if (settings.placing == DatasetCameras::Orbit) {
    p.turn = 360 * (camera + randomUnit(hashCombine(all, kTurn))) / settings.cameras;
    if (!p.pitch) p.pitch = randomIn(hashCombine(all, kPitch), kLowOrbit, kHighOrbit);
    if (settings.zoom == 1) return p;
    if (const auto pose = maker.pose(p)) aim(p, *pose, 0, 0, settings.zoom);
    return p;
  }
  p.turn = randomIn(hashCombine(own, kTurn), 0, 360);
  if (!p.pitch) p.pitch = randomIn(hashCombine(own, kPitch), kLowSample, kHighSample);
  // Where there is none, drawing tells why.
  if (const auto pose = maker.pose(p)) {
    const auto draw = [&](Draw what, double lo, double hi) {
      return randomIn(hashCombine(own, what), lo, hi);
    };
    const double right = kAimShare * draw(kAcross, -1, 1), above = kAimShare * draw(kUp, -1, 1);
    aim(p, *pose, right, above, settings.zoom * draw(kZoom, 1, kMostZoom));
  }
  return p;
}

}  // namespace gable
