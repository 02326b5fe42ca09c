// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Accessors are numbered in the order of writing: first those of instance groups, which nodes name,
// then those of primitives, unit by unit. Each primitive has two buffer views, one for its vertices
// and one for its indices.
#include "io/exporters/gltf_document.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/number.h"
#include "base/work.h"
#include "io/exporters/quaternion.h"
#include "io/gltf_format.h"
#include "scene/flatten.h"

namespace gable {
namespace {

using namespace gltf;

// The widest text that a coordinate can have.
constexpr float kWidestFloat = -1.17549435e-38f;
/// work() of a node or a primitive: its text takes about a microsecond.
constexpr size_t kWorkOfText = 64;
constexpr float kWidestStep = static_cast<float>(VertexGrid::kMostSteps);

void writeRounded(JsonWriter& w, double v, int decimals) {
  char text[kNumberRoom];
  w.raw({text, static_cast<size_t>(writeFixed(text, v, decimals) - text)});
}

void writeVec(JsonWriter& w, const char* name, const Vec3& v, int decimals) {
  w.key(name).beginArray();
  for (size_t i = 0; i < 3; ++i) writeRounded(w, v[i], decimals);
  w.endArray();
}

void writeSteps(JsonWriter& w, const Vec3& v) {
  w.key("scale").beginArray();
  for (size_t i = 0; i < 3; ++i) w.value(static_cast<float>(v[i]));
  w.endArray();
}

void writeFloats(JsonWriter& w, const char* name, const std::array<float, 3>& v) {
  w.key(name).beginArray();
  for (const float f : v) w.value(f);
  w.endArray();
}

bool isEmpty(const std::vector<GltfPrimitive>& mesh) {
  return std::all_of(mesh.begin(), mesh.end(),
                     [](const GltfPrimitive& p) { return p.indexCount == 0; });
}

}  // namespace

GltfDocument::GltfDocument(const Scene& scene, const ScenePlan& plan,
                           const GltfMaterials& materials, const WriteOptions& options)
    : scene_(scene), plan_(plan), materials_(materials), options_(options) {}

std::vector<GltfDocument::Group> GltfDocument::groupsOf(const ScenePlan& plan, uint32_t unit,
                                                        bool instanced) {
  std::vector<Group> groups;
  std::map<uint32_t, size_t> at;
  const std::vector<PlannedChild>& children = plan.units()[unit].children;
  work(children.size());
  for (uint32_t c = 0; c < children.size(); ++c) {
    const uint32_t shown = children[c].unit;
    const bool groupable = instanced && plan.units()[shown].children.empty();
    const auto known = groupable ? at.find(shown) : at.end();
    if (known != at.end()) {
      groups[known->second].children.push_back(c);
    } else {
      if (groupable) at[shown] = groups.size();
      groups.push_back({shown, {c}});
    }
  }
  return groups;
}

Vec3 GltfDocument::placeOf(const PlannedChild& c, const VertexGrid& grid) {
  return grid.on ? c.frame.point(scaled(grid.low, c.scale)) : c.frame.origin;
}

Vec3 GltfDocument::scaleOf(const Vec3& scale, const VertexGrid& grid) {
  return grid.on ? scale * grid.step : scale;
}

uint64_t GltfDocument::planNodes(const std::vector<bool>& hasMesh,
                                 const std::vector<VertexGrid>& grids, bool instanced) {
  instanced_ = instanced;
  grids_ = grids;
  const size_t count = plan_.units().size();
  meshNumbers_.assign(count, -1);
  int64_t meshes = 0;
  for (size_t u = 0; u < count; ++u) {
    if (hasMesh[u]) meshNumbers_[u] = meshes++;
  }
  instanceBase_.assign(count, 0);
  uint32_t accessors = 0;
  for (uint32_t u = 0; u < count; ++u) {
    instanceBase_[u] = accessors;
    if (!instanced_) continue;
    for (const Group& g : groupsOf(plan_, u, true)) accessors += g.children.size() > 1 ? 3 : 0;
  }
  countNodes();
  uint64_t all = 0;
  for (const PlannedRoot& r : plan_.roots()) all = saturatingAdd(all, nodeCounts_[r.unit]);
  return all;
}

// Depth first with a stack of our own; a unit is counted when its children are.
void GltfDocument::countNodes() {
  const size_t count = plan_.units().size();
  constexpr uint64_t kUnknown = ~uint64_t{0};
  nodeCounts_.assign(count, kUnknown);
  apart_.assign(count, false);
  std::vector<uint32_t> stack;
  for (uint32_t root = 0; root < count; ++root) {
    stack.push_back(root);
    while (!stack.empty()) {
      const uint32_t u = stack.back();
      if (nodeCounts_[u] != kUnknown) {
        stack.pop_back();
        continue;
      }
      const size_t before = stack.size();
      uint64_t nodes = 0;
      for (const Group& g : groupsOf(plan_, u, instanced_)) {
        if (nodeCounts_[g.unit] == kUnknown) {
          stack.push_back(g.unit);
        } else {
          nodes = saturatingAdd(nodes, nodesFor(g));
        }
      }
      if (stack.size() > before) continue;
      apart_[u] = nodes > 0 && meshNumbers_[u] >= 0 && grids_[u].on;
      if (apart_[u]) nodes = saturatingAdd(nodes, 1);
      nodeCounts_[u] = nodes > 0 || meshNumbers_[u] >= 0 ? saturatingAdd(nodes, 1) : 0;
      stack.pop_back();
    }
  }
}

uint64_t GltfDocument::nodesFor(const Group& g) const {
  return g.children.size() > 1 ? std::min<uint64_t>(nodeCounts_[g.unit], 1) : nodeCounts_[g.unit];
}

const std::string& GltfDocument::nameOf(uint32_t unit) const {
  static const std::string kNone;
  const ScenePlan::Unit& u = plan_.units()[unit];
  if (u.leaf == ScenePlan::kNone && u.prototype == ScenePlan::kNone) return kNone;
  const uint32_t name =
      u.leaf != ScenePlan::kNone ? scene_.leaves[u.leaf].name : scene_.prototypes[u.prototype].name;
  return name < scene_.names.size() ? scene_.names[name] : kNone;
}

void GltfDocument::writeExtras(JsonWriter& w, const Leaf& leaf) const {
  if (leaf.source >= scene_.sources.size()) return;
  const SourcePlace& s = scene_.sources[leaf.source];
  if (s.rule.empty()) return;
  w.key("extras").beginObject().field("rule", s.rule).field("line", s.line).endObject();
}

void GltfDocument::writeNode(JsonWriter& w, const OpenUnit& open, const NodePlace& place) const {
  const uint32_t unit = open.unit;
  w.beginObject();
  if (!place.name->empty()) w.field("name", *place.name);
  const bool onGrid = grids_[unit].on && meshNumbers_[unit] >= 0 && !apart_[unit];
  if (meshNumbers_[unit] >= 0 && !apart_[unit]) w.field("mesh", meshNumbers_[unit]);
  const Frame& f = *place.frame;
  const Vec3 origin = onGrid ? f.point(scaled(grids_[unit].low, place.scale)) : f.origin;
  if (origin != Vec3{}) writeVec(w, "translation", origin, 6);
  if (f.turned) {
    w.key("rotation").beginArray();
    for (const double q : quaternionOf(f)) writeRounded(w, q, 9);
    w.endArray();
  }
  if (onGrid)
    writeSteps(w, scaleOf(place.scale, grids_[unit]));
  else if (place.scale != Vec3{1, 1, 1})
    writeVec(w, "scale", place.scale, 9);
  uint64_t next = open.next;
  bool any = apart_[unit];
  if (any) w.key("children").beginArray().value(next - 1);
  for (const Group& g : open.groups) {
    const uint64_t nodes = nodesFor(g);
    if (nodes == 0) continue;
    if (!any) w.key("children").beginArray();
    any = true;
    w.value(next);
    next += nodes;
  }
  if (any) w.endArray();
  if (place.leaf != PlannedChild::kNone) writeExtras(w, scene_.leaves[place.leaf]);
  if (place.levels && !place.levels->empty()) writeLevels(w, *place.levels);
  w.endObject();
}

// How much of a view each level wants is known of the extension's readers only, not of its text.
void GltfDocument::writeLevels(JsonWriter& w, const std::vector<uint64_t>& levels) const {
  w.key("extensions").beginObject().key("MSFT_lod").beginObject().key("ids").beginArray();
  for (const uint64_t node : levels) w.value(node);
  w.endArray().endObject().endObject();
  w.key("extras").beginObject().key("MSFT_screencoverage").beginArray();
  for (size_t i = 0; i <= levels.size() && i < options_.coverage.size(); ++i) {
    w.value(i == levels.size() ? 0 : options_.coverage[i]);
  }
  w.endArray().endObject();
}

// By root: the nodes of its levels that are there.
std::vector<std::vector<uint64_t>> GltfDocument::levelNodes() const {
  constexpr uint64_t kNone = ~uint64_t{0};
  std::vector<uint64_t> nodeOf(scene_.roots.size(), kNone);
  uint64_t index = 0;
  for (const PlannedRoot& root : plan_.roots()) {
    if (nodeCount(root.unit) > 0) nodeOf[root.root] = index;
    index += nodeCount(root.unit);
  }
  std::vector<std::vector<uint64_t>> out(scene_.roots.size());
  for (size_t r = 0; r < options_.levels.size(); ++r) {
    for (const uint32_t level : options_.levels[r]) {
      if (nodeOf[level] != kNone) out[r].push_back(nodeOf[level]);
    }
  }
  return out;
}

void GltfDocument::writeMeshNode(JsonWriter& w, uint32_t unit) const {
  const VertexGrid& grid = grids_[unit];
  w.beginObject().field("mesh", meshNumbers_[unit]);
  if (grid.low != Vec3{}) writeVec(w, "translation", grid.low, 6);
  writeSteps(w, scaleOf({1, 1, 1}, grid));
  w.endObject();
}

// A node that shows all children of a group.
void GltfDocument::writeGroup(JsonWriter& w, const Group& g, uint32_t accessor) const {
  w.beginObject().field("name", nameOf(g.unit)).field("mesh", meshNumbers_[g.unit]);
  w.key("extensions").beginObject().key("EXT_mesh_gpu_instancing").beginObject();
  w.key("attributes").beginObject().field("TRANSLATION", accessor);
  w.field("ROTATION", accessor + 1).field("SCALE", accessor + 2).endObject();
  w.endObject().endObject().endObject();
}

// A unit's node, that of its mesh, then those below it, each before its own. Units nest as deep as
// rules do, so those at work are a list.
void GltfDocument::writeTree(JsonWriter& w, uint32_t unit, const NodePlace& place, uint64_t index) {
  std::vector<OpenUnit> open;
  const auto begin = [&](uint32_t u, const NodePlace& at, uint64_t number) {
    work(kWorkOfText);
    const uint64_t first = number + (apart_[u] ? 2 : 1);
    open.push_back({u, first, instanceBase_[u], 0, groupsOf(plan_, u, instanced_)});
    writeNode(w, open.back(), at);
    if (apart_[u]) writeMeshNode(w, u);
  };
  begin(unit, place, index);
  while (!open.empty()) {
    OpenUnit& top = open.back();
    if (top.group == top.groups.size()) {
      open.pop_back();
      continue;
    }
    const Group& g = top.groups[top.group++];
    const uint64_t nodes = nodeCount(g.unit);
    const uint64_t number = top.next;
    if (g.children.size() > 1) {
      if (nodes > 0) writeGroup(w, g, top.accessor);
      top.next += nodes > 0 ? 1 : 0;
      top.accessor += 3;
    } else if (nodes > 0) {
      const PlannedChild& c = plan_.units()[top.unit].children[g.children[0]];
      top.next += nodes;
      begin(c.unit, {&c.frame, c.scale, &nameOf(c.unit), c.leaf}, number);
    }
  }
}

void GltfDocument::writeNodes() {
  nodes_.clear();
  roots_.clear();
  JsonWriter nodes(nodes_), roots(roots_);
  nodes.beginArray();
  roots.beginArray();
  uint64_t index = 0;
  static const std::string kNoName;
  std::vector<std::vector<uint64_t>> levels;
  std::vector<bool> isLevel(scene_.roots.size());
  if (!options_.levels.empty()) levels = levelNodes();
  for (const auto& of : options_.levels) {
    for (const uint32_t level : of) isLevel[level] = true;
  }
  hasLevels_ = false;
  for (const PlannedRoot& root : plan_.roots()) {
    if (nodeCount(root.unit) == 0) continue;
    const bool named =
        root.root != PlannedRoot::kAll && scene_.roots[root.root].name < scene_.names.size();
    const std::string& name = named ? scene_.names[scene_.roots[root.root].name] : kNoName;
    NodePlace place{&root.frame, {1, 1, 1}, &name, PlannedChild::kNone};
    if (!levels.empty()) place.levels = &levels[root.root];
    hasLevels_ = hasLevels_ || (place.levels && !place.levels->empty());
    writeTree(nodes, root.unit, place, index);
    if (levels.empty() || !isLevel[root.root]) roots.value(index);
    index += nodeCount(root.unit);
  }
  nodes.endArray();
  roots.endArray();
  nodesWritten_ = index;
}

void GltfDocument::writeMeshes(JsonWriter& w, const GltfContent& content) const {
  uint64_t accessor = 0;
  for (const auto& groups : content.instances) accessor += 3 * groups.size();
  bool any = false;
  // Of the run.
  uint64_t vertices = 0;
  for (uint32_t u = 0; u < content.meshes.size(); ++u) {
    if (isEmpty(content.meshes[u])) continue;
    if (!any) w.key("meshes").beginArray();
    any = true;
    w.beginObject();
    if (!nameOf(u).empty()) w.field("name", nameOf(u));
    w.key("primitives").beginArray();
    for (const GltfPrimitive& p : content.meshes[u]) {
      work(kWorkOfText);
      if (p.indexCount == 0) continue;
      const VertexLayout& l = materials_.layout(p.variant);
      if (p.first) {
        vertices = accessor;
        accessor += l.attributes();
      }
      uint64_t attribute = vertices;
      w.beginObject().key("attributes").beginObject();
      w.field("POSITION", attribute++);
      if (l.normals) w.field("NORMAL", attribute++);
      if (l.tangentSet >= 0) w.field("TANGENT", attribute++);
      for (uint32_t i = 0; i < l.uvCount; ++i) {
        w.field("TEXCOORD_" + std::to_string(i), attribute++);
      }
      w.endObject();
      w.field("indices", accessor++);
      w.field("material", materials_.materialOf(p.variant)).endObject();
    }
    w.endArray().endObject();
  }
  if (any) w.endArray();
}

void GltfDocument::writeAccessors(JsonWriter& w, const GltfContent& content, bool roomy) const {
  uint32_t view = 0;
  bool any = false;
  const auto begin = [&](uint32_t bufferView, uint32_t offset, int component, uint32_t count,
                         const char* type) {
    if (!any) w.key("accessors").beginArray();
    any = true;
    w.beginObject().field("bufferView", bufferView);
    if (offset) w.field("byteOffset", offset);
    w.field("componentType", component).field("count", count).field("type", type);
  };
  for (const auto& groups : content.instances) {
    for (const GltfInstances& g : groups) {
      begin(view++, 0, kFloat, g.count, "VEC3");
      w.endObject();
      begin(view++, 0, kFloat, g.count, "VEC4");
      w.endObject();
      begin(view++, 0, kFloat, g.count, "VEC3");
      w.endObject();
    }
  }
  for (size_t u = 0; u < content.meshes.size(); ++u) {
    const bool onGrid = content.grids[u].on;
    std::array<float, 3> widest;
    widest.fill(onGrid ? kWidestStep : kWidestFloat);
    // Where the indices begin within those of the run.
    uint32_t indices = 0;
    for (const GltfPrimitive& p : content.meshes[u]) {
      work(kWorkOfText);
      if (p.indexCount == 0) continue;
      const VertexLayout& l = materials_.layout(p.variant);
      const uint32_t count = p.vertexCount;
      uint32_t offset = 0;
      const auto attribute = [&](const char* type, int component, uint32_t bytes) {
        begin(view - 2, offset, component, count, type);
        if (component == kByte || (component == kUnsignedShort && offset > 0)) {
          w.field("normalized", true);
        }
        if (offset == 0) {
          writeFloats(w, "min", roomy ? widest : p.min);
          writeFloats(w, "max", roomy ? widest : p.max);
        }
        w.endObject();
        offset += bytes;
      };
      if (p.first) {
        view += 2;
        indices = 0;
        const int direction = l.compact ? kByte : kFloat;
        attribute("VEC3", onGrid ? kUnsignedShort : kFloat, l.positionBytes(onGrid));
        if (l.normals) attribute("VEC3", direction, l.normalBytes());
        if (l.tangentSet >= 0) attribute("VEC4", kFloat, l.tangentBytes());
        const int uv = l.uvForm == UvForm::Float ? kFloat : kUnsignedShort;
        for (uint32_t i = 0; i < l.uvCount; ++i) attribute("VEC2", uv, l.uvBytes());
      }
      const int index = p.wideIndices ? kUnsignedInt : kUnsignedShort;
      begin(view - 1, indices, index, p.indexCount, "SCALAR");
      w.endObject();
      indices += p.indexCount * 2;
    }
  }
  if (any) w.endArray();
}

void GltfDocument::writeViews(JsonWriter& w, const GltfContent& content, bool roomy) const {
  bool any = false;
  const auto view = [&](uint64_t offset, uint64_t bytes, uint32_t stride, int target) {
    if (!any) w.key("bufferViews").beginArray();
    any = true;
    w.beginObject().field("buffer", 0);
    w.field("byteOffset", roomy ? content.bufferBytes : offset);
    w.field("byteLength", bytes);
    if (stride) w.field("byteStride", stride);
    if (target) w.field("target", target);
    w.endObject();
  };
  for (const auto& groups : content.instances) {
    for (const GltfInstances& g : groups) {
      const uint64_t n = g.count;
      view(g.offset, 12 * n, 0, 0);
      view(g.offset + 12 * n, 16 * n, 0, 0);
      view(g.offset + 28 * n, 12 * n, 0, 0);
    }
  }
  for (size_t u = 0; u < content.meshes.size(); ++u) {
    for (const GltfPrimitive& p : content.meshes[u]) {
      work(kWorkOfText);
      if (p.indexCount == 0 || !p.first) continue;
      const uint32_t stride = materials_.layout(p.variant).stride(content.grids[u].on);
      view(p.vertexOffset, uint64_t{p.vertexCount} * stride, stride, kArrayBuffer);
      view(p.indexOffset, uint64_t{p.runIndices} * (p.wideIndices ? 4 : 2), 0, kElementArrayBuffer);
    }
  }
  for (const GltfImageRange& i : content.images) view(i.offset, i.bytes, 0, 0);
  if (any) w.endArray();
}

void GltfDocument::writeImages(JsonWriter& w, const GltfContent& content) const {
  const std::vector<ModelTexture>& images = materials_.images();
  if (images.empty()) return;
  uint64_t view = 0;
  for (const auto& groups : content.instances) view += 3 * groups.size();
  for (const auto& mesh : content.meshes) {
    for (const GltfPrimitive& p : mesh) view += p.indexCount > 0 && p.first ? 2 : 0;
  }
  w.key("images").beginArray();
  for (size_t i = 0; i < images.size(); ++i) {
    w.beginObject().field("name", images[i].name);
    if (content.imageUris.empty()) {
      w.field("bufferView", view + i).field("mimeType", images[i].mime);
    } else {
      w.field("uri", content.imageUris[i]);
    }
    w.endObject();
  }
  w.endArray();
}

std::string GltfDocument::text(const GltfContent& content, bool roomy) const {
  std::string out;
  JsonWriter w(out);
  w.beginObject();
  w.key("asset").beginObject().field("version", "2.0").field("generator", "Gable");
  if (scene_.geoOrigin.present) {
    w.key("extras").beginObject().key("geoOrigin").beginArray();
    w.value(scene_.geoOrigin.longitude).value(scene_.geoOrigin.latitude).endArray().endObject();
  }
  w.endObject();
  bool groups = false;
  for (const auto& g : content.instances) groups = groups || !g.empty();
  const bool compact =
      materials_.isCompact() && !std::all_of(content.meshes.begin(), content.meshes.end(), isEmpty);
  const auto extensions = [&](const char* key, bool transforms, const std::set<std::string>& more) {
    if (!groups && !compact && !transforms && more.empty()) return;
    w.key(key).beginArray();
    if (groups) w.value("EXT_mesh_gpu_instancing");
    if (compact) w.value("KHR_mesh_quantization");
    if (transforms) w.value("KHR_texture_transform");
    for (const std::string& name : more) w.value(name);
    w.endArray();
  };
  std::set<std::string> used = materials_.extensions();
  if (hasLevels_) used.insert("MSFT_lod");
  extensions("extensionsUsed", materials_.usesTransforms(), used);
  extensions("extensionsRequired", materials_.needsTransforms(), {});
  w.field("scene", 0).key("scenes").beginArray().beginObject();
  if (nodesWritten_ > 0) w.key("nodes").raw(roots_);
  w.endObject().endArray();
  if (nodesWritten_ > 0) w.key("nodes").raw(nodes_);
  writeMeshes(w, content);
  materials_.write(w);
  writeImages(w, content);
  writeAccessors(w, content, roomy);
  writeViews(w, content, roomy);
  if (content.bufferBytes > 0) {
    w.key("buffers").beginArray().beginObject();
    if (!content.bufferUri.empty()) w.field("uri", content.bufferUri);
    w.field("byteLength", content.bufferBytes);
    w.endObject().endArray();
  }
  w.endObject();
  return out;
}

}  // namespace gable
