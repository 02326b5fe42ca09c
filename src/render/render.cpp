// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The life of a picture: the scene becomes triangles, the camera finds its place, every pixel
// traces its paths, what noise is left is smoothed, and the exposure makes it a picture. Drawings
// leave the paths out.

#include "render/render.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <mutex>
#include <string_view>
#include <tuple>
#include <utility>

#include "base/work.h"
#include "math/trig.h"
#include "render/denoise.h"
#include "render/drawing.h"
#include "render/film.h"
#include "render/layers.h"
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

/// 9 km as on a clear day; from far above less, so that a town keeps its colours.
double hazeDistance(const RenderOptions& options, const Camera& camera, const rt::World& world) {
  if (options.hazeDistance) return *options.hazeDistance;
  if (options.uniformSky || camera.parallel) return 0;
  return std::max(9000.0, 24 * length(world.subject.center() - camera.eye));
}

/// Share of the picture's mean light that a lens scatters over all of it: shadows keep some light.
constexpr float kVeil = 0.008f;
/// The mean level that a picture should have, and how many stops the exposure may move for it: the
/// stone on which the exposure rests stays between 195 and 225.
constexpr float kMeanLevel = 126 / 255.0f, kLeastStops = -0.3f, kMostStops = 0.35f;
/// The same at night, when the brightest part of the dusk may be before the camera or behind it.
constexpr float kNightLevel = 40 / 255.0f, kNightStops = -1.0f;
/// By day, what shines less than this is lost in the light.
constexpr float kLostByDay = 0.5f;

/// Mean display level of some thousand pixels, from 0 to 1.
float meanLevel(const std::vector<rt::Vec3f>& pixels, float exposure) {
  const size_t step = 1 + pixels.size() / 8192;
  float sum = 0, count = 0;
  for (size_t i = 0; i < pixels.size(); i += step) {
    sum += rt::srgbLevel(std::min(1.0f, rt::luminance(rt::toneMapped(pixels[i] * exposure))));
    ++count;
  }
  return sum / (255 * count);
}

/// From light to picture: veil and exposure.
void develop(std::vector<rt::Vec3f> pixels, const rt::Light& light, bool adapt, double stops,
             LinearImage& image) {
  float exposure = light.exposure;
  if (adapt && !pixels.empty()) {
    // What outshines white counts as white, or a lit window would fog the picture.
    const float white = 2 / exposure;
    Vec3 sum;
    for (const rt::Vec3f& p : pixels) {
      sum += rt::toVec3({std::min(p.x, white), std::min(p.y, white), std::min(p.z, white)});
    }
    const rt::Vec3f mean = rt::toVec3f(sum * (1 / static_cast<double>(pixels.size())));
    for (rt::Vec3f& p : pixels) p = rt::mix(p, mean, kVeil);
    const float wanted = kMeanLevel + (kNightLevel - kMeanLevel) * light.night;
    float lo = kLeastStops + (kNightStops - kLeastStops) * light.night, hi = kMostStops;
    for (int i = 0; i < 12; ++i) {
      const float middle = (lo + hi) / 2;
      (meanLevel(pixels, exposure * std::exp2(middle)) > wanted ? hi : lo) = middle;
    }
    exposure *= std::exp2((lo + hi) / 2);
  }
  exposure *= static_cast<float>(std::exp2(stops));
  image.rgb.reserve(pixels.size() * 3);
  for (const rt::Vec3f& p : pixels) {
    for (const float v : {p.x, p.y, p.z}) image.rgb.push_back(std::max(0.0f, v * exposure));
  }
}

/// Of a section: the paper behind the model, and the block of soil it stands on.
constexpr Vec3 kPaper{0xf4 / 255.0, 0xf1 / 255.0, 0xea / 255.0};

/// Of PictureLighting::Direct: what surfaces reflect of the light of an open place, half of them in
/// the shade.
constexpr float kAmbientAlbedo = 0.15f;

