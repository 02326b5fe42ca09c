// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What is known of initial shapes, for models that hold attributes.
#include <algorithm>
#include <map>

#include "base/work.h"
#include "engine/footprint.h"
#include "engine/impl.h"
#include "runtime/output.h"
#include "shape/edge_attributes.h"

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

// The attributes that the rules of a shape may read, sorted.
const std::vector<uint32_t>* readOf(const Model::Impl& model, size_t shape) {
  const Program& program = model.rules->program;
  const int32_t rule = shape < model.shapeAttributes.size()
                           ? startRuleOf(model.shapeAttributes[shape], program, model.startRule)
                           : model.startRule;
  if (rule < 0 || static_cast<size_t>(rule) >= program.rules.size()) return nullptr;
  return &program.rules[static_cast<size_t>(rule)].reads.attributes;
}

void addAttributes(const Model::Impl& model, size_t shape, std::vector<AttributeValue>& out) {
  const std::vector<uint32_t>* read = readOf(model, shape);
  for (const EvaluatedAttribute& a : model.result.attributes[shape]) {
    work();
    const std::string& name = model.rules->program.attributes[a.attribute].name;
    if (name.find('.') != std::string::npos) continue;
    const bool isRead = read && std::binary_search(read->begin(), read->end(), a.attribute);
    if (!isRead && !model.setAttributes.count(name)) continue;
    out.push_back(plainAttribute(name, a.value, *model.rules->pool));
  }
}

}  // namespace

int32_t startRuleOf(const std::vector<AttributeValue>& attributes, const Program& program,
                    int32_t usual) {
  int32_t rule = usual;
  for (const AttributeValue& a : attributes) {
    if (!namesStartRule(a)) continue;
    const int32_t named = program.findRule(a.values[0].text);
    if (named >= 0) rule = named;
  }
  return rule;
}

std::vector<AttributeValue> knownOfRoot(const Model::Impl& model, size_t root) {
  std::vector<AttributeValue> out;
  if (root >= model.result.roots.size()) return out;
  addReports(model, root, out);
  const size_t shape = model.result.roots[root].shape;
  if (shape < model.result.attributes.size() && model.rules) addAttributes(model, shape, out);
  if (shape >= model.shapeAttributes.size()) return out;
  for (const AttributeValue& a : model.shapeAttributes[shape]) {
    const bool isOfEdges = EdgeAttributes::isNamed(a.name, a.rows > 0 || a.columns > 0);
    if (a.name != kStartRuleAttribute && !isOfEdges) out.push_back(a);
  }
  return out;
}

}  // namespace gable
