// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A GLB begins with its JSON, which holds offsets, counts and bounds that are known only when the
// geometry behind it has been written. So the geometry is planned first (which primitives there
// will be), room is kept for the longest JSON that such a plan can have, the geometry is streamed,
// and the JSON is put into its room, filled up with spaces as the format allows.
//
// A unit's leaves are ordered by material variant, in the order in which variants first occur, and
// cut into primitives of at most 65535 vertices: indices then take two bytes, and what has to be
// kept in memory until a primitive ends is small. A mesh that has more vertices gets its own.
// Variants of one layout lie together, so that small primitives can share their vertices.
#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>
#include <span>

#include "base/files.h"
#include "base/hash.h"
#include "base/work.h"
#include "io/exporters/gltf_document.h"
#include "io/exporters/quaternion.h"
#include "io/exporters/vertex_writer.h"
#include "io/gltf_format.h"
#include "io/uri.h"
#include "material/library.h"
#include "scene/flatten.h"

namespace gable {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian");

constexpr uint32_t kMostVertices = 65535;
// Of primitives that share them. Some readers give each primitive a copy of all: it stays small.
constexpr uint32_t kMostShared = 1024;
constexpr uint64_t kMostInDocument = 50'000'000;
// Merged into one unit.
constexpr double kMostLeaves = 1e8;
// No grid begins farther from its unit's origin.
constexpr double kFarthest = 1e6;

// A part of a leaf's mesh: what one slot shows.
struct Draw {
  uint32_t leaf = 0, placement = 0;
  uint32_t variant = 0;
  uint16_t slot = 0;
  uint32_t corners = 0, triangles = 0;
};

using Instancing = WriteOptions::Instancing;

PlanOptions planFor(const WriteOptions& options) {
  // As wide as a grid of the coarsest steps reaches, but for the steps that rounding may take.
  constexpr double kWidest = (VertexGrid::kMostSteps - 4) * 2 * WriteOptions::kMostQuantized;
  PlanOptions plan;
  plan.share = options.instancing != Instancing::None;
  plan.whole = options.instancing == Instancing::Shapes;
  if (plan.whole || options.apart) return plan;
  if (options.instancing == Instancing::Auto) plan.mostNodes = WriteOptions::kMostNodes;
  if (options.vertices >= WriteOptions::Vertices::Compact) plan.widest = kWidest;
  return plan;
}

// With a vertex of 24 bytes, as if each prototype were written once.
bool isLarge(const Scene& scene) {
  constexpr uint64_t kVertex = 24, kTriangle = 6;
  std::vector<uint64_t> meshBytes(scene.meshes.size());
  for (size_t m = 0; m < meshBytes.size(); ++m) {
    work(scene.meshes[m]->faces.size() + 1);
    for (const SlotTally& s : slotTallies(*scene.meshes[m])) {
      meshBytes[m] += kVertex * s.corners + kTriangle * s.triangles;
    }
  }
  uint64_t bytes = 0;
  for (const Leaf& l : scene.leaves) {
    work();
    bytes += meshBytes[l.mesh];
    if (bytes > WriteOptions::kMostFloat) return true;
  }
  return false;
}

// Over all uv sets. Where normals are smooth, faces share vertices: they are one.
UvReach uvReachOf(const Mesh& m, bool flat) {
  UvReach reach{true, 0};
  for (const std::vector<Vec2>& uv : m.uvs) {
    if (uv.empty()) continue;
    Box3 all;
    for (size_t f = 0; f < m.faces.size(); ++f) {
      if (flat) all = {};
      for (const MeshLoop& l : m.loopsOf(f)) {
        for (uint32_t c = l.firstCorner; c < l.firstCorner + l.cornerCount; ++c) {
          const Vec2 at = uv[c];
          all.include(Vec3{at.x, at.y, 0});
          reach.unit = reach.unit && at.x >= 0 && at.x <= 1 && at.y >= 0 && at.y <= 1;
        }
      }
      if (all.empty()) continue;
      const Vec3 size = all.size();
      reach.most = std::max({reach.most, size.x, size.y});
    }
  }
  return reach;
}

class GltfWriter {
 public:
  GltfWriter(const Scene& scene, const std::string& path, const WriteOptions& options)
      : scene_(scene),
        path_(path),
        binary_(extensionOf(path) == "glb"),
        options_(options),
        plan_(scene, planFor(options)),
        gpu_(options.instancing == Instancing::Gpu || plan_.grouped()),
        materials_(scene, options, report_.warnings),
        document_(scene, plan_, materials_, options),
        recentVariants_(256, {~uint64_t{0}, 0}) {}

