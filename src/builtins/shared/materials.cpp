// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Each edit is looked up before it is made (MaterialTable::edited): a facade sets the same colour a
// thousand times.

#include "builtins/shared/materials.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <map>

#include "material/builtin_textures.h"
#include "material/library.h"

namespace gable {

namespace {

template <double Material::*field>
double* numberOf(Material& m) {
  return &(m.*field);
}
template <Vec3 Material::*field, size_t axis>
double* componentOf(Material& m) {
  return &(m.*field)[axis];
}
template <TextureLayer layer>
std::string* pathOf(Material& m) {
  return &m.map(layer).path;
}
template <TextureLayer layer, double TextureMap::*field>
double* mapNumberOf(Material& m) {
  return &(m.map(layer).*field);
}
template <std::string Material::*field>
std::string* textOf(Material& m) {
  return &(m.*field);
}
bool* doubleSidedOf(Material& m) { return &m.doubleSided; }

constexpr ValueType kFloat = ValueType::Float;
constexpr ValueType kString = ValueType::String;

constexpr MaterialField number(const char* name, const char* doc, double* (*at)(Material&)) {
  return {name, kFloat, doc, at, nullptr, nullptr};
}
constexpr MaterialField text(const char* name, const char* doc, std::string* (*at)(Material&)) {
  return {name, kString, doc, nullptr, at, nullptr};
}

// The six fields of a texture layer; a macro because their names must be literals.
#define GABLE_MAP_FIELDS(LAYER, NAME)                                                           \
  text(NAME, "Image of this texture layer, by its project path.", pathOf<TextureLayer::LAYER>), \
      number(NAME ".su", "Scale of the layer's texture along u.",                               \
             mapNumberOf<TextureLayer::LAYER, &TextureMap::su>),                                \
      number(NAME ".sv", "Scale of the layer's texture along v.",                               \
             mapNumberOf<TextureLayer::LAYER, &TextureMap::sv>),                                \
      number(NAME ".tu", "Shift of the layer's texture along u.",                               \
             mapNumberOf<TextureLayer::LAYER, &TextureMap::tu>),                                \
      number(NAME ".tv", "Shift of the layer's texture along v.",                               \
             mapNumberOf<TextureLayer::LAYER, &TextureMap::tv>),                                \
      number(NAME ".rw", "Turn of the layer's texture around u = v = 0, in degrees.",           \
             mapNumberOf<TextureLayer::LAYER, &TextureMap::rw>)

// The same layer under the name that it had before.
#define GABLE_OLD_MAP_FIELDS(LAYER, NAME, NOW)                     \
  text(NAME, "Old name of " NOW ".", pathOf<TextureLayer::LAYER>), \
      number(NAME ".su", "Old name of " NOW ".su.",                \
             mapNumberOf<TextureLayer::LAYER, &TextureMap::su>),   \
      number(NAME ".sv", "Old name of " NOW ".sv.",                \
             mapNumberOf<TextureLayer::LAYER, &TextureMap::sv>),   \
      number(NAME ".tu", "Old name of " NOW ".tu.",                \
             mapNumberOf<TextureLayer::LAYER, &TextureMap::tu>),   \
      number(NAME ".tv", "Old name of " NOW ".tv.",                \
             mapNumberOf<TextureLayer::LAYER, &TextureMap::tv>),   \
      number(NAME ".rw", "Old name of " NOW ".rw.",                \
             mapNumberOf<TextureLayer::LAYER, &TextureMap::rw>)

constexpr const char* kRgbName = "material.color.rgb";
constexpr const char* kModeName = "material.opacitymap.mode";

constexpr MaterialField kFields[] = {
    text("material.name", "Name of the material, as writers put it into files.",
         textOf<&Material::name>),
    text("material.shader", "Name of the shader that is to draw the material.",
         textOf<&Material::shader>),
    number("material.color.r", "Red of the diffuse colour, sRGB, 0 to 1.",
           componentOf<&Material::color, 0>),
    number("material.color.g", "Green of the diffuse colour.", componentOf<&Material::color, 1>),
    number("material.color.b", "Blue of the diffuse colour.", componentOf<&Material::color, 2>),
    {kRgbName, kString, "The diffuse colour as \"#rrggbb\"."},
    number("material.color.a", "Old name of material.opacity.", numberOf<&Material::opacity>),
    number("material.ambient.r", "Red of the ambient colour.", componentOf<&Material::ambient, 0>),
    number("material.ambient.g", "Green of the ambient colour.",
           componentOf<&Material::ambient, 1>),
    number("material.ambient.b", "Blue of the ambient colour.", componentOf<&Material::ambient, 2>),
    number("material.specular.r", "Red of the specular colour.",
           componentOf<&Material::specular, 0>),
    number("material.specular.g", "Green of the specular colour.",
           componentOf<&Material::specular, 1>),
    number("material.specular.b", "Blue of the specular colour.",
           componentOf<&Material::specular, 2>),
    number("material.emissive.r", "Red of the light that the surface gives off.",
           componentOf<&Material::emissive, 0>),
    number("material.emissive.g", "Green of the light that the surface gives off.",
           componentOf<&Material::emissive, 1>),
    number("material.emissive.b", "Blue of the light that the surface gives off.",
           componentOf<&Material::emissive, 2>),
    number("material.opacity", "From 0, invisible, to 1, opaque.", numberOf<&Material::opacity>),
    number("material.reflectivity", "Share of the surroundings that is mirrored, 0 to 1.",
           numberOf<&Material::reflectivity>),
    number("material.shininess", "Exponent of the highlight, 0 to 128.",
           numberOf<&Material::shininess>),
    number("material.bumpValue", "Strength of the bump map.", numberOf<&Material::bumpValue>),
    number("material.metallic", "From 0, not metal, to 1, metal.", numberOf<&Material::metallic>),
    number("material.roughness", "From 0, smooth, to 1, rough.", numberOf<&Material::roughness>),
    {"material.doubleSided", ValueType::Bool, "Whether faces are seen from behind.", nullptr,
     nullptr, doubleSidedOf},
    {kModeName, kString, "How alpha is used: \"blend\", \"mask\" or \"opaque\"."},
    number("material.opacitymap.cutoff", "The least alpha that is drawn, for mode \"mask\".",
           numberOf<&Material::opacityCutoff>),
    GABLE_MAP_FIELDS(Color, "material.colormap"),
    GABLE_MAP_FIELDS(Bump, "material.bumpmap"),
    GABLE_MAP_FIELDS(Dirt, "material.dirtmap"),
    GABLE_MAP_FIELDS(Specular, "material.specularmap"),
    GABLE_MAP_FIELDS(Opacity, "material.opacitymap"),
    GABLE_MAP_FIELDS(Normal, "material.normalmap"),
    GABLE_MAP_FIELDS(Emissive, "material.emissivemap"),
    GABLE_MAP_FIELDS(Occlusion, "material.occlusionmap"),
    GABLE_MAP_FIELDS(Roughness, "material.roughnessmap"),
    GABLE_MAP_FIELDS(Metallic, "material.metallicmap"),
    GABLE_OLD_MAP_FIELDS(Specular, "material.map3", "material.specularmap"),
    GABLE_OLD_MAP_FIELDS(Opacity, "material.map4", "material.opacitymap"),
    GABLE_OLD_MAP_FIELDS(Normal, "material.map5", "material.normalmap"),
};
#undef GABLE_MAP_FIELDS
#undef GABLE_OLD_MAP_FIELDS

// Edits beyond the fields; fields use their place in the table.
constexpr uint32_t kColorEdit = 1000, kColorAndOpacityEdit = 1001, kTextureEdit = 1002,
                   kAlphaTextureEdit = 1003, kLibraryEdit = 1004;

const char* modeName(OpacityMode mode) {
  return mode == OpacityMode::Opaque ? "opaque" : mode == OpacityMode::Mask ? "mask" : "blend";
}

// The path that a texture has in the project; built-in images and none stay as they are.
std::string resolved(std::string_view path, Services& services, std::string_view file) {
  if (path.empty()) return {};
  if (path.starts_with("builtin:")) {
    if (!isBuiltinTexture(path) && !materialPictureOf(path).material) {
      services.warn("missing-texture", "there is no built-in image '" + std::string(path) + "'",
                    "they are named as in 'builtin:textures/02_brick.png'");
    }
    return std::string(path);
  }
  if (!services.assets().exists(path, file)) {
    services.warn("missing-texture", "there is no image '" + std::string(path) + "'",
                  kWherePathsStart);
  }
  return services.assets().resolve(path, file);
}

// Other materials for the same slots, which stay of their groups.
void keepMaterials(Shape& s, std::vector<MaterialId> list, Services& services) {
  AttributePool& pool = services.attributes();
  s.assetMaterials = pool.internMaterials(std::move(list), pool.groups(s.assetMaterials));
}

// Makes an edit on the shape's own material and on those in use in its slots.
template <class Change>
void editAll(Shape& s, Services& services, MaterialEdit edit, Change change) {
  MaterialTable& table = services.materials();
  edit.base = s.material;
  s.material = table.edited(edit, change);
  if (s.assetMaterials == 0) return;
  std::vector<MaterialId> list = services.attributes().materials(s.assetMaterials);
  for (size_t i = 0; i < list.size() / 2; ++i) {
    edit.base = list[i];
    list[i] = table.edited(edit, change);
  }
  keepMaterials(s, std::move(list), services);
}

uint32_t indexOf(const MaterialField& f) { return static_cast<uint32_t>(&f - kFields); }

Status wrong(const MaterialField& f, std::string_view v, const char* hint) {
  return Status::failure("bad-argument",
                         std::string(f.name) + " cannot be '" + std::string(v) + "'", hint);
}

Status writeText(const MaterialField& f, std::string_view v, Shape& s, Services& services,
                 std::string_view file) {
  const std::string content = isTexture(f) ? resolved(v, services, file) : std::string(v);
  MaterialEdit edit{0, indexOf(f), hashBytes(content), hashBytes(content, 1), content.size()};
  if (f.text) {
    editAll(s, services, edit, [&](Material& m) { *f.text(m) = content; });
    return {};
  }
  if (f.name == kRgbName) {
    Vec3 rgb;
    double opacity = -1;
    if (!parseColor(v, rgb, opacity)) return wrong(f, v, "write a colour as \"#rrggbb\"");
    setColor(s, rgb, opacity, services);
    return {};
  }
  for (const OpacityMode mode : {OpacityMode::Opaque, OpacityMode::Mask, OpacityMode::Blend}) {
    if (v != modeName(mode)) continue;
    editAll(s, services, edit, [&](Material& m) { m.opacityMode = mode; });
    return {};
  }
  return wrong(f, v, "use \"blend\", \"mask\" or \"opaque\"");
}

Status writeNumber(const MaterialField& f, double v, Shape& s, Services& services) {
  if (std::isnan(v)) return wrong(f, "nan", "set a number");
  const MaterialEdit edit{0, indexOf(f), std::bit_cast<uint64_t>(v)};
  if (f.flag)
    editAll(s, services, edit, [&](Material& m) { *f.flag(m) = v != 0; });
  else
    editAll(s, services, edit, [&](Material& m) { *f.number(m) = v; });
  return {};
}

// The slot of the shape's first face.
uint16_t firstSlot(const Shape& s) {
  if (s.geometry.kind != GeometryKind::Mesh || s.geometry.mesh->empty()) return 0;
  return s.geometry.mesh->faces[0].materialSlot;
}

}  // namespace

std::span<const MaterialField> materialFields() { return kFields; }

std::string_view shortName(const MaterialField& f) {
  return std::string_view(f.name).substr(std::string_view("material.").size());
}

bool isOldName(const MaterialField& f) {
  return std::string_view(f.doc).starts_with("Old name of ");
}

bool isTexture(const MaterialField& f) {
  const std::string_view name = shortName(f);
  return f.text != nullptr && (name.ends_with("map") || isOldName(f));
}

const MaterialField* materialField(std::string_view name) {
  const auto at = std::find_if(std::begin(kFields), std::end(kFields),
                               [&](const MaterialField& f) { return shortName(f) == name; });
  return at == std::end(kFields) ? nullptr : at;
}

Value readField(const MaterialField& f, const Material& m, ValuePool& pool) {
  // The accessors are made for writing; reading through them changes nothing.
  Material& material = const_cast<Material&>(m);
  if (f.number) return Value::of(*f.number(material));
  if (f.flag) return Value::of(*f.flag(material));
  if (f.text) return pool.string(*f.text(material));
  return pool.string(f.name == kRgbName ? colorText(m.color) : modeName(m.opacityMode));
}

Status writeField(const MaterialField& f, const Value& v, Shape& s, Services& services,
                  std::string_view file) {
  if (f.type == kString) return writeText(f, services.pool().text(v.id), s, services, file);
  return writeNumber(f, v.number, s, services);
}

Status writeFieldText(const MaterialField& f, std::string_view v, Shape& s, Services& services,
                      std::string_view file) {
  if (f.type == kString) return writeText(f, v, s, services, file);
  if (v == "true" || v == "false") return writeNumber(f, v == "true", s, services);
  const std::string digits(v);
  char* end = nullptr;
  const double number = std::strtod(digits.c_str(), &end);
  if (digits.empty() || *end != 0) return wrong(f, v, "write a number");
  return writeNumber(f, number, s, services);
}

void setColor(Shape& s, const Vec3& rgb, double opacity, Services& services) {
  const Vec3 c{std::clamp(rgb.x, 0.0, 1.0), std::clamp(rgb.y, 0.0, 1.0),
               std::clamp(rgb.z, 0.0, 1.0)};
  const auto bits = [](double v) { return std::bit_cast<uint64_t>(v); };
  editAll(s, services, {0, kColorEdit, bits(c.x), bits(c.y), bits(c.z)},
          [&](Material& m) { m.color = c; });
  if (!(opacity >= 0)) return;
  const double o = std::min(opacity, 1.0);
  editAll(s, services, {0, kColorAndOpacityEdit, bits(o)}, [&](Material& m) { m.opacity = o; });
}

void setTexture(Shape& s, std::string_view path, Services& services, std::string_view file) {
  const std::string content = resolved(path, services, file);
  const bool alpha = !content.empty() && services.assets().image(path, file).hasAlpha;
  editAll(s, services,
          {0, alpha ? kAlphaTextureEdit : kTextureEdit, hashBytes(content), hashBytes(content, 1),
           content.size()},
          [&](Material& m) {
            // What is laid in metres has pictures that belong together.
            if (isLaid(m)) m = Material{};
            m.map(TextureLayer::Color).path = content;
            m.map(TextureLayer::Opacity).path = alpha ? content : std::string();
          });
}

Status setLibraryMaterial(Shape& s, std::string_view name, const Vec3* tint, Services& services,
                          std::string_view file) {
  Material m;
  if (const LibraryMaterial* entry = libraryMaterial(name)) {
    m = laidMaterial(*entry, tint);
  } else {
    const std::string path = "materials/" + std::string(name) + "/material.mtl";
    Result<Material> own = services.assets().material(path, file);
    if (!own.ok() && own.error().code == "missing-file") {
      return Status::failure("unknown-material", "there is no material '" + std::string(name) + "'",
                             materialHint(name));
    }
    if (!own.ok()) {
      return Status::failure("bad-material", own.error().message, own.error().hint);
    }
    m = std::move(*own);
    m.name = name;
    m.shader = std::string(kLaidShader) + "own";
    if (tint) m.color = *tint;
  }
  editAll(s, services, {0, kLibraryEdit, contentHash(m), hashBytes(name), 0},
          [&](Material& to) { to = m; });
  return {};
}

MaterialId usedMaterial(const Shape& s, const Services& services) {
  const uint16_t slot = firstSlot(s);
  const auto& list = services.attributes().materials(s.assetMaterials);
  return slot == 0 || slot > list.size() / 2 ? s.material : list[slot - 1u];
}

MaterialId geometryMaterial(const Shape& s, const Services& services) {
  const uint16_t slot = firstSlot(s);
  const auto& list = services.attributes().materials(s.assetMaterials);
  return slot == 0 || slot > list.size() / 2 ? 0 : list[list.size() / 2 + slot - 1u];
}

Material overlaid(const Material& own, const Material& model) {
  const Material plain;
  Material out = model;
  Material& from = const_cast<Material&>(own);
  Material& base = const_cast<Material&>(plain);
  for (const MaterialField& f : kFields) {
    if (f.number && *f.number(from) != *f.number(base)) *f.number(out) = *f.number(from);
    if (f.text && *f.text(from) != *f.text(base)) *f.text(out) = *f.text(from);
    if (f.flag && *f.flag(from) != *f.flag(base)) *f.flag(out) = *f.flag(from);
  }
  // A colour is one thing: its components that happen to be the default's count too.
  for (Vec3 Material::*color :
       {&Material::color, &Material::ambient, &Material::specular, &Material::emissive}) {
    if (own.*color != plain.*color) out.*color = own.*color;
  }
  if (own.opacityMode != plain.opacityMode) out.opacityMode = own.opacityMode;
  return out;
}

void setModelMaterials(Shape& s, const AssetModel& model, Services& services) {
  if (model.materials.empty()) return;
  MaterialTable& table = services.materials();
  const Material& own = table.get(s.material);
  std::vector<MaterialId> list;
  list.reserve(model.materials.size() * 2);
  for (const Material& m : model.materials) list.push_back(table.intern(overlaid(own, m)));
  for (const Material& m : model.materials) list.push_back(table.intern(m));
  std::vector<StringId> groups;
  for (const std::string& name : model.groups) groups.push_back(services.pool().intern(name));
  s.assetMaterials = services.attributes().internMaterials(std::move(list), std::move(groups));
}

namespace {

// The first slot of each key, for the slots that the mesh has.
template <class KeyOf>
std::vector<uint16_t> firstOfKey(const Shape& s, KeyOf keyOf) {
  size_t slots = 1;
  if (s.geometry.kind == GeometryKind::Mesh) {
    for (const MeshFace& f : s.geometry.mesh->faces) {
      slots = std::max(slots, size_t{f.materialSlot} + 1);
    }
  }
  std::vector<uint16_t> first(slots);
  std::map<decltype(keyOf(size_t{0})), uint16_t> known;
  for (size_t slot = 0; slot < slots; ++slot) {
    first[slot] = known.try_emplace(keyOf(slot), static_cast<uint16_t>(slot)).first->second;
  }
  return first;
}

}  // namespace

std::vector<uint16_t> slotsByMaterial(const Shape& s, const Services& services) {
  const auto& list = services.attributes().materials(s.assetMaterials);
  const size_t n = list.size() / 2;
  return firstOfKey(s, [&](size_t slot) {
    const bool own = slot == 0 || slot > n;
    return own ? std::pair<MaterialId, MaterialId>{s.material, 0}
               : std::pair<MaterialId, MaterialId>{list[slot - 1], list[n + slot - 1]};
  });
}

std::vector<uint16_t> slotsByGroup(const Shape& s, const Services& services) {
  const auto& groups = services.attributes().groups(s.assetMaterials);
  return firstOfKey(s, [&](size_t slot) {
    return slot == 0 || slot > groups.size() ? StringId{0} : groups[slot - 1];
  });
}

void resetMaterials(Shape& s, bool own, bool geometry, Services& services) {
  MaterialTable& table = services.materials();
  if (own) s.material = 0;
  std::vector<MaterialId> list = services.attributes().materials(s.assetMaterials);
  const size_t n = list.size() / 2;
  if (n == 0) return;
  for (size_t i = 0; i < n; ++i) {
    MaterialId& original = list[n + i];
    if (geometry) original = 0;
    list[i] = table.intern(overlaid(table.get(s.material), table.get(original)));
  }
  keepMaterials(s, std::move(list), services);
}

}  // namespace gable
