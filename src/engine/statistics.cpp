// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Counts and reports of a model.

#include <algorithm>
#include <map>
#include <span>

#include "base/work.h"
#include "engine/impl.h"

namespace gable {

namespace {

struct ReportTotal {
  uint64_t count = 0;
  ReportSummary::Numbers numbers;
  uint64_t numberCount = 0;
  std::map<std::string, uint64_t> values;
};

std::map<std::string, ReportTotal> totals(std::span<const Report> reports) {
  std::map<std::string, ReportTotal> out;
  for (const Report& r : reports) {
    work();
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

std::vector<ReportSummary> summariesOf(std::span<const Report> reports) {
  std::vector<ReportSummary> out;
  for (auto& [key, t] : totals(reports)) {
    ReportSummary r;
    r.key = key;
    r.count = t.count;
    if (t.numberCount > 0) r.numbers = t.numbers;
    r.values.assign(t.values.begin(), t.values.end());
    out.push_back(std::move(r));
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
  out.reports = summariesOf(scene.reports);
  return out;
}

std::vector<ShapeReports> reportsByShapeOf(const Model::Impl& model) {
  std::vector<ShapeReports> out;
  const Scene& scene = model.result.scene;
  const std::span<const Report> all = scene.reports;
  size_t begin = 0;
  for (size_t i = 0; i < model.result.roots.size() && i < scene.roots.size(); ++i) {
    const DerivedRoot& root = model.result.roots[i];
    ShapeReports shape;
    shape.name = scene.names[scene.roots[i].name];
    // The id of the file comes behind a property of that name.
    if (root.shape < model.shapeAttributes.size()) {
      for (const AttributeValue& a : model.shapeAttributes[root.shape]) {
        if (a.name == "id" && a.values.size() == 1 && !a.values[0].text.empty()) {
          shape.id = a.values[0].text;
        }
      }
    }
    shape.reports = summariesOf(all.subspan(begin, root.reportsEnd - begin));
    begin = root.reportsEnd;
    out.push_back(std::move(shape));
  }
  return out;
}

}  // namespace gable