/// Share of rooms with light at night, where nobody says.
constexpr double kLitRooms = 0.4;
/// What a room gives to the street, over what a lamp as bright would give: it shows more than it
/// shines, through curtains and towards its own walls.
constexpr float kRoomShine = 0.008f;

/// The corners of a block, or what a cut leaves of them and where it goes through the block's
/// edges.
void addBlock(const rt::Stage::Block& block, const rt::Cut* cut, std::vector<rt::Vec3f>& points) {
  const auto corner = [&](unsigned i) {
    return rt::Vec3f{i & 1 ? block.max.x : block.min.x, i & 2 ? block.max.y : block.min.y,
                     i & 4 ? block.max.z : block.min.z};
  };
  for (unsigned i = 0; i < 8; ++i) {
    const rt::Vec3f a = corner(i);
    if (!cut || cut->beyond(a) <= 0) points.push_back(a);
    for (const unsigned bit : {1u, 2u, 4u}) {
      const rt::Vec3f b = corner(i | bit);
      if (cut && (cut->beyond(a) > 0) != (cut->beyond(b) > 0)) points.push_back(cut->between(a, b));
    }
  }
}

/// Turned about the vertical through `middle`, counter-clockwise from above.
void orbit(Camera& camera, const Vec3& middle, double degrees) {
  if (degrees == 0) return;
  const double c = cosDeg(degrees), s = sinDeg(degrees);
  const auto turned = [&](const Vec3& v) {
    return Vec3{c * v.x + s * v.z, v.y, c * v.z - s * v.x};
  };
  camera.eye = middle + turned(camera.eye - middle);
  camera.right = turned(camera.right);
  camera.up = turned(camera.up);
  camera.forward = turned(camera.forward);
}

}  // namespace

struct Renderer::Impl {
  const Scene& scene;
  Stopwatch making;
  rt::World world;
  double trianglesSeconds = making.lap();
  rt::Tracer tracer;
  double treeSeconds = making.lap();
  std::vector<rt::Vec3f> points;
  double front;
  /// Of the last picture that had some: the frames of a walk share them.
  mutable std::mutex cloudsMaking;
  mutable std::shared_ptr<const rt::Clouds> clouds;

  Impl(const Scene& s, const TextureSource* textures)
      : scene(s),
        world(rt::makeWorld(s, textures)),
        tracer(world),
        points(rt::framingPoints(world)),
        front(rt::frontAzimuthOf(world)) {}

  rt::Subject subject(const RenderOptions& o) const {
    const double foot = o.groundHeight ? *o.groundHeight - world.origin.y : world.footHeight;
    return {world, tracer, framed(o, foot), foot, o.frontAzimuth.value_or(front)};
  }

  /// What a camera without a place of its own has to show.
  std::vector<rt::Vec3f> framed(const RenderOptions& o, double foot) const {
    const std::optional<rt::Cut> plane = cut(o);
    const rt::Cut* const cut = plane ? &*plane : nullptr;
    std::vector<rt::Vec3f> left = cut ? rt::framingPoints(world, cut) : points;
    if (standsOnBlock(o)) addBlock(block(foot), cut, left);
    return left;
  }

  static bool standsOnBlock(const RenderOptions& o) {
    return o.ground && (o.groundBlock || o.look == PictureLook::Section);
  }

  rt::Light light(const RenderOptions& o) const {
    const bool drawn = o.look == PictureLook::Ink || o.look == PictureLook::Blueprint;
    RenderOptions options = o;
    if (o.look == PictureLook::Clay) options.groundColor = {0.78, 0.77, 0.75};
    if (drawn) options.haziness = 1;
    const auto [elevation, azimuth] = sun(o);
    const bool shows = o.look == PictureLook::Photo || o.look == PictureLook::Clay;
    return {options, elevation, azimuth, shows ? cloudsOf(o, elevation) : nullptr};
  }

