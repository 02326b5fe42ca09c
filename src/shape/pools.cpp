// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <mutex>
#include <optional>
#include <string>

#include "base/hash.h"
#include "base/interned.h"
#include "shape/services.h"
#include "shape/tags.h"

namespace gable {

void fitModel(AssetModel& model) {
  model.bounds = model.mesh->bounds();
  Mesh mesh = *model.mesh;
  if (!mesh.empty()) {
    for (Vec3& p : mesh.positions) p = p - model.bounds.min;
  }
  if (!model.materials.empty()) {
    for (MeshFace& f : mesh.faces) f.materialSlot = static_cast<uint16_t>(f.materialSlot + 1);
  }
  model.fitted = makeRef<Mesh>(std::move(mesh));
}

MeshRef fittedMesh(const AssetModel& model) {
  if (model.fitted) return model.fitted;
  AssetModel made = model;
  fitModel(made);
  return made.fitted;
}

// A face has a region, an edge an edge.
struct TagTable::Set {
  std::vector<StringId> names;
  std::optional<RegionProvenance> region;
  std::optional<EdgeProvenance> edge;
  double streetWidth = 0;
  bool operator==(const Set&) const = default;
};

namespace {

// What with() gave of late: operations put the same few names on face after face.
class KnownUnions {
 public:
  std::optional<TagSetId> find(TagSetId set, std::string_view name) {
    const std::lock_guard lock(mutex_);
    const Entry& e = entries_[placeOf(set, name)];
    if (e.name.empty() || e.set != set || e.name != name) return {};
    return e.result;
  }
  void keep(TagSetId set, std::string_view name, TagSetId result) {
    std::string copy(name);
    const std::lock_guard lock(mutex_);
    Entry& e = entries_[placeOf(set, name)];
    e.name.swap(copy);
    e.set = set;
    e.result = result;
  }

 private:
  struct Entry {
    TagSetId set = 0, result = 0;
    std::string name;
  };
  // The names of a family begin alike: the last letters tell them apart.
  static size_t placeOf(TagSetId set, std::string_view name) {
    uint64_t end = 0;
    const size_t count = std::min(name.size(), sizeof end);
    std::memcpy(&end, name.data() + name.size() - count, count);
    return hashCombine(end, set) % kKept;
  }

  static constexpr size_t kKept = 64;
  std::mutex mutex_;
  std::array<Entry, kKept> entries_;
};

}  // namespace

struct TagTable::Impl {
  ValuePool& pool;
  Interned<Set> sets;
  KnownUnions unions;
};

TagTable::TagTable(ValuePool& pool) : impl_(new Impl{pool, {}, {}}) { intern(Set{}); }
TagTable::~TagTable() = default;

const std::vector<StringId>& TagTable::names(TagSetId set) const {
  return impl_->sets.get(set).names;
}

TagSetId TagTable::intern(Set set) {
  std::vector<StringId>& names = set.names;
  std::sort(names.begin(), names.end(),
            [&](StringId a, StringId b) { return impl_->pool.text(a) < impl_->pool.text(b); });
  names.erase(std::unique(names.begin(), names.end()), names.end());
  uint64_t hash = names.size();
  for (StringId s : names) hash = hashCombine(hash, s);
  if (set.region) hash = hashCombine(hash, set.region->hash());
  if (set.edge) hash = hashCombine(hash, set.edge->hash());
  if (set.streetWidth > 0) hash = hashCombine(hash, hashDouble(set.streetWidth));
  return impl_->sets.intern(hash, set);
}

TagSetId TagTable::intern(std::vector<StringId> names) {
  return intern(Set{std::move(names), {}, {}, 0});
}

TagSetId TagTable::of(std::string_view name) {
  return intern(std::vector<StringId>{impl_->pool.intern(name)});
}

TagSetId TagTable::with(TagSetId set, std::string_view name) {
  if (const auto known = impl_->unions.find(set, name)) return *known;
  std::vector<StringId> all = names(set);
  all.push_back(impl_->pool.intern(name));
  const TagSetId result = withNames(set, std::move(all));
  impl_->unions.keep(set, name, result);
  return result;
}

TagSetId TagTable::withNames(TagSetId set, std::vector<StringId> names) {
  Set out = impl_->sets.get(set);
  out.names = std::move(names);
  return intern(std::move(out));
}

TagSetId TagTable::merged(TagSetId a, TagSetId b) {
  Set out = impl_->sets.get(a);
  const Set& more = impl_->sets.get(b);
  out.names.insert(out.names.end(), more.names.begin(), more.names.end());
  if (more.region) out.region = more.region;
  if (more.edge) out.edge = more.edge;
  if (more.streetWidth > 0) out.streetWidth = more.streetWidth;
  return intern(std::move(out));
}

TagSetId TagTable::marked(TagSetId set, const RegionProvenance& region) {
  return intern(Set{names(set), region, {}, streetWidth(set)});
}

TagSetId TagTable::marked(TagSetId set, const EdgeProvenance& edge) {
  return intern(Set{names(set), {}, edge, streetWidth(set)});
}

TagSetId TagTable::plain(TagSetId set) {
  const Set& own = impl_->sets.get(set);
  return own.region || own.edge ? intern(Set{own.names, {}, {}, own.streetWidth}) : set;
}

TagSetId TagTable::withStreetWidth(TagSetId set, double width) {
  Set out = impl_->sets.get(set);
  out.streetWidth = width;
  return intern(std::move(out));
}

double TagTable::streetWidth(TagSetId set) const { return impl_->sets.get(set).streetWidth; }

const RegionProvenance* TagTable::region(TagSetId set) const {
  const Set& own = impl_->sets.get(set);
  return own.region ? &*own.region : nullptr;
}

const EdgeProvenance* TagTable::edge(TagSetId set) const {
  const Set& own = impl_->sets.get(set);
  return own.edge ? &*own.edge : nullptr;
}

bool TagTable::has(TagSetId set, std::string_view name) const {
  const auto& all = names(set);
  return std::any_of(all.begin(), all.end(),
                     [&](StringId s) { return impl_->pool.text(s) == name; });
}

namespace {
struct SlotList {
  std::vector<MaterialId> materials;
  std::vector<StringId> groups;
  bool operator==(const SlotList&) const = default;
};
}  // namespace

namespace {

// What with() gave of late: each shape that an import is called on gets all of the import's
// attributes, one after the other, and most of them what the shape before got.
class KnownSets {
 public:
  std::optional<uint32_t> find(uint32_t set, uint32_t key, const Value& value) {
    const uint64_t hash = hashOf(set, key, value);
    const std::lock_guard lock(mutex_);
    const Known& k = known_[hash % known_.size()];
    const bool same =
        k.set == set && k.key == key && k.value.type == value.type && k.value.unit == value.unit &&
        k.value.id == value.id &&
        std::bit_cast<uint64_t>(k.value.number) == std::bit_cast<uint64_t>(value.number);
    if (k.result == 0 || !same) return {};
    return k.result;
  }
  void keep(uint32_t set, uint32_t key, const Value& value, uint32_t result) {
    const uint64_t hash = hashOf(set, key, value);
    const std::lock_guard lock(mutex_);
    if (++kept_ > known_.size() && known_.size() < kMost) grow();
    known_[hash % known_.size()] = {set, key, result, value};
  }

