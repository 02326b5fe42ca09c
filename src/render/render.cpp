// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The life of a picture: the scene becomes triangles, the camera finds its place, every pixel
// traces its paths, what noise is left is smoothed, and the exposure makes it a picture.

#include "render/render.h"

#include <chrono>
#include <cmath>

#include "render/denoise.h"
#include "render/integrator.h"
#include "render/tone.h"
#include "render/viewpoint.h"

namespace gable {

namespace {

class Stopwatch {
 public:
  /// Seconds since the last call.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// 6 km as on a clear day; from far above less, so that a town keeps its colours.
double hazeDistance(const RenderOptions& options, const Camera& camera, const rt::World& world) {
  if (options.hazeDistance) return *options.hazeDistance;
  if (options.uniformSky || camera.parallel) return 0;
  return std::max(6000.0, 16 * length(world.bounds.center() - camera.eye));
}

/// Share of the picture's mean light that a lens scatters over all of it: shadows keep some light.
constexpr float kVeil = 0.008f;
/// The mean level that a picture should have, and how many stops the exposure may move for it: the
/// stone on which the exposure rests stays between 195 and 225.
constexpr float kMeanLevel = 126 / 255.0f, kLeastStops = -0.3f, kMostStops = 0.35f;

/// Mean display level of some thousand pixels.
float meanLevel(const std::vector<rt::Vec3f>& pixels, float exposure) {
  const size_t step = 1 + pixels.size() / 8192;
  float sum = 0, count = 0;
  for (size_t i = 0; i < pixels.size(); i += step) {
    sum += rt::linearToSrgb(rt::luminance(rt::toneMapped(pixels[i] * exposure)));
    ++count;
  }
  return sum / count;
}

/// From light to picture: veil and exposure.
void develop(std::vector<rt::Vec3f> pixels, float exposure, bool adapt, double stops,
             LinearImage& image) {
  if (adapt && !pixels.empty()) {
    // What outshines white counts as white, or a lit window would fog the picture.
    const float white = 2 / exposure;
    Vec3 sum;
    for (const rt::Vec3f& p : pixels) {
      sum += rt::toVec3({std::min(p.x, white), std::min(p.y, white), std::min(p.z, white)});
    }
    const rt::Vec3f mean = rt::toVec3f(sum * (1 / static_cast<double>(pixels.size())));
    for (rt::Vec3f& p : pixels) p = rt::mix(p, mean, kVeil);
    float lo = kLeastStops, hi = kMostStops;
    for (int i = 0; i < 12; ++i) {
      const float middle = (lo + hi) / 2;
      (meanLevel(pixels, exposure * std::exp2(middle)) > kMeanLevel ? hi : lo) = middle;
    }
    exposure *= std::exp2((lo + hi) / 2);
  }
  exposure *= static_cast<float>(std::exp2(stops));
  image.rgb.reserve(pixels.size() * 3);
  for (const rt::Vec3f& p : pixels) {
    for (const float v : {p.x, p.y, p.z}) image.rgb.push_back(std::max(0.0f, v * exposure));
  }
}

}  // namespace

Picture render(const Scene& scene, const RenderOptions& options) {
  Picture picture;
  picture.image.width = options.width;
  picture.image.height = options.height;
  if (options.width == 0 || options.height == 0) return picture;

  Stopwatch watch;
  const rt::World world = rt::makeWorld(scene, options.textures);
  const rt::Tracer tracer(world);
  const double foot =
      options.groundHeight ? *options.groundHeight - world.origin.y : world.footHeight;
  const double front = options.frontAzimuth ? *options.frontAzimuth : rt::frontAzimuthOf(world);
  const rt::Subject subject{world, tracer, rt::framingPoints(world), foot, front};
  const rt::Light light(
      options, options.sunElevation.value_or(options.view == PictureView::Top ? 50.0 : 38.0),
      options.sunAzimuth.value_or(front + 45));
  picture.camera = rt::chooseCamera(subject, options, light);

  const double haze = hazeDistance(options, picture.camera, world);
  const double away =
      length(world.bounds.center() - picture.camera.eye) + length(world.bounds.size()) / 2;
  const rt::Stage stage{world,
                        tracer,
                        light,
                        options.ground,
                        static_cast<float>(foot),
                        static_cast<float>(haze > 0 ? 1 / haze : 0),
                        static_cast<float>(std::max(250.0, 2 * away)),
                        options.bounces};
  picture.stats.seconds.prepare = watch.lap();

  rt::Film film;
  picture.cancelled = !rt::tracePicture(stage, picture.camera, options, film, picture.stats.rays);
  picture.stats.seconds.trace = watch.lap();

  const std::vector<rt::Vec3f> pixels =
      rt::resolve(film, options.denoise && !picture.cancelled, options.threads);
  develop(pixels, light.exposure,
          options.adaptExposure && !options.uniformSky && !picture.cancelled, options.exposureStops,
          picture.image);
  picture.stats.seconds.denoise = watch.lap();

  picture.stats.triangles = world.triangles;
  picture.stats.instances = world.placements.size();
  for (const rt::Part& part : world.parts) picture.stats.storedTriangles += part.triangles();
  picture.camera.eye += world.origin;
  return picture;
}

}  // namespace gable
