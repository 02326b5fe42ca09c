// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "scene/flatten.h"

#include "base/hash.h"

namespace gable {
namespace {

uint64_t hashVec(uint64_t h, const Vec3& v) {
  return hashCombine(hashCombine(hashCombine(h, hashDouble(v.x)), hashDouble(v.y)),
                     hashDouble(v.z));
}

uint64_t hashFrame(uint64_t h, const Frame& f) {
  return hashVec(hashVec(hashVec(hashVec(h, f.origin), f.x), f.y), f.z);
}

uint64_t hashOf(const PlainValue& v) {
  return hashBytes(v.text, hashCombine(static_cast<uint64_t>(v.kind), hashDouble(v.number)));
}

uint64_t hashOf(const Scene& scene, const std::vector<uint32_t>& set) {
  uint64_t h = set.size();
  for (const uint32_t place : set) {
    const AttributeValue& a = scene.attributeValues[place];
    h = hashCombine(hashBytes(a.name, h), static_cast<uint64_t>(a.rows) << 32 | a.columns);
    for (const PlainValue& v : a.values) h = hashCombine(h, hashOf(v));
  }
  return h;
}

uint64_t hashOf(const SourcePlace& s) {
  return hashBytes(s.rule,
                   hashCombine(hashBytes(s.file), static_cast<uint64_t>(s.line) << 32 | s.column));
}

// The hashes of what leaves refer to, computed once each.
struct PoolHashes {
  std::vector<uint64_t> meshes, materialLists, names, sources, attributeSets;

  explicit PoolHashes(const Scene& s) {
    for (const MeshRef& m : s.meshes) meshes.push_back(m->contentHash());
    for (const auto& list : s.materialLists) {
      uint64_t h = list.size();
      for (const uint32_t m : list) {
        h = hashCombine(h, m < s.materials.size() ? contentHash(s.materials[m]) : 0);
      }
      materialLists.push_back(h);
    }
    for (const std::string& n : s.names) names.push_back(hashBytes(n));
    for (const SourcePlace& p : s.sources) sources.push_back(hashOf(p));
    for (const auto& a : s.attributeSets) attributeSets.push_back(hashOf(s, a));
  }
  static uint64_t at(const std::vector<uint64_t>& pool, uint32_t i) {
    return i < pool.size() ? pool[i] : 0;
  }
};

}  // namespace

std::vector<uint64_t> prototypeLeafCounts(const Scene& scene) {
  std::vector<uint64_t> counts;
  counts.reserve(scene.prototypes.size());
  for (const Prototype& p : scene.prototypes) {
    uint64_t n = p.leafCount;
    for (uint32_t i = 0; i < p.instanceCount; ++i) {
      n = saturatingAdd(n, counts[scene.instances[p.firstInstance + i].prototype]);
    }
    counts.push_back(n);
  }
  return counts;
}

uint64_t leafCount(const Scene& scene) {
  const std::vector<uint64_t> counts = prototypeLeafCounts(scene);
  uint64_t all = 0;
  for (const Root& r : scene.roots) all = saturatingAdd(all, counts[r.instance.prototype]);
  return all;
}

std::vector<PlacedLeaf> flatLeaves(const Scene& scene) {
  std::vector<PlacedLeaf> out;
  forEachLeaf(scene, [&](const Leaf& leaf, const Frame& world) { out.push_back({&leaf, world}); });
  return out;
}

Mesh worldMesh(const Scene& scene, const PlacedLeaf& placed) {
  return transformed(*scene.meshes[placed.leaf->mesh], placed.leaf->scale, placed.world);
}

uint32_t materialIndexOf(const Scene& scene, const Leaf& leaf, uint32_t slot) {
  if (leaf.materials >= scene.materialLists.size()) return kNoMaterial;
  const std::vector<uint32_t>& list = scene.materialLists[leaf.materials];
  if (list.empty()) return kNoMaterial;
  const uint32_t m = slot < list.size() ? list[slot] : list[0];
  return m < scene.materials.size() ? m : kNoMaterial;
}

const Material& materialOf(const Scene& scene, const Leaf& leaf, uint32_t slot) {
  static const Material kDefault;
  const uint32_t m = materialIndexOf(scene, leaf, slot);
  return m == kNoMaterial ? kDefault : scene.materials[m];
}

uint64_t contentHash(const Scene& scene) {
  const PoolHashes pools(scene);
  uint64_t h = scene.roots.size();
  for (const Root& root : scene.roots) {
    h = hashCombine(h, PoolHashes::at(pools.names, root.name));
    const Prototype& p = scene.prototypes[root.instance.prototype];
    forEachLeaf(scene, p, root.instance.frame, [&](const Leaf& leaf, const Frame& world) {
      // What shows nothing stands nowhere.
      if (!scene.meshes[leaf.mesh]->empty()) h = hashVec(hashFrame(h, world), leaf.scale);
      h = hashCombine(h, pools.meshes[leaf.mesh]);
      h = hashCombine(h, PoolHashes::at(pools.materialLists, leaf.materials));
      h = hashCombine(h, PoolHashes::at(pools.names, leaf.name));
      h = hashCombine(h, PoolHashes::at(pools.sources, leaf.source));
      h = hashCombine(h,
                      leaf.attributes ? PoolHashes::at(pools.attributeSets, leaf.attributes) : 0);
    });
  }
  for (const Report& r : scene.reports) h = hashCombine(hashBytes(r.key, h), hashOf(r.value));
  for (const std::string& p : scene.prints) h = hashBytes(p, h);
  h = hashCombine(h, scene.geoOrigin.present ? 1 : 0);
  h = hashCombine(h, hashDouble(scene.geoOrigin.longitude));
  return hashCombine(h, hashDouble(scene.geoOrigin.latitude));
}

uint64_t saturatingMultiply(uint64_t a, uint64_t b) {
  uint64_t product = 0;
  return __builtin_mul_overflow(a, b, &product) ? ~uint64_t{0} : product;
}

}  // namespace gable
