// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Materials in glTF's terms. A variant is a material together with the uv sets that a surface
// brings: it fixes the layout of vertices and which TEXCOORD each texture reads.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/json.h"
#include "io/exporters/textures.h"
#include "scene/scene.h"

namespace gable {

/// What a number of a uv set is in the file.
enum class UvForm : uint8_t {
  Float,
  /// 16 bits over [0, 1].
  Unit,
  /// 16 bits over 32 repeats of the picture, from a whole one: the material's transform says so.
  /// Half a step is 1/4096 of the picture.
  Repeats,
  /// The same over 256 repeats, with half a step of 1/512.
  ManyRepeats,
};

/// What 16 bits reach over; 0 where they do not count repeats.
constexpr double repeatsOf(UvForm form) {
  return form == UvForm::Repeats ? 32 : form == UvForm::ManyRepeats ? 256 : 0;
}
/// Faces begin at a multiple of so many repeats, so that neighbours begin at one.
constexpr double kUvStart = 8;

/// What the uv coordinates of a surface reach over.
struct UvReach {
  /// All within [0, 1].
  bool unit = false;
  /// Of one face, in units of uv.
  double most = 0;
};

/// How a map lies on texture coordinates: scaled, turned, moved.
struct UvPlace {
  double su = 1, sv = 1, tu = 0, tv = 0, cosine = 1, sine = 0;
  Vec2 at(const Vec2& uv) const {
    return {cosine * su * uv.x - sine * sv * uv.y + tu, sine * su * uv.x + cosine * sv * uv.y + tv};
  }
};

/// A vertex: position, normal, tangent if any, uv sets. In floats 3, 3, 4 and 2 each; compact, the
/// position takes 12 bytes, or 8 as integers, the normal 4, a uv set 4, or 8 as floats, and there
/// is no tangent.
struct VertexLayout {
  bool compact = false;
  /// False where readers are to make flat normals.
  bool normals = true;
  /// The one uv set is made here, in metres (material/laying.h).
  bool laid = false;
  /// The uv set of the normal map, or -1.
  int tangentSet = -1;
  uint32_t uvCount = 0;
  /// TEXCOORD_n shows uv set uvSets[n].
  uint8_t uvSets[kTextureLayers] = {};
  UvForm uvForm = UvForm::Float;
  /// Of the picture, a unit of uv, where repeats are counted.
  Vec2 uvRepeats{1, 1};
  /// Whether uv sets are written as places says, by TEXCOORD.
  bool baked = false;
  std::array<UvPlace, kTextureLayers> places{};
  /// Whether vertices have the same attributes in the same bytes.
  bool isLike(const VertexLayout& o) const {
    return compact == o.compact && normals == o.normals &&
           (tangentSet >= 0) == (o.tangentSet >= 0) && uvCount == o.uvCount &&
           (uvCount == 0 || uvForm == o.uvForm);
  }
  /// How many accessors that are.
  uint32_t attributes() const {
    return 1 + (normals ? 1 : 0) + (tangentSet >= 0 ? 1 : 0) + uvCount;
  }
  /// Before it is packed: a normal is always there.
  uint32_t floats() const { return 6 + (tangentSet >= 0 ? 4 : 0) + 2 * uvCount; }
  uint32_t positionBytes(bool quantized) const { return quantized ? 8 : 12; }
  uint32_t normalBytes() const { return !normals ? 0 : compact ? 4 : 12; }
  uint32_t tangentBytes() const { return tangentSet < 0 ? 0 : 16; }
  uint32_t uvBytes() const { return uvForm == UvForm::Float ? 8 : 4; }
  uint32_t stride(bool quantized) const {
    return positionBytes(quantized) + normalBytes() + tangentBytes() + uvBytes() * uvCount;
  }
};

/// Positions as steps from a corner: step is a power of two, and low a multiple of it.
struct VertexGrid {
  static constexpr double kMostSteps = 65535;
  bool on = false;
  Vec3 low;
  double step = 1;
};

class GltfMaterials {
 public:
  GltfMaterials(const Scene& scene, const WriteOptions& options,
                std::vector<std::string>& warnings);

  /// `material` indexes Scene::materials or is kNoMaterial; bit s of `uvMask` says that the surface
  /// has uv set s; `flat` says that it is lit flat. Variants are numbered in the order of first
  /// use.
  uint32_t variant(uint32_t material, uint32_t uvMask, bool flat = false,
                   UvForm form = UvForm::Float);
  /// The narrowest form in which a picture of 512 texels moves by one at most.
  UvForm uvFormOf(uint32_t material, const UvReach& reach);
  const VertexLayout& layout(uint32_t variant) const { return variants_[variant].layout; }
  size_t count() const { return variants_.size(); }
  /// The number of the variant's glTF material: variants that differ in their layout only share
  /// one.
  uint32_t materialOf(uint32_t variant) const { return variants_[variant].number; }
  const std::vector<ModelTexture>& images() const { return textures_.all(); }
  /// Whether vertices have integers of KHR_mesh_quantization.
  bool isCompact() const { return compact_; }
  bool usesTransforms() const { return usesTransforms_; }
  /// Whether pictures are wrong without transforms.
  bool needsTransforms() const { return needsTransforms_; }
  /// KHR_materials_... of the library's materials in use, sorted.
  const std::set<std::string>& extensions() const { return extensions_; }

  /// The members "materials", "textures" and "samplers"; images are up to the caller.
  void write(JsonWriter& w) const;

 private:
  struct Map {
    int image = TextureSet::kNone;
    uint32_t texcoord = 0;
    TextureMap transform;
  };
  struct Variant {
    VertexLayout layout;
    const Material* material = nullptr;
    bool transparent = false;
    /// Of the glTF material.
    uint32_t number = 0;
    Map color, metallicRoughness, normal, occlusion, emissive;
  };
  Variant make(const Material& m, uint32_t uvMask, bool flat, UvForm form);
  void numberMaterial(uint32_t material, Variant& v);
  static std::vector<uint32_t> layoutKey(uint32_t material, const VertexLayout& layout);
  Map mapOf(const Material& m, TextureLayer layer, uint32_t uvMask, int image);
  void addSets(Variant& v, uint32_t uvMask);
  void bake(Variant& v) const;
  void writeMaterial(JsonWriter& w, const Variant& v) const;
  void writeMap(JsonWriter& w, const char* name, const Map& map, UvForm form) const;
  static void writeExtensions(JsonWriter& w, const Material& m);
  void warnOnce(const std::string& text);

  const Scene& scene_;
  bool keepUv_, compact_, bare_, bakedUv_;
  std::vector<std::string>& warnings_;
  TextureSet textures_;
  std::vector<Variant> variants_;
  uint32_t materials_ = 0;
  std::map<uint64_t, uint32_t> known_;
  /// By material and what tells variants, and glTF materials, of one material apart.
  std::map<std::vector<uint32_t>, uint32_t> byLayout_, numbers_;
  std::set<std::string> warned_;
  std::set<std::string> extensions_;
  bool usesTransforms_ = false, needsTransforms_ = false;
  /// By material: repeats of its pictures a unit of uv; negative where not known yet.
  std::vector<double> repeats_;
};

}  // namespace gable
