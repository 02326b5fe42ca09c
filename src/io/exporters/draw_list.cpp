// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// One pass counts how often each mesh stands, a second one sorts leaves into batches. A batch is
// named by what a draw call cannot change: geometry, textures and the class of the material.

#include "io/exporters/draw_list.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <tuple>

#include "base/json.h"
#include "base/work.h"
#include "io/exporters/surface.h"
#include "scene/flatten.h"

namespace gable {

namespace {

/// From so many places on, instances are smaller than merged copies of even a small mesh.
constexpr uint32_t kOftenEnough = 3;
// Each geometry of its own is a draw call, or several; beyond so many only those that save most.
constexpr size_t kMostOwn = 100;
constexpr uint32_t kMerged = 0xffffffff;
/// Stands for the zero scale of a flat shape, which no normal survives.
constexpr double kFlat = 1e-5;

// The part of a material that a batch has in common. Roughness and the like in steps nobody sees.
struct Look {
  std::string map;
  double su = 1, sv = 1, tu = 0, tv = 0, rw = 0;
  int roughness = 10, metallic = 0, opacity = 20;
  int cutoff = -1;
  uint32_t emissive = 0;
  auto tie() const {
    return std::tie(map, su, sv, tu, tv, rw, roughness, metallic, opacity, cutoff, emissive);
  }
  bool operator<(const Look& o) const { return tie() < o.tie(); }
};

uint32_t rgb8(const Vec3& c) {
  const auto byte = [](double v) {
    return static_cast<uint32_t>(std::lround(std::clamp(v, 0.0, 1.0) * 255));
  };
  return byte(c.x) | byte(c.y) << 8 | byte(c.z) << 16 | 0xff000000u;
}

Look lookOf(const Material& m) {
  Look l;
  const TextureMap& map = m.map(TextureLayer::Color);
  l.map = map.path;
  if (!l.map.empty())
    std::tie(l.su, l.sv, l.tu, l.tv, l.rw) = std::tie(map.su, map.sv, map.tu, map.tv, map.rw);
  l.roughness = static_cast<int>(std::lround(std::clamp(m.roughness, 0.0, 1.0) * 10));
  l.metallic = static_cast<int>(std::lround(std::clamp(m.metallic, 0.0, 1.0) * 10));
  if (m.opacityMode == OpacityMode::Mask)
    l.cutoff = static_cast<int>(std::lround(m.opacityCutoff * 20));
  else if (m.opacityMode == OpacityMode::Blend)
    l.opacity = static_cast<int>(std::lround(std::clamp(m.opacity, 0.0, 1.0) * 20));
  l.emissive = rgb8(m.emissive) & 0xffffffu;
  return l;
}

struct BatchKey {
  uint32_t look = 0;
  uint32_t mesh = kMerged;
  uint16_t slot = 0;
  bool mirrored = false;
  auto tie() const { return std::tie(look, mesh, slot, mirrored); }
  bool operator<(const BatchKey& o) const { return tie() < o.tie(); }
};

struct Batch {
  std::vector<float> positions, normals, uvs, leaves;
  std::vector<uint32_t> colors, indices;
  std::vector<float> matrices, instanceLeaves;
  std::vector<uint32_t> instanceColors;
};

float narrow(double v) { return static_cast<float>(v); }

void push(std::vector<float>& out, const Vec3& v) {
  out.push_back(narrow(v.x));
  out.push_back(narrow(v.y));
  out.push_back(narrow(v.z));
}

class Builder {
 public:
  explicit Builder(const Scene& scene) : scene_(scene), looks_(scene.materials.size() + 1) {}

  std::string build() {
    countMeshes();
    findOften();
    findDrawn();
    for (const Root& r : scene_.roots) {
      addPrototype(scene_.prototypes[r.instance.prototype], r.instance.frame);
    }
    return bytes(made_);
  }

 private:
  // As forEachLeaf, but it ends: instances of instances can stand for more than time allows.
  void addPrototype(const Prototype& p, const Frame& world) {
    const auto addLeaf = [&](uint32_t leaf, const Frame& at, size_t) {
      if (made_ >= kMostLeaves) return;
      const Leaf& l = scene_.leaves[leaf];
      add(l, at * l.frame, made_++);
    };
    const auto enter = [&](const Instance& instance, const Frame&, size_t) {
      return made_ < kMostLeaves && drawn_[instance.prototype];
    };
    walk(scene_, p, world, addLeaf, enter);
  }

