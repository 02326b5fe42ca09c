// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// As glTF's exporter has them: opacitymap is the alpha of the colour, metallicmap the blue and
// roughnessmap the green channel of one texture. UsdTransform2d scales, turns and shifts in this
// order about the lower left, as CGA does.
#include "io/exporters/usd_materials.h"

#include <algorithm>

#include "base/number.h"
#include "material/library.h"
#include "material/linear_light.h"
#include "scene/flatten.h"

namespace gable {
namespace {

double unit(double v) { return v >= 0 ? std::min(v, 1.0) : 0; }

std::string numberOf(double v) {
  char text[kNumberRoom];
  return {text, writeShortest(text, static_cast<float>(v))};
}

std::string pair(double a, double b) { return "(" + numberOf(a) + ", " + numberOf(b) + ")"; }

}  // namespace

bool UsdMaterials::isLaid(uint32_t binding) const { return gable::isLaid(material(binding)); }

std::string UsdMaterials::path(uint32_t binding) const { return kScope + bindings_[binding].name; }

uint32_t UsdMaterials::binding(uint32_t material, uint32_t uvMask) {
  static const Material kDefault;
  const Material& m = material == kNoMaterial ? kDefault : scene_.materials[material];
  // The writer makes the coordinates of what is laid.
  if (gable::isLaid(m)) uvMask = 1;
  const uint64_t key = static_cast<uint64_t>(material) << 32 | uvMask;
  const auto [at, isNew] = known_.try_emplace(key, static_cast<uint32_t>(bindings_.size()));
  if (!isNew) return at->second;
  Binding b = make(m, uvMask);
  // Masks that differ in sets which no texture reads are one material in all but their uv sets.
  b.name = names_.unique(m.name.empty() ? "color_" + colorText(m.color).substr(1) : m.name);
  bindings_.push_back(std::move(b));
  return at->second;
}

UsdMaterials::Map UsdMaterials::mapOf(const Material& m, TextureLayer layer, uint32_t uvMask,
                                      int image) {
  Map map;
  const auto set = static_cast<uint32_t>(layer);
  // A surface without the layer's own uv set shows the texture by set 0.
  if (uvMask >> set & 1) {
    map.set = set;
  } else if ((uvMask & 1) == 0) {
    return map;
  }
  map.image = image;
  map.place = m.map(layer);
  return map;
}

void UsdMaterials::tellLosses(const Material& m) {
  for (const TextureLayer l : {TextureLayer::Bump, TextureLayer::Dirt, TextureLayer::Specular}) {
    if (m.map(l).path.empty()) continue;
    const std::string text = std::string("UsdPreviewSurface has no ") +
                             kTextureLayerNames[static_cast<size_t>(l)] +
                             ": such textures are left out";
    if (warned_.insert(text).second) warnings_.push_back(text);
  }
}

UsdMaterials::Binding UsdMaterials::make(const Material& m, uint32_t uvMask) {
  Binding b;
  b.material = &m;
  const auto pathOf = [&](TextureLayer l) -> const std::string& { return m.map(l).path; };
  const std::string& opacity = pathOf(TextureLayer::Opacity);
  const bool useOpacity = !opacity.empty() && m.opacityMode != OpacityMode::Opaque;
  if (uvMask != 0) {
    const std::string& color = pathOf(TextureLayer::Color);
    const std::string& roughness = pathOf(TextureLayer::Roughness);
    const std::string& metallic = pathOf(TextureLayer::Metallic);
    const bool fromOpacity = color.empty() && useOpacity;
    b.color =
        mapOf(m, fromOpacity ? TextureLayer::Opacity : TextureLayer::Color, uvMask,
              useOpacity ? textures_.addColorWithOpacity(color, opacity) : textures_.add(color));
    b.metallicRoughness =
        mapOf(m, roughness.empty() ? TextureLayer::Metallic : TextureLayer::Roughness, uvMask,
              roughness.empty() && metallic.empty()
                  ? TextureSet::kNone
                  : textures_.addMetallicRoughness(roughness, metallic));
    const auto plain = [&](TextureLayer l) {
      return mapOf(m, l, uvMask, textures_.add(pathOf(l)));
    };
    b.normal = plain(TextureLayer::Normal);
    b.occlusion = plain(TextureLayer::Occlusion);
    b.emissive = plain(TextureLayer::Emissive);
  }
  tellLosses(m);
  const bool textureAlpha = useOpacity && b.color.image != TextureSet::kNone &&
                            images()[static_cast<size_t>(b.color.image)].hasAlpha;
  b.transparent = m.opacityMode != OpacityMode::Opaque && (m.opacity < 1 || textureAlpha);
  b.uvMask = uvMask & 1;
  for (const Map* map : {&b.color, &b.metallicRoughness, &b.normal, &b.occlusion, &b.emissive}) {
    if (map->image != TextureSet::kNone) b.uvMask |= 1u << map->set;
  }
  return b;
}

// The texture, what places it where it is placed, and what reads the uv set.
void UsdMaterials::writeTexture(UsdLayer& layer, const std::string& home, const char* name,
                                const Map& map, const std::string& folder, bool isColor,
                                const std::string& scale) const {
  if (map.image == TextureSet::kNone) return;
  const std::string own = std::string("Texture_") + name, reader = std::string("Uv_") + name;
  const TextureMap& t = map.place;
  const bool placed = t.su != 1 || t.sv != 1 || t.tu != 0 || t.tv != 0 || t.rw != 0;
  const std::string place = std::string("Place_") + name;
  layer.open("def Shader \"" + own + "\"");
  layer.line("uniform token info:id = \"UsdUVTexture\"");
  const ModelTexture& image = images()[static_cast<size_t>(map.image)];
  layer.line("asset inputs:file = " + usdAsset(folder + image.name));
  layer.line("float2 inputs:st.connect = <" + home + "/" + (placed ? place : reader) +
             ".outputs:result>");
  layer.line(std::string("token inputs:sourceColorSpace = \"") + (isColor ? "sRGB\"" : "raw\""));
  layer.line("token inputs:wrapS = \"repeat\"");
  layer.line("token inputs:wrapT = \"repeat\"");
  if (!scale.empty()) layer.line(scale);
  layer.line("float3 outputs:rgb");
  for (const char* channel : {"r", "g", "b", "a"}) {
    layer.line(std::string("float outputs:") + channel);
  }
  layer.close();
  if (placed) {
    layer.open("def Shader \"" + place + "\"");
    layer.line("uniform token info:id = \"UsdTransform2d\"");
    layer.line("float2 inputs:in.connect = <" + home + "/" + reader + ".outputs:result>");
    layer.line("float inputs:rotation = " + numberOf(t.rw));
    layer.line("float2 inputs:scale = " + pair(t.su, t.sv));
    layer.line("float2 inputs:translation = " + pair(t.tu, t.tv));
    layer.line("float2 outputs:result");
    layer.close();
  }
  layer.open("def Shader \"" + reader + "\"");
  layer.line("uniform token info:id = \"UsdPrimvarReader_float2\"");
  layer.line("string inputs:varname = " + usdText(primvar(map.set)));
  layer.line("float2 outputs:result");
  layer.close();
}

void UsdMaterials::writeOne(UsdLayer& layer, const Binding& b, const std::string& folder) const {
  const Material& m = *b.material;
  const std::string home = kScope + b.name;
  const auto has = [](const Map& map) { return map.image != TextureSet::kNone; };
  const auto from = [&](const char* texture, const char* output) {
    return ".connect = <" + home + "/Texture_" + texture + ".outputs:" + output + ">";
  };
  layer.open("def Material \"" + b.name + "\"");
  layer.line("token outputs:surface.connect = <" + home + "/Surface.outputs:surface>");
  layer.open("def Shader \"Surface\"");
  layer.line("uniform token info:id = \"UsdPreviewSurface\"");
  layer.line("color3f inputs:diffuseColor" +
             (has(b.color) ? from("color", "rgb") : " = " + usdVec(linearOf(m.color))));
  const bool combined = has(b.metallicRoughness);
  layer.line("float inputs:metallic" +
             (combined ? from("surface", "b") : " = " + numberOf(unit(m.metallic))));
  layer.line("float inputs:roughness" +
             (combined ? from("surface", "g") : " = " + numberOf(unit(m.roughness))));
  if (has(b.emissive)) {
    layer.line("color3f inputs:emissiveColor" + from("emissive", "rgb"));
  } else if (m.emissive != Vec3{}) {
    layer.line("color3f inputs:emissiveColor = " + usdVec(linearOf(m.emissive)));
  }
  if (b.transparent) {
    layer.line("float inputs:opacity" +
               (has(b.color) ? from("color", "a") : " = " + numberOf(unit(m.opacity))));
    if (m.opacityMode == OpacityMode::Mask) {
      layer.line("float inputs:opacityThreshold = " + numberOf(unit(m.opacityCutoff)));
    }
  }
  if (has(b.normal)) layer.line("normal3f inputs:normal" + from("normal", "rgb"));
  if (has(b.occlusion)) layer.line("float inputs:occlusion" + from("occlusion", "r"));
  layer.line("token outputs:surface");
  layer.close();
  const auto factor = [](const Vec3& rgb, double a) {
    const std::string three = usdVec(rgb);
    return "float4 inputs:scale = " + three.substr(0, three.size() - 1) + ", " + numberOf(a) + ")";
  };
  writeTexture(layer, home, "color", b.color, folder, true,
               factor(linearOf(m.color), b.transparent ? unit(m.opacity) : 1));
  writeTexture(layer, home, "surface", b.metallicRoughness, folder, false,
               factor({1, unit(m.roughness), unit(m.metallic)}, 1));
  writeTexture(layer, home, "normal", b.normal, folder, false,
               "float4 inputs:scale = (2, 2, 2, 1)\nfloat4 inputs:bias = (-1, -1, -1, 0)");
  writeTexture(layer, home, "occlusion", b.occlusion, folder, false, {});
  writeTexture(layer, home, "emissive", b.emissive, folder, true, factor(linearOf(m.emissive), 1));
  layer.close();
}

void UsdMaterials::write(UsdLayer& layer, const std::string& folder) const {
  layer.open("def Scope \"Materials\"");
  for (const Binding& b : bindings_) writeOne(layer, b, folder);
  layer.close();
}

}  // namespace gable
