// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A leaf that is left out keeps its place with an empty mesh, so that numbers of leaves stay what
// derivation trees and viewers take them for. An instance whose frame is broken shows an empty twin
// of its prototype: the same leaves without meshes, in the same order. Twins come before all other
// prototypes, since an instance's prototype has a smaller index than the one that holds it.
#include "scene/sound.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/parallel_work.h"
#include "scene/flatten.h"

namespace gable {
namespace {

bool fits(double v) { return std::fabs(v) <= kFarthest; }
bool fits(const Vec3& v) { return fits(v.x) && fits(v.y) && fits(v.z); }

// Chains of turns drift from rigid by rounding alone.
constexpr double kRigid = 1e-3;

bool isRigid(const Frame& f) {
  const auto is = [](double v, double wanted) { return std::fabs(v - wanted) <= kRigid; };
  return is(dot(f.x, f.x), 1) && is(dot(f.y, f.y), 1) && is(dot(f.z, f.z), 1) &&
         is(dot(f.x, f.y), 0) && is(dot(f.y, f.z), 0) && is(dot(f.z, f.x), 0);
}

bool isSound(const Frame& f) { return fits(f.origin) && (!f.turned || isRigid(f)); }

// Long enough, and short enough, to be scaled and turned without losing its direction; or open.
bool isSoundNormal(const Vec3& n) {
  const double square = dot(n, n);
  return (square > 1e-12 && square < 1e12) || n == Vec3{};
}

struct MeshState {
  /// The largest coordinate along each axis.
  Vec3 most;
  bool sound = true;
  /// Values to replace.
  uint64_t broken = 0;
};

MeshState stateOf(const Mesh& m) {
  work(1 + m.positions.size() + m.normals.size());
  MeshState s;
  for (const Vec3& p : m.positions) {
    s.sound = s.sound && fits(p);
    for (size_t i = 0; i < 3; ++i) s.most[i] = std::max(s.most[i], std::fabs(p[i]));
  }
  for (const Vec3& n : m.normals) s.broken += isSoundNormal(n) ? 0 : 1;
  for (const auto& uvs : m.uvs) {
    for (const Vec2& uv : uvs) s.broken += fits(uv.x) && fits(uv.y) ? 0 : 1;
  }
  return s;
}

Mesh mended(const Mesh& m) {
  Mesh out = m;
  for (Vec3& n : out.normals) n = isSoundNormal(n) ? n : Vec3{};
  for (auto& uvs : out.uvs) {
    for (Vec2& uv : uvs) uv = fits(uv.x) && fits(uv.y) ? uv : Vec2{};
  }
  return out;
}

// Calls `visit(value, what it is without a rule's doing)` for every number.
template <class AnyMaterial, class Visit>
void forEachNumber(AnyMaterial& m, Visit&& visit) {
  const Material plain;
  const TextureMap plainMap;
  for (size_t i = 0; i < 3; ++i) {
    visit(m.color[i], plain.color[i]);
    visit(m.ambient[i], plain.ambient[i]);
    visit(m.specular[i], plain.specular[i]);
    visit(m.emissive[i], plain.emissive[i]);
  }
  visit(m.opacity, plain.opacity);
  visit(m.reflectivity, plain.reflectivity);
  visit(m.shininess, plain.shininess);
  visit(m.bumpValue, plain.bumpValue);
  visit(m.metallic, plain.metallic);
  visit(m.roughness, plain.roughness);
  visit(m.opacityCutoff, plain.opacityCutoff);
  for (auto& map : m.maps) {
    visit(map.su, plainMap.su);
    visit(map.sv, plainMap.sv);
    visit(map.tu, plainMap.tu);
    visit(map.tv, plainMap.tv);
    visit(map.rw, plainMap.rw);
  }
}

uint64_t brokenNumbers(const Material& m) {
  uint64_t n = 0;
  forEachNumber(m, [&](const double& v, double) { n += fits(v) ? 0 : 1; });
  return n;
}

class Mender {
 public:
  Mender(const Scene& scene, unsigned jobs) : scene_(scene), meshes_(scene.meshes.size()) {
    parallelWork((meshes_.size() + kMeshesATask - 1) / kMeshesATask, jobs,
                 [&](size_t task, unsigned) {
                   const size_t end = std::min(meshes_.size(), (task + 1) * kMeshesATask);
                   for (size_t m = task * kMeshesATask; m < end; ++m)
                     meshes_[m] = stateOf(*scene.meshes[m]);
                 });
  }

  // Most scenes are sound, which takes no more than a look at each thing by whoever has time.
  bool isSoundScene(unsigned jobs) const {
    const auto isSoundMesh = [](const MeshState& m) { return m.broken == 0; };
    const auto isSoundMaterial = [](const Material& m) { return brokenNumbers(m) == 0; };
    const auto stands = [](const auto& root) { return isSound(root.instance.frame); };
    return std::ranges::all_of(meshes_, isSoundMesh) &&
           std::ranges::all_of(scene_.materials, isSoundMaterial) &&
           std::ranges::all_of(scene_.roots, stands) &&
           allOf(scene_.instances, jobs, [](const Instance& i) { return isSound(i.frame); }) &&
           allOf(scene_.leaves, jobs, [&](const Leaf& l) { return isSoundLeaf(l); });
  }

  SoundScene mend() {
    counts_ = prototypeLeafCounts(scene_);
    measure();
    if (!broken_) return {};
    result_.scene = scene_;
    Scene& out = *result_.scene;
    mendValues(out);
    const auto none = static_cast<uint32_t>(out.meshes.size());
    out.meshes.push_back(makeRef<Mesh>(Mesh{}));
    for (size_t i = 0; i < scene_.leaves.size(); ++i) {
      if (!isSoundLeaf(scene_.leaves[i])) clear(out.leaves[i], none);
    }
    if (!twins_.empty()) addTwins(out, none);
    return std::move(result_);
  }

