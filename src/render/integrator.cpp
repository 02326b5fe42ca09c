// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A path tracer in the manner of Kajiya: at each hit the sun is asked directly and one lamp, then
// one direction is followed, and a ray that leaves the scene brings the sky's light. The sun's disc
// is only ever found by asking, and lamps are, but in the mirrors that the camera sees, which do
// not ask: so nothing counts twice. Paths are cut short where they carry little (Russian roulette);
// the last surface gets a share of the sky in place of what it would have gathered. What the camera
// sees of a window or of water is split: the mirrored ray and the other one are both followed,
// since drawing one of them is what noise in glass comes from.

#include "render/integrator.h"

#include "render/sampler.h"
#include "render/water.h"

namespace gable::rt {

namespace {

/// Dimensions of the sampler: the pixel, then a block a bounce; the mirrored half of a split path
/// has blocks of its own.
constexpr uint32_t kFirstBlock = 1, kBlock = 7, kMirroredBlocks = 0x10000;
enum BlockPart : uint32_t { kOpacity, kSun, kDirection, kPick, kRoulette, kLamp, kLampPoint };

/// Straight passages through clear things a path may make.
constexpr int kMostPassages = 24;
/// Share of the open sky's light that stands for the bounces that are not traced.
constexpr float kUntracedShare = 0.4f;
/// How narrow the highlight of the sun or a lamp may be on what is not seen directly.
constexpr float kLeastReflectedAlpha = 0.1f;
/// Mirrors rougher than this spread what is brighter than white over many pixels, of which few
/// paths meet it: there white is the most.
constexpr float kBlurs = 0.15f;

/// A path on its way.
struct Walk {
  Ray ray;
  Vec3f carried{1, 1, 1};
  uint32_t depth = 0, blocks = kFirstBlock;
  /// Until a rough surface is met, light belongs to the part that is not smoothed.
  bool sharp = true;
  bool mirrored = false;
  /// By a mirror in which no lamp is told from the light about it.
  bool blurred = false;
  float travelled = 0;
  int passages = 0;
  /// Within water: how far one sees in it, and the light that it scatters; 0 outside.
  float clearWater = 0;
  Vec3f waterLight;

  uint32_t dimension(BlockPart part) const { return blocks + kBlock * depth + part; }
};

class Tracing {
 public:
  Tracing(const Stage& stage, const Sampler& sampler, bool brief)
      : stage_(stage),
        light_(stage.light),
        sampler_(sampler),
        limit_(fireflyLimit(light_)),
        brief_(brief) {}

  void follow(Walk w) {
    while (step(w)) {
    }
  }

  /// From a surface whose sunlight is known on to the next; false where the path ends.
  bool leave(Walk& w, const Surface& surface, const Lobes& lobes, const Vec3f& view) {
    gatherLamp(w, surface, lobes, view);
    if (w.depth >= stage_.bounces) {
      const Vec3f rest = lobes.diffuse * light_.skyIrradiance * (kUntracedShare / kPif);
      target(w) += w.carried * rest;
      return false;
    }
    return scatterOn(w, surface, lobes, view);
  }

  /// At what its ray has met, and from there on; false where the path ends.
  bool arrive(Walk& w, const Surface& surface, float distance) {
    if (w.clearWater > 0) leaveWater(w, distance);
    if (w.sharp && stage_.haze > 0) fade(w, surface, distance);
    if (!w.mirrored && w.sharp) w.travelled += distance;

    const Vec3f view = -w.ray.direction;
    const Lobes lobes = lobesOf(surface, view);
    if (surface.opacity < 1 && passes(w, surface, lobes)) {
      // On from the facet: the surface's own point is lifted off it where it stands for a round
      // one.
      const Vec3f met = w.ray.origin + w.ray.direction * distance;
      w.ray.origin = offsetFrom(met, surface.facet, w.ray.direction);
      return ++w.passages <= kMostPassages;
    }
    if (surface.matter == Matter::Water && surface.clearWater > 0) {
      return stepOnWater(w, surface, lobes);
    }
    shine(w, surface);
    if (w.sharp && !w.mirrored) {
      result.albedo = lobes.diffuse + lobes.through + lobes.coat;
      // Smoke has no side: to the smoothing a puff is as one whichever way its shell turns.
      result.normal = surface.matter == Matter::Smoke ? view : surface.normal;
      result.distance = w.travelled;
    }
    gatherSun(w, surface, lobes, view);
    return leave(w, surface, lobes, view);
  }

  PathResult result;

 private:
  /// On to the next surface; false where the path ends.
  bool step(Walk& w) {
    Surface surface;
    float distance = 0;
    ++result.rays;
    if (meet(stage_, w.ray, w.sharp, surface, distance)) return arrive(w, surface, distance);
    miss(w);
    return false;
  }

