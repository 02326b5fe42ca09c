// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "engine/leaf_labels.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "base/work.h"
#include "builtins/selection.h"

namespace gable {

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

std::optional<GivenTag> givenTag(const Program& program, size_t at) {
  const Instruction& i = program.code[at];
  const bool isConstant = i.code == Code::OperationConstant;
  if (!isConstant && i.code != Code::Operation) return std::nullopt;
  if (std::string_view(program.operations[i.a]->name) != "tag") return std::nullopt;
  GivenTag tag{!isConstant, {}};
  if (isConstant && i.x != 0 && at + 1 < program.code.size()) {
    tag.name = program.pool->text(program.constants[program.code[at + 1].a].id);
    // As the operation takes it.
    std::erase_if(tag.name, [](char c) { return c == '?' || c == '*'; });
  }
  return tag;
}

std::set<std::string> tagsNamedBy(const Program& program) {
  std::set<std::string> names;
  for (size_t at = 0; at < program.code.size(); ++at) {
    std::optional<GivenTag> tag = givenTag(program, at);
    if (tag && !tag->name.empty()) names.insert(std::move(tag->name));
  }
  return names;
}

bool computesTags(const Program& program) {
  for (size_t at = 0; at < program.code.size(); ++at) {
    const std::optional<GivenTag> tag = givenTag(program, at);
    if (tag && tag->isComputed) return true;
  }
  return false;
}

namespace {

// Which categories shapes have from their tags and from those above them. What is above a shape has
// been found before it, so each of its sets is one of few.
class TagCategories {
 public:
  TagCategories(const std::vector<std::string>& queries,
                const std::vector<std::vector<std::string>>& tagSets) {
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

}  // namespace

std::vector<uint32_t> taggedNodes(const std::vector<std::string>& queries,
                                  const DerivationTrace& trace) {
  TagCategories sets(queries, trace.tagSets);
  std::vector<uint32_t> out, setOf;
  for (const DerivationTrace::Node& node : trace.nodes) {
    work();
    const auto step = sets.below(node.parent ? setOf[*node.parent] : 0, node.tags);
    setOf.push_back(step.set);
    out.push_back(step.fresh);
  }
  return out;
}

LeafMarks marksOf(const DerivationTrace& trace, const std::vector<uint32_t>& markOfNode,
                  uint64_t leaves) {
  LeafMarks out;
  out.shapes.assign(leaves, 0);
  out.marks.assign(leaves, 0);
  // Parents come before their children, so the nearest mark is the last one to be written.
  uint32_t shape = 0;
  for (size_t n = 0; n < trace.nodes.size(); ++n) {
    const std::optional<DerivationTrace::Leaves>& below = trace.nodes[n].leaves;
    if (markOfNode[n] == 0 || !below) continue;
    ++shape;
    for (uint64_t i = below->first; i < std::min<uint64_t>(below->end, leaves); ++i) {
      work();
      out.shapes[i] = shape;
      out.marks[i] = markOfNode[n];
    }
  }
  return out;
}

}  // namespace gable
