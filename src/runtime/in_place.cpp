// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/in_place.h"

#include "base/hash.h"

namespace gable {

void InPlace::begin(uint32_t rules) {
  frames_.clear();
  previous_.clear();
  around_ = rules;
}

InPlace::Frame& InPlace::open(Kind kind) {
  const uint32_t now = rules();
  Frame& f = frames_.emplace_back();
  f.kind = kind;
  f.rules = now;
  return f;
}

void InPlace::beginRule(Activation& a, const RuleCode& code, uint32_t rule, uint64_t site,
                        const Return& back) {
  Frame& f = open(Kind::Rule);
  ++f.rules;
  f.back = back;
  f.parameters = a.parameters;
  f.rule = a.rule;
  f.path = a.shape.path;
  if (code.needsPrevious) {
    f.keepsPrevious = true;
    f.previous = static_cast<uint32_t>(previous_.size());
    previous_.push_back(a.previous);
    a.keepScope();
  }
  a.shape.path = hashCombine(a.shape.path, site);
  a.rule = rule;
  a.parameters = back.stackBase;
}

InPlace::Return InPlace::endRule(Activation& a) {
  const Frame& f = frames_.back();
  a.shape.path = f.path;
  a.rule = f.rule;
  a.parameters = f.parameters;
  if (f.keepsPrevious) {
    // Activations that ended early may have left theirs above.
    a.previous = previous_[f.previous];
    previous_.resize(f.previous);
  }
  const Return back = f.back;
  frames_.pop_back();
  return back;
}

void InPlace::beginLoop(Shape& s, uint32_t turns, uint64_t site) {
  Frame& f = open(Kind::Loop);
  f.turns = turns;
  f.split = s.split;
  f.path = s.path;
  f.loopPath = hashCombine(s.path, site);
  s.split = {0, turns};
  s.path = hashCombine(f.loopPath, 0);
}

bool InPlace::nextTurn(Shape& s) {
  Frame& f = frames_.back();
  if (++f.turn == f.turns) {
    endLoop(s);
    return false;
  }
  s.split = {f.turn, f.turns};
  s.path = hashCombine(f.loopPath, f.turn);
  return true;
}

void InPlace::endLoop(Shape& s) {
  s.split = frames_.back().split;
  s.path = frames_.back().path;
  frames_.pop_back();
}

void InPlace::beginLocals(const Shape& s) {
  Frame& f = open(Kind::Locals);
  f.locals = s.locals;
  f.localCount = static_cast<uint32_t>(locals_.size());
}

void InPlace::endLocals(Shape& s) {
  s.locals = frames_.back().locals;
  locals_.cut(frames_.back().localCount);
  frames_.pop_back();
}

}  // namespace gable
