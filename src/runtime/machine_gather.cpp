// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Operations that wait for the leaves of their children, in the machine.

#include "program/tag_effects.h"
#include "runtime/machine.h"

namespace gable {

// An operation that declares kReadsTags gets the tags of its leaves.
void Machine::beginGather(const Instruction& i, const OpCall& call,
                          std::span<const Value> arguments) {
  gathers_.begin({&i,
                  activationCount_ - 1,
                  current().made,
                  flat_,
                  lightPartsAllowed_,
                  {arguments.begin(), arguments.end()},
                  (program_.operations[i.a]->effects & kReadsTags) != 0,
                  call.keepsOrigins()});
  flat_ = true;
  lightPartsAllowed_ = false;
}

void Machine::leaveGather(const Gathers::Call& call) {
  flat_ = call.flat;
  lightPartsAllowed_ = call.light;
}

void Machine::endGather() {
  Gathers::Ended ended = gathers_.end();
  leaveGather(ended.call);
  const Instruction& i = *ended.call.at;
  Activation& a = current();
  const OpSpec& spec = *program_.operations[i.a];
  const CallPlace place{a.previous.frame, a.previous.size,
                        program_.files[program_.rules[a.rule].file], program_.sites[pcOf(&i)]};
  // Its selectors are those that the leaves came of, leaf by leaf.
  std::vector<SelectorItem> cameOf(ended.leaves.size());
  for (size_t k = 0; k < cameOf.size(); ++k) cameOf[k].slot = ended.slots[k];
  BlockInput block;
  block.slotCount = static_cast<uint32_t>(program_.blocks[i.y - 1].slots.size());
  block.selectors = cameOf;
  OpCall call(spec, a.shape, ended.call.arguments, *this, place, &block);
  instruction_ = &i;
  const Shape before = a.shape;
  const Status status = guarded([&] { return call.runGathered(ended.leaves); });
  if (status.ok()) {
    a.made = ended.call.made;
  } else {
    a.shape = before;
    tellFailure(spec.name, status);
  }
  gathers_.putBack(ended, status.ok());
}

// An operation that glues its parts together wants to know where those lay that are gone.
void Machine::keepDeleted(const Shape& s) {
  if (!gathers_.keepsOrigins() || s.geometry.kind != GeometryKind::Mesh) return;
  if (!hasOrigins(*s.geometry.mesh)) return;
  Mesh mesh = *s.geometry.mesh;
  markDeleted(mesh);
  Shape deleted = s;
  deleted.geometry.mesh = makeRef<Mesh>(std::move(mesh));
  putLeaf(deleted, program_.rules[current().rule].name, pcOf(pc_ - 1));
}

// Takes what lies in the scope into that of the operation that waits.
Frame Machine::homeOf(const Shape& s) const {
  const Shape& home = activations_[gathers_.innermost().activation].shape;
  return inverse(home.scope) * worlds_.ofLeaves() * s.scope;
}

// Notes what a shape moved by itself, where others begin with its geometry. The shape itself may go
// on. Nothing where no origins are known. One that was divided is kept for its edges: vertices that
// the division made on them follow their ends.
std::optional<Handover> Machine::endOrigins(const Shape& s, bool divided) {
  if (!gathers_.keepsOrigins() || s.geometry.kind != GeometryKind::Mesh) return std::nullopt;
  if (!hasOrigins(*s.geometry.mesh)) return std::nullopt;
  Handover out(*meshInScope(s), homeOf(s));
  if (out.moved() || divided) {
    keepDeleted(s);
    out.keep();
  }
  return out;
}

void Machine::beginOrigins(const Handover& from, Shape& s) {
  if (s.geometry.kind != GeometryKind::Mesh || !hasOrigins(*s.geometry.mesh)) return;
  Mesh mesh = *meshInScope(s);
  from.begin(mesh, homeOf(s), gathers_.nextShape());
  setMesh(s, std::move(mesh), ScopeFit::Keep);
}

// From a shape that was divided to its parts.
void Machine::handOver(const OpSpec& spec, size_t firstChild) {
  const bool divided = firstChild < children_.size() && (spec.effects & kForgetsOrigins) == 0;
  const std::optional<Handover> from = endOrigins(current().shape, divided);
  if (!from) return;
  for (size_t c = firstChild; c < children_.size(); ++c) {
    Shape& child = children_[c].shape;
    if ((spec.effects & kForgetsOrigins) == 0) {
      beginOrigins(*from, child);
    } else if (child.geometry.kind == GeometryKind::Mesh) {
      Mesh mesh = *child.geometry.mesh;
      dropOrigins(mesh, 0);
      child.geometry.mesh = makeRef<Mesh>(std::move(mesh));
    }
  }
}

// A limit struck within.
void Machine::dropGathers() {
  while (gathers_.anyOpen()) leaveGather(gathers_.drop());
}

}  // namespace gable
