// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// One pass counts how often each mesh stands, one how much each batch will hold, and the last one
// sorts leaves into batches, several threads a range of them each. A batch is named by what a draw
// call cannot change: geometry, textures and the class of the material. Counting visits what is
// stored, sorting what is flattened. A large place has hundreds of megabytes here: memory that is
// asked for once is touched once.

#include "io/exporters/draw_list.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <deque>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>
#include <unordered_map>

#include "base/json.h"
#include "base/parallel.h"
#include "base/work.h"
#include "io/exporters/surface.h"
#include "material/library.h"
#include "scene/flatten.h"

namespace gable {

namespace {

/// From so many places on, instances are smaller than merged copies of even a small mesh.
constexpr uint32_t kOftenEnough = 3;
// Each geometry of its own is a draw call, or several; beyond so many only those that save most.
constexpr size_t kMostOwn = 100;
constexpr uint32_t kMerged = 0xffffffff;
/// A thread has at least so many leaves.
constexpr uint64_t kLeavesAPart = 1 << 16;
/// Behind the bytes: what they become a part of goes in front, without moving house.
constexpr size_t kRoom = 1 << 20;
/// Stands for the zero scale of a flat shape, which no normal survives.
constexpr double kFlat = 1e-5;

bool isWhole(const Vec3& scale) {
  const auto one = [](double s) { return std::abs(std::abs(s) - 1) < 1e-3; };
  return one(scale.x) && one(scale.y) && one(scale.z);
}

// The part of a material that a batch has in common. Roughness and the like in steps nobody sees.
struct Look {
  std::string map;
  double su = 1, sv = 1, tu = 0, tv = 0, rw = 0;
  int roughness = 10, metallic = 0, opacity = 20;
  int cutoff = -1;
  uint32_t emissive = 0;
  /// Its coordinates are metres.
  bool laid = false;
  auto tie() const {
    return std::tie(map, su, sv, tu, tv, rw, roughness, metallic, opacity, cutoff, emissive, laid);
  }
  bool operator<(const Look& o) const { return tie() < o.tie(); }
};

uint32_t rgb8(const Vec3& c) {
  const auto byte = [](double v) {
    return static_cast<uint32_t>(std::lround(std::clamp(v, 0.0, 1.0) * 255));
  };
  return byte(c.x) | byte(c.y) << 8 | byte(c.z) << 16 | 0xff000000u;
}

Look lookOf(const Material& m) {
  Look l;
  const TextureMap& map = m.map(TextureLayer::Color);
  l.map = map.path;
  l.laid = isLaid(m);
  if (!l.map.empty())
    std::tie(l.su, l.sv, l.tu, l.tv, l.rw) = std::tie(map.su, map.sv, map.tu, map.tv, map.rw);
  l.roughness = static_cast<int>(std::lround(std::clamp(m.roughness, 0.0, 1.0) * 10));
  l.metallic = static_cast<int>(std::lround(std::clamp(m.metallic, 0.0, 1.0) * 10));
  if (m.opacityMode == OpacityMode::Mask)
    l.cutoff = static_cast<int>(std::lround(m.opacityCutoff * 20));
  else if (m.opacityMode == OpacityMode::Blend)
    l.opacity = static_cast<int>(std::lround(std::clamp(m.opacity, 0.0, 1.0) * 20));
  l.emissive = rgb8(m.emissive) & 0xffffffu;
  return l;
}

struct BatchKey {
  uint32_t look = 0;
  uint32_t mesh = kMerged;
  uint16_t slot = 0;
  bool mirrored = false;
  auto tie() const { return std::tie(look, mesh, slot, mirrored); }
  bool operator<(const BatchKey& o) const { return tie() < o.tie(); }
};

struct Batch {
  std::vector<float> positions, normals, uvs, leaves;
  std::vector<uint32_t> colors, indices;
  std::vector<float> matrices, instanceLeaves;
  std::vector<uint32_t> instanceColors;
};

// What is drawn of a material. `group`: the first paint of the same look.
struct Paint {
  Look look;
  uint32_t color = 0;
  uint32_t group = 0;
};

// What a batch will hold; upper bounds.
struct Tally {
  uint64_t instances = 0, corners = 0, triangles = 0;
};

float narrow(double v) { return static_cast<float>(v); }

void push(std::vector<float>& out, const Vec3& v) {
  out.push_back(narrow(v.x));
  out.push_back(narrow(v.y));
  out.push_back(narrow(v.z));
}

// What all threads look up: who draws which material, what stands how often, how much there will
// be.
class Plan {
 public:
  explicit Plan(const Scene& scene)
      : scene_(scene), leavesOf_(prototypeLeafCounts(scene)), paints_(scene.materials.size() + 1) {
    for (const std::vector<uint32_t>& list : scene.materialLists) {
      laidLists_.push_back(
          std::any_of(list.begin(), list.end(), [&](uint32_t m) { return isLaidPaint(m); }));
    }
    countPrototypes();
    countMeshes();
    findOften();
    findPaints();
    all_ = leafCount(scene_);
    // Where only the first leaves are drawn, nobody knows how much of a batch that is.
    if (all_ <= kMostLeaves) tallyBatches();
  }

