// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "engine/city_labels.h"

#include <algorithm>

#include "base/work.h"
#include "engine/footprint.h"
#include "engine/leaf_labels.h"
#include "io/exporters/city_kinds.h"
#include "scene/flatten.h"

namespace gable {

namespace {

bool saysPart(const std::string& label) {
  return !label.empty() && cityKindOfLabel(label) != CityKind::Unknown;
}

bool givesTags(const Program& program, size_t at) {
  const std::optional<GivenTag> tag = givenTag(program, at);
  return tag && (tag->isComputed || saysPart(tag->name));
}

// What the code of a rule says itself, and which rules it calls. The code of its blocks lies in it.
struct RuleContent {
  bool says = false;
  std::vector<uint32_t> calls;
};

RuleContent contentOf(const Program& program, uint32_t begin, uint32_t end) {
  RuleContent out;
  for (uint32_t at = begin; at < end; ++at) {
    const Instruction& i = program.code[at];
    if (i.code == Code::CallRule || i.code == Code::RunRule) out.calls.push_back(i.a);
    out.says = out.says || givesTags(program, at);
  }
  return out;
}

// Tags that say a part, of several on one shape the one of most words first.
std::vector<std::string> tagsThatSay(const DerivationTrace& trace) {
  std::set<std::string> all;
  for (const std::vector<std::string>& set : trace.tagSets) {
    for (const std::string& tag : set) {
      if (saysPart(tag)) all.insert(tag);
    }
  }
  std::vector<std::string> out(all.begin(), all.end());
  const auto words = [](const std::string& tag) { return std::count(tag.begin(), tag.end(), '.'); };
  std::stable_sort(out.begin(), out.end(),
                   [&](const std::string& a, const std::string& b) { return words(a) > words(b); });
  return out;
}

}  // namespace

CityLabels::CityLabels(const Model::Impl& model, const std::atomic<bool>* cancel)
    : model_(model), cancel_(cancel) {
  if (!model.rules || !model.from) return;
  labels_ = labelsOf(Rules(model.rules));
  for (std::string& label : labels_) {
    if (!saysPart(label)) label.clear();
  }
  rulesSay_ = rulesThatSay();
  leafCounts_ = prototypeLeafCounts(model.scene());
  const std::vector<ShapeFootprint>& shapes = model.from->shapes.impl().footprints;
  together_ = std::any_of(shapes.begin(), shapes.end(), [&](const ShapeFootprint& shape) {
    const int32_t rule = ruleOf(shape);
    return rule >= 0 &&
           asksOthers(model.rules->program.rules[static_cast<size_t>(rule)].reads.effects);
  });
  if (!together_) return;
  firstOfRoots_.push_back(0);
  for (const Root& root : model.scene().roots) {
    firstOfRoots_.push_back(
        saturatingAdd(firstOfRoots_.back(), leafCounts_[root.instance.prototype]));
  }
}

std::vector<bool> CityLabels::rulesThatSay() const {
  const Program& program = model_.rules->program;
  std::vector<uint32_t> entries;
  for (const RuleCode& r : program.rules) entries.push_back(r.entry);
  for (const FunctionCode& f : program.functions) entries.push_back(f.entry);
  for (const AttributeCode& a : program.attributes) entries.push_back(a.entry);
  std::sort(entries.begin(), entries.end());
  std::vector<RuleContent> contents;
  std::vector<bool> says;
  for (size_t r = 0; r < program.rules.size(); ++r) {
    const auto next = std::upper_bound(entries.begin(), entries.end(), program.rules[r].entry);
    const uint32_t end = next == entries.end() ? static_cast<uint32_t>(program.code.size()) : *next;
    contents.push_back(contentOf(program, program.rules[r].entry, end));
    says.push_back(contents[r].says || !labels_[r].empty());
  }
  // A rule says what those say that it calls, round by round.
  for (bool changed = true; changed;) {
    changed = false;
    for (size_t r = contents.size(); r-- > 0;) {
      work();
      const std::vector<uint32_t>& calls = contents[r].calls;
      if (says[r] || std::none_of(calls.begin(), calls.end(), [&](uint32_t c) { return says[c]; }))
        continue;
      says[r] = true;
      changed = true;
    }
  }
  return says;
}

int32_t CityLabels::ruleOf(const ShapeFootprint& shape) const {
  return startRuleOf(shape.attributes, model_.rules->program, model_.startRule);
}

bool CityLabels::says(const ShapeFootprint& shape) const {
  const int32_t rule = ruleOf(shape);
  return (rule >= 0 && rulesSay_[static_cast<size_t>(rule)]) ||
         std::any_of(shape.faceTags.begin(), shape.faceTags.end(), saysPart);
}

// One of the initial shapes, or all of them.
std::shared_ptr<const Model::Impl> CityLabels::derivedAgain(std::optional<size_t> shape) const {
  DeriveSettings settings = model_.from->settings;
  settings.trace = true;
  settings.cancel = cancel_;
  Shapes shapes = model_.from->shapes;
  if (shape) {
    settings.jobs = 1;
    settings.shapeSeeds.clear();
    for (const auto& [index, seed] : model_.from->settings.shapeSeeds) {
      if (index == *shape) settings.shapeSeeds.emplace_back(0, seed);
    }
    auto one = std::make_shared<Shapes::Impl>();
    one->geoOrigin = shapes.impl().geoOrigin;
    one->geo = shapes.impl().geo;
    one->isWhole = false;
    ShapeFootprint& f = one->footprints.emplace_back(shapes.impl().footprints[*shape]);
    if (f.index < 0) f.index = static_cast<int64_t>(*shape);
    shapes = Shapes(std::move(one));
  }
  std::shared_ptr<const Model::Impl> model = derived(Rules(model_.rules), shapes, settings);
  // Who has stopped it wants no file without labels.
  work(kWorkBetweenLooks + 1);
  return model;
}

// Of all leaves of a traced derivation, by their numbers among all of them.
std::vector<LabelledLeaves> CityLabels::labelsIn(const Model::Impl& again) const {
  const DerivationTrace trace = traceOf(again.result, again.rules->program, again.rules->sources);
  const std::vector<std::string> tags = tagsThatSay(trace);
  std::vector<uint32_t> marks = taggedNodes(tags, trace);
  // The label of a rule counts before the tag that its shape came with. Marks go on behind those of
  // the tags.
  for (size_t n = 0; n < trace.nodes.size(); ++n) {
    const std::optional<uint32_t>& rule = trace.nodes[n].rule;
    if (rule && !labels_[*rule].empty()) {
      marks[n] = static_cast<uint32_t>(tags.size()) + 1 + *rule;
    }
  }
  const LeafMarks leaves = marksOf(trace, marks, leafCount(again.result.scene));
  std::vector<LabelledLeaves> out;
  for (uint64_t i = 0; i < leaves.shapes.size(); ++i) {
    work();
    const uint32_t shape = leaves.shapes[i], mark = leaves.marks[i];
    if (shape == 0) continue;
    if (!out.empty() && out.back().end == i && out.back().shape == shape) {
      ++out.back().end;
    } else {
      const bool isTag = mark <= tags.size();
      out.push_back({i, i + 1, shape, isTag ? tags[mark - 1] : labels_[mark - 1 - tags.size()]});
    }
  }
  return out;
}

std::vector<LabelledLeaves> CityLabels::of(size_t root) {
  if (rulesSay_.empty() || root >= model_.result.roots.size()) return {};
  const size_t shape = model_.result.roots[root].shape;
  if (!says(model_.from->shapes.impl().footprints[shape])) return {};
  const uint64_t count = leafCounts_[model_.scene().roots[root].instance.prototype];
  if (!together_) {
    const auto again = derivedAgain(shape);
    if (leafCount(again->result.scene) == count) return labelsIn(*again);
    ++unread_;
    return {};
  }
  if (!all_) {
    const auto again = derivedAgain(std::nullopt);
    all_.emplace();
    if (leafCount(again->result.scene) == firstOfRoots_.back()) {
      all_ = labelsIn(*again);
    } else {
      ++unread_;
    }
  }
  const uint64_t first = firstOfRoots_[root];
  std::vector<LabelledLeaves> out;
  const auto from = std::partition_point(all_->begin(), all_->end(),
                                         [&](const LabelledLeaves& l) { return l.end <= first; });
  for (auto l = from; l != all_->end() && l->first < first + count; ++l) {
    work();
    out.push_back({l->first - first, l->end - first, l->shape, l->label});
  }
  return out;
}

}  // namespace gable
