// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "shape/op_call.h"

#include <algorithm>

#include "base/check_context.h"
#include "base/work.h"
#include "program/program.h"
#include "program/tag_effects.h"
#include "shape/audit.h"

namespace gable {

namespace {

const ArgumentCode* argumentOf(const Value& v, const Services& services) {
  return v.type == ValueType::Code ? &services.program()->arguments[v.id] : nullptr;
}

// Selections name the world in their terms: facing(world.west).
bool namesWorldIn(std::span<const Value> values, const Services& services) {
  return std::any_of(values.begin(), values.end(), [&](const Value& v) {
    const ArgumentCode* const code = argumentOf(v, services);
    return code && std::any_of(code->terms.begin(), code->terms.end(), [](const ArgumentTerm& t) {
             return t.spec && namesWorld(t.spec->name);
           });
  });
}

const char* codeOf(const ArgumentProblem& problem) {
  return problem.kind == ArgumentProblem::Kind::Value ? "bad-argument" : "wrong-argument";
}

// What tells others of itself would tell them twice.
[[maybe_unused]] constexpr uint32_t kTells =
    kReports | kReadsPath | kLabels | kReadsContext | kAsksForRoom;

}  // namespace

// The terms are in postfix order; indices and tags select nothing here.
bool selectsWord(const SelectorItem& item, std::string_view word, const ValuePool& pool) {
  std::vector<bool> stack;
  const auto pop = [&] {
    if (stack.empty()) return false;
    const bool top = stack.back();
    stack.pop_back();
    return top;
  };
  for (const SelectorTerm& t : item.terms) {
    switch (t.kind) {
      case SelectorTerm::Kind::Word: {
        const std::string_view own = pool.text(t.word);
        stack.push_back(own == word || (own == "all" && word != "otherwise"));
        break;
      }
      case SelectorTerm::Kind::Boolean: stack.push_back(t.number != 0); break;
      case SelectorTerm::Kind::Not: stack.push_back(!pop()); break;
      case SelectorTerm::Kind::And:
      case SelectorTerm::Kind::Or: {
        const bool b = pop(), a = pop();
        stack.push_back(t.kind == SelectorTerm::Kind::And ? a && b : a || b);
        break;
      }
      default: stack.push_back(false);
    }
  }
  return pop();
}

double component(const Vec3& v, Axis a) { return v[static_cast<size_t>(a)]; }

void OpCall::emit(Shape child, uint32_t slot, uint32_t piece) {
  work();
  // Empty braces take nothing.
  if (slot >= block_->slotCount) return;
  child.path = hashCombine(hashCombine(shape_.path, place_.site), uint64_t{slot} << 32 | piece);
  // More than any limit on width allows: the runtime will refuse them all.
  constexpr size_t kMost = 1'000'000;
  if (block_->children->size() < kMost) block_->children->push_back({std::move(child), slot});
}

void OpCall::emitParts(Axis axis, bool flatten, std::span<const SplitPiece> pieces,
                       bool repeatable) {
  const GeometryKind kind = shape_.geometry.kind;
  const bool square = (kind == GeometryKind::QuadXy && axis == Axis::Z) ||
                      (kind == GeometryKind::QuadXz && axis == Axis::Y);
  PartPlan plan{axis, square && flatten, static_cast<uint32_t>(pieces.size()), 0,
                hashCombine(shape_.path, place_.site)};
  if (square) {
    // A rectangle lies in the plane 0 of the axis that is square to it.
    while (plan.first < pieces.size() && pieces[plan.first].start != 0) ++plan.first;
    pieces = pieces.subspan(plan.first, plan.first < pieces.size() ? 1 : 0);
  }
  if (block_->pieces) {
    *block_->plan = plan;
    if (SplitMemo* memo = block_->split.memo; memo && repeatable && !square) {
      memo->givenOutOf = kind;
      memo->plan = plan;
    }
    block_->pieces->insert(block_->pieces->end(), pieces.begin(), pieces.end());
    return;
  }
  for (uint32_t i = 0; i < pieces.size(); ++i) {
    BlockChild& child = block_->children->emplace_back();
    child.slot = pieces[i].slot;
    makePart(shape_, plan, pieces[i], plan.first + i, child.shape);
  }
}

Status OpCall::bind(void* arguments) const {
  const ArgumentProblem problem =
      bindArguments(spec_.signatures, place_.form, args_, services_.pool(), arguments);
  if (problem.kind == ArgumentProblem::Kind::None) return {};
  return fail(codeOf(problem), problemText(problem, spec_.name, args_, services_.pool()),
              problemHint(problem));
}

bool OpCall::giveToOtherwise() {
  if (!spec_.part("otherwise")) return false;
  for (const SelectorItem& item : selectors()) {
    if (!selectsWord(item, "otherwise", services_.pool())) continue;
    emit(shape_, item.slot, 0);
    // After an operation with plain parts the shape goes on.
    if (spec_.block == BlockKind::Operations) shape_.geometry = Geometry{};
    return true;
  }
  return false;
}

Status OpCall::orElse(Status failure) { return giveToOtherwise() ? Status() : std::move(failure); }

uint32_t OpCall::effects() const {
  const ValuePool& pool = services_.pool();
  uint32_t all = effectsOfValues(spec_.effects, args_, pool);
  if (namesWorldIn(args_, services_)) all |= effectsOfCall(spec_.effects, true) | kReadsWorld;
  for (const SelectorItem& item : selectors()) {
    for (const SelectorTerm& term : item.terms) {
      if (term.kind == SelectorTerm::Kind::Word && namesWorld(pool.text(term.word)))
        all |= kReadsWorld | kReadsInitialShape;
    }
  }
  return all;
}

Status OpCall::run() {
#if GABLE_DCHECKS
  const Services::Declared declared(services_, effects());
  const CheckContext context(spec_.name);
  if ((spec_.effects & kTells) != 0 || spec_.gathered ||
      !services_.isAuditDue(reinterpret_cast<uintptr_t>(&spec_))) {
    return spec_.apply(*this);
  }
  const Shape before = shape_;
  const size_t children = block_ ? block_->children->size() : 0;
  const size_t pieces = block_ && block_->pieces ? block_->pieces->size() : 0;
  Evaluations evaluations;
  Status status;
  {
    const Services::Recording recording(services_, &evaluations);
    status = spec_.apply(*this);
  }
  OpOutcome outcome{status, shape_, dropped_, {}, {}};
  if (block_) outcome.children = std::span(*block_->children).subspan(children);
  if (block_ && block_->pieces) outcome.pieces = std::span(*block_->pieces).subspan(pieces);
  auditFields(spec_, before, args_, services_, place_, block_, outcome, evaluations);
  return status;
#else
  return spec_.apply(*this);
#endif
}

Status OpCall::runGathered(std::span<Gathered> leaves) {
#if GABLE_DCHECKS
  const Services::Declared declared(services_, effects());
  const CheckContext context(spec_.name);
#endif
  return spec_.gathered(*this, leaves);
}

Value FunctionCall::run(Value (*function)(FunctionCall&), [[maybe_unused]] uint32_t effects) {
#if GABLE_DCHECKS
  uint32_t all = effectsOfValues(effects, args_, services_.pool());
  if (namesWorldIn(args_, services_)) all |= effectsOfCall(effects, true) | kReadsWorld;
  const Services::Declared declared(services_, all);
  const CheckContext context(spec_ ? spec_->name : "an attribute");
  if ((effects & kTells) != 0 || !services_.isAuditDue(reinterpret_cast<uintptr_t>(function))) {
    return function(*this);
  }
  Evaluations evaluations;
  Value first;
  {
    const Services::Recording recording(services_, &evaluations);
    first = function(*this);
  }
  const bool streets = std::ranges::any_of(args_, [&](const Value& v) {
    return v.type == ValueType::Selector && asksForStreets(services_.pool().text(v.id));
  });
  const uint32_t seen = effectsOfFunction(streets ? effects | kReadsTags : effects);
  const Shape other = changedFields(shape_, seen);
  FunctionCall again(args_, other, services_, spec_, form_);
  again.place(file_, site_);
  auditFunction(spec_ ? spec_->name : "an attribute", function, again, first, evaluations);
  return first;
#else
  return function(*this);
#endif
}

Value FunctionCall::zero() const {
  switch (form_ ? form_->result : spec_->signatures[0].result) {
    case ValueType::Float: return Value::of(0.0);
    case ValueType::Bool: return Value::of(false);
    case ValueType::String: return services_.pool().string("");
    default: return {};
  }
}

bool FunctionCall::bind(void* arguments) const {
  const ArgumentProblem problem =
      bindArguments(spec_->signatures, form_, args_, services_.pool(), arguments);
  if (problem.kind == ArgumentProblem::Kind::None) return true;
  // Nothing comes of what failed before, and was told there.
  if (problem.index < args_.size() && args_[problem.index].type == ValueType::Null) return false;
  services_.warn(codeOf(problem), problemText(problem, spec_->name, args_, services_.pool()),
                 problemHint(problem));
  return false;
}

Value FunctionCall::result(std::string_view text) const {
  if (text.size() <= kMaxTextLength) return services_.pool().string(text);
  return fail("text-too-long", "the text would be longer than 16 megabytes", "",
              services_.pool().string(""));
}

Value FunctionCall::result(Array a) const {
  if (a.size() <= kMaxArraySize) return services_.pool().intern(std::move(a));
  Array none;
  none.element = a.element;
  return fail("array-too-large", "the array would have more than 100000 elements", "",
              services_.pool().intern(std::move(none)));
}

Value FunctionCall::fail(const char* code, std::string message, std::string hint,
                         Value otherwise) const {
  services_.warn(code, std::move(message), std::move(hint));
  return otherwise;
}

}  // namespace gable
