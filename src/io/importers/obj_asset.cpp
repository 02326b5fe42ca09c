// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include <algorithm>

#include "base/work.h"
#include "io/importers/asset.h"
#include "io/importers/face_filter.h"
#include "io/importers/mtl_file.h"
#include "io/importers/obj_file.h"

namespace gable {
namespace {

constexpr uint32_t kNone = ObjCorner::kNone;
constexpr size_t kMostMaterialFiles = 1000;

// Material names of the faces become slots in the order of their first use.
class ObjSlots {
 public:
  ObjSlots(const ObjFile& file, std::map<std::string, Material> materials, Asset& out)
      : file_(file),
        materials_(std::move(materials)),
        out_(out),
        slots_(file.materials.size() + 1) {}

  uint16_t of(uint32_t material) {
    uint32_t& slot = slots_[std::min<size_t>(material, file_.materials.size())];
    if (slot == 0) {
      if (out_.materials.size() == kMostMaterials) {
        overflows_ = true;
        return 0;
      }
      out_.materials.push_back(find(material));
      slot = static_cast<uint32_t>(out_.materials.size());
    }
    return static_cast<uint16_t>(slot - 1);
  }
  bool overflows() const { return overflows_; }

 private:
  Material find(uint32_t material) {
    if (material >= file_.materials.size()) return {};
    const auto known = materials_.find(file_.materials[material]);
    if (known != materials_.end()) return known->second;
    Material m;
    m.name = file_.materials[material];
    return m;
  }

  const ObjFile& file_;
  std::map<std::string, Material> materials_;
  Asset& out_;
  // One more than the slot, 0 for none yet.
  std::vector<uint32_t> slots_;
  bool overflows_ = false;
};

std::map<std::string, Material> materialsOf(const ObjFile& file, const AssetOptions& options,
                                            std::vector<std::string>& warnings) {
  std::map<std::string, Material> all;
  for (const std::string& name : file.materialFiles) {
    const std::string path = relativeTo(options.path, name);
    if (!options.readFile) {
      warnings.push_back("the material file '" + path + "' is not read");
      continue;
    }
    const Result<std::string> text = options.readFile(path);
    if (!text.ok()) {
      warnings.push_back("the material file '" + path + "' is left out: " + text.error().message);
      continue;
    }
    for (auto& [key, material] : parseMtl(text.value(), path)) {
      work();
      all[key] = material;
    }
  }
  return all;
}

}  // namespace

Result<Asset> readObjAsset(std::string_view text, const AssetOptions& options) {
  const ObjFile file = parseObj(text);
  if (file.materialFiles.size() > kMostMaterialFiles) {
    return tooManyOf("material files", kMostMaterialFiles, options, "join them into one");
  }
  Asset out;
  ObjSlots slots(file, materialsOf(file, options, out.warnings), out);
  const bool anyUv = std::any_of(file.corners.begin(), file.corners.end(),
                                 [](const ObjCorner& c) { return c.uv != kNone; });
  const bool anyNormal = std::any_of(file.corners.begin(), file.corners.end(),
                                     [](const ObjCorner& c) { return c.normal != kNone; });
  FaceFilter filter(file.positions, options.zUp);
  std::vector<uint32_t> groupOf(file.groups.size() + 1, kNone);
  std::vector<uint32_t> positions;
  for (const ObjFace& f : file.faces) {
    const ObjCorner* corners = file.corners.data() + f.firstCorner;
    positions.clear();
    for (uint32_t i = 0; i < f.cornerCount; ++i) positions.push_back(corners[i].position);
    if (!filter.accept(positions)) continue;
    MeshBuilder& b = filter.builder();
    b.beginFace(slots.of(f.material), 0, f.smooth);
    b.beginLoop();
    for (const uint32_t i : filter.kept()) {
      const uint32_t c = b.addCorner(filter.position(corners[i].position));
      if (anyUv) b.setUv(c, 0, corners[i].uv == kNone ? Vec2{} : file.uvs[corners[i].uv]);
      if (anyNormal) {
        b.setNormal(c, corners[i].normal == kNone
                           ? Vec3{}
                           : filter.direction(normalized(file.normals[corners[i].normal])));
      }
    }
    uint32_t& group = groupOf[std::min<size_t>(f.group, file.groups.size())];
    if (group == kNone) {
      group = static_cast<uint32_t>(out.groups.size());
      out.groups.push_back(f.group == kNone ? "" : file.groups[f.group]);
    }
    out.faceGroups.push_back(group);
  }
  if (slots.overflows()) {
    return tooManyOf("materials", kMostMaterials, options, "join those that look alike");
  }
  if (filter.dropped() > 0) {
    out.warnings.push_back(std::to_string(filter.dropped()) + " faces without area are left out");
  }
  if (file.badLines > 0) {
    out.warnings.push_back(std::to_string(file.badLines) + " lines cannot be read");
  }
  return finishAsset(filter.builder().take(), std::move(out), options);
}

}  // namespace gable
