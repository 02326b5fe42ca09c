// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Tracing, and the questions about other shapes.

#include <limits>

#include "runtime/machine.h"
#include "shape/deformation.h"

namespace gable {

namespace {

constexpr size_t kMostNotes = 400'000;

}  // namespace

void Machine::traceShape(Activation& a, uint32_t parentNode, const Instruction* at) {
  TraceNode node;
  node.parent = parentNode;
  node.initialShape = info_.index;
  node.name = program_.rules[a.rule].name;
  node.span = at ? program_.spans[pcOf(at)] : program_.rules[a.rule].span;
  node.scope = worlds_.back() * a.shape.scope;
  node.size = a.shape.size;
  node.ruleCall = true;
  if (options().traceShapes) {
    Shape asMade = a.shape;
    if (isDeformed(asMade)) bakeDeformation(asMade);
    const auto index = static_cast<uint32_t>(output_.openLeaves.size());
    if (putLeaf(asMade, node.name, at ? pcOf(at) : program_.rules[a.rule].entry)) {
      node.shapeIndex = index;
    }
  }
  a.traceNode = static_cast<uint32_t>(trace_.size());
  trace_.push_back(node);
  if (options().traceShapes) noteParameters(a);
}

// Null where no rule is at work, or where there are too many for anybody to look at.
TraceNote* Machine::note(TraceNote::Kind kind) {
  if (activationCount_ == 0 || notes_.size() >= kMostNotes) return nullptr;
  const uint32_t node = current().traceNode;
  if (node == TraceNode::kNone) return nullptr;
  TraceNote& n = notes_.emplace_back();
  n.kind = kind;
  n.node = node;
  return &n;
}

void Machine::noteParameters(const Activation& a) {
  const std::vector<ParameterInfo>& parameters = program_.rules[a.rule].parameters;
  for (uint32_t k = 0; k < parameters.size() && notes_.size() < kMostNotes; ++k) {
    TraceNote& n = notes_.emplace_back();
    n.kind = TraceNote::Kind::Parameter;
    n.node = a.traceNode;
    n.value = plainAttribute(std::string(pool().text(parameters[k].name)), stack_[a.parameters + k],
                             pool());
  }
}

// A rule that reads an attribute again saw it already.
void Machine::noteAttribute(uint32_t a, const Value& v) {
  if (activationCount_ == 0) return;
  const std::string& name = program_.attributes[a].name;
  for (size_t i = notes_.size(); i-- > 0 && notes_[i].node == current().traceNode;) {
    if (notes_[i].kind == TraceNote::Kind::Attribute && notes_[i].value.name == name) return;
  }
  if (TraceNote* n = note(TraceNote::Kind::Attribute)) n->value = plainAttribute(name, v, pool());
}

// A rule call that made nothing is its own leaf; a leaf of a slot or of an unknown rule is a child.
void Machine::traceLeaf(const Activation& a, StringId name, uint32_t source) {
  const uint32_t leafIndex = a.shape.geometry.kind == GeometryKind::None
                                 ? TraceNode::kNone
                                 : static_cast<uint32_t>(output_.openLeaves.size());
  if (a.made == 0 && !a.slot && a.traceNode != TraceNode::kNone) {
    trace_[a.traceNode].leaf = true;
    trace_[a.traceNode].leafIndex = leafIndex;
    return;
  }
  TraceNode node;
  node.parent = a.traceNode;
  node.initialShape = info_.index;
  node.name = name;
  node.span = program_.spans[source];
  node.scope = worlds_.back() * a.shape.scope;
  node.size = a.shape.size;
  node.leaf = true;
  node.leafIndex = leafIndex;
  trace_.push_back(node);
}

std::vector<uint32_t> Machine::treePath() const {
  std::vector<uint32_t> path;
  for (uint32_t i = 1; i < activationCount_; ++i) {
    if (!activations_[i].slot) path.push_back(activations_[i].ordinal);
  }
  return path;
}

Occluder Machine::asking(const Shape& s) const {
  Occluder o;
  o.initialShape = info_.index;
  o.path = treePath();
  o.mesh = transformed(meshInLocal(s), {1, 1, 1}, worlds_.back());
  o.scope = worlds_.back() * s.scope;
  o.size = s.size;
  return o;
}

void Machine::addOccluder(StringId label, const Shape& s) {
  if (s.geometry.kind == GeometryKind::None) return;
  Occluder o = asking(s);
  o.label = label;
  occluders_.push_back(std::move(o));
}

void Machine::takeLabel(StringId name, const Shape& shape) {
  if (collectOccluders_) addOccluder(name, shape);
}

bool Machine::answerQuery(ContextTest test, ContextScope scope, StringId label,
                          const Shape& shape) {
  return shared_.occluders && shared_.occluders->test(test, scope, label, asking(shape));
}

double Machine::answerDistance(ContextScope scope, StringId label, const Shape& shape) {
  if (!shared_.occluders) return std::numeric_limits<double>::infinity();
  return shared_.occluders->minimumDistance(scope, label, asking(shape));
}

double Machine::answerCount(ContextScope scope, StringId label) {
  if (!shared_.occluders) return 0;
  return static_cast<double>(shared_.occluders->count(scope, label, asking(*seen_)));
}

double Machine::answerRank(ContextScope scope, StringId label, ContextOrder order,
                           const Shape& shape) {
  if (!shared_.occluders) return 0;
  return static_cast<double>(shared_.occluders->rank(scope, label, order, asking(shape)));
}

}  // namespace gable
