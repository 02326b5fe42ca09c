// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Material: how a face looks, in CGA's terms (material.* attributes). Colours are sRGB components
// in [0, 1] as rules write them; writers convert. Texture paths are project paths.
//
// A MaterialTable interns materials: equal contents have one id. Ids depend on the order of
// interning and never reach any output.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "math/vec.h"

namespace gable {

/// The ten texture layers; the number is the uv set that a layer uses.
enum class TextureLayer : uint8_t {
  Color,
  Bump,
  Dirt,
  Specular,
  Opacity,
  Normal,
  Emissive,
  Occlusion,
  Roughness,
  Metallic,
};
constexpr size_t kTextureLayers = 10;
/// "colormap", "bumpmap", ... by layer.
extern const std::array<const char*, kTextureLayers> kTextureLayerNames;

struct TextureMap {
  /// Empty for none.
  std::string path;
  /// material.<layer>.su .sv .tu .tv .rw: scale, shift and turn (degrees) of the uv coordinates.
  double su = 1, sv = 1, tu = 0, tv = 0, rw = 0;
  bool operator==(const TextureMap&) const = default;
};

enum class OpacityMode : uint8_t { Opaque, Mask, Blend };

struct Material {
  std::string name;
  Vec3 color{1, 1, 1};
  Vec3 ambient{0, 0, 0};
  Vec3 specular{0, 0, 0};
  Vec3 emissive{0, 0, 0};
  double opacity = 1;
  double reflectivity = 0;
  double shininess = 1;
  double bumpValue = 1;
  double metallic = 0;
  double roughness = 1;
  bool doubleSided = true;
  OpacityMode opacityMode = OpacityMode::Blend;
  double opacityCutoff = 0.5;
  std::string shader = "CityEngineShader";
  std::array<TextureMap, kTextureLayers> maps;

  const TextureMap& map(TextureLayer l) const { return maps[static_cast<size_t>(l)]; }
  TextureMap& map(TextureLayer l) { return maps[static_cast<size_t>(l)]; }
  bool operator==(const Material&) const = default;
};

uint64_t contentHash(const Material& m);

using MaterialId = uint32_t;

/// One change of a material, by which its result is found again: `field` says what is changed, the
/// rest to what (bits of numbers, hashes of texts).
struct MaterialEdit {
  MaterialId base = 0;
  uint32_t field = 0;
  uint64_t a = 0, b = 0, c = 0;
  bool operator==(const MaterialEdit&) const = default;
};

/// Any thread may call; get() takes no lock and its result stays valid as long as the table.
class MaterialTable {
 public:
  MaterialTable();
  ~MaterialTable();
  /// Id 0 is the default material: white, rough, opaque.
  MaterialId intern(const Material& m);
  const Material& get(MaterialId id) const;
  /// The content hash of an interned material, without reading it again.
  uint64_t hashOf(MaterialId id) const;

  /// The material that `change` makes of edit.base. Allocates nothing when the same edit was made
  /// before: rules make the same few edits for each of many shapes.
  template <class Change>
  MaterialId edited(const MaterialEdit& edit, Change change) {
    MaterialId id = 0;
    if (findEdit(edit, id)) return id;
    Material m = get(edit.base);
    change(m);
    id = intern(m);
    rememberEdit(edit, id);
    return id;
  }

 private:
  bool findEdit(const MaterialEdit& edit, MaterialId& id) const;
  void rememberEdit(const MaterialEdit& edit, MaterialId id);

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// "#rrggbb" or "#rrggbboo" to components in [0, 1]; false when it is neither. `opacity` is left as
/// it is when the text has none.
bool parseColor(std::string_view text, Vec3& rgb, double& opacity);
/// Lower-case "#rrggbb".
std::string colorText(const Vec3& rgb);

}  // namespace gable
