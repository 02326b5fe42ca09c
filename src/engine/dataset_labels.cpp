// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What pixels are. By rule it is in the layers of the picture. By @Label and by tag it comes from
// the derivation tree: the leaves of a shape lie together in path order, and without sharing the
// renderer numbers leaves in that order.

#include <algorithm>
#include <set>

#include "base/text.h"
#include "builtins/selection.h"
#include "engine/dataset.h"

namespace gable {

namespace {

// By rule, as Rules::rules() has them: its label, or nothing.
std::vector<std::string> labelsOf(const Rules& rules) {
  std::vector<std::string> out;
  for (const RuleInfo& rule : rules.rules()) {
    std::string& label = out.emplace_back();
    for (const AttributeInfo::Annotation& note : rule.annotations) {
      if (note.name == "Label" && !note.arguments.empty()) label = note.arguments[0].second;
    }
  }
  return out;
}

// What the rules name where they give tags: texts that stand in the call itself.
std::set<std::string> tagsNamedBy(const Program& program) {
  std::set<std::string> names;
  for (size_t at = 0; at + 1 < program.code.size(); ++at) {
    const Instruction& i = program.code[at];
    if (i.code != Code::OperationConstant || i.x == 0) continue;
    if (std::string_view(program.operations[i.a]->name) != "tag") continue;
    std::string name(program.pool->text(program.constants[program.code[at + 1].a].id));
    // As the operation takes it.
    std::erase_if(name, [](char c) { return c == '?' || c == '*'; });
    if (!name.empty()) names.insert(std::move(name));
  }
  return names;
}

// Rules may give tags that they compute.
bool computesTags(const Program& program) {
  return std::any_of(program.code.begin(), program.code.end(), [&](const Instruction& i) {
    return i.code == Code::Operation && std::string_view(program.operations[i.a]->name) == "tag";
  });
}

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

namespace {

// Which categories shapes have from their tags and from those above them. What is above a shape has
// been found before it, so each of its sets is one of few.
class TagCategories {
 public:
  TagCategories(const Categories& queries, const std::vector<std::vector<std::string>>& tagSets) {
    for (const std::vector<std::string>& set : tagSets) {
      std::vector<uint32_t>& ids = ofTags_.emplace_back();
      for (uint32_t q = 0; q < queries.size(); ++q) {
        const auto matches = [&](const std::string& tag) { return tagMatches(queries[q], tag); };
        if (std::any_of(set.begin(), set.end(), matches)) ids.push_back(q + 1);
      }
    }
  }

  struct Step {
    /// The set of the shape with those above it, by number; 0 for the empty one.
    uint32_t set = 0;
    /// The first that is not above it, or 0.
    uint32_t fresh = 0;
  };
  Step below(uint32_t above, uint32_t tags) {
    const auto [at, isNew] = steps_.try_emplace({above, tags});
    if (isNew) at->second = found(above, ofTags_[tags]);
    return at->second;
  }

 private:
  Step found(uint32_t above, const std::vector<uint32_t>& own) {
    std::set<uint32_t> all = sets_[above];
    Step step;
    for (const uint32_t id : own) {
      if (all.insert(id).second && step.fresh == 0) step.fresh = id;
    }
    const auto [at, isNew] = numbers_.try_emplace(all, static_cast<uint32_t>(sets_.size()));
    if (isNew) sets_.push_back(std::move(all));
    step.set = at->second;
    return step;
  }

  std::vector<std::vector<uint32_t>> ofTags_;
  std::vector<std::set<uint32_t>> sets_{{}};
  std::map<std::set<uint32_t>, uint32_t> numbers_{{{}, 0}};
  std::map<std::pair<uint32_t, uint32_t>, Step> steps_;
};

// By node of the trace its own category, 0 for none: a part of what has the same tag is no instance
// of its own.
std::vector<uint32_t> taggedNodes(const Categories& categories, const DerivationTrace& trace) {
  TagCategories sets(categories, trace.tagSets);
  std::vector<uint32_t> out, setOf;
  for (const DerivationTrace::Node& node : trace.nodes) {
    const auto step = sets.below(node.parent ? setOf[*node.parent] : 0, node.tags);
    setOf.push_back(step.set);
    out.push_back(step.fresh);
  }
  return out;
}

}  // namespace

Labeller::Labeller(const Rules& rules, const Categories& categories, DatasetLabels labels,
                   const Model& model)
    : labels_(labels) {
  for (const std::string& name : categories) {
    ids_.emplace(name, static_cast<uint32_t>(ids_.size() + 1));
  }
  if (labels == DatasetLabels::Rule) return;
  const DerivationTrace trace = model.trace();
  mark(trace,
       labels == DatasetLabels::Tag ? taggedNodes(categories, trace) : labelled(rules, trace),
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

void Labeller::mark(const DerivationTrace& trace, const std::vector<uint32_t>& categoryOfNode,
                    uint64_t leaves) {
  instanceOf_.assign(leaves, 0);
  categoryOf_.assign(leaves, 0);
  // Parents come before their children, so the nearest category is the last one to be written.
  uint32_t instance = 0;
  for (size_t n = 0; n < trace.nodes.size(); ++n) {
    const std::optional<DerivationTrace::Leaves>& below = trace.nodes[n].leaves;
    if (categoryOfNode[n] == 0 || !below) continue;
    ++instance;
    for (uint64_t i = below->first; i < std::min<uint64_t>(below->end, leaves); ++i) {
      instanceOf_[i] = instance;
      categoryOf_[i] = categoryOfNode[n];
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
