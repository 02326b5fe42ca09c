// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What is known of one leaf. It is found by the counts of prototypes, so that no instance is
// expanded for it.

#include "engine/impl.h"
#include "scene/flatten.h"

namespace gable {

namespace {

/// The leaf of that number in path order; null when there is none.
const Leaf* leafAt(const Scene& scene, uint64_t number) {
  const std::vector<uint64_t> counts = prototypeLeafCounts(scene);
  const Prototype* p = nullptr;
  for (const Root& r : scene.roots) {
    const uint64_t here = counts[r.instance.prototype];
    if (number < here) {
      p = &scene.prototypes[r.instance.prototype];
      break;
    }
    number -= here;
  }
  while (p) {
    const Prototype* inner = nullptr;
    uint32_t leaf = 0;
    for (uint32_t i = 0; i < p->instanceCount && !inner; ++i) {
      const Instance& instance = scene.instances[p->firstInstance + i];
      const uint32_t before = instance.leavesBefore - leaf;
      if (number < before) break;
      number -= before;
      leaf = instance.leavesBefore;
      const uint64_t here = counts[instance.prototype];
      if (number < here)
        inner = &scene.prototypes[instance.prototype];
      else
        number -= here;
    }
    if (!inner) return &scene.leaves[p->firstLeaf + leaf + number];
    p = inner;
  }
  return nullptr;
}

void writeMaterial(JsonWriter& json, const Material& m) {
  json.beginObject();
  if (!m.name.empty()) json.key("name").value(m.name);
  json.key("color").value(colorText(m.color)).key("opacity").value(m.opacity);
  json.key("roughness").value(m.roughness).key("metallic").value(m.metallic);
  if (m.emissive.x + m.emissive.y + m.emissive.z > 0) {
    json.key("emissive").value(colorText(m.emissive));
  }
  for (size_t layer = 0; layer < kTextureLayers; ++layer) {
    if (!m.maps[layer].path.empty()) {
      json.key(kTextureLayerNames[layer]).value(m.maps[layer].path);
    }
  }
  json.endObject();
}

void writePlain(JsonWriter& json, const PlainValue& v) {
  switch (v.kind) {
    case PlainValue::Kind::Number: json.value(v.number); break;
    case PlainValue::Kind::Bool: json.value(v.number != 0); break;
    case PlainValue::Kind::Text: json.value(v.text); break;
  }
}

}  // namespace

void writeAttribute(JsonWriter& json, const AttributeValue& a) {
  if (a.rows == 0) {
    if (a.values.empty())
      json.null();
    else
      writePlain(json, a.values[0]);
    return;
  }
  json.beginArray();
  for (uint32_t r = 0; r < a.rows; ++r) {
    if (a.rows > 1) json.beginArray();
    for (uint32_t c = 0; c < a.columns; ++c) writePlain(json, a.values[r * a.columns + c]);
    if (a.rows > 1) json.endArray();
  }
  json.endArray();
}

std::string Model::leafJson(uint64_t number) const {
  const Scene& scene = impl_->result.scene;
  const Leaf* leaf = leafAt(scene, number);
  if (!leaf) return {};
  std::string out;
  JsonWriter json(out);
  json.beginObject().key("name").value(scene.names[leaf->name]);
  if (leaf->source < scene.sources.size()) {
    const SourcePlace& s = scene.sources[leaf->source];
    json.key("rule").value(s.rule).key("file").value(s.file);
    json.key("line").value(s.line).key("column").value(s.column);
  }
  const Mesh& mesh = *scene.meshes[leaf->mesh];
  json.key("faces").value(static_cast<uint64_t>(mesh.faceCount()));
  json.key("vertices").value(static_cast<uint64_t>(mesh.positions.size()));
  json.key("material");
  writeMaterial(json, materialOf(scene, *leaf, 0));
  json.key("attributes").beginObject();
  if (leaf->attributes < scene.attributeSets.size()) {
    for (const AttributeValue& a : scene.attributeSets[leaf->attributes]) {
      json.key(a.name);
      writeAttribute(json, a);
    }
  }
  json.endObject().endObject();
  return out;
}

}  // namespace gable
