// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What is known of initial shapes, for models that hold attributes.
#include <map>

#include "base/work.h"
#include "engine/footprint.h"
#include "engine/impl.h"
#include "runtime/output.h"

namespace gable {
namespace {

bool isNumber(const PlainValue& v) { return v.kind == PlainValue::Kind::Number; }

void addReports(const Model::Impl& model, size_t root, std::vector<AttributeValue>& out) {
  const std::vector<Report>& reports = model.result.scene.reports;
  const std::vector<DerivedRoot>& roots = model.result.roots;
  std::map<std::string_view, size_t> known;
  for (size_t i = root ? roots[root - 1].reportsEnd : 0; i < roots[root].reportsEnd; ++i) {
    work();
    const Report& r = reports[i];
    const auto [at, isNew] = known.try_emplace(r.key, out.size());
    if (isNew) {
      out.push_back({r.key, {r.value}, 0, 0});
    } else if (PlainValue& sum = out[at->second].values[0]; isNumber(sum) && isNumber(r.value)) {
      sum.number += r.value.number;
    }
  }
}

}  // namespace

std::vector<AttributeValue> knownOfRoot(const Model::Impl& model, size_t root) {
  std::vector<AttributeValue> out;
  if (root >= model.result.roots.size()) return out;
  addReports(model, root, out);
  const size_t shape = model.result.roots[root].shape;
  if (shape < model.result.attributes.size() && model.rules) {
    for (const EvaluatedAttribute& a : model.result.attributes[shape]) {
      const std::string& name = model.rules->program.attributes[a.attribute].name;
      out.push_back(plainAttribute(name, a.value, *model.rules->pool));
    }
  }
  if (shape >= model.shapeAttributes.size()) return out;
  for (const AttributeValue& a : model.shapeAttributes[shape]) {
    if (a.name != kStartRuleAttribute) out.push_back(a);
  }
  return out;
}

}  // namespace gable