  Result<WriteReport> write();

 private:
  struct MeshInfo {
    bool known = false;
    Box3 bounds;
    uint32_t uvMask = 0;
    /// No normals of its own, no face that is smooth.
    bool flat = false;
    UvReach uv;
    std::vector<SlotTally> slots;
  };

  void planUnits();
  uint64_t planNodes();
  void makeDraws(uint32_t unit);
  Box3 boundsOf(const PlannedLeaf& p);
  VertexGrid gridFor(double largestScale);
  void cutPrimitives(std::vector<GltfPrimitive>& out, std::vector<size_t>* ends);
  void joinRuns(std::vector<GltfPrimitive>& primitives) const;
  void writeRun(FileWriter& out, VertexWriter& vertices, std::span<GltfPrimitive> run,
                std::span<const size_t> ends, size_t draw, const VertexGrid& grid);
  std::vector<uint32_t> rankByLayout(const std::vector<uint32_t>& variants) const;
  const MeshInfo& infoOf(uint32_t mesh);
  uint32_t variantOf(uint32_t material, const MeshInfo& info, UvForm form);
  UvForm uvFormOf(uint32_t material, const MeshInfo& info, const PlannedLeaf& p);
  Error tooLarge(uint64_t bytes) const;
  std::vector<bool> meshFlags() const;

  void writeBuffer(FileWriter& out);
  void writeInstances(FileWriter& out, uint32_t unit);
  void writeUnit(FileWriter& out, VertexWriter& vertices, uint32_t unit);
  void writeIndices(FileWriter& out, const PrimitiveState& state, bool wide);
  void align(FileWriter& out);
  uint64_t bytesOf(const GltfPrimitive& p, bool quantized) const;
  void countShown();

  void rewriteNodes(const std::vector<bool>& planned);
  Result<WriteReport> writeGlb();
  Result<WriteReport> writeSeparate();
  std::optional<Error> writeImageFiles();

