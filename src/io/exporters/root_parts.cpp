// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/root_parts.h"

#include <algorithm>
#include <limits>

#include "base/work.h"
#include "scene/flatten.h"

namespace gable {

namespace {

// A sheet that looks up and lies at the foot of a building is what stands around it: a lawn.
bool liesAtFoot(const Leaf& leaf, const Frame& world, CityFaces& faces, double foot) {
  constexpr double kSheet = 0.05;
  const Box3 box = faces.boxOf(leaf, world);
  if (box.size().y > kSheet || box.max.y > foot + kCityGround) return false;
  bool up = false, down = false;
  faces.forEach(leaf, world, [&](const CityFace& face) { (face.normal.y > 0 ? up : down) = true; });
  return up && !down;
}

}  // namespace

double RootParts::footOf(const Scene& scene, const Root& root, CityFaces& faces) {
  double foot = std::numeric_limits<double>::infinity();
  begin();
  forEachLeaf(scene, scene.prototypes[root.instance.prototype], root.instance.frame,
              [&](const Leaf& leaf, const Frame& world) {
                if (isOfBuilding(next(leaf).kind)) {
                  foot = std::min(foot, faces.boxOf(leaf, world).min.y);
                }
              });
  return foot;
}

void RootParts::settle(const Scene& scene, const Root& root, CityFaces& faces,
                       CityKind kindOfShape) {
  runs_.reset();
  const double foot = footOf(scene, root, faces);
  CityRuns runs(faces);
  // Behind the last leaf of the instance at hand that is of one opening.
  uint64_t end = 0;
  const auto enter = [&](const Instance& in) {
    if (const std::optional<CityPart> part = solitary(in.prototype)) {
      runs.skip(kinds_.leafCount(in.prototype), *part);
      skip(in.prototype);
      return false;
    }
    const std::optional<CityPart> part = at_ < end ? std::nullopt : whole(in.prototype);
    if (part && isOpening(part->kind) && !part->trim) {
      runs.end();
      end = at_ + kinds_.leafCount(in.prototype);
    }
    return true;
  };
  const auto take = [&](uint32_t index, const Frame& around, size_t) {
    const Leaf& leaf = scene.leaves[index];
    const Frame world = around * leaf.frame;
    const Label* label = this->label();
    CityPart said = partWithin(partOf(leaf, label), kindOfShape);
    // A name alone may call the earth around a building its ground.
    const bool byName = !label && kinds_.saidBy(leaf).kind == CityKind::Unknown;
    const bool isOpen = said.kind == CityKind::Unknown || (said.kind == CityKind::Ground && byName);
    if (isOpen && liesAtFoot(leaf, world, faces, foot)) said.kind = CityKind::Land;
    // What a label says of trim counts where it touches nothing that says more.
    const CityPart named = partWithin(kinds_.of(leaf), kindOfShape);
    const bool isTrim = named.trim && (!label || holdsOpenings(label->kind));
    runs.take(isTrim ? named : said, said, leaf, world);
    if (++at_ == end) runs.end();
  };
  begin();
  if (enter(root.instance)) {
    walk(scene, scene.prototypes[root.instance.prototype], root.instance.frame, take,
         [&](const Instance& in, const Frame&, size_t) { return enter(in); });
  }
  runs.end();
  runs_.emplace(std::move(runs));
  begin();
}

void RootParts::open(const std::vector<LabelledLeaves>& labels) {
  labels_.clear();
  runs_.reset();
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
  const uint64_t at = at_++;
  return runs_ ? runs_->part(at) : partOf(leaf, label);
}

std::optional<CityPart> RootParts::solitary(uint32_t prototype) {
  const std::optional<CityPart> part = whole(prototype);
  return part && isSolitary(part->kind) ? part : std::nullopt;
}

std::optional<CityPart> RootParts::element(uint32_t prototype) {
  if (const auto part = solitary(prototype)) return part;
  if (!runs_->isOne(at_, kinds_.leafCount(prototype))) return std::nullopt;
  const CityPart& part = runs_->part(at_);
  return part.kind == CityKind::Unknown ? std::nullopt : std::optional(part);
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
