// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/edge_sampling.h"

#include <vector>

#include "base/work.h"

namespace gable {

Vec3 EdgeSampler::inObject(const Vec3& direction) const {
  return services_.initialShape().origin.toLocalDirection(
      services_.world().direction(shape_.scope.direction(direction)));
}

int32_t EdgeSampler::edgeAt(std::span<const Vec3> points, const Vec3& normal) const {
  if (!edges_) return -1;
  const Frame& object = services_.initialShape().origin;
  std::vector<Vec3> there;
  there.reserve(points.size());
  for (const Vec3& p : points) {
    work();
    there.push_back(object.toLocal(services_.world().point(shape_.scope.point(p))));
  }
  return edges_->edgeAt(there, inObject(normal));
}

// Faces have normals of their own. Edges and vertices that a component split made carry theirs at
// the corners.
int32_t EdgeSampler::ofShape() const {
  if (!edges_) return -1;
  const MeshRef m = meshInScope(shape_);
  if (m->empty()) return edgeAt(std::vector<Vec3>{{}}, {0, 0, 1});
  Vec3 sum;
  double total = 0;
  for (size_t f = 0; f < m->faceCount(); ++f) {
    work();
    sum += m->areaNormal(f);
    total += length(m->areaNormal(f));
  }
  if (!(total > 0)) {
    for (const Vec3& n : m->normals) sum += n;
  } else if (length(sum) <= 1e-9 * total) {
    sum = {};
  }
  return edgeAt(m->positions, sum);
}

Value edgeValue(const Value& list, int32_t edge, const ValuePool& pool) {
  if (edge < 0) return {};
  const auto at = static_cast<size_t>(edge);
  const Array& a = pool.array(list);
  if (list.type == ValueType::StringArray) {
    return at < a.strings.size() ? Value::string(a.strings[at]) : Value{};
  }
  if (at >= a.numbers.size()) return {};
  return list.type == ValueType::BoolArray ? Value::of(a.numbers[at] != 0)
                                           : Value::of(a.numbers[at]);
}

}  // namespace gable
