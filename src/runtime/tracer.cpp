// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/tracer.h"

#include <algorithm>

#include "runtime/output.h"

namespace gable {

bool Tracer::isTop(const std::vector<const std::string*>& path) const {
  if (filter_.rule && *path.back() != *filter_.rule) return false;
  return filter_.path.empty() ||
         std::equal(path.begin(), path.end(), filter_.path.begin(), filter_.path.end(),
                    [](const std::string* a, const std::string& b) { return *a == b; });
}

bool Tracer::reachesBelow(uint32_t node) const {
  if (node == TraceNode::kCut) return false;
  return !filter_.depth || node == TraceNode::kNone || levels_[node] < *filter_.depth;
}

TraceNode& Tracer::add(const Made& made) {
  if (filter_.depth)
    levels_.push_back(made.parent == TraceNode::kNone ? 0 : levels_[made.parent] + 1);
  TraceNode& node = nodes_.emplace_back();
  node.parent = made.parent;
  node.initialShape = made.initialShape;
  node.name = made.name;
  node.span = made.span;
  node.scope = made.scope;
  node.size = made.size;
  node.tags = made.tags;
  return node;
}

uint32_t Tracer::addCall(const Made& made, uint32_t rule) {
  add(made).rule = rule;
  return static_cast<uint32_t>(nodes_.size() - 1);
}

void Tracer::addLeaf(const Made& made, uint32_t leafIndex) {
  TraceNode& node = add(made);
  node.leaf = true;
  node.leafIndex = leafIndex;
}

void Tracer::endAsLeaf(uint32_t node, uint32_t leafIndex) {
  nodes_[node].leaf = true;
  nodes_[node].leafIndex = leafIndex;
}

void Tracer::drop(uint32_t node) { nodes_[node].dropped = true; }

TraceNote* Tracer::note(uint32_t node, TraceNote::Kind kind) {
  if (node >= TraceNode::kCut || notes_.size() >= kMostNotes) return nullptr;
  TraceNote& n = notes_.emplace_back();
  n.kind = kind;
  n.node = node;
  return &n;
}

void Tracer::noteParameters(uint32_t node, const RuleCode& rule, const Value* values) {
  const ValuePool& pool = *program_.pool;
  for (const ParameterInfo& parameter : rule.parameters) {
    TraceNote* n = note(node, TraceNote::Kind::Parameter);
    if (!n) return;
    n->value = plainAttribute(std::string(pool.text(parameter.name)), *values++, pool);
  }
}

void Tracer::noteAttribute(uint32_t node, uint32_t attribute, const Value& v) {
  const std::string& name = program_.attributes[attribute].name;
  for (size_t i = notes_.size(); i-- > 0 && notes_[i].node == node;) {
    if (notes_[i].kind == TraceNote::Kind::Attribute && notes_[i].value.name == name) return;
  }
  if (TraceNote* n = note(node, TraceNote::Kind::Attribute)) {
    n->value = plainAttribute(name, v, *program_.pool);
  }
}

void Tracer::noteDraw(uint32_t node, const Span& span, const char* function, const Value& v) {
  TraceNote* n = note(node, TraceNote::Kind::Draw);
  if (!n) return;
  n->span = span;
  n->value = plainAttribute(function, v, *program_.pool);
}

void Tracer::noteChoice(uint32_t node, const Span& span, const Choice& choice) {
  TraceNote* n = note(node, TraceNote::Kind::Choice);
  if (!n) return;
  n->span = span;
  n->draw = choice.draw;
  n->chance = choice.chance;
  n->chosen = choice.chosen;
  n->choices = choice.choices;
}

std::vector<bool> Tracer::shownShapes(size_t from, uint32_t firstLeaf, size_t count) const {
  std::vector<bool> shown(count, false);
  for (size_t n = from; n < nodes_.size(); ++n) {
    if (nodes_[n].shapeIndex != TraceNode::kNone) shown[nodes_[n].shapeIndex - firstLeaf] = true;
  }
  return shown;
}

void Tracer::renumberLeaves(size_t from, uint32_t firstLeaf, const std::vector<uint32_t>& numbers) {
  for (size_t n = from; n < nodes_.size(); ++n) {
    for (uint32_t* index : {&nodes_[n].leafIndex, &nodes_[n].shapeIndex}) {
      if (*index != TraceNode::kNone && *index >= firstLeaf) *index = numbers[*index - firstLeaf];
    }
  }
}

}  // namespace gable
