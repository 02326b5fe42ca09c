// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Several paths at once: their rays to the first surface and from there to the sun are asked
// together, since they run side by side. From there on each goes its own way and is followed alone,
// as is what clear things, mirrors and water need. Where Stage::ambient stands for all that is
// behind the first surface, the rays to the sky end all paths and are asked together as well.

#include "render/integrator.h"
#include "render/sampler.h"

namespace gable::rt {

namespace {

/// Dimensions of the sampler, as a path's first block has them.
constexpr uint32_t kSun = 2, kDirection = 3, kPick = 4, kLamp = 6, kLampPoint = 7;
constexpr size_t kMost = Tracer::kMostTogether;

bool isPlain(const Surface& s, const Lobes& lobes) {
  return s.opacity >= 1 && s.matter != Matter::Water &&
         (s.roughness >= kMirror || lobes.coatChance <= 0);
}

class Bundle {
 public:
  Bundle(const Stage& stage, std::span<const PathStart> starts, uint32_t seed, bool brief,
         PathResult* results)
      : stage_(stage),
        light_(stage.light),
        starts_(starts),
        seed_(seed),
        brief_(brief),
        results_(results),
        limit_(fireflyLimit(stage.light)) {}

  void trace() {
    for (size_t i = 0; i < starts_.size(); ++i) rays_[i] = starts_[i].ray;
    float distances[kMost];
    const uint32_t met = meetTogether(stage_, {rays_, starts_.size()}, surfaces_, distances);
    for (size_t i = 0; i < starts_.size(); ++i) {
      results_[i] = PathResult();
      ++results_[i].rays;
      if (met >> i & 1)
        arrive(i, distances[i]);
      else
        miss(i);
    }
    addSun();
    if (!brief_ && stage_.ambient) {
      addSky();
      addLamps();
    } else if (!brief_) {
      goOnAlone();
    }
    for (size_t i = 0; i < starts_.size(); ++i) keepFinite(results_[i]);
  }

 private:
  void miss(size_t i) {
    const Vec3f& d = starts_[i].ray.direction;
    const Vec3f sky = stage_.paper ? *stage_.paper : light_.shown(d);
    results_[i].direct = withoutFireflies(sky, limit_ * 4);
  }

  void arrive(size_t i, float distance) {
    const PathStart& start = starts_[i];
    const Surface& s = surfaces_[i];
    lobes_[i] = lobesOf(s, -start.ray.direction);
    PathResult& result = results_[i];
    if (!isPlain(s, lobes_[i])) {
      result = goOnFrom(stage_, start, s, distance, seed_, brief_);
      return;
    }
    lit_[count_++] = i;
    carried_[i] = {1, 1, 1};
    if (stage_.haze > 0) {
      const float clear = clearAlong(stage_, s, distance);
      result.direct = light_.horizon(start.ray.direction) * (1 - clear);
      carried_[i] *= clear;
    }
    result.direct += carried_[i] * s.emissive * light_.shownGlow;
    result.albedo = lobes_[i].diffuse + lobes_[i].through + lobes_[i].coat;
    result.normal = s.normal;
    result.distance = distance;
  }

  Sampler sampler(size_t i) const { return {starts_[i].x, starts_[i].y, starts_[i].sample, seed_}; }

  /// Asks how open each lit surface is along the ray that `aim` gives it; a ray that goes nowhere
  /// is not asked.
  template <class Aim, class Add>
  void ask(Aim&& aim, Add&& add) {
    for (size_t k = 0; k < count_; ++k) {
      const size_t i = lit_[k];
      const Vec3f towards = aim(i);
      Ray& ray = rays_[k];
      ray = Ray();
      ray.origin = offsetFrom(surfaces_[i].point, surfaces_[i].facet, towards);
      ray.direction = towards;
      if (!(maxOf(values_[i]) > 0)) ray.to = 0;
    }
    answer(add);
  }

  /// Calls `add` with how open the ray of each lit surface is, where it goes anywhere.
  template <class Add>
  void answer(Add&& add) {
    float open[kMost];
    visibilityTogether(stage_, {rays_, count_}, open);
    for (size_t k = 0; k < count_; ++k) {
      const size_t i = lit_[k];
      if (!(rays_[k].to > 0)) continue;
      ++results_[i].rays;
      add(i, rays_[k].direction, open[k]);
    }
  }

  void addSun() {
    if (maxOf(light_.sun) <= 0) return;
    ask(
        [&](size_t i) {
          const Vec3f towards = light_.towardsSun(sampler(i).point(kSun));
          values_[i] = evaluate(surfaces_[i], lobes_[i], -starts_[i].ray.direction, towards);
          return towards;
        },
        [&](size_t i, const Vec3f&, float open) {
          results_[i].sun =
              withoutFireflies(carried_[i] * values_[i] * light_.sun * open, limit_ * 4);
        });
  }

  void addSky() {
    ask(
        [&](size_t i) {
          const PathStart& start = starts_[i];
          const Scatter next = scatter(surfaces_[i], lobes_[i], -start.ray.direction,
                                       std::min(sampler(i).number(kPick), 0.9999999f),
                                       pointOfBlock(start.x, start.y, start.sample, seed_));
          values_[i] = next.weight;
          return next.direction;
        },
        [&](size_t i, const Vec3f& direction, float open) {
          const Vec3f light = skyBehind(stage_, direction, open);
          results_[i].indirect = withoutFireflies(carried_[i] * values_[i] * light, limit_);
          results_[i].open = open;
        });
  }

  void addLamps() {
    if (stage_.emitters.empty()) return;
    for (size_t k = 0; k < count_; ++k) {
      const size_t i = lit_[k];
      const Sampler numbers = sampler(i);
      const LampRay lamp = rayToLamp(stage_, surfaces_[i], lobes_[i], -starts_[i].ray.direction,
                                     numbers.number(kLamp), numbers.point(kLampPoint));
      rays_[k] = lamp.ray;
      values_[i] = lamp.light;
      if (maxOf(lamp.light) <= 0) rays_[k].to = 0;
    }
    answer([&](size_t i, const Vec3f&, float open) {
      results_[i].indirect += withoutFireflies(carried_[i] * values_[i] * open, limit_);
    });
  }

  void goOnAlone() {
    for (size_t k = 0; k < count_; ++k) {
      const size_t i = lit_[k];
      const PathResult rest = goOn(stage_, starts_[i], surfaces_[i], lobes_[i], carried_[i], seed_);
      results_[i].direct += rest.direct;
      results_[i].indirect += rest.indirect;
      results_[i].rays += rest.rays;
    }
  }

  const Stage& stage_;
  const Light& light_;
  std::span<const PathStart> starts_;
  uint32_t seed_;
  bool brief_;
  PathResult* results_;
  float limit_;
  Ray rays_[kMost];
  Surface surfaces_[kMost];
  Lobes lobes_[kMost];
  Vec3f carried_[kMost], values_[kMost];
  /// The paths that are at a surface.
  size_t lit_[kMost], count_ = 0;
};

}  // namespace

void traceTogether(const Stage& stage, std::span<const PathStart> starts, uint32_t seed, bool brief,
                   PathResult* results) {
  Bundle(stage, starts, seed, brief, results).trace();
}

}  // namespace gable::rt