  const Scene& scene_;
  std::string path_;
  bool binary_;
  const WriteOptions& options_;
  WriteReport report_;
  ScenePlan plan_;
  /// Equal children of a node are one node.
  bool gpu_;
  GltfMaterials materials_;
  GltfDocument document_;
  GltfContent content_;
  std::vector<MeshInfo> meshInfo_;
  std::vector<std::pair<uint64_t, uint32_t>> recentVariants_;
  // Where the buffer begins in the file.
  uint64_t bufferStart_ = 0;
  // Of the unit at hand.
  UnitContent unit_;
  std::vector<Draw> draws_, sorted_;
  // Of the run at hand.
  PrimitiveState state_;
  bool tooManyLeaves_ = false;
};

const GltfWriter::MeshInfo& GltfWriter::infoOf(uint32_t mesh) {
  MeshInfo& info = meshInfo_[mesh];
  if (!info.known) {
    const Mesh& m = *scene_.meshes[mesh];
    work(m.corners.size());
    info.known = true;
    info.bounds = m.bounds();
    for (int s = 0; s < kUvSets; ++s) info.uvMask |= m.hasUv(s) ? 1u << s : 0;
    info.flat = m.normals.empty() && std::none_of(m.faces.begin(), m.faces.end(),
                                                  [](const MeshFace& f) { return f.smooth; });
    info.slots = slotTallies(m);
    if (materials_.isCompact()) info.uv = uvReachOf(m, info.flat);
  }
  return info;
}

// Neighbouring leaves alternate between few materials: a table in front of the map.
uint32_t GltfWriter::variantOf(uint32_t material, const MeshInfo& info, UvForm form) {
  const uint64_t key = static_cast<uint64_t>(material) << 32 | info.uvMask << 1 | info.flat |
                       static_cast<uint64_t>(form) << 16;
  auto& entry = recentVariants_[mix64(key) % recentVariants_.size()];
  if (entry.first != key) entry = {key, materials_.variant(material, info.uvMask, info.flat, form)};
  return entry.second;
}

// What is laid has coordinates in metres: a face reaches no farther than its mesh.
UvForm GltfWriter::uvFormOf(uint32_t material, const MeshInfo& info, const PlannedLeaf& p) {
  if (!materials_.isCompact() || material == kNoMaterial) return UvForm::Float;
  if (!isLaid(scene_.materials[material])) {
    return info.uvMask == 0 ? UvForm::Float : materials_.uvFormOf(material, info.uv);
  }
  const Vec3 size = info.bounds.empty() ? Vec3{} : info.bounds.size();
  const bool own = p.placement == ScenePlan::kNone;
  const double most = length(own ? size : scaled(size, scene_.leaves[p.leaf].scale));
  return materials_.uvFormOf(material, {false, most});
}

// By variant: its place where those of one layout lie together, each kind where it first occurs.
std::vector<uint32_t> GltfWriter::rankByLayout(const std::vector<uint32_t>& variants) const {
  std::vector<uint32_t> rank(materials_.count(), kNoMaterial);
  uint32_t next = 0;
  for (size_t i = 0; i < variants.size(); ++i) {
    if (rank[variants[i]] != kNoMaterial) continue;
    const VertexLayout& layout = materials_.layout(variants[i]);
    for (size_t k = i; k < variants.size(); ++k) {
      uint32_t& r = rank[variants[k]];
      if (r == kNoMaterial && layout.isLike(materials_.layout(variants[k]))) r = next++;
    }
  }
  return rank;
}

// Fills draws_, ordered by variant and by path within one.
void GltfWriter::makeDraws(uint32_t unit) {
  draws_.clear();
  plan_.collect(unit, unit_);
  // Rank of each variant by its first occurrence in this unit.
  std::vector<uint32_t> order, rank(materials_.count(), kNoMaterial);
  for (const PlannedLeaf& p : unit_.leaves) {
    const Leaf& leaf = scene_.leaves[p.leaf];
    const MeshInfo& info = infoOf(leaf.mesh);
    work(info.slots.size());
    for (const SlotTally& s : info.slots) {
      const uint32_t material = materialIndexOf(scene_, leaf, s.slot);
      const uint32_t v = variantOf(material, info, uvFormOf(material, info, p));
      if (v >= rank.size()) rank.resize(v + size_t{1}, kNoMaterial);
      if (rank[v] == kNoMaterial) {
        rank[v] = static_cast<uint32_t>(order.size());
        order.push_back(v);
      }
      draws_.push_back({p.leaf, p.placement, v, s.slot, s.corners, s.triangles});
    }
  }
  if (order.size() < 2) return;
  rank = rankByLayout(order);
  std::vector<size_t> starts(order.size() + 1);
  for (const Draw& d : draws_) ++starts[rank[d.variant] + 1];
  for (size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
  sorted_.resize(draws_.size());
  for (const Draw& d : draws_) sorted_[starts[rank[d.variant]]++] = d;
  draws_.swap(sorted_);
}

// The primitives that draws_ become; `ends` tells where in draws_ each stops.
void GltfWriter::cutPrimitives(std::vector<GltfPrimitive>& out, std::vector<size_t>* ends) {
  uint64_t corners = 0;
  for (size_t i = 0; i < draws_.size(); ++i) {
    const Draw& d = draws_[i];
    const bool open = !out.empty() && i > 0 && out.back().variant == d.variant &&
                      corners + d.corners <= kMostVertices;
    if (!open) {
      if (i > 0 && ends) ends->push_back(i);
      GltfPrimitive p;
      p.variant = d.variant;
      // Until it is written: the most it can have, and more than nothing.
      p.indexCount = 3;
      out.push_back(p);
      corners = 0;
    }
    corners += d.corners;
    out.back().vertexCount = static_cast<uint32_t>(std::min<uint64_t>(corners, UINT32_MAX));
    out.back().indexCount = static_cast<uint32_t>(std::min<uint64_t>(
        uint64_t{out.back().indexCount} + 3 * uint64_t{d.triangles}, UINT32_MAX));
    out.back().wideIndices = corners > kMostVertices;
  }
  if (ends && !draws_.empty()) ends->push_back(draws_.size());
  joinRuns(out);
}

// Small primitives of one layout become runs; counts are the most that they can have.
void GltfWriter::joinRuns(std::vector<GltfPrimitive>& primitives) const {
  GltfPrimitive* run = nullptr;
  for (GltfPrimitive& p : primitives) {
    p.runIndices = p.indexCount;
    const bool joins = run && run->vertexCount + uint64_t{p.vertexCount} <= kMostShared &&
                       materials_.layout(run->variant).isLike(materials_.layout(p.variant));
    if (!joins) {
      run = &p;
      continue;
    }
    run->vertexCount += p.vertexCount;
    run->runIndices += p.indexCount;
    p.vertexCount = p.runIndices = 0;
    p.first = false;
  }
}

// In the unit's frame, where the leaf's mesh lies: no smaller.
Box3 GltfWriter::boundsOf(const PlannedLeaf& p) {
  const Leaf& leaf = scene_.leaves[p.leaf];
  const Box3& mesh = infoOf(leaf.mesh).bounds;
  if (p.placement == ScenePlan::kNone) return mesh;
  return boundsAt(mesh, unit_.placements[p.placement] * leaf.frame, leaf.scale);
}

// The finest grid that holds the unit at hand; none where a vertex might move too far.
VertexGrid GltfWriter::gridFor(double largestScale) {
  if (!materials_.isCompact()) return {};
  Box3 all;
  for (const PlannedLeaf& p : unit_.leaves) {
    work();
    const Box3 box = boundsOf(p);
    if (!box.empty()) all.include(box);
  }
  if (all.empty()) return {};
  double side = 0;
  for (size_t i = 0; i < 3; ++i) side = std::max(side, all.max[i] - all.min[i]);
  VertexGrid grid;
  grid.step = 1.0 / (1 << 20);
  const double coarsest = 2 * WriteOptions::kMostQuantized / largestScale;
  // Two steps are for the corner, which is rounded.
  while (grid.step <= coarsest && side > (VertexGrid::kMostSteps - 2) * grid.step) grid.step *= 2;
  grid.on = grid.step <= coarsest && length(all.min) < kFarthest;
  for (size_t i = 0; i < 3; ++i) grid.low[i] = std::floor(all.min[i] / grid.step) * grid.step;
  return grid;
}

void GltfWriter::planUnits() {
  const size_t count = plan_.units().size();
  meshInfo_.resize(scene_.meshes.size());
  content_.meshes.resize(count);
  content_.grids.resize(count);
  content_.instances.resize(count);
  std::vector<double> largestScale(count, 1);
  for (const auto& unit : plan_.units()) {
    for (const PlannedChild& c : unit.children) {
      for (size_t i = 0; i < 3; ++i) {
        largestScale[c.unit] = std::max(largestScale[c.unit], std::fabs(c.scale[i]));
      }
    }
  }
  uint64_t bytes = 0;
  for (uint32_t u = 0; u < count; ++u) {
    tooManyLeaves_ = plan_.tooLarge() || plan_.contentSize(u) > kMostLeaves;
    if (tooManyLeaves_) return;
    makeDraws(u);
    cutPrimitives(content_.meshes[u], nullptr);
    content_.grids[u] = gridFor(largestScale[u]);
    for (const Draw& d : draws_) {
      bytes += uint64_t{d.corners} * materials_.layout(d.variant).stride(content_.grids[u].on) +
               uint64_t{d.triangles} * 6;
    }
    // Each ends with up to three bytes of padding.
    bytes += 4 * content_.meshes[u].size();
    if (!gpu_) continue;
    for (const auto& g : GltfDocument::groupsOf(plan_, u, true)) {
      if (g.children.size() > 1) {
        content_.instances[u].push_back({0, static_cast<uint32_t>(g.children.size())});
        bytes += 40 * g.children.size();
      }
    }
  }
  content_.bufferBytes = bytes;
  for (const ModelTexture& t : materials_.images()) content_.bufferBytes += t.bytes.size() + 4;
}

Error GltfWriter::tooLarge(uint64_t bytes) const {
  return {"model-too-large",
          "'" + path_ + "' would hold " + std::to_string(bytes >> 20) +
              " MiB, but a .glb file ends at 4096 MiB",
          "write .gltf, or generate fewer shapes at a time"};
}

std::vector<bool> GltfWriter::meshFlags() const {
  std::vector<bool> flags;
  for (const auto& mesh : content_.meshes) {
    flags.push_back(std::any_of(mesh.begin(), mesh.end(),
                                [](const GltfPrimitive& p) { return p.indexCount > 0; }));
  }
  return flags;
}

void GltfWriter::align(FileWriter& out) {
  const uint64_t rest = (out.offset() - bufferStart_) % 4;
  if (rest) out.fill(0, 4 - rest);
}

void GltfWriter::writeIndices(FileWriter& out, const PrimitiveState& state, bool wide) {
  if (wide) {
    out.append(state.indices.data(), state.indices.size() * 4);
    return;
  }
  constexpr size_t kStep = 32768;
  for (size_t i = 0; i < state.indices.size(); i += kStep) {
    const size_t n = std::min(kStep, state.indices.size() - i);
    char* p = out.reserve(n * 2);
    for (size_t k = 0; k < n; ++k) {
      const auto index = static_cast<uint16_t>(state.indices[i + k]);
      std::memcpy(p + 2 * k, &index, 2);
    }
    out.advance(n * 2);
  }
}

void GltfWriter::writeInstances(FileWriter& out, uint32_t unit) {
  size_t next = 0;
  const std::vector<PlannedChild>& children = plan_.units()[unit].children;
  for (const auto& g : GltfDocument::groupsOf(plan_, unit, true)) {
    if (g.children.size() < 2) continue;
    content_.instances[unit][next++].offset = out.offset() - bufferStart_;
    const VertexGrid& grid = content_.grids[g.unit];
    const auto put = [&](std::initializer_list<double> values) {
      for (const double v : values) {
        const auto f = static_cast<float>(v);
        std::memcpy(out.reserve(4), &f, 4);
        out.advance(4);
      }
    };
    for (const uint32_t c : g.children) {
      const Vec3 o = GltfDocument::placeOf(children[c], grid);
      put({o.x, o.y, o.z});
    }
    for (const uint32_t c : g.children) {
      const auto q = quaternionOf(children[c].frame);
      put({q[0], q[1], q[2], q[3]});
    }
    for (const uint32_t c : g.children) {
      const Vec3 s = GltfDocument::scaleOf(children[c].scale, grid);
      put({s.x, s.y, s.z});
    }
  }
}

void GltfWriter::writeUnit(FileWriter& out, VertexWriter& vertices, uint32_t unit) {
  makeDraws(unit);
  std::vector<GltfPrimitive>& primitives = content_.meshes[unit];
  primitives.clear();
  std::vector<size_t> ends;
  cutPrimitives(primitives, &ends);
  for (size_t i = 0; i < primitives.size() && !out.failed();) {
    size_t end = i + 1;
    while (end < primitives.size() && !primitives[end].first) ++end;
    writeRun(out, vertices, {primitives.data() + i, end - i}, {ends.data() + i, end - i},
             i == 0 ? 0 : ends[i - 1], content_.grids[unit]);
    i = end;
  }
  vertices.trimCache();
}

// `ends` tells where in draws_ each primitive of the run stops, `draw` where the first begins.
void GltfWriter::writeRun(FileWriter& out, VertexWriter& vertices, std::span<GltfPrimitive> run,
                          std::span<const size_t> ends, size_t draw, const VertexGrid& grid) {
  PrimitiveState& state = state_;
  state.grid = grid;
  state.clear();
  const uint64_t offset = out.offset() - bufferStart_;
  // The first that has a triangle has the vertices.
  GltfPrimitive* first = nullptr;
  for (size_t i = 0; i < run.size(); ++i) {
    GltfPrimitive& p = run[i];
    const VertexLayout& layout = materials_.layout(p.variant);
    const size_t before = state.indices.size();
    for (; draw < ends[i]; ++draw) {
      const Draw& d = draws_[draw];
      work(d.corners);
      const Leaf& leaf = scene_.leaves[d.leaf];
      const bool own = d.placement == ScenePlan::kNone;
      vertices.add(leaf.mesh, d.slot, own ? Frame{} : unit_.placements[d.placement] * leaf.frame,
                   own ? Vec3{1, 1, 1} : leaf.scale, layout, state);
    }
    p.indexCount = static_cast<uint32_t>(state.indices.size() - before);
    p.vertexCount = p.runIndices = 0;
    p.wideIndices = state.vertexCount > kMostVertices;
    p.first = !first && p.indexCount > 0;
    if (p.first) first = &p;
  }
  if (!first) return;
  first->vertexOffset = offset;
  first->vertexCount = state.vertexCount;
  first->runIndices = static_cast<uint32_t>(state.indices.size());
  first->min = state.min;
  first->max = state.max;
  first->indexOffset = out.offset() - bufferStart_;
  writeIndices(out, state, first->wideIndices);
  align(out);
}

void GltfWriter::writeBuffer(FileWriter& out) {
  bufferStart_ = out.offset();
  VertexWriter vertices(scene_, out);
  const auto count = static_cast<uint32_t>(plan_.units().size());
  for (uint32_t u = 0; u < count && gpu_; ++u) writeInstances(out, u);
  for (uint32_t u = 0; u < count && !out.failed(); ++u) writeUnit(out, vertices, u);
  if (binary_) {
    for (const ModelTexture& t : materials_.images()) {
      content_.images.push_back({out.offset() - bufferStart_, t.bytes.size()});
      out.append(t.bytes);
      align(out);
    }
  }
  content_.bufferBytes = out.offset() - bufferStart_;
  if (vertices.brokenFaces() > 0) {
    report_.warnings.push_back(std::to_string(vertices.brokenFaces()) +
                               " faces are left out: their coordinates are too large or undefined");
  }
}

uint64_t GltfWriter::bytesOf(const GltfPrimitive& p, bool quantized) const {
  return uint64_t{p.vertexCount} * materials_.layout(p.variant).stride(quantized) +
         uint64_t{p.indexCount} * (p.wideIndices ? 4 : 2);
}

// Triangles with nodes expanded: units are shown by their nodes. What a unit takes is saved each
// time but the first.
void GltfWriter::countShown() {
  const size_t count = plan_.units().size();
  std::vector<uint64_t> shown(count);
  for (const PlannedRoot& r : plan_.roots()) ++shown[r.unit];
  // A parent's unit may come after its child's, so this follows the references in rounds of depth.
  std::vector<uint32_t> waiting(count);
  for (const auto& unit : plan_.units()) {
    for (const PlannedChild& c : unit.children) ++waiting[c.unit];
  }
  std::vector<uint32_t> ready;
  for (uint32_t u = 0; u < count; ++u) {
    if (waiting[u] == 0) ready.push_back(u);
  }
  while (!ready.empty()) {
    const uint32_t u = ready.back();
    ready.pop_back();
    uint64_t own = 0, bytes = 0;
    for (const GltfPrimitive& p : content_.meshes[u]) {
      own += p.indexCount / 3;
      bytes += bytesOf(p, content_.grids[u].on);
    }
    if (shown[u] > 1) {
      report_.savedBytes =
          saturatingAdd(report_.savedBytes, saturatingMultiply(bytes, shown[u] - 1));
    }
    report_.triangles = saturatingAdd(report_.triangles, saturatingMultiply(own, shown[u]));
    for (const PlannedChild& c : plan_.units()[u].children) {
      shown[c.unit] = saturatingAdd(shown[c.unit], shown[u]);
      if (--waiting[c.unit] == 0) ready.push_back(c.unit);
    }
  }
}

// Units that turned out to have no triangle have no mesh and perhaps no node.
void GltfWriter::rewriteNodes(const std::vector<bool>& planned) {
  if (meshFlags() == planned) return;
  planNodes();
  document_.writeNodes();
}

uint64_t GltfWriter::planNodes() { return document_.planNodes(meshFlags(), content_.grids, gpu_); }

Result<WriteReport> GltfWriter::writeGlb() {
  FileWriter out(path_);
  if (out.failed()) return out.finish().error();
  content_.images.resize(materials_.images().size());
  uint64_t room = document_.text(content_, true).size();
  room += (4 - room % 4) % 4;
  content_.images.clear();

  // A file without geometry has no second chunk.
  const bool hasBuffer = content_.bufferBytes > 0;
  out.fill(0, gltf::kGlbHead);
  out.fill(' ', room);
  if (hasBuffer) out.fill(0, gltf::kGlbChunkHead);
  const std::vector<bool> planned = meshFlags();
  writeBuffer(out);
  rewriteNodes(planned);
  std::string text = document_.text(content_, false);
  GABLE_CHECK_LE(text.size(), room);
  if (out.offset() > gltf::kGlbLimit) return tooLarge(out.offset());

  const auto word = [](uint64_t v) { return static_cast<uint32_t>(v); };
  const uint32_t head[5] = {gltf::kGlbMagic, gltf::kGlbVersion, word(out.offset()), word(room),
                            gltf::kJsonChunk};
  const uint32_t chunk[2] = {word(content_.bufferBytes), gltf::kBinaryChunk};
  text.insert(0, reinterpret_cast<const char*>(head), sizeof head);
  out.patch(0, text.data(), text.size());
  if (hasBuffer) out.patch(gltf::kGlbHead + room, chunk, sizeof chunk);
  const Result<uint64_t> bytes = out.finish();
  if (!bytes.ok()) return bytes.error();
  report_.bytes = bytes.value();
  report_.files = {path_};
  return report_;
}

std::optional<Error> GltfWriter::writeImageFiles() {
  const std::string stem = path_.substr(0, path_.size() - extensionOf(path_).size() - 1);
  for (const ModelTexture& t : materials_.images()) {
    const std::string file = stem + "-" + t.name;
    const Result<uint64_t> bytes = writeFile(file, t.bytes);
    if (!bytes.ok()) return bytes.error();
    report_.bytes += bytes.value();
    report_.files.push_back(file);
    content_.imageUris.push_back(uriOf(fileNameOf(file)));
  }
  return {};
}

Result<WriteReport> GltfWriter::writeSeparate() {
  report_.files = {path_};
  const std::string bufferPath = path_.substr(0, path_.size() - extensionOf(path_).size()) + "bin";
  FileWriter buffer(bufferPath);
  const std::vector<bool> planned = meshFlags();
  writeBuffer(buffer);
  rewriteNodes(planned);
  if (content_.bufferBytes > 0) {
    const Result<uint64_t> bytes = buffer.finish();
    if (!bytes.ok()) return bytes.error();
    report_.bytes += bytes.value();
    report_.files.push_back(bufferPath);
    content_.bufferUri = uriOf(fileNameOf(bufferPath));
  }
  if (auto error = writeImageFiles()) return *error;
  const Result<uint64_t> bytes = writeFile(path_, document_.text(content_, false));
  if (!bytes.ok()) return bytes.error();
  report_.bytes += bytes.value();
  return report_;
}

Result<WriteReport> GltfWriter::write() {
  planUnits();
  if (tooManyLeaves_) {
    return Error{"model-too-large", "'" + path_ + "' would show more leaves than can be written",
                 "generate fewer shapes at a time"};
  }
  if (binary_ && content_.bufferBytes > gltf::kGlbLimit) return tooLarge(content_.bufferBytes);
  uint64_t nodes = planNodes();
  const uint64_t most = planFor(options_).mostNodes;
  if (materials_.isCompact() && most > 0 && nodes > most) {
    // Without nodes for meshes beside children.
    for (uint32_t u = 0; u < plan_.units().size(); ++u) {
      if (plan_.units()[u].children.empty() || !content_.grids[u].on) continue;
      content_.grids[u].on = false;
      for (const GltfPrimitive& p : content_.meshes[u]) {
        const VertexLayout& layout = materials_.layout(p.variant);
        content_.bufferBytes +=
            uint64_t{p.vertexCount} * (layout.stride(false) - layout.stride(true));
      }
    }
    nodes = planNodes();
  }
  if (nodes > kMostInDocument) {
    return Error{"model-too-large",
                 "'" + path_ + "' would have " + std::to_string(nodes) + " nodes",
                 "generate fewer shapes at a time"};
  }
  document_.writeNodes();
  Result<WriteReport> result = binary_ ? writeGlb() : writeSeparate();
  if (!result.ok()) return result;
  countShown();
  result->triangles = report_.triangles;
  result->savedBytes = report_.savedBytes;
  return result;
}

}  // namespace

Result<WriteReport> writeGltf(const Scene& scene, const std::string& path,
                              const WriteOptions& options) {
  using Vertices = WriteOptions::Vertices;
  WriteOptions chosen = options;
  if (options.vertices == Vertices::Auto) {
    chosen.vertices = isLarge(scene) ? Vertices::Compact : Vertices::Float;
  }
  return GltfWriter(scene, path, chosen).write();
}

}  // namespace gable