  std::shared_ptr<const rt::Clouds> cloudsOf(const RenderOptions& o, double sunElevation) const {
    if (!(o.clouds > 0) || o.uniformSky) return nullptr;
    const std::lock_guard lock(cloudsMaking);
    if (!clouds || !clouds->isFor(o.clouds, sunElevation)) {
      clouds = std::make_shared<const rt::Clouds>(o.clouds, sunElevation);
    }
    return clouds;
  }

  std::pair<double, double> sun(const RenderOptions& o) const {
    // It goes with the camera around the turntable.
    return {o.sunElevation.value_or(o.view == PictureView::Top ? 50.0 : 38.0),
            o.sunAzimuth.value_or(o.frontAzimuth.value_or(front) + 45 - o.orbit)};
  }

  Camera camera(const RenderOptions& o, const rt::Subject& subject) const {
    const auto [elevation, azimuth] = sun(o);
    Camera camera = rt::chooseCamera(subject, o, rt::towardsSun(elevation, azimuth));
    orbit(camera, world.subject.center(), o.orbit);
    return camera;
  }

  std::optional<rt::Cut> cut(const RenderOptions& o) const {
    if (o.cut) {
      return rt::Cut{rt::toVec3f(o.cut->normal),
                     static_cast<float>(o.cut->offset - dot(o.cut->normal, world.origin))};
    }
    CutSide side = o.cutSide;
    if (side == CutSide::None && o.look == PictureLook::Section) side = CutSide::Front;
    if (side == CutSide::None) return {};
    const double azimuth = o.frontAzimuth.value_or(front) - (side == CutSide::Side ? 90 : 0);
    const Vec3 normal{sinDeg(azimuth), 0, -cosDeg(azimuth)}, size = world.subject.size();
    const double across = std::abs(normal.x) * size.x + std::abs(normal.z) * size.z;
    const double middle = dot(normal, world.subject.center()), built = dot(normal, builtMiddle());
    // A house in the front of its lot is cut, and not its garden.
    const bool isAside = std::abs(built - middle) > 0.05 * across;
    return rt::Cut{rt::toVec3f(normal), static_cast<float>(isAside ? built : middle)};
  }

  /// The middle of what is seen from above and stands high, without leaves; of the whole where
  /// nothing does.
  Vec3 builtMiddle() const {
    constexpr int kRays = 48;
    constexpr double kHigh = 2;
    const Box3& s = world.subject;
    Vec3 sum;
    double weight = 0;
    for (int i = 0; i < kRays * kRays; ++i) {
      const Vec3 share{(i % kRays + 0.5) / kRays, 0, (i / kRays + 0.5) / kRays}, size = s.size();
      const Vec3 from{s.min.x + share.x * size.x, s.max.y + 1, s.min.z + share.z * size.z};
      const rt::Ray ray{rt::toVec3f(from), 0, {0, -1, 0}};
      rt::Hit hit;
      if (!tracer.intersect(ray, hit) || hit.clear) continue;
      const double height = from.y - static_cast<double>(hit.distance) - world.footHeight;
      if (height < kHigh) continue;
      sum += height * from;
      weight += height;
    }
    return weight > 0 ? sum * (1 / weight) : s.center();
  }

  /// Whether a cut takes all of it away.
  bool isCutAway(const std::optional<rt::Cut>& plane) const {
    return plane && !points.empty() &&
           std::all_of(points.begin(), points.end(),
                       [&](const rt::Vec3f& p) { return plane->beyond(p) > 0; });
  }

  rt::Emitters emitters(const RenderOptions& o, const rt::Light& light, double rooms) const {
    if (o.look == PictureLook::Clay || o.lampPower <= 0) return {};
    const float least = light.night > 0 ? 0 : kLostByDay;
    if (light.night <= 0 && rooms <= 0 && !anyEmission(least)) return {};
    return {world, [&](const rt::SurfaceMaterial& m, const rt::Vec3f& middle, const rt::Vec3f& n) {
              rt::Vec3f shine = rt::maxOf(m.meanEmissive) > least ? m.meanEmissive : rt::Vec3f{};
              if (m.pane && rooms > 0) {
                shine += rt::roomLight(static_cast<float>(rooms), middle, n) * kRoomShine;
              }
              return shine;
            }};
  }

