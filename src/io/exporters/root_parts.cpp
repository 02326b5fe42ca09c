// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/root_parts.h"

#include "base/work.h"

namespace gable {

void RootParts::open(const std::vector<LabelledLeaves>& labels) {
  labels_.clear();
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

CityPart RootParts::next(const Leaf& leaf) {
  const Label* label = this->label();
  ++at_;
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