  /// Where the light of a step goes to.
  Vec3f& target(const Walk& w) { return w.sharp ? result.direct : result.indirect; }

  void miss(const Walk& w) {
    const Vec3f& d = w.ray.direction;
    const Vec3f sky = !w.sharp       ? light_.sky(d)
                      : stage_.paper ? *stage_.paper
                      : w.depth == 0 ? light_.shown(d)
                                     : light_.shownSky(d);
    target(w) += withoutFireflies(w.carried * sky, limit_ * 4);
  }

  float white() const { return 1 / light_.exposure; }

  void fade(Walk& w, const Surface& surface, float distance) {
    const float clear = clearAlong(stage_, surface, distance);
    result.direct += w.carried * light_.horizon(w.ray.direction) * (1 - clear);
    w.carried *= clear;
  }

  /// Whether a path goes straight on through something clear.
  bool passes(const Walk& w, const Surface& surface, const Lobes& lobes) const {
    // A smooth pane mirrors fully however clear it is.
    const float mirror = surface.roughness < kMirror ? luminance(lobes.coat) : 0;
    const float pass = (1 - surface.opacity) * (1 - mirror);
    return sampler_.number(w.dimension(kOpacity) + 7919u * static_cast<uint32_t>(w.passages)) <
           pass;
  }

  /// What shines. Surfaces ask for lamps, so a path that comes from one has had this light.
  void shine(const Walk& w, const Surface& surface) {
    if (!w.sharp || maxOf(surface.emissive) <= 0) return;
    const Vec3f shown = surface.emissive * light_.shownGlow;
    result.direct += w.carried * (w.blurred ? withoutFireflies(shown, white()) : shown);
  }

  void gatherSun(const Walk& w, const Surface& surface, const Lobes& lobes, const Vec3f& view) {
    const Vec3f sun = sunlight(w, surface, lobes, view);
    (w.mirrored && w.sharp ? result.direct
     : w.sharp             ? result.sun
                           : result.indirect) +=
        withoutFireflies(w.carried * sun, w.sharp ? limit_ * 4 : limit_);
  }

  /// What lamps give to the first surface is indirect.
  void gatherLamp(const Walk& w, const Surface& surface, const Lobes& lobes, const Vec3f& view) {
    if (stage_.emitters.empty() || (brief_ && !w.mirrored)) return;
    const Vec3f lamp = lamplight(w, surface, lobes, view);
    // A mirror shows no more of a surface beside a lamp than the camera sees of it.
    if (w.mirrored && w.sharp)
      result.direct += w.carried * withoutFireflies(lamp, w.blurred ? white() : limit_);
    else
      result.indirect += withoutFireflies(w.carried * lamp, limit_);
  }

  Vec3f sunlight(const Walk& w, const Surface& surface, const Lobes& lobes, const Vec3f& view) {
    if (maxOf(light_.sun) <= 0) return {};
    const Vec3f value = evaluate(surface, forSun(w, lobes), view, light_.sunDirection);
    if (maxOf(value) <= 0) return {};
    const Vec3f towards = light_.towardsSun(sampler_.point(w.dimension(kSun)));
    Ray shadow;
    shadow.origin = offsetFrom(surface.point, surface.facet, towards);
    shadow.direction = towards;
    ++result.rays;
    return value * light_.sun * visibility(stage_, shadow);
  }

  /// The lobes that the whole disc of the sun is mirrored in: wider by its radius, which turns half
  /// as far as the normal. What the camera does not see itself shines in a wider one (Kaplanyan and
  /// Dachsbacher 2013, Path Space Regularization): few paths find a narrow one, and those that do
  /// are fireflies.
  Lobes forSun(const Walk& w, const Lobes& lobes) const {
    Lobes wide = lobes;
    const float half = light_.sunRadius() / 2;
    wide.alpha = std::sqrt(lobes.alpha * lobes.alpha + half * half);
    if (w.depth > 0 || !w.sharp) wide.alpha = std::max(wide.alpha, kLeastReflectedAlpha);
    return wide;
  }

  Vec3f lamplight(const Walk& w, const Surface& surface, const Lobes& lobes, const Vec3f& view) {
    const LampRay lamp =
        rayToLamp(stage_, surface, forLamps(w, surface, lobes), view,
                  sampler_.number(w.dimension(kLamp)), sampler_.point(w.dimension(kLampPoint)));
    if (maxOf(lamp.light) <= 0) return {};
    ++result.rays;
    return lamp.light * visibility(stage_, lamp.ray);
  }