  const Scene& scene() const { return scene_; }
  uint64_t leaves() const { return std::min(all_, kMostLeaves); }
  bool truncated() const { return all_ > kMostLeaves; }
  uint64_t leavesOf(uint32_t prototype) const { return leavesOf_[prototype]; }
  const Paint& paint(uint32_t number) const { return paints_[number]; }
  size_t paints() const { return paints_.size(); }
  bool isSingle(uint32_t mesh) const { return uses_[mesh] == 1; }
  /// What is laid in metres stands often only where it is not scaled.
  bool isOften(const Leaf& leaf) const {
    if (leaf.mesh >= kFirstMesh && !often_[leaf.mesh]) return false;
    return isWhole(leaf.scale) || !isLaidLeaf(leaf);
  }
  bool isLaidLeaf(const Leaf& leaf) const {
    return leaf.materials < laidLists_.size() && laidLists_[leaf.materials];
  }
  bool isLaidPaint(uint32_t number) const {
    return number < scene_.materials.size() && isLaid(scene_.materials[number]);
  }

  // The place of a leaf's material among the paints.
  uint32_t paintOf(const Leaf& leaf, uint16_t slot) const {
    const uint32_t material = materialIndexOf(scene_, leaf, slot);
    return material == kNoMaterial ? static_cast<uint32_t>(scene_.materials.size()) : material;
  }

  // `look`: what stands for it.
  static BatchKey keyOf(const Leaf& leaf, uint16_t slot, bool often, uint32_t look) {
    const bool mirrored = leaf.scale.x * leaf.scale.y * leaf.scale.z < 0;
    return {look, often ? leaf.mesh : kMerged, often ? slot : uint16_t{0}, often && mirrored};
  }

  /// By a key whose look is the group of its paint; null where it is not known.
  const Tally* tally(const BatchKey& byGroup) const {
    const auto found = tallies_.find(byGroup);
    return found == tallies_.end() ? nullptr : &found->second;
  }

 private:
  const Scene& scene_;
  // How often each prototype stands.
  void countPrototypes() {
    times_.assign(scene_.prototypes.size(), 0);
    for (const Root& r : scene_.roots) ++times_[r.instance.prototype];
    for (size_t p = scene_.prototypes.size(); p-- > 0;) {
      const Prototype& prototype = scene_.prototypes[p];
      for (uint32_t i = 0; i < prototype.instanceCount; ++i) {
        uint64_t& inner = times_[scene_.instances[prototype.firstInstance + i].prototype];
        inner = saturatingAdd(inner, times_[p]);
      }
    }
  }

  void countMeshes() {
    uses_.assign(scene_.meshes.size(), 0);
    for (size_t p = 0; p < scene_.prototypes.size(); ++p) {
      const Prototype& prototype = scene_.prototypes[p];
      for (uint32_t i = 0; i < prototype.leafCount; ++i) {
        uint64_t& used = uses_[scene_.leaves[prototype.firstLeaf + i].mesh];
        used = saturatingAdd(used, times_[p]);
      }
    }
  }

