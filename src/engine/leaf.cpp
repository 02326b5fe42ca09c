// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What is known of one leaf, and of the parts above it. It is found by the counts of prototypes, so
// that no instance is expanded for it. Values and materials in their public form.

#include "engine/impl.h"
#include "scene/flatten.h"

namespace gable {

namespace {

/// A rule's shape above a leaf, with the leaves below it.
struct Above {
  const Prototype* prototype = nullptr;
  uint64_t first = 0, end = 0;
};

struct FoundLeaf {
  const Leaf* leaf = nullptr;
  Frame world;
  /// Those that were derived as prototypes, from the initial shape down.
  std::vector<Above> above;
};

/// The leaf of that number in path order.
FoundLeaf leafAt(const Scene& scene, const std::vector<uint64_t>& counts, uint64_t wanted) {
  FoundLeaf found;
  uint64_t first = 0;
  const Prototype* p = nullptr;
  const auto enter = [&](const Instance& instance) {
    p = &scene.prototypes[instance.prototype];
    found.world = found.world * instance.frame;
    found.above.push_back({p, first, first + counts[instance.prototype]});
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
void setScope(LeafInfo& out, const Scene& scene, const FoundLeaf& found) {
  Box3 box;
  for (const Vec3& v : scene.meshes[found.leaf->mesh]->positions) {
    box.include(scaled(v, found.leaf->scale));
  }
  const Frame& w = found.world;
  size_t i = 0;
  for (const Vec3& v : {w.point(box.min), w.x, w.y, w.z}) {
    for (const double d : {v.x, v.y, v.z}) out.frame[i++] = d;
  }
  const Vec3 size = box.size();
  out.size = {size.x, size.y, size.z};
}

RuleValue::Scalar scalarOf(const PlainValue& v) {
  switch (v.kind) {
    case PlainValue::Kind::Number: return v.number;
    case PlainValue::Kind::Bool: return v.number != 0;
    case PlainValue::Kind::Text: break;
  }
  return v.text;
}

}  // namespace

RuleValue ruleValueOf(const AttributeValue& a) {
  RuleValue out;
  if (a.rows > 0) out.array = RuleValue::Size{a.rows, a.columns};
  for (const PlainValue& v : a.values) out.items.push_back(scalarOf(v));
  return out;
}

AttributeValue attributeValueOf(const NamedValue& given) {
  AttributeValue out;
  out.name = given.name;
  if (given.value.array) {
    out.rows = given.value.array->rows;
    out.columns = given.value.array->columns;
  }
  for (const RuleValue::Scalar& item : given.value.items) {
    PlainValue& v = out.values.emplace_back();
    if (const auto* number = std::get_if<double>(&item)) {
      v.number = *number;
    } else if (const auto* flag = std::get_if<bool>(&item)) {
      v.kind = PlainValue::Kind::Bool;
      v.number = *flag ? 1 : 0;
    } else {
      v.kind = PlainValue::Kind::Text;
      v.text = std::get<std::string>(item);
    }
  }
  return out;
}

std::vector<NamedValue> namedValuesOf(const std::vector<AttributeValue>& attributes) {
  std::vector<NamedValue> out;
  for (const AttributeValue& a : attributes) out.push_back({a.name, ruleValueOf(a)});
  return out;
}

MaterialInfo materialInfoOf(const Material& m) {
  MaterialInfo out;
  out.name = m.name;
  out.color = colorText(m.color);
  out.opacity = m.opacity;
  out.roughness = m.roughness;
  out.metallic = m.metallic;
  if (m.emissive.x + m.emissive.y + m.emissive.z > 0) out.emissive = colorText(m.emissive);
  for (size_t layer = 0; layer < kTextureLayers; ++layer) {
    if (m.maps[layer].path.empty()) continue;
    out.textures.emplace_back(kTextureLayerNames[layer], m.maps[layer].path);
  }
  return out;
}

std::optional<LeafInfo> leafOf(const Scene& scene, uint64_t number) {
  const FoundLeaf found = leafAt(scene, prototypeLeafCounts(scene), number);
  const Leaf* leaf = found.leaf;
  if (!leaf) return std::nullopt;
  LeafInfo out;
  out.name = scene.names[leaf->name];
  if (leaf->source < scene.sources.size()) {
    const SourcePlace& s = scene.sources[leaf->source];
    out.source = LeafInfo::Source{s.rule, s.file, s.line, s.column};
  }
  const Mesh& mesh = *scene.meshes[leaf->mesh];
  out.faces = mesh.faceCount();
  out.vertices = mesh.positions.size();
  out.material = materialInfoOf(materialOf(scene, *leaf, 0));
  if (leaf->attributes < scene.attributeSets.size()) {
    std::vector<AttributeValue> set;
    for (const uint32_t place : scene.attributeSets[leaf->attributes]) {
      set.push_back(scene.attributeValues[place]);
    }
    out.attributes = namedValuesOf(set);
  }
  setScope(out, scene, found);
  for (const Above& a : found.above) {
    out.parts.push_back({scene.names[a.prototype->name], a.first, a.end});
  }
  return out;
}

ModelParts partsOf(const Scene& scene, uint64_t leaf, size_t level, uint64_t most) {
  const std::vector<uint64_t> counts = prototypeLeafCounts(scene);
  ModelParts out;
  uint64_t next = 0;
  const auto add = [&](uint32_t name, uint64_t leaves, bool isLeaf) {
    work();
    if (leaves == 0) return;
    if (out.parts.size() < most)
      out.parts.push_back({scene.names[name], next, next + leaves, isLeaf});
    else
      ++out.more;
    next += leaves;
  };
  const auto addInstance = [&](const Instance& instance) {
    add(scene.prototypes[instance.prototype].name, counts[instance.prototype], false);
  };
  if (level == 0) {
    for (const Root& r : scene.roots) addInstance(r.instance);
    return out;
  }
  const FoundLeaf found = leafAt(scene, counts, leaf);
  if (level > found.above.size()) return out;
  const Prototype& p = *found.above[level - 1].prototype;
  next = found.above[level - 1].first;
  uint32_t done = 0;
  for (uint32_t i = 0; i <= p.instanceCount; ++i) {
    const bool last = i == p.instanceCount;
    const Instance* instance = last ? nullptr : &scene.instances[p.firstInstance + i];
    const uint32_t end = last ? p.leafCount : instance->leavesBefore;
    for (; done < end; ++done) add(scene.leaves[p.firstLeaf + done].name, 1, true);
    if (instance) addInstance(*instance);
  }
  return out;
}

}  // namespace gable
