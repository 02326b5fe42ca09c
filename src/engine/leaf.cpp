// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What is known of one leaf. It is found by the counts of prototypes, so that no instance is
// expanded for it.

#include "engine/impl.h"
#include "scene/flatten.h"

namespace gable {

namespace {

/// A rule's shape above a leaf, with the leaves below it.
struct Above {
  uint32_t name = 0;
  uint64_t first = 0, end = 0;
};

struct FoundLeaf {
  const Leaf* leaf = nullptr;
  Frame world;
  /// Those that were derived as prototypes, from the initial shape down.
  std::vector<Above> above;
};

/// The leaf of that number in path order.
FoundLeaf leafAt(const Scene& scene, uint64_t wanted) {
  const std::vector<uint64_t> counts = prototypeLeafCounts(scene);
  FoundLeaf found;
  uint64_t first = 0;
  const Prototype* p = nullptr;
  const auto enter = [&](const Instance& instance) {
    p = &scene.prototypes[instance.prototype];
    found.world = found.world * instance.frame;
    found.above.push_back({p->name, first, first + counts[instance.prototype]});
  };
  for (const Root& r : scene.roots) {
    const uint64_t here = counts[r.instance.prototype];
    if (wanted < first + here) {
      enter(r.instance);
      break;
    }
    first += here;
  }
  while (p) {
    const Prototype* at = p;
    uint32_t leaf = 0;
    bool inner = false;
    for (uint32_t i = 0; i < at->instanceCount && !inner; ++i) {
      const Instance& instance = scene.instances[at->firstInstance + i];
      const uint32_t before = instance.leavesBefore - leaf;
      if (wanted < first + before) break;
      first += before;
      leaf = instance.leavesBefore;
      const uint64_t here = counts[instance.prototype];
      inner = wanted < first + here;
      if (inner)
        enter(instance);
      else
        first += here;
    }
    if (inner) continue;
    found.leaf = &scene.leaves[at->firstLeaf + leaf + (wanted - first)];
    found.world = found.world * found.leaf->frame;
    break;
  }
  return found;
}

// The box of a leaf's mesh in the leaf's own frame.
void writeScope(JsonWriter& json, const Scene& scene, const FoundLeaf& found) {
  Box3 box;
  for (const Vec3& v : scene.meshes[found.leaf->mesh]->positions) {
    box.include(scaled(v, found.leaf->scale));
  }
  const Frame& w = found.world;
  const Vec3 origin = w.point(box.min), size = box.size();
  json.key("frame").beginArray();
  for (const Vec3& v : {origin, w.x, w.y, w.z}) json.value(v.x).value(v.y).value(v.z);
  json.endArray().key("size").beginArray();
  json.value(size.x).value(size.y).value(size.z);
  json.endArray();
}

void writeAbove(JsonWriter& json, const Scene& scene, const std::vector<Above>& above) {
  json.key("above").beginArray();
  for (const Above& a : above) {
    json.beginObject().key("name").value(scene.names[a.name]);
    json.key("from").value(a.first).key("to").value(a.end).endObject();
  }
  json.endArray();
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
  const Scene& scene = impl_->scene();
  const FoundLeaf found = leafAt(scene, number);
  const Leaf* leaf = found.leaf;
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
  json.endObject();
  writeScope(json, scene, found);
  writeAbove(json, scene, found.above);
  json.endObject();
  return out;
}

}  // namespace gable