 private:
  static constexpr size_t kMeshesATask = 256, kThingsATask = 1 << 13;

  template <class T, class Test>
  static bool allOf(const std::vector<T>& all, unsigned jobs, Test&& test) {
    std::atomic<bool> holds{true};
    parallelWork((all.size() + kThingsATask - 1) / kThingsATask, jobs, [&](size_t task, unsigned) {
      work(kThingsATask);
      const auto begin = all.begin() + static_cast<ptrdiff_t>(task * kThingsATask);
      const size_t count = std::min(kThingsATask, all.size() - task * kThingsATask);
      if (!std::all_of(begin, begin + static_cast<ptrdiff_t>(count), test)) holds = false;
    });
    return holds;
  }

  bool isSoundLeaf(const Leaf& l) const {
    const MeshState& m = meshes_[l.mesh];
    return m.sound && isSound(l.frame) && fits(l.scale) && fits(scaled(m.most, l.scale));
  }

  static void clear(Leaf& l, uint32_t none) {
    l.mesh = none;
    l.frame = {};
    l.scale = {1, 1, 1};
  }

  void leaveOut(uint64_t leaves, uint32_t first) {
    broken_ = true;
    result_.leavesLeftOut = saturatingAdd(result_.leavesLeftOut, leaves);
    if (first < result_.firstLeft) result_.firstLeft = first;
  }

  // What is broken, and how often it stands; marks the prototypes that need a twin.
  void measure() {
    for (const MeshState& m : meshes_) {
      result_.valuesReplaced += m.broken;
      broken_ = broken_ || m.broken > 0;
    }
    for (const Material& m : scene_.materials) {
      const uint64_t n = brokenNumbers(m);
      result_.valuesReplaced += n;
      broken_ = broken_ || n > 0;
    }
    std::vector<uint64_t> times(scene_.prototypes.size());
    const auto show = [&](const Instance& in, uint64_t often) {
      uint64_t& inner = times[in.prototype];
      if (isSound(in.frame)) {
        inner = saturatingAdd(inner, often);
        return;
      }
      leaveOut(saturatingMultiply(often, counts_[in.prototype]),
               scene_.prototypes[in.prototype].firstLeaf);
      twins_.resize(scene_.prototypes.size());
      twins_[in.prototype] = true;
    };
    for (const Root& r : scene_.roots) show(r.instance, 1);
    for (size_t p = scene_.prototypes.size(); p-- > 0;) {
      const Prototype& prototype = scene_.prototypes[p];
      for (uint32_t i = 0; i < prototype.instanceCount; ++i) {
        const Instance& in = scene_.instances[prototype.firstInstance + i];
        show(in, times[p]);
        if (!twins_.empty() && twins_[p]) twins_[in.prototype] = true;
      }
      for (uint32_t i = 0; i < prototype.leafCount; ++i) {
        const uint32_t leaf = prototype.firstLeaf + i;
        if (!isSoundLeaf(scene_.leaves[leaf])) leaveOut(times[p], leaf);
      }
    }
  }

  void mendValues(Scene& out) const {
    for (size_t i = 0; i < meshes_.size(); ++i) {
      const MeshState& m = meshes_[i];
      if (m.sound && m.broken > 0) {
        out.meshes[i] = makeRef<Mesh>(mended(*out.meshes[i]));
      }
    }
    for (Material& m : out.materials) {
      forEachNumber(m, [](double& v, double plain) { v = fits(v) ? v : plain; });
    }
  }

  void addTwins(Scene& out, uint32_t none) const {
    // Each prototype's new number, and its twin's.
    std::vector<uint32_t> twinOf(twins_.size());
    uint32_t shift = 0;
    for (size_t p = 0; p < twins_.size(); ++p) twinOf[p] = twins_[p] ? shift++ : 0;
    const auto renumber = [&](Instance& in) {
      const bool sound = isSound(in.frame);
      in.prototype = sound ? in.prototype + shift : twinOf[in.prototype];
      if (!sound) in.frame = {};
    };
    for (Root& r : out.roots) renumber(r.instance);
    for (Instance& in : out.instances) renumber(in);
    std::vector<Prototype> all;
    for (size_t p = 0; p < twins_.size(); ++p) {
      if (!twins_[p]) continue;
      Prototype twin = scene_.prototypes[p];
      twin.firstLeaf = static_cast<uint32_t>(out.leaves.size());
      twin.firstInstance = static_cast<uint32_t>(out.instances.size());
      for (uint32_t i = 0; i < twin.leafCount; ++i) {
        Leaf l = scene_.leaves[scene_.prototypes[p].firstLeaf + i];
        clear(l, none);
        out.leaves.push_back(l);
      }
      for (uint32_t i = 0; i < twin.instanceCount; ++i) {
        Instance in = scene_.instances[scene_.prototypes[p].firstInstance + i];
        in.prototype = twinOf[in.prototype];
        in.frame = {};
        out.instances.push_back(in);
      }
      all.push_back(twin);
    }
    all.insert(all.end(), out.prototypes.begin(), out.prototypes.end());
    out.prototypes = std::move(all);
  }

  const Scene& scene_;
  std::vector<uint64_t> counts_;
  std::vector<MeshState> meshes_;
  /// By prototype, where any instance is broken.
  std::vector<bool> twins_;
  bool broken_ = false;
  SoundScene result_;
};

}  // namespace

SoundScene soundOf(const Scene& scene, unsigned jobs) {
  Mender mender(scene, jobs);
  return mender.isSoundScene(jobs) ? SoundScene{} : mender.mend();
}

}  // namespace gable
