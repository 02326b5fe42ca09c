// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Triangles of all meshes that the scene shows, in one mesh. Vertices that files repeat for the
// sake of normals and uv coordinates are one position again where their coordinates are equal to
// the bit.
#include "base/work.h"
#include "io/importers/gltf_meshes.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "io/importers/geojson_edges.h"
#include "material/linear_light.h"

namespace gable {
namespace {

// Beyond so many colours of vertices, others are told apart by five steps.
constexpr size_t kExactColors = 4096;
constexpr size_t kTriangles = 4, kTriangleStrip = 5, kTriangleFan = 6;

size_t modeOf(const JsonValue& primitive) {
  const JsonValue* mode = primitive.find("mode");
  return mode ? GltfFile::index(*mode) : kTriangles;
}

}  // namespace

bool GltfMeshes::add(const GltfPlacement& placement, uint32_t group) {
  const JsonValue& mesh = file_.json()["meshes"].at(placement.mesh);
  for (const JsonValue& p : mesh["primitives"].items()) {
    if (!readPrimitive(p)) {
      ++broken_;
      continue;
    }
    place(placement.world);
    const JsonValue* material = p.find("material");
    addTriangles(p, material ? GltfFile::index(*material) : GltfFile::kNone, placement.world,
                 group);
    work_ += positions_.size() + indices_.size();
    if (work_ > kMostWork) return false;
  }
  return true;
}

bool GltfMeshes::readPrimitive(const JsonValue& p) {
  const size_t mode = modeOf(p);
  if (mode != kTriangles && mode != kTriangleStrip && mode != kTriangleFan) return false;
  const JsonValue& attributes = p["attributes"];
  const auto has = [&](const std::string& name) { return attributes.find(name) != nullptr; };
  const auto read = [&](const std::string& name, int components, std::vector<double>& out) {
    return file_.read(GltfFile::index(attributes[name]), components, out);
  };
  if (!has("POSITION") || !read("POSITION", 3, positions_)) return false;
  const size_t count = positions_.size() / 3;
  normals_.clear();
  if (has("NORMAL") && (!read("NORMAL", 3, normals_) || normals_.size() != count * 3)) {
    normals_.clear();
  }
  readColors(attributes, count);
  uvs_.clear();
  for (int set = 0; set < kUvSets; ++set) {
    const std::string name = "TEXCOORD_" + std::to_string(set);
    if (!has(name)) break;
    uvs_.emplace_back();
    if (!read(name, 2, uvs_.back()) || uvs_.back().size() != count * 2) {
      uvs_.pop_back();
      break;
    }
  }
  return file_.readIndices(p, count, indices_);
}

void GltfMeshes::readColors(const JsonValue& attributes, size_t count) {
  colors_.clear();
  if (!attributes.find("COLOR_0")) return;
  const size_t accessor = GltfFile::index(attributes["COLOR_0"]);
  if (file_.read(accessor, 4, colors_)) {
    if (colors_.size() != count * 4) colors_.clear();
    return;
  }
  std::vector<double> opaque;
  if (!file_.read(accessor, 3, opaque) || opaque.size() != count * 3) return;
  reserveWork(colors_, static_cast<double>(count * 4));
  for (size_t v = 0; v < count; ++v) {
    gable::work();
    colors_.insert(colors_.end(), {opaque[3 * v], opaque[3 * v + 1], opaque[3 * v + 2], 1});
  }
}

// The vertices' places in the world, as numbers of shared positions.
void GltfMeshes::place(const Affine& world) {
  const size_t count = positions_.size() / 3;
  numbers_.resize(count);
  for (size_t v = 0; v < count; ++v) {
    gable::work();
    const Vec3 p = world.point({positions_[3 * v], positions_[3 * v + 1], positions_[3 * v + 2]});
    if (!isFinite(p)) {
      // Equal to nothing; faces with such a point are dropped.
      numbers_[v] = static_cast<uint32_t>(points_.size());
      points_.push_back(p);
      continue;
    }
    const auto [at, isNew] = known_.try_emplace(std::array<double, 3>{p.x, p.y, p.z},
                                                static_cast<uint32_t>(points_.size()));
    if (isNew) points_.push_back(p);
    numbers_[v] = at->second;
  }
}

size_t GltfMeshes::PositionHash::operator()(const std::array<double, 3>& p) const {
  return hashCombine(hashCombine(hashDouble(p[0]), hashDouble(p[1])), hashDouble(p[2]));
}

// Which TEXCOORD becomes uv set `set`: set 0 is the colour's, others only where they differ.
int GltfMeshes::texcoordFor(size_t material, int set) const {
  const int most = static_cast<int>(uvs_.size());
  if (material >= materials_.size()) return set == 0 && most > 0 ? 0 : -1;
  const auto& texcoords = materials_[material].texcoords;
  const int base = std::max(texcoords[0], 0);
  const int wanted = set == 0 ? base : texcoords[static_cast<size_t>(set)];
  if (wanted < 0 || wanted >= most || (set > 0 && wanted == base)) return -1;
  return wanted;
}

// A primitive without a material has one of its own.
const Material& GltfMeshes::materialOf(size_t material) const {
  static const Material kPlain;
  return material < materials_.size() ? materials_[material].material : kPlain;
}

uint16_t GltfMeshes::slotOf(size_t material) {
  if (slots_.empty()) slots_.assign(materials_.size() + 1, 0);
  uint32_t& slot = slots_[std::min(material, materials_.size())];
  if (slot == 0) slot = newSlot(materialOf(material)) + 1u;
  return static_cast<uint16_t>(slot - 1);
}

uint16_t GltfMeshes::newSlot(const Material& m) {
  if (asset_.materials.size() == kMostMaterials) {
    tooManyMaterials_ = true;
    return 0;
  }
  asset_.materials.push_back(m);
  return static_cast<uint16_t>(asset_.materials.size() - 1);
}

// A face has one colour: the mean of its vertices'.
uint16_t GltfMeshes::coloredSlotOf(size_t material, const uint32_t (&vertices)[3]) {
  std::array<double, 4> light{};
  for (const uint32_t v : vertices) {
    for (size_t c = 0; c < 4; ++c) light[c] += colors_[4 * v + c] / 3;
  }
  const Material& plain = materialOf(material);
  if (material < materials_.size() && plain.opacityMode == OpacityMode::Opaque) light[3] = 1;
  std::array<uint8_t, 4> bytes{};
  const int step = coloredSlots_.size() < kExactColors ? 1 : 51;
  for (size_t c = 0; c < 4; ++c) {
    const double part = c < 3 ? srgbOf(light[c]) : (light[c] >= 0 ? std::min(light[c], 1.0) : 0);
    bytes[c] = static_cast<uint8_t>(std::lround(part * 255 / step) * step);
  }
  const auto [at, isNew] =
      coloredSlots_.try_emplace({std::min(material, materials_.size()), bytes});
  if (isNew) {
    Material m = plain;
    const auto tinted = [&](double own, size_t c) {
      return srgbOf(linearOf(own) * linearOf(bytes[c] / 255.0));
    };
    m.color = {tinted(m.color.x, 0), tinted(m.color.y, 1), tinted(m.color.z, 2)};
    m.opacity *= bytes[3] / 255.0;
    at->second = newSlot(m);
  }
  return at->second;
}

void GltfMeshes::addTriangles(const JsonValue& primitive, size_t material, const Affine& world,
                              uint32_t group) {
  const size_t mode = modeOf(primitive);
  const bool mirrors = world.determinant() < 0;
  int sets[kUvSets];
  for (int s = 0; s < kUvSets; ++s) sets[s] = texcoordFor(material, s);
  const size_t step = mode == kTriangles ? 3 : 1;
  for (size_t i = 0; i + 2 < indices_.size(); i += step) {
    uint32_t v[3] = {indices_[mode == kTriangleFan ? 0 : i], indices_[i + 1], indices_[i + 2]};
    const bool turn = mirrors != (mode == kTriangleStrip && i % 2 == 1);
    if (turn) std::swap(v[1], v[2]);
    triangle_.assign({numbers_[v[0]], numbers_[v[1]], numbers_[v[2]]});
    if (!filter_.accept(triangle_)) continue;
    MeshBuilder& b = filter_.builder();
    b.beginFace(colors_.empty() ? slotOf(material) : coloredSlotOf(material, v));
    b.beginLoop();
    for (const uint32_t vertex : v) {
      const uint32_t c = b.addCorner(filter_.position(numbers_[vertex]));
      for (int s = 0; s < kUvSets; ++s) {
        if (sets[s] < 0) continue;
        const std::vector<double>& uv = uvs_[static_cast<size_t>(sets[s])];
        const Vec2 at{uv[2 * vertex], 1 - uv[2 * vertex + 1]};
        b.setUv(c, s, std::isfinite(at.x) && std::isfinite(at.y) ? at : Vec2{});
      }
      if (normals_.empty()) continue;
      const Vec3 n{normals_[3 * vertex], normals_[3 * vertex + 1], normals_[3 * vertex + 2]};
      const Vec3 turned = normalized(world.normal(n));
      b.setNormal(c, isFinite(turned) ? filter_.direction(turned) : Vec3{});
    }
    asset_.faceGroups.push_back(group);
  }
}

Mesh GltfMeshes::take() {
  Mesh m = filter_.builder().take();
  if (m.normals.empty()) return m;
  // Normals that say no more than the faces themselves are not worth keeping.
  for (size_t f = 0; f < m.faceCount(); ++f) {
    const Vec3 flat = m.normal(f);
    for (const MeshLoop& loop : m.loopsOf(f)) {
      for (uint32_t i = 0; i < loop.cornerCount; ++i) {
        const Vec3 n = m.normals[loop.firstCorner + i];
        if (n != Vec3{} && dot(n, flat) < 0.9999) return m;
      }
    }
  }
  m.normals.clear();
  return m;
}

namespace {

// The extras of the file and of its scene: what writers let users add. The first of a name counts.
void readMetadata(const JsonValue& json, Asset& asset) {
  const JsonValue& scenes = json["scenes"];
  const size_t scene = json.find("scene") ? GltfFile::index(json["scene"]) : 0;
  const JsonValue& ofScene = scenes.at(std::min(scene, scenes.size()))["extras"];
  for (const JsonValue* extras : {&json["asset"]["extras"], &ofScene, &json["extras"]}) {
    for (const auto& [key, v] : extras->members()) {
      work();
      if (isPlainValue(v)) asset.metadata.emplace_back(key, plainValue(v));
    }
  }
}

}  // namespace

Result<Asset> readGltfAsset(std::string_view bytes, const AssetOptions& options) {
  Result<GltfFile> file = GltfFile::open(bytes, options);
  if (!file.ok()) return file.error();
  Asset asset;
  asset.warnings = file->warnings();
  const std::vector<GltfMaterial> materials = readGltfMaterials(*file, options, asset);
  GltfMeshes meshes(*file, materials, asset, options.zUp);
  const GltfShown shown = file->shown();
  if (shown.left > 0) {
    asset.warnings.push_back("collision shapes and coarser levels of detail, " +
                             std::to_string(shown.left) + " in all, are left out");
  }
  for (const GltfPlacement& p : shown.placements) {
    asset.groups.push_back(p.name);
    if (!meshes.add(p, static_cast<uint32_t>(asset.groups.size() - 1))) {
      return Error{
          "asset-broken", "'" + options.path + "' shows more triangles than can be read", {}};
    }
  }
  if (meshes.tooManyMaterials()) {
    return tooManyOf("materials", kMostMaterials, options, "join those that look alike");
  }
  if (meshes.dropped() > 0) {
    asset.warnings.push_back(std::to_string(meshes.dropped()) +
                             " triangles without area are left out");
  }
  if (meshes.broken() > 0) {
    asset.warnings.push_back(std::to_string(meshes.broken()) + " primitives cannot be read");
  }
  Mesh mesh = meshes.take();
  readMetadata(file->json(), asset);
  return finishAsset(std::move(mesh), std::move(asset), options);
}

}  // namespace gable
