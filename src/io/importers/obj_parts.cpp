// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/obj_parts.h"

#include <algorithm>
#include <unordered_map>

#include "base/work.h"
#include "io/importers/face_filter.h"
#include "io/importers/mtl_file.h"

namespace gable {
namespace {

constexpr uint32_t kNone = ObjCorner::kNone;
constexpr size_t kMostMaterialFiles = 1000;

class PartBuilder {
 public:
  PartBuilder(const ObjFile& file, std::span<const uint32_t> faces, const ObjMaterials& materials,
              const ObjPartWishes& wishes, bool zUp)
      : file_(file),
        faces_(faces),
        materials_(materials),
        wishes_(wishes),
        used_(positionsOf(faces)),
        filter_(points_, zUp) {
    points_.reserve(used_.size());
    for (const uint32_t p : used_) points_.push_back(file.positions[p]);
  }

  bool build(ObjPart& out) {
    out_ = &out;
    const bool anyUv = anyCorner([](const ObjCorner& c) { return c.uv != kNone; });
    const bool anyNormal =
        wishes_.normals && anyCorner([](const ObjCorner& c) { return c.normal != kNone; });
    for (const uint32_t f : faces_) addFace(file_.faces[f], anyUv, anyNormal);
    out.dropped = filter_.dropped();
    out.mesh = filter_.builder().take();
    return !overflows_;
  }

 private:
  std::span<const ObjCorner> cornersOf(const ObjFace& f) const {
    return {file_.corners.data() + f.firstCorner, f.cornerCount};
  }

  std::vector<uint32_t> positionsOf(std::span<const uint32_t> faces) const {
    std::vector<uint32_t> used;
    for (const uint32_t f : faces) {
      work(1 + file_.faces[f].cornerCount);
      for (const ObjCorner& c : cornersOf(file_.faces[f])) used.push_back(c.position);
    }
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    return used;
  }

  template <class Has>
  bool anyCorner(Has has) const {
    return std::any_of(faces_.begin(), faces_.end(), [&](uint32_t f) {
      const auto corners = cornersOf(file_.faces[f]);
      return std::any_of(corners.begin(), corners.end(), has);
    });
  }

  void addFace(const ObjFace& f, bool anyUv, bool anyNormal) {
    const auto corners = cornersOf(f);
    positions_.clear();
    for (const ObjCorner& c : corners) {
      const auto at = std::lower_bound(used_.begin(), used_.end(), c.position);
      positions_.push_back(static_cast<uint32_t>(at - used_.begin()));
    }
    if (!filter_.accept(positions_)) return;
    MeshBuilder& b = filter_.builder();
    b.beginFace(slotOf(f.material), 0, f.smooth);
    b.beginLoop();
    for (const uint32_t i : filter_.kept()) {
      const ObjCorner& from = corners[i];
      const uint32_t c = b.addCorner(filter_.position(positions_[i]));
      if (anyUv) b.setUv(c, 0, from.uv == kNone ? Vec2{} : file_.uvs[from.uv]);
      if (!anyNormal) continue;
      const Vec3 n = from.normal == kNone ? Vec3{} : normalized(file_.normals[from.normal]);
      b.setNormal(c, filter_.direction(n));
    }
    out_->asset.faceGroups.push_back(groupOf(byObject_ ? f.object : f.group));
  }

  // Material names of the faces become slots in the order of their first use.
  uint16_t slotOf(uint32_t material) {
    std::vector<Material>& all = out_->asset.materials;
    const Material* found = nullptr;
    if (material < file_.materials.size()) {
      const auto known = materials_.find(file_.materials[material]);
      if (known != materials_.end()) found = &known->second;
      if (!found && wishes_.definedOnly) material = kNone;
    }
    const auto [at, fresh] = slots_.try_emplace(material, static_cast<uint32_t>(all.size()));
    if (!fresh) return static_cast<uint16_t>(at->second);
    if (all.size() == kMostMaterials) {
      overflows_ = true;
      at->second = 0;
      return 0;
    }
    all.push_back(found ? *found : Material{});
    if (!found && material < file_.materials.size()) all.back().name = file_.materials[material];
    return static_cast<uint16_t>(at->second);
  }

  uint32_t groupOf(uint32_t group) {
    const std::vector<std::string>& all = byObject_ ? file_.objects : file_.groups;
    if (!wishes_.groups || group >= all.size()) group = kNone;
    std::vector<std::string>& names = out_->asset.groups;
    const auto [at, fresh] = groups_.try_emplace(group, static_cast<uint32_t>(names.size()));
    if (fresh) names.push_back(group == kNone ? "" : all[group]);
    return at->second;
  }

  const ObjFile& file_;
  std::span<const uint32_t> faces_;
  const ObjMaterials& materials_;
  const ObjPartWishes& wishes_;
  // Objects are the groups of a file that has no others.
  const bool byObject_ = file_.groups.empty();
  // The positions that the faces use, sorted, and their places.
  std::vector<uint32_t> used_, positions_;
  std::vector<Vec3> points_;
  FaceFilter filter_;
  ObjPart* out_ = nullptr;
  std::unordered_map<uint32_t, uint32_t> slots_, groups_;
  bool overflows_ = false;
};

}  // namespace

Result<ObjMaterials> objMaterials(const ObjFile& file, const AssetOptions& options,
                                  std::vector<std::string>& missing,
                                  std::vector<std::string>& losses) {
  if (file.materialFiles.size() > kMostMaterialFiles) {
    return tooManyOf("material files", kMostMaterialFiles, options, "join them into one");
  }
  ObjMaterials all;
  for (const std::string& name : file.materialFiles) {
    const std::string path = relativeTo(options.path, name);
    if (!options.readFile) {
      missing.push_back("the material file '" + path + "' is not read");
      continue;
    }
    const Result<std::string> text = options.readFile(path);
    if (!text.ok()) {
      missing.push_back("the material file '" + path + "' is left out: " + text.error().message);
      continue;
    }
    for (const Material& material : parseMtl(text.value(), path, losses)) {
      work();
      all[material.name] = material;
    }
  }
  return all;
}

Result<ObjPart> objPart(const ObjFile& file, std::span<const uint32_t> faces,
                        const ObjMaterials& materials, const ObjPartWishes& wishes,
                        const AssetOptions& options) {
  ObjPart out;
  PartBuilder builder(file, faces, materials, wishes, options.zUp);
  if (!builder.build(out)) {
    return tooManyOf("materials", kMostMaterials, options, "join those that look alike");
  }
  return out;
}

}  // namespace gable