  void findOften() {
    std::vector<std::pair<double, uint32_t>> own;
    for (uint32_t m = kFirstMesh; m < uses_.size(); ++m) {
      if (uses_[m] < kOftenEnough) continue;
      const double copies = static_cast<double>(uses_[m] - 1);
      own.push_back({-copies * static_cast<double>(scene_.meshes[m]->positions.size()), m});
    }
    std::sort(own.begin(), own.end());
    if (own.size() > kMostOwn) own.resize(kMostOwn);
    often_.assign(uses_.size(), false);
    for (const auto& [saved, m] : own) often_[m] = true;
  }

  void findPaints() {
    static const Material kPlain;
    std::map<Look, uint32_t> first;
    for (uint32_t m = 0; m < paints_.size(); ++m) {
      work();
      const Material& material = m < scene_.materials.size() ? scene_.materials[m] : kPlain;
      Look look = lookOf(material);
      const uint32_t group = first.try_emplace(look, m).first->second;
      paints_[m] = {std::move(look), rgb8(material.color), group};
    }
  }

  // How much each batch will hold, by what is stored.
  void tallyBatches() {
    for (size_t p = 0; p < scene_.prototypes.size(); ++p) {
      const Prototype& prototype = scene_.prototypes[p];
      work(prototype.leafCount + 1);
      if (times_[p] == 0) continue;
      for (uint32_t i = 0; i < prototype.leafCount; ++i) {
        count(scene_.leaves[prototype.firstLeaf + i], times_[p]);
      }
    }
  }

  void count(const Leaf& leaf, uint64_t times) {
    const auto [at, fresh] = slots_.try_emplace(leaf.mesh);
    if (fresh) at->second = slotTallies(*scene_.meshes[leaf.mesh]);
    const bool often = isOften(leaf);
    for (const SlotTally& slot : at->second) {
      const uint32_t group = paints_[paintOf(leaf, slot.slot)].group;
      Tally& sum = tallies_[keyOf(leaf, slot.slot, often, group)];
      sum.instances += times;
      sum.corners += times * slot.corners;
      sum.triangles += times * slot.triangles;
    }
  }

  const std::vector<uint64_t> leavesOf_;
  uint64_t all_ = 0;
  /// By prototype, by mesh: how often it stands.
  std::vector<uint64_t> times_, uses_;
  std::vector<bool> often_;
  /// By list of materials: whether one of them is laid in metres.
  std::vector<bool> laidLists_;
  /// By material, the default one last.
  std::vector<Paint> paints_;
  std::unordered_map<uint32_t, std::vector<SlotTally>> slots_;
  std::map<BatchKey, Tally> tallies_;
};

// The batches of a range of leaves in path order. Looks are numbered as they come.
class Part {
 public:
  Part(const Plan& plan, uint64_t from, uint64_t to)
      : plan_(plan), scene_(plan.scene()), from_(from), to_(to), looks_(plan.paints()) {}

  void build() {
    for (const Root& r : scene_.roots) {
      if (enters(r.instance)) {
        addPrototype(scene_.prototypes[r.instance.prototype], r.instance.frame);
      }
    }
  }
  std::map<BatchKey, Batch>& batches() { return batches_; }
  /// By look: a paint that has it.
  const std::vector<uint32_t>& looks() const { return lookOrder_; }

 private:
  // As forEachLeaf, but it ends: instances of instances can stand for more than time allows.
  void addPrototype(const Prototype& p, const Frame& world) {
    const auto addLeaf = [&](uint32_t leaf, const Frame& at, size_t) {
      const uint64_t number = passed_++;
      if (number < from_ || number >= to_) return;
      const Leaf& l = scene_.leaves[leaf];
      add(l, at * l.frame, static_cast<uint32_t>(number));
    };
    const auto enter = [&](const Instance& instance, const Frame&, size_t) {
      return enters(instance);
    };
    walk(scene_, p, world, addLeaf, enter);
  }

  // What lies outside of the range is passed by.
  bool enters(const Instance& instance) {
    const uint64_t inside = plan_.leavesOf(instance.prototype);
    if (inside == 0 || passed_ >= to_) return false;
    if (saturatingAdd(passed_, inside) > from_) return true;
    passed_ += inside;
    return false;
  }

