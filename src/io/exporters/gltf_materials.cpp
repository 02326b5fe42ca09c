// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The correspondence of CGA's and glTF's attributes is the table of the CGA reference (material
// shape attributes): opacitymap is the alpha of the base colour, metallicmap the blue and
// roughnessmap the green channel of one texture.
#include "io/exporters/gltf_materials.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "material/library.h"
#include "material/linear_light.h"
#include "math/trig.h"
#include "scene/flatten.h"

namespace gable {
namespace {

double unit(double v) { return v >= 0 ? std::min(v, 1.0) : 0; }

void writeColor(JsonWriter& w, const Vec3& srgb) {
  for (size_t i = 0; i < 3; ++i) w.value(static_cast<float>(linearOf(srgb[i])));
}

bool plain(const TextureMap& t) {
  return t.su == 1 && t.sv == 1 && t.tu == 0 && t.tv == 0 && t.rw == 0;
}

// Repeats of all pictures of a material a unit of uv, if they are the same for all of them, and
// none is turned.
std::optional<Vec2> repeatsIn(const Material& m) {
  std::optional<Vec2> all;
  for (const TextureMap& t : m.maps) {
    if (t.path.empty()) continue;
    const Vec2 own{t.su, t.sv};
    if (t.rw != 0 || !std::isfinite(t.su) || !std::isfinite(t.sv) || (all && *all != own))
      return {};
    all = own;
  }
  return all;
}

// What a material of the library has beyond glTF's core: each extension, its field, its value.
template <class Visit>
void forEachExtension(const Material& m, Visit visit) {
  const LibraryMaterial* entry = libraryEntryOf(m);
  if (!entry) return;
  const LibraryMaterial plain{};
  if (entry->clearcoat > 0) {
    visit("KHR_materials_clearcoat", "clearcoatFactor", entry->clearcoat);
  }
  if (entry->ior != plain.ior) visit("KHR_materials_ior", "ior", entry->ior);
  if (entry->transmission > 0) {
    visit("KHR_materials_transmission", "transmissionFactor", entry->transmission);
  }
}

}  // namespace

GltfMaterials::GltfMaterials(const Scene& scene, const WriteOptions& options,
                             std::vector<std::string>& warnings)
    : scene_(scene),
      keepUv_(options.keepUv && options.vertices <= WriteOptions::Vertices::Float),
      compact_(options.vertices == WriteOptions::Vertices::Compact ||
               options.vertices == WriteOptions::Vertices::Bare),
      bare_(options.vertices == WriteOptions::Vertices::Bare),
      bakedUv_(options.bakedUv),
      warnings_(warnings),
      textures_(options, warnings) {}

UvForm GltfMaterials::uvFormOf(uint32_t material, const UvReach& reach) {
  // What counts repeats needs a transform, which is what baked numbers are to do without.
  if (!compact_ || bakedUv_ || material == kNoMaterial) return UvForm::Float;
  if (reach.unit) return UvForm::Unit;
  if (material >= repeats_.size()) repeats_.resize(scene_.materials.size(), -1);
  double& repeats = repeats_[material];
  if (repeats < 0) {
    const std::optional<Vec2> r = repeatsIn(scene_.materials[material]);
    repeats = r ? std::max(std::fabs(r->x), std::fabs(r->y)) : HUGE_VAL;
  }
  // A face is let reach over half of what there is: where it is laid, its reach is an estimate.
  for (const UvForm form : {UvForm::Repeats, UvForm::ManyRepeats}) {
    if (reach.most * repeats <= repeatsOf(form) / 2) return form;
  }
  return UvForm::Float;
}

uint32_t GltfMaterials::variant(uint32_t material, uint32_t uvMask, bool flat, UvForm form) {
  constexpr uint32_t kFlat = 1u << 31;
  const uint64_t key = static_cast<uint64_t>(material) << 32 | uvMask |
                       static_cast<uint64_t>(form) << 16 | (bare_ && flat ? kFlat : 0);
  const auto found = known_.find(key);
  if (found != known_.end()) return found->second;
  static const Material kDefault;
  const Material& m = material == kNoMaterial ? kDefault : scene_.materials[material];
  Variant v = make(m, uvMask, flat, form);
  // Masks that differ in sets which the material does not use give the same variant.
  const auto [at, isNew] =
      byLayout_.try_emplace(layoutKey(material, v.layout), static_cast<uint32_t>(variants_.size()));
  if (isNew) {
    numberMaterial(material, v);
    variants_.push_back(v);
  }
  return known_[key] = at->second;
}

std::vector<uint32_t> GltfMaterials::layoutKey(uint32_t material, const VertexLayout& layout) {
  std::vector<uint32_t> key{material, static_cast<uint32_t>(layout.tangentSet), layout.normals,
                            static_cast<uint32_t>(layout.uvForm)};
  key.insert(key.end(), layout.uvSets, layout.uvSets + layout.uvCount);
  return key;
}

void GltfMaterials::numberMaterial(uint32_t material, Variant& v) {
  std::vector<uint32_t> key{material, static_cast<uint32_t>(repeatsOf(v.layout.uvForm))};
  for (const Map* map : {&v.color, &v.metallicRoughness, &v.normal, &v.occlusion, &v.emissive}) {
    key.insert(key.end(), {static_cast<uint32_t>(map->image), map->texcoord});
  }
  const auto [at, isNew] = numbers_.try_emplace(std::move(key), materials_);
  if (isNew) ++materials_;
  v.number = at->second;
}

GltfMaterials::Map GltfMaterials::mapOf(const Material& m, TextureLayer layer, uint32_t uvMask,
                                        int image) {
  Map map;
  const auto set = static_cast<uint32_t>(layer);
  // A surface without the layer's own uv set shows the texture by set 0.
  if (uvMask >> set & 1) {
    map.texcoord = set;
  } else if (uvMask & 1) {
    map.texcoord = 0;
  } else {
    return map;
  }
  map.image = image;
  map.transform = m.map(layer);
  return map;
}

void GltfMaterials::warnOnce(const std::string& text) {
  if (warned_.insert(text).second) warnings_.push_back(text);
}

GltfMaterials::Variant GltfMaterials::make(const Material& m, uint32_t uvMask, bool flat,
                                           UvForm form) {
  Variant v;
  v.material = &m;
  v.layout.compact = compact_;
  v.layout.laid = isLaid(m);
  if (v.layout.laid) uvMask = 1;
  forEachExtension(m, [&](const char* name, const char*, double) { extensions_.insert(name); });
  const std::string& opacity = m.map(TextureLayer::Opacity).path;
  const bool useOpacity = !opacity.empty() && m.opacityMode != OpacityMode::Opaque;
  if (uvMask != 0) {
    const std::string& color = m.map(TextureLayer::Color).path;
    const std::string& roughness = m.map(TextureLayer::Roughness).path;
    const std::string& metallic = m.map(TextureLayer::Metallic).path;
    const bool fromOpacity = color.empty() && useOpacity;
    v.color =
        mapOf(m, fromOpacity ? TextureLayer::Opacity : TextureLayer::Color, uvMask,
              useOpacity ? textures_.addColorWithOpacity(color, opacity) : textures_.add(color));
    v.metallicRoughness =
        mapOf(m, roughness.empty() ? TextureLayer::Metallic : TextureLayer::Roughness, uvMask,
              roughness.empty() && metallic.empty()
                  ? TextureSet::kNone
                  : textures_.addMetallicRoughness(roughness, metallic));
    v.normal =
        mapOf(m, TextureLayer::Normal, uvMask, textures_.add(m.map(TextureLayer::Normal).path));
    v.occlusion = mapOf(m, TextureLayer::Occlusion, uvMask,
                        textures_.add(m.map(TextureLayer::Occlusion).path));
    v.emissive =
        mapOf(m, TextureLayer::Emissive, uvMask, textures_.add(m.map(TextureLayer::Emissive).path));
  }
  const bool textureAlpha = useOpacity && v.color.image != TextureSet::kNone &&
                            images()[static_cast<size_t>(v.color.image)].hasAlpha;
  v.transparent = m.opacityMode != OpacityMode::Opaque && (m.opacity < 1 || textureAlpha);
  for (const TextureLayer l : {TextureLayer::Bump, TextureLayer::Dirt, TextureLayer::Specular}) {
    if (m.map(l).path.empty()) continue;
    warnOnce(std::string("glTF has no ") + kTextureLayerNames[static_cast<size_t>(l)] +
             ": such textures are left out");
  }
  addSets(v, uvMask);
  if (bakedUv_) bake(v);
  if (v.layout.uvCount > 0) v.layout.uvForm = form;
  if (repeatsOf(v.layout.uvForm) > 0) {
    v.layout.uvRepeats = repeatsIn(m).value_or(Vec2{1, 1});
    usesTransforms_ = needsTransforms_ = true;
  }
  for (const Map* map : {&v.color, &v.metallicRoughness, &v.normal, &v.occlusion, &v.emissive}) {
    usesTransforms_ =
        usesTransforms_ || (map->image != TextureSet::kNone && !plain(map->transform));
  }
  // Without normals there are no tangents either.
  v.layout.normals = !(bare_ && flat && v.layout.tangentSet < 0);
  return v;
}

// Collects the uv sets in use and turns set numbers into TEXCOORD numbers.
void GltfMaterials::addSets(Variant& v, uint32_t uvMask) {
  Map* maps[] = {&v.color, &v.metallicRoughness, &v.normal, &v.occlusion, &v.emissive};
  uint32_t used = keepUv_ ? uvMask & 1 : 0;
  for (const Map* map : maps) {
    if (map->image != TextureSet::kNone) used |= 1u << map->texcoord;
  }
  // Readers make them where there are none, by the method that glTF names.
  if (!compact_ && v.normal.image != TextureSet::kNone)
    v.layout.tangentSet = static_cast<int>(v.normal.texcoord);
  for (uint32_t set = 0; set < kTextureLayers; ++set) {
    if (used >> set & 1) v.layout.uvSets[v.layout.uvCount++] = static_cast<uint8_t>(set);
  }
  for (Map* map : maps) {
    map->texcoord = static_cast<uint32_t>(std::popcount(used & ((1u << map->texcoord) - 1)));
  }
}

// Maps that share a uv set share how they lie, or keep it for readers.
void GltfMaterials::bake(Variant& v) const {
  Map* maps[] = {&v.color, &v.metallicRoughness, &v.normal, &v.occlusion, &v.emissive};
  const auto likeness = [](const TextureMap& t) {
    return std::array<double, 5>{t.su, t.sv, t.tu, t.tv, t.rw};
  };
  for (uint32_t set = 0; set < v.layout.uvCount; ++set) {
    const auto isOn = [set](const Map* m) {
      return m->image != TextureSet::kNone && m->texcoord == set;
    };
    Map** const first = std::find_if(std::begin(maps), std::end(maps), isOn);
    if (first == std::end(maps)) continue;
    const TextureMap t = (*first)->transform;
    const bool alike = std::all_of(first, std::end(maps), [&](const Map* m) {
      return !isOn(m) || likeness(m->transform) == likeness(t);
    });
    if (!alike || plain(t)) continue;
    v.layout.places[set] = {t.su, t.sv, t.tu, t.tv, cosDeg(t.rw), sinDeg(t.rw)};
    v.layout.baked = true;
    for (Map* m : maps) {
      if (isOn(m)) m->transform = {};
    }
  }
}

void GltfMaterials::writeMap(JsonWriter& w, const char* name, const Map& map, UvForm form) const {
  if (map.image == TextureSet::kNone) return;
  w.key(name).beginObject().field("index", map.image);
  if (map.texcoord) w.field("texCoord", map.texcoord);
  const TextureMap& t = map.transform;
  const double repeats = repeatsOf(form);
  if (!plain(t) || repeats > 0) {
    // Ours turns and scales about the lower left corner with v upwards, glTF's about the upper left
    // with v downwards: substituting v = 1 - v' on both sides leaves scale and turn as they are and
    // changes the offset.
    const double c = cosDeg(t.rw), s = sinDeg(t.rw);
    w.key("extensions").beginObject().key("KHR_texture_transform").beginObject();
    w.key("offset").beginArray().value(static_cast<float>(t.tu - s * t.sv));
    w.value(static_cast<float>(1 - t.tv - c * t.sv)).endArray();
    if (t.rw != 0) w.field("rotation", static_cast<float>(toRadians(t.rw)));
    const Vec2 scale = repeats > 0 ? Vec2{repeats, repeats} : Vec2{t.su, t.sv};
    w.key("scale").beginArray();
    w.value(static_cast<float>(scale.x)).value(static_cast<float>(scale.y));
    w.endArray().endObject().endObject();
  }
  w.endObject();
}

void GltfMaterials::writeMaterial(JsonWriter& w, const Variant& v) const {
  const Material& m = *v.material;
  w.beginObject();
  w.field("name", m.name.empty() ? colorText(m.color) : m.name);
  w.key("pbrMetallicRoughness").beginObject();
  w.key("baseColorFactor").beginArray();
  writeColor(w, m.color);
  w.value(static_cast<float>(v.transparent ? unit(m.opacity) : 1)).endArray();
  writeMap(w, "baseColorTexture", v.color, v.layout.uvForm);
  // With a texture in one channel only the other factor stands alone: white times the factor.
  w.field("metallicFactor", static_cast<float>(unit(m.metallic)));
  w.field("roughnessFactor", static_cast<float>(unit(m.roughness)));
  writeMap(w, "metallicRoughnessTexture", v.metallicRoughness, v.layout.uvForm);
  w.endObject();
  writeMap(w, "normalTexture", v.normal, v.layout.uvForm);
  writeMap(w, "occlusionTexture", v.occlusion, v.layout.uvForm);
  writeMap(w, "emissiveTexture", v.emissive, v.layout.uvForm);
  if (m.emissive != Vec3{}) {
    w.key("emissiveFactor").beginArray();
    writeColor(w, m.emissive);
    w.endArray();
  }
  if (v.transparent) {
    const bool mask = m.opacityMode == OpacityMode::Mask;
    w.field("alphaMode", mask ? "MASK" : "BLEND");
    if (mask) w.field("alphaCutoff", static_cast<float>(unit(m.opacityCutoff)));
  }
  if (m.doubleSided) w.field("doubleSided", true);
  writeExtensions(w, m);
  w.endObject();
}

void GltfMaterials::writeExtensions(JsonWriter& w, const Material& m) {
  bool any = false;
  forEachExtension(m, [&](const char* name, const char* field, double value) {
    if (!any) w.key("extensions").beginObject();
    any = true;
    w.key(name).beginObject().field(field, static_cast<float>(value)).endObject();
  });
  if (any) w.endObject();
}

void GltfMaterials::write(JsonWriter& w) const {
  if (!variants_.empty()) {
    w.key("materials").beginArray();
    uint32_t next = 0;
    for (const Variant& v : variants_) {
      if (v.number != next) continue;
      writeMaterial(w, v);
      ++next;
    }
    w.endArray();
  }
  if (images().empty()) return;
  // One texture an image, one sampler for all: linear with mipmaps, repeated both ways.
  w.key("textures").beginArray();
  for (int i = 0; i < static_cast<int>(images().size()); ++i) {
    w.beginObject().field("sampler", 0).field("source", i).endObject();
  }
  w.endArray();
  w.key("samplers").beginArray().beginObject();
  w.field("magFilter", 9729).field("minFilter", 9987).field("wrapS", 10497).field("wrapT", 10497);
  w.endObject().endArray();
}

}  // namespace gable