  /// The lobes that lamps light. A mirror that the camera sees shows them itself: its path finds
  /// them and has their light. What other paths meet has a wider lobe, as for the sun.
  static Lobes forLamps(const Walk& w, const Surface& surface, const Lobes& lobes) {
    Lobes lit = lobes;
    if (!w.sharp)
      lit.alpha = std::max(lobes.alpha, kLeastReflectedAlpha);
    else if (surface.roughness < kMirror)
      lit.coatChance = 0;
    return lit;
  }

  /// Mirror and water part here: half of the light each its way.
  bool stepOnWater(Walk& w, const Surface& surface, const Lobes& lobes) {
    const Vec3f view = -w.ray.direction;
    const bool fromAbove = surface.facet.y > 0;
    if (!fromAbove) {
      // Out again, straight on: what is seen there is little.
      w.ray.origin = offsetFrom(surface.point, surface.facet, w.ray.direction);
      return ++w.passages <= kMostPassages;
    }
    // The sun's glitter is on the surface itself.
    Lobes coat = lobes;
    coat.diffuse = coat.through = {};
    target(w) += withoutFireflies(w.carried * sunlight(w, surface, coat, view),
                                  w.sharp ? limit_ * 4 : limit_);
    const float cosine = std::clamp(dot(surface.normal, view), 0.0f, 1.0f);
    const float m = 1 - cosine, mirror = surface.facing + (1 - surface.facing) * m * m * m * m * m;
    const bool splits = w.depth == 0 && w.sharp;
    const bool isMirrored = !splits && sampler_.number(w.dimension(kPick)) < mirror;
    if (splits || isMirrored) {
      Walk other = w;
      const Scatter next = mirrored(w, surface, lobes, view);
      other.carried *= next.weight * (lobes.coatChance / (splits ? 1 : mirror));
      if (maxOf(next.weight) > 0) {
        other.mirrored = true;
        ++other.depth;
        other.blocks = splits ? kFirstBlock + kMirroredBlocks : w.blocks;
        other.ray = startOf(surface, next.direction);
        if (!splits) {
          w = other;
          return w.depth <= stage_.bounces;
        }
        follow(other);
      }
      if (!splits) return false;
      w.carried *= 1 - mirror;
    }
    const Vec3f down = refracted(w.ray.direction, surface.normal, kWater);
    if (length(down) == 0) return false;
    w.clearWater = surface.clearWater;
    const float sunUp = std::max(0.0f, light_.sunDirection.y);
    w.waterLight = surface.base * (light_.sun * sunUp + light_.skyIrradiance) * (0.5f / kPif);
    w.ray = startOf(surface, down);
    return ++w.passages <= kMostPassages;
  }

  /// The water between two surfaces takes light and gives back some of its own.
  void leaveWater(Walk& w, float distance) {
    const Vec3f through = throughWater(distance, w.clearWater);
    target(w) += w.carried * w.waterLight * (Vec3f{1, 1, 1} - through);
    w.carried *= through;
    w.clearWater = 0;
  }

  /// A direction off the coat, whatever its chance was.
  Scatter mirrored(const Walk& w, const Surface& surface, const Lobes& lobes, const Vec3f& view) {
    return scatter(surface, lobes, view, 0, sampler_.point(w.dimension(kDirection)));
  }

  static Ray startOf(const Surface& surface, const Vec3f& direction) {
    Ray ray;
    ray.origin = offsetFrom(surface.point, surface.facet, direction);
    ray.direction = direction;
    return ray;
  }

  bool scatterOn(Walk& w, const Surface& surface, const Lobes& lobes, const Vec3f& view) {
    float pick = sampler_.number(w.dimension(kPick));
    float share = 1;
    const bool smooth = surface.roughness < kMirror;
    if (w.depth == 0 && smooth && lobes.coatChance > 0 && lobes.coatChance < 1) {
      const Scatter off = mirrored(w, surface, lobes, view);
      if (maxOf(off.weight) > 0) {
        Walk other = w;
        other.carried *= off.weight * lobes.coatChance;
        other.mirrored = true;
        other.blurred = w.blurred || surface.roughness > kBlurs;
        ++other.depth;
        other.blocks += kMirroredBlocks;
        other.ray = startOf(surface, off.direction);
        follow(other);
      }
      pick = lobes.coatChance + pick * (1 - lobes.coatChance);
      share = 1 - lobes.coatChance;
    }
    const Scatter next = scatter(surface, lobes, view, std::min(pick, 0.9999999f),
                                 sampler_.point(w.dimension(kDirection)));
    if (maxOf(next.weight) <= 0) return false;
    w.carried *= next.weight * share;
    if (next.coat && smooth) {
      w.mirrored = true;
      w.blurred = w.blurred || surface.roughness > kBlurs;
    } else {
      if (brief_) return false;
      if (stage_.ambient) return lightBySky(w, surface, next.direction);
      w.sharp = false;
    }
    if (w.depth >= 1) {
      const float stay = std::clamp(maxOf(w.carried) * 1.5f, 0.08f, 1.0f);
      if (sampler_.number(w.dimension(kRoulette)) >= stay) return false;
      w.carried *= 1 / stay;
    }
    ++w.depth;
    w.ray = startOf(surface, next.direction);
    return true;
  }