  uint32_t lookIndex(uint32_t paint) {
    uint32_t& index = looks_[plan_.paint(paint).group];
    if (index == 0) {
      lookOrder_.push_back(paint);
      index = static_cast<uint32_t>(lookOrder_.size());
    }
    return index - 1;
  }

  // Memory for all that it will hold is taken once.
  void reserve(Batch& batch, const BatchKey& byGroup) const {
    const Tally* const known = plan_.tally(byGroup);
    if (!known) return;
    const Tally& sum = *known;
    if (byGroup.mesh != kMerged) {
      batch.matrices.reserve(sum.instances * 16);
      batch.instanceLeaves.reserve(sum.instances);
      batch.instanceColors.reserve(sum.instances);
      return;
    }
    batch.positions.reserve(sum.corners * 3);
    batch.normals.reserve(sum.corners * 3);
    batch.uvs.reserve(sum.corners * 2);
    batch.leaves.reserve(sum.corners);
    batch.colors.reserve(sum.corners);
    batch.indices.reserve(sum.triangles * 3);
  }

  // Leaves that lie beside each other mostly go into the same batch.
  Batch& batchOf(const BatchKey& byGroup, uint32_t paint) {
    if (last_ && !(byGroup < lastKey_) && !(lastKey_ < byGroup)) return *last_;
    BatchKey key = byGroup;
    key.look = lookIndex(paint);
    const auto [at, fresh] = batches_.try_emplace(key);
    if (fresh) reserve(at->second, byGroup);
    lastKey_ = byGroup;
    last_ = &at->second;
    return *last_;
  }

  // Faces of what is laid have coordinates of their own.
  const Surface& surfaceOf(uint32_t mesh, bool apart) {
    if (plan_.isSingle(mesh)) {
      single_.build(*scene_.meshes[mesh], triangulator_, apart);
      return single_;
    }
    const auto [at, fresh] = surfaces_.try_emplace({mesh, apart});
    if (fresh) at->second.build(*scene_.meshes[mesh], triangulator_, apart);
    return at->second;
  }

  void add(const Leaf& leaf, const Frame& world, uint32_t number) {
    const bool often = plan_.isOften(leaf);
    const bool mirrored = leaf.scale.x * leaf.scale.y * leaf.scale.z < 0;
    const Surface& surface = surfaceOf(leaf.mesh, plan_.isLaidLeaf(leaf));
    if (!often) work(surface.corners.size());
    for (const SurfacePart& part : surface.parts) {
      const uint32_t paint = plan_.paintOf(leaf, part.slot);
      const uint32_t color = plan_.paint(paint).color;
      Batch& batch = batchOf(Plan::keyOf(leaf, part.slot, often, plan_.paint(paint).group), paint);
      const bool laid = plan_.isLaidPaint(paint);
      if (!often) {
        addPart(batch, leaf.mesh, surface, part, world, leaf.scale, color, narrow(number), laid);
        continue;
      }
      if (batch.positions.empty()) {
        const Vec3 scale{mirrored ? -1.0 : 1.0, 1, 1};
        addPart(batch, leaf.mesh, surface, part, {}, scale, 0xffffffffu, 0, laid);
      }
      addInstance(batch, leaf, world, mirrored);
      batch.instanceColors.push_back(color);
      batch.instanceLeaves.push_back(narrow(number));
    }
  }

  // The geometry of a mirrored batch is mirrored in x itself, so the matrix takes that back: what a
  // graphics card gets never mirrors.
  static void addInstance(Batch& batch, const Leaf& leaf, const Frame& world, bool mirrored) {
    const auto whole = [](double s) { return std::abs(s) < kFlat ? kFlat : s; };
    const Vec3 x = world.x * (whole(leaf.scale.x) * (mirrored ? -1 : 1));
    const Vec3 y = world.y * whole(leaf.scale.y), z = world.z * whole(leaf.scale.z);
    const Vec3& o = world.origin;
    const float matrix[] = {
        narrow(x.x), narrow(x.y), narrow(x.z), 0, narrow(y.x), narrow(y.y), narrow(y.z), 0,
        narrow(z.x), narrow(z.y), narrow(z.z), 0, narrow(o.x), narrow(o.y), narrow(o.z), 1};
    batch.matrices.insert(batch.matrices.end(), std::begin(matrix), std::end(matrix));
  }

