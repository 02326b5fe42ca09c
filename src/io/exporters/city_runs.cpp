// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/city_runs.h"

#include <algorithm>

#include "base/work.h"
#include "scene/flatten.h"

namespace gable {
namespace {

// Metres between leaves that touch, and between those of a window along its depth, in which it
// measures least: panes are set back.
constexpr double kTouching = 0.05, kSetBack = 0.3;
// So many elements of a sequence are looked at for one that a leaf touches.
constexpr size_t kLookBack = 256;

bool touch(const Box3& a, const Box3& b, const Vec3& gap) {
  for (size_t i = 0; i < 3; ++i) {
    if (a.min[i] > b.max[i] + gap[i] || b.min[i] > a.max[i] + gap[i]) return false;
  }
  return true;
}

}  // namespace

bool CityRuns::follows(const CityPart& part, uint32_t name) const {
  if (runs_.empty() || !partOfBoth(of_, part)) return false;
  // Of what is unknown the name is all that there is.
  return part.kind != CityKind::Unknown || name == name_;
}

bool CityRuns::areOne(const Run& a, const Run& b) const {
  if (a.part.shape != 0 && a.part.shape == b.part.shape) return true;
  Vec3 gap{kTouching, kTouching, kTouching};
  if (isOpening(of_.kind)) {
    Box3 both = a.box;
    both.include(b.box);
    const Vec3 size = both.size();
    const size_t depth = size.x < size.y ? (size.x < size.z ? 0 : 2) : (size.y < size.z ? 1 : 2);
    gap[depth] = kSetBack;
  }
  return touch(a.box, b.box, gap);
}

// All that lies between an element that the next leaf touches and the leaf is of that element.
void CityRuns::join(Run& next) {
  const size_t least = runs_.size() - std::min(runs_.size(), kLookBack);
  for (size_t k = runs_.size(); k-- > least;) {
    work();
    if (!areOne(runs_[k], next)) continue;
    begins_[next.first] = false;
    for (size_t j = runs_.size(); j-- > k;) {
      begins_[runs_[j].first] = j == k;
      next.box.include(runs_[j].box);
      next.part = partOfBoth(runs_[j].part, next.part).value_or(next.part);
    }
    next.first = runs_[k].first;
    runs_.resize(k);
  }
}

void CityRuns::take(const CityPart& part, const CityPart& said, const Leaf& leaf,
                    const Frame& world) {
  const uint64_t at = parts_.size();
  if (!follows(part, leaf.name)) {
    // Trim that comes last may be of what follows.
    size_t kept = runs_.size();
    while (takesTrim(part.kind) && kept > 0 && runs_[kept - 1].part.trim) --kept;
    for (size_t r = 0; r < kept; ++r) settle(r);
    runs_.erase(runs_.begin(), runs_.begin() + static_cast<std::ptrdiff_t>(kept));
    of_ = part;
  }
  if (runs_.empty()) {
    trim_.clear();
    toAxes_ = inverse(world);
    of_ = part;
  }
  of_ = partOfBoth(of_, part).value_or(part);
  name_ = leaf.name;
  parts_.push_back(said);
  begins_.push_back(true);
  if (part.trim) trim_.push_back(at);
  Run next{at, part, faces_.boxOf(leaf, toAxes_ * world)};
  join(next);
  runs_.push_back(next);
}

// A sill with nothing beside it stays what its name or its label says.
void CityRuns::settle(size_t run) {
  CityPart part = runs_[run].part;
  if (part.trim && part.kind != CityKind::Window) return;
  part.trim = false;
  const uint64_t end = run + 1 < runs_.size() ? runs_[run + 1].first : parts_.size();
  const auto first = std::lower_bound(trim_.begin(), trim_.end(), runs_[run].first);
  for (auto t = first; t != trim_.end() && *t < end; ++t) parts_[*t] = part;
}

void CityRuns::end() {
  for (size_t r = 0; r < runs_.size(); ++r) settle(r);
  runs_.clear();
  trim_.clear();
}

void CityRuns::skip(uint64_t count, const CityPart& part) {
  end();
  parts_.resize(parts_.size() + count, part);
  begins_.resize(begins_.size() + count, true);
}

bool CityRuns::isOne(uint64_t first, uint64_t count) const {
  if (count == 0 || !begins_[first]) return false;
  for (uint64_t i = first + 1; i < first + count; ++i) {
    if (begins_[i]) return false;
  }
  return first + count == begins_.size() || begins_[first + count];
}

}  // namespace gable
