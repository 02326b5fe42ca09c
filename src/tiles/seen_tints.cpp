// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "tiles/seen_tints.h"

#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "base/work.h"

namespace gable {
namespace {

// What is turned farther away is seen better from another direction: a cosine.
constexpr double kFacing = 0.5;
// Surfaces in one place are one where such cosines differ by less.
constexpr double kTurned = 0.2;

}  // namespace

void SeenTints::add(const DepthImage& fine, const DepthImage& coarse,
                    const std::vector<CoarsePart>& parts, double area) {
  seen_.resize(parts.size());
  std::vector<Tint> fronts(parts.size()), backs(parts.size());
  for (int64_t y = 0; y < fine.height(); ++y) {
    work(static_cast<size_t>(fine.width()));
    for (int64_t x = 0; x < fine.width(); ++x) {
      const DepthImage::Hit &was = fine.at(x, y), &is = coarse.at(x, y);
      if (!was.part || !is.part || std::abs(is.facing) < kFacing) continue;
      // What is farther before or behind is another thing, and so is a roof that a wall rises
      // through.
      if (std::abs(was.depth - is.depth) > tolerance_) continue;
      if (std::abs(std::abs(was.facing) - std::abs(is.facing)) > kTurned) continue;
      const auto number = static_cast<size_t>(is.part - parts.data());
      (is.facing > 0 ? fronts : backs)[number].add(was.part->finish, area);
    }
  }
  for (size_t i = 0; i < parts.size(); ++i) count(seen_[i], fronts[i], backs[i]);
  ++pairs_;
}

void SeenTints::count(Seen& seen, const Tint& front, const Tint& back) const {
  if (front.weight > 0 && !seen.isFront) {
    seen = {};
    seen.isFront = true;
  }
  const Tint& tint = seen.isFront ? front : back;
  seen.tint.add(tint);
  if (!(tint.weight > seen.most)) return;
  seen.most = tint.weight;
  seen.pair = pairs_;
}

void SeenTints::apply(std::vector<CoarsePart>& parts) const {
  std::map<std::pair<size_t, std::array<int64_t, 3>>, Tint> alike;
  const auto keyOf = [&](size_t i) { return std::pair(seen_[i].pair, tintKey(parts[i].finish)); };
  for (size_t i = 0; i < seen_.size(); ++i) {
    if (seen_[i].most > 0) alike[keyOf(i)].add(seen_[i].tint);
  }
  for (size_t i = 0; i < seen_.size(); ++i) {
    if (seen_[i].most > 0) parts[i].finish = alike.at(keyOf(i)).mean({});
  }
}

}  // namespace gable