  bool anyEmission(float least) const {
    for (const rt::SurfaceMaterial& m : world.materials) {
      if (rt::maxOf(m.emissive) > least) return true;
    }
    return false;
  }

  bool anyPane() const {
    for (const rt::Part& part : world.parts) {
      for (const bool clear : {false, true}) {
        for (const rt::TriangleSet::Triangle& t : part.set(clear).triangles) {
          if (world.materials[t.material].pane) return true;
        }
      }
    }
    return false;
  }

  /// The block of soil: as wide as the model, and some.
  rt::Stage::Block block(double foot) const {
    const Vec3 size = world.bounds.size();
    const double margin = 0.04 * std::max(size.x, size.z) + 0.5;
    const double deep = std::clamp(0.12 * std::max(size.x, size.z), 0.8, 12.0);
    const Vec3 out{margin, 0, margin};
    Vec3 min = world.bounds.min - out, max = world.bounds.max + out;
    min.y = std::min(foot - deep, world.bounds.min.y - 0.3);
    max.y = foot;
    return {rt::toVec3f(min), rt::toVec3f(max)};
  }

  rt::Stage stage(const RenderOptions& o, const rt::Light& light, const rt::Emitters& emitters,
                  const Camera& camera, double foot) const {
    rt::Stage s{world, tracer, light, emitters};
    s.ground = o.ground;
    s.groundHeight = static_cast<float>(foot);
    const double haze = hazeDistance(o, camera, world);
    s.haze = static_cast<float>(haze > 0 ? 1 / haze : 0);
    const double away =
        length(world.bounds.center() - camera.eye) + length(world.bounds.size()) / 2;
    s.nearGround = static_cast<float>(std::max(250.0, 2 * away));
    s.pixel = static_cast<float>(2 * camera.halfWidth / o.width);
    s.parallel = camera.parallel;
    s.bounces = o.bounces;
    if (o.lighting == PictureLighting::Direct) s.ambient = ambient(light);
    s.clay = o.look == PictureLook::Clay;
    s.cut = cut(o);
    s.litRooms = static_cast<float>(rooms(o, light));
    if (o.look == PictureLook::Section) {
      s.paper = rt::inverseToneMapped(rt::srgbToLinear(kPaper)) * (1 / light.exposure);
      s.haze = 0;
    }
    if (standsOnBlock(o)) s.block = block(foot);
    return s;
  }

  /// What surfaces send on average of what sun and sky give them.
  static rt::Vec3f ambient(const rt::Light& light) {
    const float up = std::max(0.0f, light.sunDirection.y);
    return (light.sun * up + light.skyIrradiance) * (kAmbientAlbedo / rt::kPif);
  }

  static double rooms(const RenderOptions& o, const rt::Light& light) {
    if (o.look == PictureLook::Clay) return 0;
    return o.litRooms.value_or(light.night > 0 ? kLitRooms * static_cast<double>(light.night) : 0);
  }

  rt::Lens lens(const RenderOptions& o, const Camera& camera, const rt::Stage& stage) const {
    rt::Lens lens;
    if (o.aperture <= 0 || camera.parallel) return lens;
    // 18 mm of film lie on each side of the lens's axis.
    lens.radius = static_cast<float>(0.018 / camera.halfWidth / o.aperture / 2);
    double focus = 0;
    if (o.focus) {
      focus = *o.focus;
    } else if (o.target) {
      focus = dot(*o.target - world.origin - camera.eye, camera.forward);
    } else {
      const double aspect = static_cast<double>(o.width) / o.height;
      focus = static_cast<double>(
          rt::glimpse(stage, scene, camera, rt::cameraRay(camera, aspect, 0.5, 0.5)).depth);
    }
    if (!(focus > 0)) focus = length(world.subject.center() - camera.eye);
    lens.focus = static_cast<float>(std::max(0.01, focus));
    return lens;
  }