  void addPart(Batch& batch, uint32_t mesh, const Surface& surface, const SurfacePart& part,
               const Frame& world, const Vec3& scale, uint32_t color, float leaf, bool laid) {
    const Mesh& m = *scene_.meshes[mesh];
    const bool turned = scale.x * scale.y * scale.z < 0;
    for (uint32_t f = part.firstFace; f < part.firstFace + part.faceCount; ++f) {
      const SurfaceFace& face = surface.faces[f];
      const auto base = static_cast<uint32_t>(batch.positions.size() / 3);
      const FaceAxes axes = laid ? layingOf(m, surface, face, world, scale) : FaceAxes{};
      for (uint32_t v = face.firstVertex; v < face.firstVertex + face.vertexCount; ++v) {
        const uint32_t corner = surface.corners[v];
        push(batch.positions, world.point(scaled(m.at(corner), scale)));
        push(batch.normals, world.direction(scaledNormal(surface.normals[v], scale)));
        const Vec2 uv = laid         ? axes.at(world.point(scaled(m.at(corner), scale)))
                        : m.hasUv(0) ? m.uvs[0][corner]
                                     : Vec2{};
        batch.uvs.push_back(narrow(uv.x));
        batch.uvs.push_back(narrow(uv.y));
        batch.leaves.push_back(leaf);
        batch.colors.push_back(color);
      }
      for (uint32_t t = 0; t < face.triangleCount; ++t) {
        const auto& tri = surface.triangles[face.firstTriangle + t];
        for (int c = 0; c < 3; ++c) batch.indices.push_back(base + tri[turned ? 2 - c : c]);
      }
    }
  }

  const Plan& plan_;
  const Scene& scene_;
  const uint64_t from_, to_;
  uint64_t passed_ = 0;
  FaceTriangulator triangulator_;
  /// By group of paints: one more than the look, 0 for not asked yet.
  std::vector<uint32_t> looks_;
  std::vector<uint32_t> lookOrder_;
  /// Of meshes that stand more than once; of the others only the last.
  std::map<std::pair<uint32_t, bool>, Surface> surfaces_;
  Surface single_;
  std::map<BatchKey, Batch> batches_;
  BatchKey lastKey_;
  Batch* last_ = nullptr;
};

// Parts in path order as one list: looks are numbered as one part would, and arrays follow each
// other.
class Joiner {
 public:
  Joiner(const Plan& plan, std::deque<Part>& parts) : plan_(plan), looks_(plan.paints()) {
    for (Part& part : parts) add(part);
  }

  std::string bytes() {
    std::string text;
    JsonWriter json(text);
    json.beginObject().key("leaves").value(plan_.leaves());
    json.key("truncated").value(plan_.truncated());
    json.key("looks").beginArray();
    for (const uint32_t paint : lookOrder_) writeLook(json, plan_.paint(paint).look);
    json.endArray().key("batches").beginArray();
    for (const auto& [key, pieces] : batches_) writeBatch(json, key, pieces);
    json.endArray().endObject();
    text.append((4 - text.size() % 4) % 4, ' ');
    const auto size = static_cast<uint32_t>(text.size());
    std::string out;
    out.reserve(text.size() + arrayBytes_ + kRoom);
    out = "GBL1";
    out.append(reinterpret_cast<const char*>(&size), sizeof size);
    out += text;
    for (const std::string_view array : arrays_) out += array;
    return out;
  }

 private:
  using Pieces = std::vector<Batch*>;

