// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What pixels are. By rule it is in the layers of the picture. By @Label and by tag it is what
// leaves are (leaf_labels.h): without sharing the renderer numbers them in path order.

#include <algorithm>
#include <set>

#include "base/text.h"
#include "builtins/selection.h"
#include "engine/dataset.h"

namespace gable {

namespace {

// A tag that no rule gives. Operations give those with a dot, such as extrude.top.
std::optional<Error> missingTag(const Program& program, const std::vector<std::string>& tags) {
  const std::set<std::string> named = tagsNamedBy(program);
  const std::vector<std::string_view> names(named.begin(), named.end());
  for (const std::string& tag : tags) {
    const auto isMeant = [&](const std::string& name) { return tagMatches(tag, name); };
    if (tag.find_first_of(".?*") != std::string::npos ||
        std::any_of(named.begin(), named.end(), isMeant)) {
      continue;
    }
    const std::string near = didYouMean(tag, names);
    if (near.empty() && computesTags(program)) continue;
    std::string known;
    for (const std::string_view n : names) known += (known.empty() ? "" : ", ") + std::string(n);
    return Error{"dataset-labels", "no rule gives the tag '" + tag + "'",
                 !near.empty()   ? near
                 : known.empty() ? "give it with the operation tag, or name those of operations, "
                                   "such as extrude.top"
                                 : "rules give " + known};
  }
  return std::nullopt;
}

Error noCategories(DatasetLabels labels) {
  if (labels == DatasetLabels::Tag) {
    return {"dataset-labels", "no rule gives a tag",
            "give tags where shapes are to be told apart, tag(\"window\"), or name those of "
            "operations, such as extrude.top"};
  }
  return {"dataset-labels", "no rule has a label",
          "write @Label(\"window\") before the rules whose shapes are to be told apart, or label "
          "by rule"};
}

}  // namespace

Result<Categories> categoriesOf(const Rules& rules, const DatasetSettings& settings) {
  if (!settings.tags.empty()) {
    if (const auto missing = missingTag(rules.impl().program, settings.tags)) return *missing;
    return settings.tags;
  }
  std::set<std::string> names;
  switch (settings.labels) {
    case DatasetLabels::Rule:
      for (const RuleInfo& rule : rules.rules()) names.insert(rule.name);
      break;
    case DatasetLabels::Label:
      for (const std::string& label : labelsOf(rules)) names.insert(label);
      names.erase("");
      break;
    case DatasetLabels::Tag: names = tagsNamedBy(rules.impl().program); break;
  }
  if (names.empty()) return noCategories(settings.labels);
  return Categories(names.begin(), names.end());
}

Labeller::Labeller(const Rules& rules, const Categories& categories, DatasetLabels labels,
                   const Model& model)
    : labels_(labels) {
  for (const std::string& name : categories) {
    ids_.emplace(name, static_cast<uint32_t>(ids_.size() + 1));
  }
  if (labels == DatasetLabels::Rule) return;
  const DerivationTrace trace = model.trace();
  const bool byTag = labels == DatasetLabels::Tag;
  leaves_ = marksOf(trace, byTag ? taggedNodes(categories, trace) : labelled(rules, trace),
                    model.leafCount());
}

std::vector<uint32_t> Labeller::labelled(const Rules& rules, const DerivationTrace& trace) const {
  std::vector<uint32_t> idOfRule;
  for (const std::string& label : labelsOf(rules)) {
    idOfRule.push_back(label.empty() ? 0 : ids_.at(label));
  }
  std::vector<uint32_t> out;
  for (const DerivationTrace::Node& node : trace.nodes) {
    out.push_back(node.rule ? idOfRule[*node.rule] : 0);
  }
  return out;
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
    if (leaf == 0 || leaf > leaves_.shapes.size()) continue;
    out.instances[i] = leaves_.shapes[leaf - 1];
    out.categories[i] = leaves_.marks[leaf - 1];
  }
  return out;
}

}  // namespace gable
