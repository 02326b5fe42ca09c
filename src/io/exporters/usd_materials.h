// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Materials in USD's terms: UsdPreviewSurface with its textures. A binding is a material together
// with the uv sets that a surface brings.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/exporters/textures.h"
#include "io/exporters/usd_text.h"
#include "scene/scene.h"

namespace gable {

class UsdMaterials {
 public:
  UsdMaterials(const Scene& scene, const WriteOptions& options, std::vector<std::string>& warnings)
      : scene_(scene), warnings_(warnings), textures_(options, warnings) {}

  /// `material` indexes Scene::materials or is kNoMaterial; bit s of `uvMask` says that the surface
  /// has uv set s. Numbered in the order of first use.
  uint32_t binding(uint32_t material, uint32_t uvMask);
  /// The uv sets that its textures read; bit 0 always where the surface has it.
  uint32_t uvMask(uint32_t binding) const { return bindings_[binding].uvMask; }
  /// Its textures lie in metres: uv set 0 is that of layingOf, whatever the surface has.
  bool isLaid(uint32_t binding) const;
  const Material& material(uint32_t binding) const { return *bindings_[binding].material; }
  std::string path(uint32_t binding) const;
  const std::vector<ModelTexture>& images() const { return textures_.all(); }
  /// All of them, below the prim that is open; files of textures begin with `folder`.
  void write(UsdLayer& layer, const std::string& folder) const;
  static constexpr const char* kScope = "/World/Materials/";
  static std::string primvar(uint32_t set) { return set == 0 ? "st" : "st" + std::to_string(set); }

 private:
  struct Map {
    int image = TextureSet::kNone;
    uint32_t set = 0;
    TextureMap place;
  };
  struct Binding {
    const Material* material = nullptr;
    std::string name;
    Map color, metallicRoughness, normal, occlusion, emissive;
    bool transparent = false;
    uint32_t uvMask = 0;
  };
  Binding make(const Material& m, uint32_t uvMask);
  void tellLosses(const Material& m);
  static Map mapOf(const Material& m, TextureLayer layer, uint32_t uvMask, int image);
  void writeOne(UsdLayer& layer, const Binding& b, const std::string& folder) const;
  void writeTexture(UsdLayer& layer, const std::string& home, const char* name, const Map& map,
                    const std::string& folder, bool isColor, const std::string& scale) const;

  const Scene& scene_;
  std::vector<std::string>& warnings_;
  std::set<std::string> warned_;
  TextureSet textures_;
  UsdNames names_;
  std::map<uint64_t, uint32_t> known_;
  std::vector<Binding> bindings_;
};

}  // namespace gable
