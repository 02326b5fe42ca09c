// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/city_text.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "base/number.h"

namespace gable {
namespace {

uint64_t hashOf(const CityVertices::Vertex& v) {
  uint64_t h = 0;
  for (const int64_t n : v) h = hashCombine(h, static_cast<uint64_t>(n));
  return h;
}

// Values in `depth` lists, which of several solids begin anew behind each.
void appendValues(std::string& out, const std::vector<uint32_t>& values,
                  const std::vector<size_t>& listEnds, int depth) {
  out += "\"values\":";
  out.append(static_cast<size_t>(depth), '[');
  size_t list = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    work();
    if (list < listEnds.size() && i == listEnds[list]) {
      out += "]],[[";
      ++list;
    } else if (i > 0) {
      out += ',';
    }
    if (values[i] == CitySurfaces::kNone) {
      out += "null";
    } else {
      appendNumber(out, values[i]);
    }
  }
  out.append(static_cast<size_t>(depth), ']');
}

bool saysSomething(const std::vector<uint32_t>& values) {
  return std::any_of(values.begin(), values.end(),
                     [](uint32_t v) { return v != CitySurfaces::kNone; });
}

}  // namespace

void appendNumber(std::string& out, int64_t v) {
  char text[kNumberRoom];
  char* end = text;
  if (v < 0) *end++ = '-';
  end = writeInteger(end, v < 0 ? ~static_cast<uint64_t>(v) + 1 : static_cast<uint64_t>(v));
  out.append(text, static_cast<size_t>(end - text));
}

uint32_t CityVertices::add(const Vertex& v) {
  if (slots_.size() < 2 * (all_.size() + 1)) grow();
  size_t at = hashOf(v) & (slots_.size() - 1);
  for (; slots_[at] != 0; at = (at + 1) & (slots_.size() - 1)) {
    if (all_[slots_[at] - 1] == v) return slots_[at] - 1;
  }
  all_.push_back(v);
  slots_[at] = static_cast<uint32_t>(all_.size());
  return slots_[at] - 1;
}

void CityVertices::grow() {
  const size_t size = std::max<size_t>(1024, slots_.size() * 2);
  workMemory(size * sizeof(uint32_t) + size / 2 * sizeof(Vertex));
  slots_.assign(size, 0);
  for (size_t i = 0; i < all_.size(); ++i) {
    size_t at = hashOf(all_[i]) & (size - 1);
    while (slots_[at] != 0) at = (at + 1) & (size - 1);
    slots_[at] = static_cast<uint32_t>(i + 1);
  }
}

void CityVertices::clear() {
  all_.clear();
  std::fill(slots_.begin(), slots_.end(), 0);
}

void appendSurfaces(std::string& out, const CitySurfaces& s, int depth) {
  if (saysSomething(s.semanticOf)) {
    out += ",\"semantics\":";
    JsonWriter w(out);
    w.beginObject().key("surfaces").beginArray();
    for (const CitySurfaces::Semantic& each : s.semantics) {
      w.beginObject().field("type", each.type);
      if (!each.name.empty()) w.field("name", each.name);
      w.endObject();
    }
    w.endArray();
    out += ',';
    appendValues(out, s.semanticOf, s.listEnds, depth);
    out += '}';
  }
  if (!saysSomething(s.materialOf)) return;
  out += ",\"material\":{\"gable\":{";
  const bool isOne = std::all_of(s.materialOf.begin(), s.materialOf.end(),
                                 [&](uint32_t m) { return m == s.materialOf[0]; });
  if (isOne) {
    out += "\"value\":";
    appendNumber(out, s.materialOf[0]);
  } else {
    appendValues(out, s.materialOf, s.listEnds, depth);
  }
  out += "}}";
}

uint32_t CityMaterials::use(uint32_t material) {
  if (material >= all_.size()) return CitySurfaces::kNone;
  numbers_.resize(all_.size(), CitySurfaces::kNone);
  if (numbers_[material] == CitySurfaces::kNone) {
    numbers_[material] = static_cast<uint32_t>(used_.size());
    used_.push_back(material);
    for (const TextureMap& map : all_[material].maps) {
      hasTextures_ = hasTextures_ || !map.path.empty();
    }
  }
  return numbers_[material];
}

void CityMaterials::write(std::string& out) const {
  JsonWriter w(out);
  w.beginObject().field("default-theme-material", "gable").key("materials").beginArray();
  const auto part = [](double v) { return std::isfinite(v) ? std::clamp(v, 0.0, 1.0) : 0.0; };
  const auto color = [&](const char* name, const Vec3& c) {
    w.key(name).beginArray();
    for (size_t i = 0; i < 3; ++i) w.value(part(c[i]));
    w.endArray();
  };
  for (const uint32_t i : used_) {
    const Material& m = all_[i];
    w.beginObject();
    w.field("name", m.name.empty() ? "material " + std::to_string(i) : m.name);
    color("diffuseColor", m.color);
    if (m.emissive != Vec3{}) color("emissiveColor", m.emissive);
    color("specularColor", m.specular);
    w.field("shininess", part(1 - m.roughness)).field("transparency", part(1 - m.opacity));
    w.endObject();
  }
  w.endArray().endObject();
}

void CityMaterials::clear() {
  used_.clear();
  numbers_.clear();
}

}  // namespace gable