  // Of prototypes without leaves there can be as many instances as of others.
  void findDrawn() {
    for (const Prototype& p : scene_.prototypes) {
      bool drawn = p.leafCount > 0;
      for (uint32_t i = 0; i < p.instanceCount && !drawn; ++i) {
        drawn = drawn_[scene_.instances[p.firstInstance + i].prototype];
      }
      drawn_.push_back(drawn);
    }
  }

  void countMeshes() {
    uses_.assign(scene_.meshes.size(), 0);
    // Expanded by prototype, so that the pass costs what is stored.
    std::vector<uint64_t> times(scene_.prototypes.size(), 0);
    for (const Root& r : scene_.roots) ++times[r.instance.prototype];
    for (size_t p = scene_.prototypes.size(); p-- > 0;) {
      const Prototype& prototype = scene_.prototypes[p];
      for (uint32_t i = 0; i < prototype.instanceCount; ++i) {
        uint64_t& inner = times[scene_.instances[prototype.firstInstance + i].prototype];
        inner = saturatingAdd(inner, times[p]);
      }
      for (uint32_t i = 0; i < prototype.leafCount; ++i) {
        uint64_t& used = uses_[scene_.leaves[prototype.firstLeaf + i].mesh];
        used = saturatingAdd(used, times[p]);
      }
    }
  }

  void findOften() {
    std::vector<std::pair<double, uint32_t>> own;
    for (uint32_t m = kFirstMesh; m < uses_.size(); ++m) {
      if (uses_[m] < kOftenEnough) continue;
      const double copies = static_cast<double>(uses_[m] - 1);
      own.push_back({-copies * static_cast<double>(scene_.meshes[m]->positions.size()), m});
    }
    std::sort(own.begin(), own.end());
    if (own.size() > kMostOwn) own.resize(kMostOwn);
    often_.assign(uses_.size(), false);
    for (const auto& [saved, m] : own) often_[m] = true;
  }

  uint32_t lookIndex(uint32_t material, const Material& m) {
    const size_t at = material == kNoMaterial ? scene_.materials.size() : material;
    if (looks_[at] == 0) {
      const auto [found, fresh] = lookNames_.try_emplace(lookOf(m), lookNames_.size());
      looks_[at] = static_cast<uint32_t>(found->second) + 1;
    }
    return looks_[at] - 1;
  }

  const Surface& surfaceOf(uint32_t mesh) {
    if (uses_[mesh] == 1) {
      single_.build(*scene_.meshes[mesh], triangulator_);
      return single_;
    }
    const auto [at, fresh] = surfaces_.try_emplace(mesh);
    if (fresh) at->second.build(*scene_.meshes[mesh], triangulator_);
    return at->second;
  }

  void add(const Leaf& leaf, const Frame& world, uint32_t number) {
    const bool often = leaf.mesh < kFirstMesh || often_[leaf.mesh];
    const bool mirrored = leaf.scale.x * leaf.scale.y * leaf.scale.z < 0;
    const Surface& surface = surfaceOf(leaf.mesh);
    if (!often) work(surface.corners.size());
    for (const SurfacePart& part : surface.parts) {
      const uint32_t material = materialIndexOf(scene_, leaf, part.slot);
      const Material& m = materialOf(scene_, leaf, part.slot);
      BatchKey key{lookIndex(material, m), often ? leaf.mesh : kMerged,
                   often ? part.slot : uint16_t{0}, often && mirrored};
      Batch& batch = batches_[key];
      if (!often) {
        addPart(batch, leaf.mesh, surface, part, world, leaf.scale, rgb8(m.color), narrow(number));
        continue;
      }
      if (batch.positions.empty()) {
        const Vec3 scale{mirrored ? -1.0 : 1.0, 1, 1};
        addPart(batch, leaf.mesh, surface, part, {}, scale, 0xffffffffu, 0);
      }
      addInstance(batch, leaf, world, mirrored);
      batch.instanceColors.push_back(rgb8(m.color));
      batch.instanceLeaves.push_back(narrow(number));
    }
  }

  // The geometry of a mirrored batch is mirrored in x itself, so the matrix takes that back: what a
  // graphics card gets never mirrors.
  static void addInstance(Batch& batch, const Leaf& leaf, const Frame& world, bool mirrored) {
    const auto whole = [](double s) { return std::abs(s) < kFlat ? kFlat : s; };
    const Vec3 x = world.x * (whole(leaf.scale.x) * (mirrored ? -1 : 1));
    for (const Vec3& column : {x, world.y * whole(leaf.scale.y), world.z * whole(leaf.scale.z)}) {
      push(batch.matrices, column);
      batch.matrices.push_back(0);
    }
    push(batch.matrices, world.origin);
    batch.matrices.push_back(1);
  }

