// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "material/material.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <string_view>
#include <unordered_map>

#include "base/hash.h"
#include "base/interned.h"

namespace gable {

const std::array<const char*, kTextureLayers> kTextureLayerNames = {
    "colormap",  "bumpmap",     "dirtmap",      "specularmap",  "opacitymap",
    "normalmap", "emissivemap", "occlusionmap", "roughnessmap", "metallicmap"};

namespace {

uint64_t hashVec(uint64_t h, const Vec3& v) {
  return hashCombine(hashCombine(hashCombine(h, hashDouble(v.x)), hashDouble(v.y)),
                     hashDouble(v.z));
}

}  // namespace

uint64_t contentHash(const Material& m) {
  uint64_t h = hashBytes(m.name);
  for (const Vec3* v : {&m.color, &m.ambient, &m.specular, &m.emissive}) h = hashVec(h, *v);
  for (double v : {m.opacity, m.reflectivity, m.shininess, m.bumpValue, m.metallic, m.roughness,
                   m.opacityCutoff}) {
    h = hashCombine(h, hashDouble(v));
  }
  h = hashCombine(h, (m.doubleSided ? 1u : 0u) | static_cast<unsigned>(m.opacityMode) << 1);
  h = hashBytes(m.shader, h);
  for (const TextureMap& t : m.maps) {
    h = hashBytes(t.path, h);
    if (t.path.empty()) continue;
    for (double v : {t.su, t.sv, t.tu, t.tv, t.rw}) h = hashCombine(h, hashDouble(v));
  }
  return h;
}

struct MaterialTable::Impl {
  struct Entry {
    Material material;
    uint64_t hash = 0;
    bool operator==(const Entry& o) const { return material == o.material; }
  };
  Interned<Entry> entries;

  struct EditHash {
    size_t operator()(const MaterialEdit& e) const {
      uint64_t h = uint64_t{e.base} << 32 | e.field;
      for (const uint64_t v : {e.a, e.b, e.c}) h = hashCombine(h, v);
      return h;
    }
  };
  std::mutex mutex;
  // Looked up, never walked through.
  std::unordered_map<MaterialEdit, MaterialId, EditHash> edits;
};

MaterialTable::MaterialTable() : impl_(std::make_unique<Impl>()) { intern(Material{}); }
MaterialTable::~MaterialTable() = default;

MaterialId MaterialTable::intern(const Material& m) {
  const uint64_t hash = contentHash(m);
  return impl_->entries.intern(hash, {m, hash});
}

const Material& MaterialTable::get(MaterialId id) const { return impl_->entries.get(id).material; }
uint64_t MaterialTable::hashOf(MaterialId id) const { return impl_->entries.get(id).hash; }

bool MaterialTable::findEdit(const MaterialEdit& edit, MaterialId& id) const {
  std::lock_guard lock(impl_->mutex);
  const auto at = impl_->edits.find(edit);
  if (at == impl_->edits.end()) return false;
  id = at->second;
  return true;
}

void MaterialTable::rememberEdit(const MaterialEdit& edit, MaterialId id) {
  std::lock_guard lock(impl_->mutex);
  if (impl_->edits.size() < impl_->entries.capacity()) impl_->edits.emplace(edit, id);
}

bool parseColor(std::string_view text, Vec3& rgb, double& opacity) {
  if ((text.size() != 7 && text.size() != 9) || text[0] != '#') return false;
  double parts[4] = {};
  for (size_t i = 0; 2 * i + 1 < text.size(); ++i) {
    int value = 0;
    for (char c : text.substr(1 + 2 * i, 2)) {
      const int digit = c >= '0' && c <= '9'   ? c - '0'
                        : c >= 'a' && c <= 'f' ? c - 'a' + 10
                        : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                               : -1;
      if (digit < 0) return false;
      value = value * 16 + digit;
    }
    parts[i] = value / 255.0;
  }
  rgb = {parts[0], parts[1], parts[2]};
  if (text.size() == 9) opacity = parts[3];
  return true;
}

std::string colorText(const Vec3& rgb) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string out = "#";
  for (size_t i = 0; i < 3; ++i) {
    const int v = static_cast<int>(std::lround(std::clamp(rgb[i], 0.0, 1.0) * 255));
    out += kDigits[v / 16];
    out += kDigits[v % 16];
  }
  return out;
}

}  // namespace gable
