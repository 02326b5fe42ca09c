// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/context_queries.h"

#include <limits>
#include <utility>

namespace gable {

namespace {

Occluder standing(const Shape& s, const ContextQueries::Place& at) {
  Occluder o;
  o.initialShape = at.initialShape;
  o.path = at.path;
  o.condition = at.condition;
  o.mesh = transformed(meshInLocal(s), {1, 1, 1}, at.world);
  o.scope = at.world * s.scope;
  o.size = s.size;
  return o;
}

}  // namespace

void ContextQueries::add(StringId label, const Shape& s, const Place& at) {
  if (s.geometry.kind == GeometryKind::None) return;
  Occluder o = standing(s, at);
  o.label = label;
  occluders_.push_back(std::move(o));
}

bool ContextQueries::test(ContextTest test, ContextScope scope, StringId label, const Shape& s,
                          const Place& at) const {
  return index_ && index_->test(test, scope, label, standing(s, at));
}

double ContextQueries::distance(ContextScope scope, StringId label, const Shape& s,
                                const Place& at) const {
  if (!index_) return std::numeric_limits<double>::infinity();
  return index_->minimumDistance(scope, label, standing(s, at));
}

double ContextQueries::count(ContextScope scope, StringId label, const Shape& s,
                             const Place& at) const {
  return index_ ? static_cast<double>(index_->count(scope, label, standing(s, at))) : 0;
}

double ContextQueries::rank(ContextScope scope, StringId label, ContextOrder order, const Shape& s,
                            const Place& at) const {
  return index_ ? static_cast<double>(index_->rank(scope, label, order, standing(s, at))) : 0;
}

}  // namespace gable
