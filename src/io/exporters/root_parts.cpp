// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/root_parts.h"

#include "base/work.h"
#include "scene/flatten.h"

namespace gable {

// Leaves that follow each other, touch, and are of one thing.
class RootParts::TrimRun {
 public:
  explicit TrimRun(std::vector<std::pair<uint64_t, CityPart>>& settled) : settled_(settled) {}

  void take(uint64_t leaf, const CityPart& part, const Box3& box) {
    const std::optional<CityPart> both =
        open_ && touch(box_, box) ? partOfBoth(of_, part) : std::nullopt;
    if (!both) end();
    of_ = both.value_or(part);
    box_.include(box);
    open_ = true;
    if (part.trim) waiting_.push_back(leaf);
    if (of_.trim) return;
    settle();
  }
  void end() {
    settle();
    open_ = false;
    box_ = Box3{};
  }

 private:
  void settle() {
    // A sill with nothing beside it is what its name or its label says.
    if (of_.trim && of_.kind != CityKind::Window) waiting_.clear();
    for (const uint64_t leaf : waiting_) settled_.emplace_back(leaf, of_);
    waiting_.clear();
  }

  std::vector<std::pair<uint64_t, CityPart>>& settled_;
  std::vector<uint64_t> waiting_;
  bool open_ = false;
  CityPart of_;
  Box3 box_;
};

void RootParts::settleTrim(const Scene& scene, const Root& root, CityFaces& faces,
                           const std::function<bool(const Instance&)>& standsAlone) {
  settled_.clear();
  begin();
  if (!kinds_.hasTrim()) return;
  std::vector<std::pair<uint64_t, CityPart>> found;
  TrimRun run(found);
  const auto enter = [&](const Instance& in) {
    if (!standsAlone(in)) return true;
    run.end();
    skip(in.prototype);
    return false;
  };
  if (enter(root.instance)) {
    walk(
        scene, scene.prototypes[root.instance.prototype], root.instance.frame,
        [&](uint32_t index, const Frame& at, size_t) {
          const Leaf& leaf = scene.leaves[index];
          const Label* label = this->label();
          // What a label says of trim counts where it touches nothing that says more.
          const CityPart named = kinds_.of(leaf);
          const bool isTrim = named.trim && (!label || holdsOpenings(label->kind));
          run.take(at_, isTrim ? named : partOf(leaf, label), faces.boxOf(leaf, at * leaf.frame));
          ++at_;
        },
        [&](const Instance& in, const Frame&, size_t) { return enter(in); });
  }
  run.end();
  settled_ = std::move(found);
}

const CityPart* RootParts::settled() {
  while (nextSettled_ < settled_.size() && settled_[nextSettled_].first < at_) ++nextSettled_;
  const bool is = nextSettled_ < settled_.size() && settled_[nextSettled_].first == at_;
  return is ? &settled_[nextSettled_].second : nullptr;
}

void RootParts::open(const std::vector<LabelledLeaves>& labels) {
  labels_.clear();
  settled_.clear();
  for (const LabelledLeaves& l : labels) {
    work();
    const CityKind kind = cityKindOfLabel(l.label);
    if (kind != CityKind::Unknown) labels_.push_back({l.first, l.end, kind, l.shape});
  }
  begin();
}

void RootParts::begin() {
  at_ = 0;
  near_ = 0;
  nextSettled_ = 0;
}

const RootParts::Label* RootParts::label() {
  while (near_ < labels_.size() && labels_[near_].end <= at_) ++near_;
  return near_ < labels_.size() && labels_[near_].first <= at_ ? &labels_[near_] : nullptr;
}

CityPart RootParts::partOf(const Leaf& leaf, const Label* label) const {
  if (!label) return kinds_.of(leaf);
  CityPart part = kinds_.saidBy(leaf);
  if (part.kind != CityKind::Unknown) return part;
  if (holdsOpenings(label->kind)) {
    const CityPart named = kinds_.of(leaf);
    if (isOpening(named.kind)) return named;
  }
  part.kind = label->kind;
  part.shape = label->shape;
  return part;
}

CityPart RootParts::next(const Leaf& leaf) {
  const Label* label = this->label();
  const CityPart* settled = this->settled();
  ++at_;
  return settled ? *settled : partOf(leaf, label);
}

std::optional<CityPart> RootParts::whole(uint32_t prototype) {
  const Label* label = this->label();
  const uint64_t end = at_ + kinds_.leafCount(prototype);
  const CityPart* said = kinds_.wholeSaid(prototype);
  if (said && said->kind != CityKind::Unknown) return *said;
  const CityPart* named = kinds_.wholePart(prototype);
  if (label) {
    const bool holds = holdsOpenings(label->kind);
    if (holds && named && isOpening(named->kind) && label->end >= end) return *named;
    if (!said || label->first != at_ || label->end != end) return std::nullopt;
    if (holds && kinds_.hasOpening(prototype)) return std::nullopt;
    CityPart part = *said;
    part.kind = label->kind;
    part.shape = label->shape;
    return part;
  }
  const bool labelWithin = near_ < labels_.size() && labels_[near_].first < end;
  return named && !labelWithin ? std::optional(*named) : std::nullopt;
}

}  // namespace gable
