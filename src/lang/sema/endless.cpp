// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rules that cannot end, A --> extrude(1) A, and files that have none.

#include <algorithm>
#include <unordered_set>

#include "base/work.h"
#include "lang/sema/analysis.h"

namespace gable::lang {

namespace {

// Whether a division makes each of its parts whatever the size of the shape: none has a length of
// its own that could be all there is.
bool makesAllParts(const Tree& t, NodeId block) {
  for (const NodeId item : t.children(block)) {
    if (t.kind(item) == NodeKind::Block) {
      if (!makesAllParts(t, item)) return false;
      continue;
    }
    const NodeId size = t.child(item, 0);
    const NodeKind kind = size == kNoNode ? NodeKind::Missing : t.kind(size);
    if (kind != NodeKind::Floating && kind != NodeKind::Relative) return false;
  }
  return true;
}

// Operations that fill an axis with parts of one kind.
bool fills(std::string_view operation) {
  return operation == "splitRepeat" || operation == "splitGrid";
}

}  // namespace

// The rules in the parts of a block that is made whatever happens.
void Analysis::certainParts(NodeId block, CertainRules& out) {
  for (const NodeId item : tree().children(block)) {
    work();
    if (tree().kind(item) == NodeKind::Block) {
      certainParts(item, out);
    } else if (const NodeId body = tree().child(item, 2); body != kNoNode) {
      certainRules(body, out);
    }
  }
}

// The rules that a sequence applies whatever happens: what stands in a choice, or in a block of
// which a part may be missing, may not be reached; the rest always is.
void Analysis::certainRules(NodeId sequence, CertainRules& out) {
  const Tree& t = tree();
  for (const NodeId item : t.children(sequence)) {
    work();
    if (t.kind(item) == NodeKind::Push) certainRules(t.child(item, 0), out);
    if (t.kind(item) != NodeKind::Apply) continue;
    // What follows has nothing to work on.
    if (t.text(item) == "NIL") return;
    const Resolution& r = module().at(item);
    if (r.kind == RefKind::Rule) out.emplace_back(r.index, nameSpan(t, item));
    if (r.kind != RefKind::Operation) continue;
    for (const NodeId block : t.children(item).subspan(1)) {
      const bool splits = t.text(item) == "split" && makesAllParts(t, block);
      if (splits || fills(t.text(item))) certainParts(block, out);
    }
    // do(Rule) applies it in place.
    if (t.text(item) != "do") continue;
    for (const NodeId call : arguments(t.child(item, 0))) {
      const Resolution& run = module().at(call);
      if (run.kind == RefKind::Rule) out.emplace_back(run.index, t.span(call));
    }
  }
}

// `path` goes from a rule to one that applies it again.
void Analysis::reportEndless(std::span<const RuleId> path, Span at) {
  constexpr size_t kMostNames = 6;
  const std::string& name = program_.rules[path[0]].name;
  std::string way;
  for (size_t i = 0; i < std::min(path.size(), kMostNames); ++i) {
    way += program_.rules[path[i]].name + ", ";
  }
  if (path.size() > kMostNames) way += "..., ";
  const bool direct = path.size() == 1;
  warning("endless-rule", at,
          direct ? quote(name) + " applies itself whatever happens, and ends at the limit on depth"
                 : quote(name) + " applies itself whatever happens, by way of other rules (" + way +
                       name + "), and ends at the limit on depth",
          "write 'case condition : ... else : ...' around it");
}

// A walk along the rules that are applied whatever happens; one that is on the way already closes a
// circle.
void Analysis::checkEndlessRules(ModuleId firstModule) {
  struct Step {
    CertainRules next;
    size_t done = 0;
  };
  enum State : uint8_t { kNew, kOnTheWay, kSeen };
  std::vector<uint8_t> states(program_.rules.size(), kNew);
  std::vector<Step> steps;
  std::vector<RuleId> path;
  const auto enter = [&](RuleId id) {
    const RuleInfo& rule = program_.rules[id];
    body_ = {};
    body_.module = rule.module;
    Step step;
    const NodeId body = bodyOf(tree(), rule.node);
    if (tree().kind(body) == NodeKind::Sequence) certainRules(body, step.next);
    // A rule that is applied several times is told once, where it stands first.
    std::unordered_set<RuleId> known;
    std::erase_if(step.next, [&](const auto& c) { return !known.insert(c.first).second; });
    states[id] = kOnTheWay;
    path.push_back(id);
    steps.push_back(std::move(step));
  };
  for (RuleId first = 0; first < program_.rules.size(); ++first) {
    if (program_.rules[first].module < firstModule || states[first] != kNew) continue;
    enter(first);
    while (!steps.empty()) {
      work();
      Step& step = steps.back();
      if (step.done == step.next.size()) {
        states[path.back()] = kSeen;
        path.pop_back();
        steps.pop_back();
        continue;
      }
      const auto [next, at] = step.next[step.done++];
      if (states[next] == kNew) {
        enter(next);
      } else if (states[next] == kOnTheWay && program_.rules[path.back()].module >= firstModule) {
        const auto from = std::find(path.begin(), path.end(), next) - path.begin();
        reportEndless(std::span<const RuleId>(path).subspan(static_cast<size_t>(from)), at);
      }
    }
  }
}

void Analysis::reportEmptyFile() {
  const Tree& t = *program_.units[0].tree;
  if (!t.children(t.root()).empty() || diagnostics_.hasErrors()) return;
  error("empty-file", {t.file(), 0, 0}, "the file has no rules", "write one: Lot --> extrude(10)");
}

}  // namespace gable::lang
