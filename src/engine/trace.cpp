// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The derivation tree as data. Leaves are numbered through all initial shapes, as the flattened
// scene counts them; a shape's leaves lie together because both are in path order.

#include <algorithm>

#include "engine/impl.h"
#include "scene/flatten.h"

namespace gable {

namespace {

std::vector<uint64_t> firstLeafOfRoots(const Scene& scene) {
  const std::vector<uint64_t> counts = prototypeLeafCounts(scene);
  std::vector<uint64_t> first{0};
  for (const Root& r : scene.roots) {
    first.push_back(saturatingAdd(first.back(), counts[r.instance.prototype]));
  }
  return first;
}

void setFrame(DerivationTrace::Node& out, const TraceNode& n) {
  size_t i = 0;
  for (const Vec3& v : {n.scope.origin, n.scope.x, n.scope.y, n.scope.z}) {
    for (const double d : {v.x, v.y, v.z}) out.frame[i++] = d;
  }
  out.size = {n.size.x, n.size.y, n.size.z};
}

std::optional<DerivationTrace::Place> placeOf(const Span& span, const Sources& sources) {
  if (!span.valid()) return std::nullopt;
  const LineColumn from = sources.locate(span.file, span.begin);
  const LineColumn to = sources.locate(span.file, span.end);
  return DerivationTrace::Place{span.file, from.line, from.column, to.line, to.column};
}

std::string_view textOf(const Span& span, const Sources& sources) {
  if (!span.valid()) return {};
  const std::string_view text = sources.text(span.file);
  return span.begin < span.end && span.end <= text.size()
             ? text.substr(span.begin, span.end - span.begin)
             : std::string_view();
}

DerivationTrace::Note noteOf(const TraceNote& n, const Sources& sources) {
  DerivationTrace::Note out;
  out.kind = static_cast<DerivationTrace::Note::Kind>(n.kind);
  out.node = n.node;
  out.name = n.value.name;
  if (n.kind == TraceNote::Kind::Draw) {
    const std::string_view text = textOf(n.span, sources);
    if (!text.empty()) out.name = text;
  }
  out.value = ruleValueOf(n.value);
  out.place = placeOf(n.span, sources);
  if (n.kind == TraceNote::Kind::Choice) {
    out.choice = DerivationTrace::Note::Choice{n.draw, n.chance, n.chosen, n.choices};
  }
  return out;
}

}  // namespace

DerivationTrace traceOf(const DeriveResult& result, const Program& program,
                        const Sources& sources) {
  DerivationTrace tree;
  for (uint32_t f = 0; f < sources.size(); ++f) tree.files.emplace_back(sources.path(f));
  const std::vector<uint64_t> first = firstLeafOfRoots(result.scene);
  std::vector<std::pair<StringId, uint32_t>> named;
  for (const TraceNode& n : result.trace) named.emplace_back(n.name, 0);
  std::sort(named.begin(), named.end());
  named.erase(std::unique(named.begin(), named.end()), named.end());
  for (const auto& [id, unused] : named) tree.names.emplace_back(program.pool->text(id));
  for (const std::vector<StringId>& set : result.traceTags) {
    std::vector<std::string>& texts = tree.tagSets.emplace_back();
    for (const StringId name : set) texts.emplace_back(program.pool->text(name));
    std::sort(texts.begin(), texts.end());
  }
  for (const TraceNode& n : result.trace) {
    DerivationTrace::Node out;
    if (n.parent != TraceNode::kNone) out.parent = n.parent;
    out.shape = n.initialShape;
    const auto at = std::lower_bound(named.begin(), named.end(), std::pair{n.name, 0u});
    out.name = static_cast<uint32_t>(at - named.begin());
    out.place = placeOf(n.span, sources);
    setFrame(out, n);
    out.leaf = n.leaf;
    out.dropped = n.dropped;
    out.ruleCall = n.rule != TraceNode::kNone;
    if (out.ruleCall) out.rule = n.rule;
    out.tags = n.tags;
    const auto numberOf = [&](uint32_t index) -> std::optional<uint32_t> {
      const bool known = index != TraceNode::kNone && n.initialShape + 1 < first.size();
      if (!known) return std::nullopt;
      return static_cast<uint32_t>(first[n.initialShape] + index);
    };
    out.before = numberOf(n.shapeIndex);
    out.after = numberOf(n.leafIndex);
    for (const std::optional<uint32_t>& own : {out.before, out.after}) {
      if (!own) continue;
      if (!out.leaves) out.leaves = DerivationTrace::Leaves{*own, *own + 1};
      out.leaves->end = *own + 1;
    }
    tree.nodes.push_back(out);
  }
  // Children stand behind their parents, so one pass from the end joins all ranges.
  for (size_t i = tree.nodes.size(); i-- > 0;) {
    const DerivationTrace::Node& n = tree.nodes[i];
    if (!n.parent || !n.leaves) continue;
    std::optional<DerivationTrace::Leaves>& above = tree.nodes[*n.parent].leaves;
    if (!above) {
      above = n.leaves;
    } else {
      above->first = std::min(above->first, n.leaves->first);
      above->end = std::max(above->end, n.leaves->end);
    }
  }
  for (const TraceNote& n : result.notes) tree.notes.push_back(noteOf(n, sources));
  return tree;
}

}  // namespace gable
