// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Counting visits what is stored, not what is flattened.

#include "io/exporters/draw_plan.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "base/json.h"
#include "base/work.h"
#include "io/exporters/draw_list.h"
#include "material/library.h"

namespace gable {

namespace {

/// From so many places on, instances are smaller than merged copies of even a small mesh.
constexpr uint32_t kOftenEnough = 3;
// Each geometry of its own is a draw call, or several; beyond so many only those that save most.
constexpr size_t kMostOwn = 100;

bool isWhole(const Vec3& scale) {
  const auto one = [](double s) { return std::abs(std::abs(s) - 1) < 1e-3; };
  return one(scale.x) && one(scale.y) && one(scale.z);
}

uint32_t rgb8(const Vec3& c) {
  const auto byte = [](double v) {
    return static_cast<uint32_t>(std::lround(std::clamp(v, 0.0, 1.0) * 255));
  };
  return byte(c.x) | byte(c.y) << 8 | byte(c.z) << 16 | 0xff000000u;
}

DrawLook lookOf(const Material& m) {
  DrawLook l;
  const TextureMap& map = m.map(TextureLayer::Color);
  l.map = map.path;
  l.laid = isLaid(m);
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

}  // namespace

uint64_t DrawLook::hash() const {
  uint64_t h = hashBytes(map);
  for (const double v : {su, sv, tu, tv, rw}) h = hashCombine(h, hashDouble(v));
  for (const int v : {roughness, metallic, opacity, cutoff}) {
    h = hashCombine(h, static_cast<uint64_t>(v));
  }
  return hashCombine(h, uint64_t{emissive} << 1 | uint64_t{laid});
}

void writeLook(JsonWriter& json, const DrawLook& l) {
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

DrawPlan::DrawPlan(const Scene& scene)
    : scene_(scene), leavesOf_(prototypeLeafCounts(scene)), paints_(scene.materials.size() + 1) {
  for (const std::vector<uint32_t>& list : scene.materialLists) {
    laidLists_.push_back(
        std::any_of(list.begin(), list.end(), [&](uint32_t m) { return isLaidPaint(m); }));
  }
  countPrototypes();
  countMeshes();
  findOften();
  findPaints();
  for (const Root& r : scene.roots) {
    all_ = saturatingAdd(all_, leavesOf_[r.instance.prototype]);
  }
}

uint64_t DrawPlan::leaves() const { return std::min(all_, kMostLeaves); }

bool DrawPlan::isOften(const Leaf& leaf) const {
  if (leaf.mesh >= kFirstMesh && !often_[leaf.mesh]) return false;
  return isWhole(leaf.scale) || !isLaidLeaf(leaf);
}

bool DrawPlan::isLaidPaint(uint32_t number) const {
  return number < scene_.materials.size() && isLaid(scene_.materials[number]);
}

uint32_t DrawPlan::paintOf(const Leaf& leaf, uint16_t slot) const {
  const uint32_t material = materialIndexOf(scene_, leaf, slot);
  return material == kNoMaterial ? lastPaint() : material;
}

BatchKey DrawPlan::keyOf(const Leaf& leaf, uint16_t slot, bool often, uint32_t look) {
  const bool mirrored = leaf.scale.x * leaf.scale.y * leaf.scale.z < 0;
  return {look, often ? leaf.mesh : kMerged, often ? slot : uint16_t{0}, often && mirrored};
}

const BatchTally* DrawPlan::tally(const BatchKey& byGroup) const {
  const auto found = tallies_.find(byGroup);
  return found == tallies_.end() ? nullptr : &found->second;
}

// How often each prototype stands.
void DrawPlan::countPrototypes() {
  times_.assign(scene_.prototypes.size(), 0);
  for (const Root& r : scene_.roots) ++times_[r.instance.prototype];
  for (size_t p = scene_.prototypes.size(); p-- > 0;) {
    const Prototype& prototype = scene_.prototypes[p];
    for (uint32_t i = 0; i < prototype.instanceCount; ++i) {
      uint64_t& inner = times_[scene_.instances[prototype.firstInstance + i].prototype];
      inner = saturatingAdd(inner, times_[p]);
    }
  }
}

void DrawPlan::countMeshes() {
  uses_.assign(scene_.meshes.size(), 0);
  for (size_t p = 0; p < scene_.prototypes.size(); ++p) {
    const Prototype& prototype = scene_.prototypes[p];
    for (uint32_t i = 0; i < prototype.leafCount; ++i) {
      uint64_t& used = uses_[scene_.leaves[prototype.firstLeaf + i].mesh];
      used = saturatingAdd(used, times_[p]);
    }
  }
}

void DrawPlan::findOften() {
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

void DrawPlan::findPaints() {
  static const Material kPlain;
  std::map<DrawLook, uint32_t> first;
  for (uint32_t m = 0; m < paints_.size(); ++m) {
    work();
    const Material& material = m < scene_.materials.size() ? scene_.materials[m] : kPlain;
    DrawLook look = lookOf(material);
    const uint32_t group = first.try_emplace(look, m).first->second;
    paints_[m] = {std::move(look), rgb8(material.color), group};
  }
}

// How much each batch will hold, by what is stored.
void DrawPlan::tallyBatches() {
  for (size_t p = 0; p < scene_.prototypes.size(); ++p) {
    const Prototype& prototype = scene_.prototypes[p];
    work(prototype.leafCount + 1);
    if (times_[p] == 0) continue;
    for (uint32_t i = 0; i < prototype.leafCount; ++i) {
      count(scene_.leaves[prototype.firstLeaf + i], times_[p]);
    }
  }
}

void DrawPlan::count(const Leaf& leaf, uint64_t times) {
  const auto [at, fresh] = slots_.try_emplace(leaf.mesh);
  if (fresh) at->second = slotTallies(*scene_.meshes[leaf.mesh]);
  const bool often = isOften(leaf);
  for (const SlotTally& slot : at->second) {
    const uint32_t group = paints_[paintOf(leaf, slot.slot)].group;
    BatchTally& sum = tallies_[keyOf(leaf, slot.slot, often, group)];
    sum.instances += times;
    sum.corners += times * slot.corners;
    sum.triangles += times * slot.triangles;
  }
}

}  // namespace gable
