// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The answers are those of the greedy algorithm: a claim that has got room keeps it, so the order
// decides. Each group has a tree of those that have room. A claim that comes of another's way is
// answered after that one, whatever its own rank: its rank is at least the other's.

#include "runtime/room.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/work.h"

namespace gable {

namespace {

using Path = std::span<const uint32_t>;

bool isPrefix(Path a, Path b) {
  return a.size() <= b.size() && std::ranges::equal(a, b.first(a.size()));
}

// How far rounding may move a shape from one pass to the other.
constexpr double kSame = 1e-6;

bool isNear(const Vec3& a, const Vec3& b) { return length(a - b) <= kSame; }

}  // namespace

uint32_t RoomClaims::add(Claim claim, const PlacePath& path, const Shape& s, const Frame& world) {
  claim.origin = world.point(s.scope.origin);
  claim.size = s.size;
  claim.pathBegin = static_cast<uint32_t>(paths_.size());
  paths_.insert(paths_.end(), path.begin(), path.end());
  claim.pathEnd = static_cast<uint32_t>(paths_.size());
  volumes_.add(s, world);
  claims_.push_back(claim);
  return count() - 1;
}

RoomPlan::RoomPlan(std::vector<RoomClaims> workers) : workers_(std::move(workers)) {
  gather();
  makeGroups();
  for (uint32_t e = 0; e < entries_.size(); ++e) {
    const RoomCondition condition = conditionOfEntry(e);
    if (entries_[e].claim().asks || entries_[e].group == kNoGroup) continue;
    if (condition == kAlways)
      put(e);
    else
      labels_.emplace_back(condition, e);
  }
  std::ranges::sort(labels_);
  for (const uint32_t e : inOrder()) {
    work();
    if (!isMade(e)) continue;
    const bool room = hasRoom(e);
    entries_[e].state = room ? State::Free : State::Taken;
    if (room) put(e);
    putLabelsOf(gable::conditionOf(e, room));
  }
  countAnswers();
  groups_.clear();
  labels_.clear();
  for (RoomClaims& w : workers_) w.forgetVolumes();
}

// The claims of an initial shape are those of one worker, one behind the other.
void RoomPlan::gather() {
  std::vector<std::tuple<uint32_t, uint32_t, uint32_t>> all;
  for (uint32_t w = 0; w < workers_.size(); ++w) {
    entryOf_.emplace_back(workers_[w].count());
    for (uint32_t k = 0; k < workers_[w].count(); ++k) {
      work();
      all.emplace_back(workers_[w].claim(k).initialShape, w, k);
    }
  }
  std::ranges::sort(all);
  workMemory(all.size() * sizeof(Entry));
  for (const auto& [initialShape, w, k] : all) {
    work();
    const auto number = static_cast<uint32_t>(entries_.size());
    entryOf_[w][k] = number;
    entries_.push_back({&workers_[w], k});
    begins_.resize(std::max<size_t>(begins_.size(), initialShape + size_t{1}),
                   static_cast<uint32_t>(asking_.size()));
    if (workers_[w].claim(k).asks) asking_.push_back(number);
  }
  begins_.push_back(static_cast<uint32_t>(asking_.size()));
}

RoomCondition RoomPlan::conditionOfEntry(uint32_t entry) const {
  const Entry& e = entries_[entry];
  const RoomCondition condition = e.claim().condition;
  return condition == kAlways ? kAlways : condition + 2 * (entry - e.local);
}

bool RoomPlan::isUsable(uint32_t entry) const {
  const Entry& e = entries_[entry];
  return e.group != kNoGroup && e.from->volumes().isSound(e.local);
}

void RoomPlan::makeGroups() {
  std::unordered_map<StringId, uint32_t> numbers;
  for (const Entry& e : entries_) {
    if (e.claim().asks) numbers.emplace(e.claim().group, static_cast<uint32_t>(numbers.size()));
  }
  groups_.resize(numbers.size());
  std::vector<bool> byHeight(groups_.size(), false);
  for (uint32_t i = 0; i < entries_.size(); ++i) {
    Entry& e = entries_[i];
    const auto found = numbers.find(e.claim().group);
    e.group = found == numbers.end() ? kNoGroup : found->second;
    if (!isUsable(i)) continue;
    if (e.claim().asks && e.claim().byHeight) byHeight[e.group] = true;
    e.item = static_cast<uint32_t>(groups_[e.group].entries.size());
    groups_[e.group].entries.push_back(i);
  }
  for (uint32_t g = 0; g < groups_.size(); ++g) {
    std::vector<Box3> boxes;
    workMemory(groups_[g].entries.size() * sizeof(Box3));
    for (const uint32_t i : groups_[g].entries) {
      boxes.push_back(entries_[i].from->volumes().box(entries_[i].local));
    }
    groups_[g].tree.emplace_back(std::move(boxes), byHeight[g]);
  }
}

// By rank; a claim has at least that of the one that it comes of.
std::vector<uint32_t> RoomPlan::inOrder() const {
  std::vector<double> ranks(entries_.size());
  for (uint32_t e = 0; e < entries_.size(); ++e) {
    work();
    const RoomCondition condition = conditionOfEntry(e);
    ranks[e] = entries_[e].claim().rank;
    if (condition != kAlways) ranks[e] = std::max(ranks[e], ranks[condition / 2]);
  }
  std::vector<uint32_t> order = asking_;
  std::ranges::stable_sort(order, {}, [&](uint32_t e) { return ranks[e]; });
  return order;
}

bool RoomPlan::isMade(uint32_t entry) const {
  const RoomCondition condition = conditionOfEntry(entry);
  if (condition == kAlways) return true;
  return entries_[condition / 2].state == (condition % 2 == 1 ? State::Free : State::Taken);
}

bool RoomPlan::hasRoom(uint32_t entry) {
  if (!isUsable(entry)) return false;
  const Entry& e = entries_[entry];
  const RoomClaims::Claim& c = e.claim();
  Box3 box = e.from->volumes().box(e.local);
  const Vec3 around{c.clearance, c.clearance, c.clearance};
  box.min = box.min - around;
  box.max = box.max + around;
  return !groups_[e.group].tree[0].any(box, !c.byHeight, [&](uint32_t item) {
    const Entry& other = entries_[groups_[e.group].entries[item]];
    const RoomClaims::Claim& o = other.claim();
    const Path mine = e.path(), theirs = other.path();
    if (c.initialShape == o.initialShape && (isPrefix(mine, theirs) || isPrefix(theirs, mine))) {
      return false;
    }
    return RoomVolumes::collide(e.volume(), other.volume(), std::max(c.clearance, o.clearance),
                                c.byHeight && o.byHeight);
  });
}

void RoomPlan::put(uint32_t entry) {
  if (!isUsable(entry)) return;
  const Entry& e = entries_[entry];
  const RoomClaims::Claim& c = e.claim();
  Box3 box = e.from->volumes().box(e.local);
  const Vec3 around{c.clearance, c.clearance, c.clearance};
  box.min = box.min - around;
  box.max = box.max + around;
  groups_[e.group].tree[0].put(e.item, box, !c.byHeight);
}

void RoomPlan::putLabelsOf(RoomCondition condition) {
  auto label = std::ranges::lower_bound(labels_, std::pair{condition, 0u});
  for (; label != labels_.end() && label->first == condition; ++label) put(label->second);
}

void RoomPlan::countAnswers() {
  std::map<StringId, size_t> known;
  for (const Entry& e : entries_) {
    work();
    const RoomClaims::Claim& c = e.claim();
    if (!c.asks || e.state == State::NotMade) continue;
    const auto [at, isNew] = known.try_emplace(c.group, counts_.size());
    if (isNew) counts_.push_back({.group = c.group});
    RoomCount& count = counts_[at->second];
    if (e.state == State::Free) {
      ++count.kept;
      continue;
    }
    if (count.dropped++ == 0) count.span = c.span;
    if (!c.hasOtherwise) ++count.lost;
  }
}

Room RoomPlan::answer(uint32_t initialShape, const PlacePath& path, const Vec3& origin,
                      const Vec3& size) const {
  if (initialShape + size_t{1} >= begins_.size()) return Room::Unknown;
  const auto last = asking_.begin() + begins_[initialShape + 1];
  const auto found = std::lower_bound(
      asking_.begin() + begins_[initialShape], last, path, [&](uint32_t e, const PlacePath& p) {
        return std::ranges::lexicographical_compare(entries_[e].path(), p);
      });
  if (found == last) return Room::Unknown;
  const Entry& e = entries_[*found];
  const bool same = std::ranges::equal(e.path(), path) && isNear(e.claim().origin, origin) &&
                    isNear(e.claim().size, size);
  if (!same || e.state == State::NotMade) return Room::Unknown;
  return e.state == State::Free ? Room::Free : Room::Taken;
}

bool RoomPlan::holds(size_t worker, RoomCondition condition) const {
  if (condition == kAlways) return true;
  const Entry& e = entries_[entryOf_[worker][condition / 2]];
  return e.state == (condition % 2 == 1 ? State::Free : State::Taken);
}

void RoomPlan::forgetAnswers() {
  groups_ = {};
  labels_ = {};
  entryOf_ = {};
  begins_ = {};
  asking_ = {};
  entries_ = {};
  workers_ = {};
}

}  // namespace gable
