// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/face_filter.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/work.h"

namespace gable {
namespace {

// Sums and products of such numbers stay finite; a model of this size is a mistake anyway.
constexpr double kFarthest = 1e12;

bool usable(const Vec3& p) {
  return std::fabs(p.x) < kFarthest && std::fabs(p.y) < kFarthest && std::fabs(p.z) < kFarthest;
}

}  // namespace

bool FaceFilter::accept(const std::vector<uint32_t>& corners) {
  work(1 + corners.size());
  kept_.clear();
  ++dropped_;
  for (uint32_t i = 0; i < corners.size(); ++i) {
    if (!usable(positions_[corners[i]])) return false;
    if (kept_.empty() || positions_[corners[i]] != positions_[corners[kept_.back()]]) {
      kept_.push_back(i);
    }
  }
  while (kept_.size() > 1 &&
         positions_[corners[kept_.back()]] == positions_[corners[kept_.front()]]) {
    kept_.pop_back();
  }
  if (kept_.size() < 3) return false;
  Vec3 sum;
  const Vec3 origin = positions_[corners[kept_[0]]];
  for (size_t i = 1; i + 1 < kept_.size(); ++i) {
    sum +=
        cross(positions_[corners[kept_[i]]] - origin, positions_[corners[kept_[i + 1]]] - origin);
  }
  if (!(dot(sum, sum) > 0)) return false;
  --dropped_;
  return true;
}

uint32_t FaceFilter::position(uint32_t index) {
  if (index >= numbers_.size()) numbers_.resize(positions_.size(), MeshBuilder::kNoPosition);
  uint32_t& number = numbers_[index];
  if (number == MeshBuilder::kNoPosition) {
    number = builder_.addPosition(direction(positions_[index]));
  }
  return number;
}

Error tooManyOf(const char* what, size_t most, const AssetOptions& options, const char* hint) {
  return {"asset-too-large",
          "'" + options.path + "' has more than " + std::to_string(most) + " " + what, hint};
}

void divideSlots(Mesh& mesh, Asset& asset) {
  const bool named = std::any_of(asset.groups.begin(), asset.groups.end(),
                                 [](const std::string& name) { return !name.empty(); });
  if (!named || asset.faceGroups.size() != mesh.faceCount()) return;
  std::map<std::pair<uint16_t, uint32_t>, size_t> slots;
  std::vector<std::pair<uint16_t, uint32_t>> pairs;
  std::vector<uint16_t> slotOf;
  for (size_t f = 0; f < mesh.faceCount(); ++f) {
    work();
    const std::pair key{mesh.faces[f].materialSlot, asset.faceGroups[f]};
    const auto [at, fresh] = slots.try_emplace(key, slots.size());
    if (fresh) pairs.push_back(key);
    if (pairs.size() > kMostMaterials) {
      asset.warnings.push_back("the groups of the file are too many to be kept");
      return;
    }
    slotOf.push_back(static_cast<uint16_t>(at->second));
  }
  std::vector<Material> materials;
  for (const auto& [material, group] : pairs) {
    workMemory(sizeof(Material));
    materials.push_back(material < asset.materials.size() ? asset.materials[material] : Material{});
    asset.slotGroups.push_back(asset.groups[group]);
  }
  asset.materials = std::move(materials);
  for (size_t f = 0; f < mesh.faceCount(); ++f) mesh.faces[f].materialSlot = slotOf[f];
}

Result<Asset> finishAsset(Mesh mesh, Asset asset, const AssetOptions& options) {
  if (mesh.empty()) {
    return Error{"asset-empty", "'" + options.path + "' has no faces", {}};
  }
  GABLE_CHECK(mesh.valid());
  asset.bounds = mesh.bounds();
  asset.mesh = makeRef<Mesh>(std::move(mesh));
  if (asset.materials.empty()) asset.materials.emplace_back();
  return asset;
}

}  // namespace gable
