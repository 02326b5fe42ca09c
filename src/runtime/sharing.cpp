// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Sharing. A call of a shared rule works in a frame of its own, the scope of the shape it was
// called on; so its result depends on nothing but the inputs that keyOf() hashes, and equal keys
// have equal results. With sharing on a result becomes a prototype and each call an instance; with
// sharing off the frames are composed in the same order while deriving, which gives the same
// numbers.

#include <cmath>

#include "runtime/key_hash.h"
#include "runtime/machine.h"

namespace gable {

void KeyHash::add(const ShapeExtra& extra) {
  add(extra.trim.size());
  for (const TrimPlane& t : extra.trim) {
    add(t.normal);
    add(t.distance);
    add(uint64_t{t.horizontal});
  }
  for (const UvProjection& p : extra.projections) {
    add(static_cast<uint64_t>(p.set) + 1);
    add(p.frame);
    for (double v : {p.width, p.height, p.offsetU, p.offsetV, p.uwFactor}) add(v);
  }
  add(uint64_t{extra.deformed});
  if (!extra.deformed) return;
  const Deformation& d = extra.deformation;
  for (const Affine* a : {&d.near, &d.far}) {
    for (const Vec3* v : {&a->x, &a->y, &a->z, &a->origin}) add(*v);
  }
  add(d.front);
  add(d.top);
}

namespace {

// What is alike but for rounding becomes exactly so: else no two calls would be alike. Coordinates
// go to a grid of a thousand-millionth of a metre, directions to a finer one.
double onGrid(double v, double grid) {
  return std::fabs(v) < 0x1.0p20 ? std::nearbyint(v / grid) * grid : v;
}
Vec3 onGrid(const Vec3& v, double grid) {
  return {onGrid(v.x, grid), onGrid(v.y, grid), onGrid(v.z, grid)};
}
constexpr double kPlaceGrid = 0x1.0p-30, kDirectionGrid = 0x1.0p-40;

Frame withoutNoise(Frame f) {
  f.origin = onGrid(f.origin, kPlaceGrid);
  const auto straight = [](const Vec3& v, size_t axis) {
    return std::fabs(v[axis] - 1) < 1e-12 && std::fabs(v[(axis + 1) % 3]) < 1e-12 &&
           std::fabs(v[(axis + 2) % 3]) < 1e-12;
  };
  return straight(f.x, 0) && straight(f.y, 1) && straight(f.z, 2) ? Frame::moved(f.origin) : f;
}

ShapeExtra localExtra(const ShapeExtra& extra, const Frame& outer) {
  ShapeExtra out = extra;
  for (TrimPlane& t : out.trim) {
    t.distance = onGrid(t.distance - dot(t.normal, outer.origin), kPlaceGrid);
    t.normal = onGrid(outer.toLocalDirection(t.normal), kDirectionGrid);
  }
  const Frame inward = inverse(outer);
  for (UvProjection& p : out.projections) p.frame = withoutNoise(inward * p.frame);
  return out;
}

}  // namespace

ShareKey Machine::keyOf(uint32_t rule, const Activation& call) {
  const RuleCode& code = program_.rules[rule];
  const uint32_t effects = code.reads.effects;
  const Shape& s = call.shape;
  KeyHash h;
  h.add(remembers_ ? shared_.reach[rule].code : uint64_t{rule});
  h.add(uint64_t{s.trimVertical} << 1 | uint64_t{s.trimHorizontal});
  h.add(s.size);
  h.add(uint64_t{s.material} << 32 | s.assetMaterials);
  h.add(uint64_t{s.attributes});
  for (uint32_t p = call.parameters; p < stackTop_; ++p) h.add(stack_[p].hash());
  h.add(contentHash(s.geometry));
  for (uint32_t a : code.reads.attributes) {
    const Value* set = locals_.find(s.locals, a);
    if (!set && s.attributes) set = attributes().find(s.attributes, a);
    h.add((set ? *set : evaluateAttribute(a)).hash());
  }
  if (effects & kReadsSplit) h.add(uint64_t{s.split.index} << 32 | s.split.total);
  if (effects & kReadsComp) {
    h.add(uint64_t{s.comp.index} << 32 | s.comp.total);
    h.add(uint64_t{s.compSelector});
  }
  if (effects & (kReadsPivot | kReadsPivotAxes)) h.add(s.pivot);
  if (s.extra) h.add(*s.extra);
  return h.key();
}

// Puts a shape into the frame of its own scope, dropping what the rule cannot see.
void Machine::localise(Shape& shape, const RuleCode& rule, const Frame& outer) const {
  const uint32_t effects = rule.reads.effects;
  if (effects & (kReadsPivot | kReadsPivotAxes)) {
    shape.pivot = withoutNoise(inverse(outer) * shape.pivot);
    if ((effects & kReadsPivot) == 0) shape.pivot.origin = {};
  } else {
    shape.pivot = Frame{};
  }
  if (shape.extra) {
    // A deformation is told in the scope's own terms, so it comes along as it is.
    const bool seen = shape.extra->deformed || (effects & (kUsesTrim | kReadsUvProjection)) != 0;
    shape.extra = seen ? makeRef<ShapeExtra>(localExtra(*shape.extra, outer)) : Ref<ShapeExtra>();
  }
  shape.scope = Frame{};
}

void Machine::openWorld(const Frame& frame) {
  worlds_.emplace_back();
  const Frame& outer = worlds_.end()[-2];
  Frame& inner = worlds_.back();
  if (outer.turned && !frame.turned) {
    inner = outer;
    inner.origin = outer.point(frame.origin);
  } else {
    inner = outer * frame;
  }
  if (!gathers_.empty()) gatherFrames_.push_back(gatherFrames_.back() * frame);
}

// True when the cache had the result and its instance has been made.
bool Machine::beginShared(const RuleCode& rule, Activation& call) {
  const Frame outer = call.shape.scope;
  localise(call.shape, rule, outer);
  if (flat_) {
    call.boundary = true;
    openWorld(outer);
    return false;
  }
  const ShareKey key = keyOf(call.rule, call);
  if (aborted_) return false;
  const uint32_t* const hit = cache_.find(key);
  uint32_t number = 0;
  if (hit) {
    ++cacheHits_;
    number = *hit;
  }
  if (hit || recallPrototype(key, number)) {
    // The call itself has been counted already.
    tally_.countExpanded(output_.prototypes[number].range.shapes - 1);
    addInstance(outer, number);
    return true;
  }
  call.boundary = true;
  openWorld(outer);
  prototypes_.push_back({output_.mark(), key, tally_.expanded() - 1, outer, call.rule});
  return false;
}

void Machine::endShared() {
  worlds_.pop_back();
  if (!gathers_.empty()) gatherFrames_.pop_back();
  if (!flat_) closeOpenPrototype();
}

// A prototype that a limit cut short is kept, but never given to another call.
void Machine::closeOpenPrototype() {
  const OpenPrototype open = prototypes_.back();
  prototypes_.pop_back();
  const StringId name = program_.rules[open.rule].name;
  const uint32_t number = output_.close(open.mark, name, tally_.expanded() - open.shapesBefore,
                                        aborted_ ? ShareKey{} : open.key);
  if (!aborted_) cache_.emplace(open.key, number);
  addInstance(open.frame, number);
}

void Machine::addInstance(const Frame& frame, uint32_t prototype) {
  const uint32_t base = prototypes_.empty() ? rootMark_.leaves : prototypes_.back().mark.leaves;
  Instance i;
  i.frame = frame;
  i.prototype = prototype;
  i.leavesBefore = static_cast<uint32_t>(output_.openLeaves.size()) - base;
  output_.openInstances.push_back(i);
}

}  // namespace gable
