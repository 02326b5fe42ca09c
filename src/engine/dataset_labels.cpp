// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What pixels are. By rule it is in the layers of the picture. By @Label it comes from the
// derivation tree: the leaves of a shape lie together in path order, and without sharing the
// renderer numbers leaves in that order.

#include <algorithm>
#include <set>

#include "engine/dataset.h"

namespace gable {

namespace {

// The labels of rules that have one.
std::map<std::string, std::string> labelsOf(const Rules& rules) {
  std::map<std::string, std::string> out;
  for (const RuleInfo& rule : rules.rules()) {
    for (const AttributeInfo::Annotation& note : rule.annotations) {
      if (note.name == "Label" && !note.arguments.empty()) {
        out[rule.name] = note.arguments[0].second;
      }
    }
  }
  return out;
}

}  // namespace

Result<Categories> categoriesOf(const Rules& rules, DatasetLabels labels) {
  std::set<std::string> names;
  if (labels == DatasetLabels::Rule) {
    for (const RuleInfo& rule : rules.rules()) names.insert(rule.name);
  } else {
    for (const auto& [rule, label] : labelsOf(rules)) names.insert(label);
  }
  if (names.empty()) {
    return Error{"dataset-labels", "no rule has a label",
                 "write @Label(\"window\") before the rules whose shapes are to be told apart, or "
                 "label by rule"};
  }
  return Categories(names.begin(), names.end());
}

Labeller::Labeller(const Rules& rules, const Categories& categories, DatasetLabels labels,
                   const Model& model)
    : labels_(labels) {
  for (const std::string& name : categories) {
    ids_.emplace(name, static_cast<uint32_t>(ids_.size() + 1));
  }
  if (labels == DatasetLabels::Label) readTrace(rules, model);
}

void Labeller::readTrace(const Rules& rules, const Model& model) {
  const std::map<std::string, std::string> labels = labelsOf(rules);
  const DerivationTrace trace = model.trace();
  std::vector<uint32_t> idOfName;
  for (const std::string& name : trace.names) {
    const auto label = labels.find(name);
    idOfName.push_back(label == labels.end() ? 0 : ids_.at(label->second));
  }
  const uint64_t leaves = model.leafCount();
  instanceOf_.assign(leaves, 0);
  categoryOf_.assign(leaves, 0);
  // Parents come before their children, so the nearest label is the last one to be written.
  uint32_t instance = 0;
  for (const DerivationTrace::Node& node : trace.nodes) {
    const uint32_t category = node.ruleCall ? idOfName[node.name] : 0;
    if (category == 0 || !node.leaves) continue;
    ++instance;
    for (uint64_t i = node.leaves->first; i < std::min<uint64_t>(node.leaves->end, leaves); ++i) {
      instanceOf_[i] = instance;
      categoryOf_[i] = category;
    }
  }
}

Marks Labeller::marks(const PictureLayers& layers) const {
  Marks out;
  const size_t pixels = layers.instances.size();
  out.categories.resize(pixels);
  if (labels_ == DatasetLabels::Rule) {
    std::vector<uint32_t> idOf{0};
    for (const std::string& rule : layers.ruleNames) {
      const auto id = ids_.find(rule);
      idOf.push_back(id == ids_.end() ? 0 : id->second);
    }
    for (size_t i = 0; i < pixels; ++i) out.categories[i] = idOf[layers.rules[i]];
    out.instances = layers.instances;
    return out;
  }
  out.instances.resize(pixels);
  for (size_t i = 0; i < pixels; ++i) {
    const uint32_t leaf = layers.instances[i];
    if (leaf == 0 || leaf > instanceOf_.size()) continue;
    out.instances[i] = instanceOf_[leaf - 1];
    out.categories[i] = categoryOf_[leaf - 1];
  }
  return out;
}

}  // namespace gable
