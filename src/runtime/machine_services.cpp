// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Tracing, and the questions about other shapes.

#include <algorithm>

#include "runtime/machine.h"
#include "shape/deformation.h"

namespace gable {

namespace {

// What all faces of a shape are tagged with.
TagSetId tagsOfAllFaces(const Shape& s, TagTable& table) {
  std::vector<StringId> common;
  bool first = true;
  TagSetId last = 0;
  // False where nothing is left that others could have, too.
  const auto narrow = [&](TagSetId set) {
    if (!first && set == last) return true;
    const std::vector<StringId>& names = table.names(set);
    if (first) {
      common = names;
    } else {
      std::erase_if(common, [&](StringId n) {
        return std::find(names.begin(), names.end(), n) == names.end();
      });
    }
    first = false;
    last = set;
    return !common.empty();
  };
  const Geometry& g = s.geometry;
  switch (g.kind) {
    case GeometryKind::None: return 0;
    case GeometryKind::Box:
      if (!std::all_of(g.tags.begin(), g.tags.end(), narrow)) return 0;
      break;
    case GeometryKind::QuadXy: narrow(g.tags[kSideFront]); break;
    case GeometryKind::QuadXz: narrow(g.tags[kSideTop]); break;
    case GeometryKind::Mesh:
      for (const MeshFace& f : g.mesh->faces) {
        work();
        if (!narrow(f.tags)) return 0;
      }
  }
  return common.empty() ? 0 : table.intern(std::move(common));
}

}  // namespace

Tracer::Made Machine::traced(const Shape& s, uint32_t parent, StringId name,
                             const Span& span) const {
  return {parent,
          info_.index,
          name,
          span,
          worlds_.present() * s.scope,
          s.size,
          tagsOfAllFaces(s, tags())};
}

// What the rule of a shape has tagged all of it with, though it may go on to take it apart.
void Machine::traceTags(const Activation& a) {
  if (a.slot || a.traceNode >= TraceNode::kCut || shapeStack_.size() > a.shapeStackBase) return;
  const TagSetId found = tagsOfAllFaces(a.shape, tags());
  if (found != 0) tracer_.setTags(a.traceNode, tags().merged(tracer_.tagsOf(a.traceNode), found));
}

bool Machine::isTraced(uint32_t parentNode, const Activation* rule) const {
  if (parentNode != TraceNode::kNone) return tracer_.reachesBelow(parentNode);
  if (!tracer_.choosesTops()) return true;
  if (!rule) return false;
  std::vector<const std::string*> path;
  for (uint32_t i = 0; i < activationCount_; ++i) {
    const Activation& a = activations_[i];
    if (!a.slot) path.push_back(&program_.rules[a.rule].qualifiedName);
  }
  return tracer_.isTop(path);
}

void Machine::traceShape(Activation& a, uint32_t parentNode, const Instruction* at) {
  if (!isTraced(parentNode, &a)) {
    a.traceNode = parentNode == TraceNode::kNone ? TraceNode::kNone : TraceNode::kCut;
    return;
  }
  const RuleCode& rule = program_.rules[a.rule];
  const Span& span = at ? program_.spans[pcOf(at)] : rule.span;
  a.traceNode = tracer_.addCall(traced(a.shape, parentNode, rule.name, span), a.rule);
  if (!tracer_.tracesShapes()) return;
  Shape asMade = a.shape;
  if (isDeformed(asMade)) bakeDeformation(asMade);
  const auto index = static_cast<uint32_t>(output_.openLeaves.size());
  if (putLeaf(asMade, rule.name, at ? pcOf(at) : rule.entry)) tracer_.showShape(a.traceNode, index);
  tracer_.noteParameters(a.traceNode, rule, stack_.at(a.parameters));
}

// A rule call that made nothing is its own leaf; a leaf of a slot or of an unknown rule is a child.
void Machine::traceLeaf(const Activation& a, StringId name, uint32_t source) {
  const uint32_t leafIndex = a.shape.geometry.kind == GeometryKind::None
                                 ? TraceNode::kNone
                                 : static_cast<uint32_t>(output_.openLeaves.size());
  if (a.made == 0 && !a.slot && a.traceNode < TraceNode::kCut) {
    tracer_.endAsLeaf(a.traceNode, leafIndex);
  } else if (isTraced(a.traceNode, nullptr)) {
    tracer_.addLeaf(traced(a.shape, a.traceNode, name, program_.spans[source]), leafIndex);
  }
}

ContextQueries::Place Machine::placeAtWork() const {
  const RoomCondition condition = activationCount_ > 0 ? current().condition : kAlways;
  // What a block makes belongs to the rule of the block.
  uint32_t end = activationCount_;
  while (end > 1 && activations_[end - 1].slot) --end;
  return {info_.index, placePath(end), worlds_.present(), condition};
}

void Machine::takeLabel(StringId name, const Shape& shape) {
  if (context_.collects()) context_.add(name, shape, placeAtWork());
  if (!shared_.collectClaims) return;
  RoomClaims::Claim claim{.initialShape = info_.index, .condition = current().condition};
  claim.group = name;
  claims_.add(claim, placePath(activationCount_), shape, worlds_.present());
}

bool Machine::answerQuery(ContextTest test, ContextScope scope, StringId label,
                          const Shape& shape) {
  return context_.test(test, scope, label, shape, placeAtWork());
}

double Machine::answerDistance(ContextScope scope, StringId label, const Shape& shape) {
  return context_.distance(scope, label, shape, placeAtWork());
}

double Machine::answerCount(ContextScope scope, StringId label) {
  return context_.count(scope, label, *seen_, placeAtWork());
}

double Machine::answerRank(ContextScope scope, StringId label, ContextOrder order,
                           const Shape& shape) {
  return context_.rank(scope, label, order, shape, placeAtWork());
}

}  // namespace gable