  /// In place of a path's next surface: the sky, or what stands for all that hides it.
  bool lightBySky(const Walk& w, const Surface& surface, const Vec3f& direction) {
    ++result.rays;
    const float open = visibility(stage_, startOf(surface, direction));
    result.indirect += withoutFireflies(w.carried * skyBehind(stage_, direction, open), limit_);
    return false;
  }

  const Stage& stage_;
  const Light& light_;
  const Sampler& sampler_;
  float limit_;
  bool brief_;
};

/// Paling of far ground by squared metres: 63 % after a kilometre.
constexpr float kGroundFade = 1e-6f;
/// A light sample may exceed sunlit white by this factor before it counts as a firefly.
constexpr float kClamp = 4;

}  // namespace

void keepFinite(PathResult& result) {
  for (Vec3f* part : {&result.direct, &result.sun, &result.indirect}) {
    if (!isFinite(*part)) *part = {};
  }
}

float clearAlong(const Stage& stage, const Surface& surface, float distance) {
  const float far = surface.isGround ? std::max(0.0f, distance - stage.nearGround) : 0;
  return std::exp(-distance * stage.haze - far * far * kGroundFade);
}

float fireflyLimit(const Light& light) { return kClamp / light.exposure; }

Vec3f withoutFireflies(const Vec3f& c, float limit) {
  const float l = luminance(c);
  return l > limit ? c * (limit / l) : c;
}

Vec3f skyBehind(const Stage& stage, const Vec3f& direction, float open) {
  Vec3f light = *stage.ambient * (1 - open);
  if (open > 0) light += stage.light.sky(direction) * open;
  return light;
}

LampRay rayToLamp(const Stage& stage, const Surface& surface, const Lobes& lobes, const Vec3f& view,
                  float pick, Vec2f u) {
  LampRay out;
  EmitterSample lamp;
  if (!stage.emitters.sample(surface.point, surface.facet, pick, u, lamp)) return out;
  const Vec3f to = lamp.point - surface.point;
  const float squared = dot(to, to);
  if (!(squared > 1e-8f)) return out;
  const float away = std::sqrt(squared);
  const Vec3f towards = to * (1 / away);
  const Vec3f value = evaluate(surface, lobes, view, towards);
  const float cosine = std::abs(dot(lamp.facet, towards));
  if (maxOf(value) <= 0 || cosine <= 0) return out;
  out.ray.origin = offsetFrom(surface.point, surface.facet, towards);
  out.ray.direction = towards;
  // It ends before the lamp and its own glass.
  out.ray.to = away * 0.999f - 0.002f;
  out.light = value * (lamp.emissive * (stage.light.glow * cosine / (squared * lamp.density)));
  return out;
}

PathResult tracePath(const Stage& stage, const Ray& ray, uint32_t x, uint32_t y, uint32_t sample,
                     uint32_t seed, bool brief) {
  const Sampler sampler(x, y, sample, seed);
  Tracing tracing(stage, sampler, brief);
  Walk walk;
  walk.ray = ray;
  tracing.follow(walk);
  keepFinite(tracing.result);
  return tracing.result;
}

PathResult goOnFrom(const Stage& stage, const PathStart& start, const Surface& surface,
                    float distance, uint32_t seed, bool brief) {
  const Sampler sampler(start.x, start.y, start.sample, seed);
  Tracing tracing(stage, sampler, brief);
  ++tracing.result.rays;
  Walk walk;
  walk.ray = start.ray;
  if (tracing.arrive(walk, surface, distance)) tracing.follow(walk);
  return tracing.result;
}

PathResult goOn(const Stage& stage, const PathStart& start, const Surface& surface,
                const Lobes& lobes, const Vec3f& carried, uint32_t seed) {
  const Sampler sampler(start.x, start.y, start.sample, seed);
  Tracing tracing(stage, sampler, false);
  Walk walk;
  walk.ray = start.ray;
  walk.carried = carried;
  if (tracing.leave(walk, surface, lobes, -start.ray.direction)) tracing.follow(walk);
  return tracing.result;
}

}  // namespace gable::rt
