// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Counts and reports of a model.

#include <algorithm>
#include <map>

#include "engine/impl.h"

namespace gable {

namespace {

struct ReportTotal {
  uint64_t count = 0;
  ReportSummary::Numbers numbers;
  uint64_t numberCount = 0;
  std::map<std::string, uint64_t> values;
};

std::map<std::string, ReportTotal> totals(const Scene& scene) {
  std::map<std::string, ReportTotal> out;
  for (const Report& r : scene.reports) {
    ReportTotal& t = out[r.key];
    ++t.count;
    if (r.value.kind == PlainValue::Kind::Number) {
      const double v = r.value.number;
      ReportSummary::Numbers& n = t.numbers;
      const bool first = ++t.numberCount == 1;
      n.min = first ? v : std::min(n.min, v);
      n.max = first ? v : std::max(n.max, v);
      n.sum += v;
      continue;
    }
    const bool isBool = r.value.kind == PlainValue::Kind::Bool;
    ++t.values[isBool ? (r.value.number != 0 ? "true" : "false") : r.value.text];
  }
  return out;
}

}  // namespace

BoundingBox boundingBoxOf(const Box3& box) {
  return {{box.min.x, box.min.y, box.min.z}, {box.max.x, box.max.y, box.max.z}};
}

Statistics statisticsOf(const Scene& scene) {
  const SceneCounts c = count(scene);
  Statistics out;
  out.shapes = c.shapes;
  out.leaves = c.leaves;
  out.faces = c.faces;
  out.vertices = c.vertices;
  out.triangles = c.triangles;
  out.encoder = {c.encoderFaces, c.vertices};
  out.instances = c.instances;
  out.prototypes = c.prototypes;
  out.materials = c.materials;
  if (!c.bounds.empty()) out.bounds = boundingBoxOf(c.bounds);
  for (auto& [key, t] : totals(scene)) {
    ReportSummary r;
    r.key = key;
    r.count = t.count;
    if (t.numberCount > 0) r.numbers = t.numbers;
    r.values.assign(t.values.begin(), t.values.end());
    out.reports.push_back(std::move(r));
  }
  return out;
}

}  // namespace gable