  /// Paths, smoothing and exposure.
  void photograph(const rt::Stage& stage, const RenderOptions& o, Picture& picture,
                  Stopwatch& watch) const {
    rt::Film film;
    picture.cancelled = !rt::tracePicture(stage, picture.camera, lens(o, picture.camera, stage), o,
                                          film, picture.stats.rays);
    picture.stats.seconds.trace = watch.lap();
    rt::Smoothing smoothing =
        o.lighting == PictureLighting::Direct ? rt::Smoothing::Sky : rt::Smoothing::Paths;
    if (!o.denoise || picture.cancelled) smoothing = rt::Smoothing::None;
    std::vector<rt::Vec3f> pixels;
    const Status smoothed = guarded([&] {
      pixels = rt::resolve(film, smoothing, o.threads);
      return Status();
    });
    // Who has stopped the smoothing is given the picture without it, unless they want none.
    if (!smoothed.ok()) {
      if (std::string_view(smoothed.code()) != kWorkStopped) throw Unwinding(smoothed);
      if (o.progress) o.progress(1);
      picture.cancelled = true;
      pixels = rt::resolve(film, rt::Smoothing::None, o.threads);
    }
    const bool adapts = o.adaptExposure && !o.uniformSky && !stage.paper && !picture.cancelled;
    develop(pixels, stage.light, adapts, o.exposureStops, picture.image);
    picture.stats.seconds.denoise = watch.lap();
  }
};

Renderer::Renderer(const Scene& scene, const TextureSource* textures)
    : impl_(std::make_unique<Impl>(scene, textures)) {}
Renderer::~Renderer() = default;

Camera Renderer::cameraOf(const RenderOptions& options) const {
  Camera camera = impl_->camera(options, impl_->subject(options));
  camera.eye += impl_->world.origin;
  return camera;
}

Picture Renderer::render(const RenderOptions& options) const {
  Picture picture;
  picture.image.width = options.width;
  picture.image.height = options.height;
  if (options.width == 0 || options.height == 0) return picture;

  const Impl& impl = *impl_;
  work(kWorkBetweenLooks + 1);
  Stopwatch watch;
  picture.stats.seconds.triangles = impl.trianglesSeconds;
  picture.stats.seconds.tree = impl.treeSeconds;
  const rt::Subject subject = impl.subject(options);
  const rt::Light light = impl.light(options);
  picture.camera = impl.camera(options, subject);
  std::tie(picture.sun.elevation, picture.sun.azimuth) = impl.sun(options);
  const rt::Emitters emitters = impl.emitters(options, light, Impl::rooms(options, light));
  const rt::Stage stage =
      impl.stage(options, light, emitters, picture.camera, subject.groundHeight);
  picture.stats.seconds.prepare = watch.lap();

  if (options.look == PictureLook::Ink || options.look == PictureLook::Blueprint) {
    picture.cancelled = !rt::drawLines(stage, impl.scene, picture.camera, options, picture.image);
    picture.stats.seconds.trace = watch.lap();
  } else {
    impl.photograph(stage, options, picture, watch);
  }
  const bool lights = options.look == PictureLook::Photo || options.look == PictureLook::Section;
  picture.isCutAway = impl.isCutAway(stage.cut);
  picture.lacksPanes = lights && options.litRooms.value_or(0) > 0 && !impl.anyPane();
  if (options.layers && !picture.cancelled) {
    picture.layers = rt::traceLayers(stage, impl.scene, picture.camera, options);
  }

  picture.stats.triangles = impl.world.triangles;
  picture.stats.instances = impl.world.placements.size();
  for (const rt::Part& part : impl.world.parts) picture.stats.storedTriangles += part.triangles();
  picture.camera.eye += impl.world.origin;
  return picture;
}

Picture render(const Scene& scene, const RenderOptions& options) {
  if (options.width == 0 || options.height == 0) {
    Picture picture;
    picture.image.width = options.width;
    picture.image.height = options.height;
    return picture;
  }
  return Renderer(scene, options.textures).render(options);
}

}  // namespace gable