 private:
  struct Known {
    /// 0 for the result, which has an entry at least: nothing is known here.
    uint32_t set = 0, key = 0, result = 0;
    Value value;
  };
  static uint64_t hashOf(uint32_t set, uint32_t key, const Value& value) {
    return hashCombine(uint64_t{set} << 32 | key, value.hash());
  }

  void grow() {
    std::vector<Known> before(known_.size() * 4);
    before.swap(known_);
    kept_ = 0;
    for (const Known& k : before) {
      if (k.result != 0) known_[hashOf(k.set, k.key, k.value) % known_.size()] = k;
    }
  }

  // Some hundred prefixes of the sets of some dozen imports; in a town hundreds of houses have sets
  // of their own, and each edit asks for all of them again.
  static constexpr size_t kLeast = 1 << 13, kMost = 1 << 19;
  std::mutex mutex_;
  std::vector<Known> known_{kLeast};
  /// Since they last grew.
  size_t kept_ = 0;
};

}  // namespace

struct AttributePool::Impl {
  Interned<std::vector<Entry>> sets;
  Interned<SlotList> lists;
  KnownSets known;
};

namespace {
uint64_t hashOf(const std::vector<AttributePool::Entry>& entries) {
  uint64_t h = entries.size();
  for (const auto& e : entries) h = hashCombine(hashCombine(h, e.key), e.value.hash());
  return h;
}
}  // namespace

AttributePool::AttributePool() : impl_(std::make_unique<Impl>()) {
  impl_->sets.intern(0, {});
  impl_->lists.intern(0, {});
}
AttributePool::~AttributePool() = default;

const std::vector<AttributePool::Entry>& AttributePool::entries(uint32_t set) const {
  return impl_->sets.get(set);
}

const Value* AttributePool::find(uint32_t set, uint32_t key) const {
  const auto& all = entries(set);
  const auto at = std::lower_bound(all.begin(), all.end(), key,
                                   [](const Entry& e, uint32_t k) { return e.key < k; });
  return at != all.end() && at->key == key ? &at->value : nullptr;
}

uint32_t AttributePool::with(uint32_t set, uint32_t key, const Value& value) {
  if (const auto known = impl_->known.find(set, key, value)) return *known;
  std::vector<Entry> all = entries(set);
  const auto at = std::lower_bound(all.begin(), all.end(), key,
                                   [](const Entry& e, uint32_t k) { return e.key < k; });
  if (at != all.end() && at->key == key)
    at->value = value;
  else
    all.insert(at, {key, value});
  const uint32_t result = impl_->sets.intern(hashOf(all), all);
  impl_->known.keep(set, key, value, result);
  return result;
}

uint32_t AttributePool::with(uint32_t set, const std::vector<Entry>& more) {
  const std::vector<Entry>& before = entries(set);
  std::vector<Entry> all;
  all.reserve(before.size() + more.size());
  auto at = before.begin();
  for (const Entry& e : more) {
    for (; at != before.end() && at->key < e.key; ++at) all.push_back(*at);
    if (at != before.end() && at->key == e.key) ++at;
    all.push_back(e);
  }
  all.insert(all.end(), at, before.end());
  return impl_->sets.intern(hashOf(all), all);
}

const std::vector<MaterialId>& AttributePool::materials(uint32_t list) const {
  return impl_->lists.get(list).materials;
}

const std::vector<StringId>& AttributePool::groups(uint32_t list) const {
  return impl_->lists.get(list).groups;
}

uint32_t AttributePool::internMaterials(std::vector<MaterialId> list,
                                        std::vector<StringId> groups) {
  uint64_t h = list.size();
  for (MaterialId m : list) h = hashCombine(h, m);
  for (StringId g : groups) h = hashCombine(h, g);
  return impl_->lists.intern(h, SlotList{std::move(list), std::move(groups)});
}

}  // namespace gable
