// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Where the camera stands: the views of RenderOptions, framed on a world. All coordinates are the
// world's own, less World::origin.
#pragma once

#include "render/light.h"
#include "render/render.h"
#include "render/tracer.h"

namespace gable::rt {

/// What framing needs to know.
struct Subject {
  const World& world;
  const Tracer& tracer;
  std::vector<Vec3f> points;
  double groundHeight = 0;
  /// Compass angle that the main front faces.
  double frontAzimuth = 180;
};

/// Wide enough to have ground of its own to stand on: streets are within it, not around it.
bool isPlace(const Subject& subject);

double frontAzimuthOf(const World& world);

/// A level or tilted camera in the direction of a compass angle; `pitch` is negative downwards.
Camera cameraTowards(double azimuth, double pitch);

/// The options' view with their overrides applied. Street views ask the tracer for a free place and
/// `towardsSun`, unit, for the sunny side.
Camera chooseCamera(const Subject& subject, const RenderOptions& options, const Vec3f& towardsSun);

/// Of somebody who stands in the street, in metres above it.
constexpr double kEyeHeight = 1.62;

/// The best place for a street view, kEyeHeight above the ground there; false when no place outside
/// things was found.
bool findStandpoint(const Subject& subject, const Vec3f& towardsSun, double halfWidth,
                    double aspect, Camera& camera);

/// The ray through a point of the picture, from left and from below in [0, 1]. Unit direction.
Ray cameraRay(const Camera& camera, double aspect, double x, double y);

}  // namespace gable::rt