  void addPart(Batch& batch, uint32_t mesh, const Surface& surface, const SurfacePart& part,
               const Frame& world, const Vec3& scale, uint32_t color, float leaf) {
    const Mesh& m = *scene_.meshes[mesh];
    const bool turned = scale.x * scale.y * scale.z < 0;
    for (uint32_t f = part.firstFace; f < part.firstFace + part.faceCount; ++f) {
      const SurfaceFace& face = surface.faces[f];
      const auto base = static_cast<uint32_t>(batch.positions.size() / 3);
      for (uint32_t v = face.firstVertex; v < face.firstVertex + face.vertexCount; ++v) {
        const uint32_t corner = surface.corners[v];
        push(batch.positions, world.point(scaled(m.at(corner), scale)));
        push(batch.normals, world.direction(scaledNormal(surface.normals[v], scale)));
        const Vec2 uv = m.hasUv(0) ? m.uvs[0][corner] : Vec2{};
        batch.uvs.push_back(narrow(uv.x));
        batch.uvs.push_back(narrow(uv.y));
        batch.leaves.push_back(leaf);
        batch.colors.push_back(color);
      }
      for (uint32_t t = 0; t < face.triangleCount; ++t) {
        const auto& tri = surface.triangles[face.firstTriangle + t];
        for (int c = 0; c < 3; ++c) batch.indices.push_back(base + tri[turned ? 2 - c : c]);
      }
    }
  }

  template <class T>
  void section(JsonWriter& json, const char* name, const std::vector<T>& data) {
    if (data.empty()) return;
    json.key(name).beginArray().value(static_cast<uint64_t>(blob_.size()));
    json.value(static_cast<uint64_t>(data.size())).endArray();
    blob_.append(reinterpret_cast<const char*>(data.data()), data.size() * sizeof(T));
  }

  std::vector<Look> looksInOrder() const {
    std::vector<Look> looks(lookNames_.size());
    for (const auto& [look, index] : lookNames_) looks[index] = look;
    return looks;
  }

  static void writeLook(JsonWriter& json, const Look& l) {
    json.beginObject().key("roughness").value(l.roughness / 10.0);
    json.key("metallic").value(l.metallic / 10.0);
    if (l.opacity < 20) json.key("opacity").value(l.opacity / 20.0);
    if (l.cutoff >= 0) json.key("cutoff").value(l.cutoff / 20.0);
    if (l.emissive) json.key("emissive").value(l.emissive);
    if (!l.map.empty()) {
      json.key("map").value(l.map).key("uv").beginArray();
      json.value(l.su).value(l.sv).value(l.tu).value(l.tv).value(l.rw).endArray();
    }
    json.endObject();
  }

  std::string bytes(uint32_t leaves) {
    const std::vector<Look> looks = looksInOrder();
    std::string text;
    JsonWriter json(text);
    json.beginObject().key("leaves").value(leaves);
    json.key("truncated").value(leafCount(scene_) > leaves);
    json.key("looks").beginArray();
    for (const Look& l : looks) writeLook(json, l);
    json.endArray().key("batches").beginArray();
    for (const auto& [key, b] : batches_) {
      if (b.indices.empty()) continue;
      json.beginObject().key("look").value(key.look);
      section(json, "position", b.positions);
      section(json, "normal", b.normals);
      if (!looks[key.look].map.empty()) section(json, "uv", b.uvs);
      section(json, "index", b.indices);
      if (key.mesh == kMerged) {
        section(json, "color", b.colors);
        section(json, "leaf", b.leaves);
      } else {
        section(json, "matrix", b.matrices);
        section(json, "color", b.instanceColors);
        section(json, "leaf", b.instanceLeaves);
      }
      json.endObject();
    }
    json.endArray().endObject();
    text.append((4 - text.size() % 4) % 4, ' ');
    const auto size = static_cast<uint32_t>(text.size());
    std::string out = "GBL1";
    out.append(reinterpret_cast<const char*>(&size), sizeof size);
    return out + text + blob_;
  }

  const Scene& scene_;
  uint32_t made_ = 0;
  /// By prototype: whether there is a leaf in it.
  std::vector<bool> drawn_;
  FaceTriangulator triangulator_;
  std::vector<uint64_t> uses_;
  std::vector<bool> often_;
  /// By material, the default one last: one more than the look, 0 for not asked yet.
  std::vector<uint32_t> looks_;
  std::map<Look, size_t> lookNames_;
  /// Of meshes that stand more than once; of the others only the last.
  std::map<uint32_t, Surface> surfaces_;
  Surface single_;
  std::map<BatchKey, Batch> batches_;
  std::string blob_;
};

}  // namespace

std::string drawList(const Scene& scene) { return Builder(scene).build(); }

}  // namespace gable