  void add(Part& part) {
    std::vector<uint32_t> numbers;
    for (const uint32_t paint : part.looks()) {
      uint32_t& number = looks_[plan_.paint(paint).group];
      if (number == 0) {
        lookOrder_.push_back(paint);
        number = static_cast<uint32_t>(lookOrder_.size());
      }
      numbers.push_back(number - 1);
    }
    for (auto& [key, batch] : part.batches()) {
      if (batch.indices.empty()) continue;
      BatchKey named = key;
      named.look = numbers[key.look];
      Pieces& pieces = batches_[named];
      if (named.mesh == kMerged) rebase(batch, pieces);
      pieces.push_back(&batch);
    }
  }
  static void rebase(Batch& batch, const Pieces& before) {
    size_t base = 0;
    for (const Batch* b : before) base += b->positions.size() / 3;
    if (base == 0) return;
    for (uint32_t& index : batch.indices) index += static_cast<uint32_t>(base);
  }

  void writeBatch(JsonWriter& json, const BatchKey& key, const Pieces& all) {
    json.beginObject().key("look").value(key.look);
    const bool merged = key.mesh == kMerged;
    // Instances have one geometry, which each part has made for itself.
    const Pieces geometry(all.begin(), merged ? all.end() : all.begin() + 1);
    section(json, "position", geometry, &Batch::positions);
    section(json, "normal", geometry, &Batch::normals);
    if (!plan_.paint(lookOrder_[key.look]).look.map.empty()) {
      section(json, "uv", geometry, &Batch::uvs);
    }
    section(json, "index", geometry, &Batch::indices);
    if (merged) {
      section(json, "color", all, &Batch::colors);
      section(json, "leaf", all, &Batch::leaves);
    } else {
      section(json, "matrix", all, &Batch::matrices);
      section(json, "color", all, &Batch::instanceColors);
      section(json, "leaf", all, &Batch::instanceLeaves);
    }
    json.endObject();
  }

  template <class T>
  void section(JsonWriter& json, const char* name, const Pieces& pieces,
               std::vector<T> Batch::*member) {
    size_t count = 0;
    const size_t begin = arrayBytes_;
    for (const Batch* piece : pieces) {
      const std::vector<T>& data = piece->*member;
      if (data.empty()) continue;
      arrays_.emplace_back(reinterpret_cast<const char*>(data.data()), data.size() * sizeof(T));
      arrayBytes_ += data.size() * sizeof(T);
      count += data.size();
    }
    if (count == 0) return;
    json.key(name).beginArray().value(static_cast<uint64_t>(begin));
    json.value(static_cast<uint64_t>(count)).endArray();
  }

  static void writeLook(JsonWriter& json, const Look& l) {
    json.beginObject().key("roughness").value(l.roughness / 10.0);
    json.key("metallic").value(l.metallic / 10.0);
    if (l.opacity < 20) json.key("opacity").value(l.opacity / 20.0);
    if (l.cutoff >= 0) json.key("cutoff").value(l.cutoff / 20.0);
    if (l.emissive) json.key("emissive").value(l.emissive);
    if (!l.map.empty()) {
      json.key("map").value(l.map).key("uv").beginArray();
      json.value(l.su).value(l.sv).value(l.tu).value(l.tv).value(l.rw).endArray();
    }
    json.endObject();
  }

  const Plan& plan_;
  /// By group of paints: one more than the look, 0 for not met yet.
  std::vector<uint32_t> looks_;
  std::vector<uint32_t> lookOrder_;
  std::map<BatchKey, Pieces> batches_;
  std::vector<std::string_view> arrays_;
  size_t arrayBytes_ = 0;
};

}  // namespace

std::string drawList(const Scene& scene, unsigned jobs) {
  const Plan plan(scene);
  const uint64_t all = plan.leaves();
  const uint64_t most = std::max<uint64_t>(1, all / kLeavesAPart);
  const uint64_t count = jobs ? jobs : std::min<uint64_t>(defaultJobs(), most);
  std::deque<Part> parts;
  for (uint64_t i = 0; i < count; ++i) {
    parts.emplace_back(plan, all * i / count, all * (i + 1) / count);
  }
  WorkMeter* const meter = detail::workState.meter;
  parallelFor(parts.size(), static_cast<unsigned>(count), [&](size_t i, unsigned) {
    std::optional<WorkScope> scope;
    if (meter) scope.emplace(*meter);
    parts[i].build();
  });
  return Joiner(plan, parts).bytes();
}

}  // namespace gable
