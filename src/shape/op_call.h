// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// OpCall and FunctionCall: what an operation or a function is given when it runs.
//
// An operation edits shape() in place, or gives out child shapes with emit(); it returns a Status.
// On failure it must leave shape() as it was and emit nothing. After an operation that emitted, the
// children run in the order of emission, each on the block slot it was given.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/random.h"
#include "base/status.h"
#include "program/spec.h"
#include "program/value.h"
#include "shape/services.h"
#include "shape/shape.h"

namespace gable {

/// One `size : ops` of a split block, or a group `{ ... }` or `{ ... }*` of more of them.
struct SplitItem {
  double size = 0;
  Unit unit = Unit::Absolute;
  /// The slot to run; unused by groups.
  uint32_t slot = 0;
  bool group = false;
  bool repeat = false;
  /// For a group: how many of the following items (groups counted whole, flattened) are inside.
  uint32_t length = 0;
};

/// The evaluated braces after a split-like operation, flattened in order of writing.
struct SplitBlock {
  std::span<const SplitItem> items;
  /// A * after the closing brace.
  bool repeat = false;
};

/// How a selector item spreads what it selects: `:` one shape each, `=` all in one, `=:` one for
/// each connected set.
enum class SelectOperator : uint8_t { Each, All, Connected };

/// A node of a selector expression, in postfix order within SelectorItem.
struct SelectorTerm {
  enum class Kind : uint8_t { Word, Index, Boolean, Tagged, Not, And, Or } kind = Kind::Word;
  /// Word: the selector's name ("front", "world.south", "remainder"). Tagged: the tag query.
  StringId word = 0;
  /// Index: the component number. Boolean: 0 or 1, evaluated before the operation. Tagged: 0, or
  /// 1 or 2 when the query is put to the component's edges or vertices.
  double number = 0;
};

struct SelectorItem {
  std::span<const SelectorTerm> terms;
  SelectOperator op = SelectOperator::Each;
  uint32_t slot = 0;
};

/// An axis of the scope, for the relative sizes of arguments.
enum class Axis : uint8_t { X, Y, Z };
double component(const Vec3& v, Axis a);

class OpCall {
 public:
  OpCall(const OpSpec& spec, Shape& shape, std::span<const Value> args, Services& services)
      : spec_(spec), shape_(shape), args_(args), services_(services) {}

  const OpSpec& spec() const { return spec_; }
  Shape& shape() { return shape_; }
  /// The scope of the shape below on the shape stack: that of the shape when its rule, its block
  /// slot or its bracket began.
  const Frame& previousScope() const { return *previousScope_; }
  const Vec3& previousSize() const { return *previousSize_; }

  // Arguments. Types have been checked against the signature; text and defaults are the callee's.
  size_t argCount() const { return args_.size(); }
  bool has(size_t i) const { return i < args_.size(); }
  const Value& arg(size_t i) const { return args_[i]; }
  double number(size_t i) const { return args_[i].number; }
  double number(size_t i, double otherwise) const { return has(i) ? args_[i].number : otherwise; }
  /// A number, times `whole` when it was written with '.
  double sized(size_t i, double whole) const {
    return args_[i].unit == Unit::Relative ? args_[i].number * whole : args_[i].number;
  }
  std::string_view text(size_t i) const { return services_.pool().text(args_[i].id); }
  std::string_view text(size_t i, std::string_view otherwise) const {
    return has(i) ? text(i) : otherwise;
  }
  bool is(size_t i, std::string_view word) const { return has(i) && text(i) == word; }
  bool truth(size_t i, bool otherwise) const { return has(i) ? args_[i].truth() : otherwise; }

  // The block.
  const SplitBlock& splitBlock() const { return splitBlock_; }
  std::span<const SelectorItem> selectors() const { return selectors_; }
  /// The number of slots of a block of operations or operands (0 without a block).
  uint32_t slotCount() const { return slotCount_; }

  /// The size that what comes of a slot is meant to have; 0 along an axis for any.
  Vec3 preferredSize(uint32_t slot) const {
    if (slot >= preferredSizes_.size()) return {};
    const std::array<double, 3>& p = preferredSizes_[slot];
    return {p[0], p[1], p[2]};
  }

  /// Gives out a child for a block slot. Its address for randomness is derived from shape().path,
  /// the slot and `piece`, which must differ among children of one slot.
  void emit(Shape child, uint32_t slot, uint32_t piece);
  /// The same for a child that is much like shape(): gives out a copy of it, to be edited in place
  /// before the next one is given out.
  Shape& emitCopy(uint32_t slot, uint32_t piece);
  /// For component splits, which run as a function too: says how many components there are, and
  /// that one of them is in the child given out last.
  void countComponents(size_t count) {
    if (componentChild_) componentChild_->assign(count, kNoChild);
  }
  void placeComponent(size_t component) {
    if (componentChild_)
      (*componentChild_)[component] = static_cast<uint32_t>(children_->size() - 1);
  }
  static constexpr uint32_t kNoChild = 0xffffffff;
  /// Deletes the shape (NIL): nothing after the operation runs.
  void drop() { dropped_ = true; }

  Services& services() const { return services_; }
  const Frame& world() const { return services_.world(); }
  /// The rule file of the instruction, for asset paths.
  std::string_view file() const { return file_; }
  /// The address of the k-th draw of this call.
  uint64_t randomAddress(uint64_t k) const {
    return hashCombine(hashCombine(shape_.path, site_), k);
  }

  Status fail(const char* code, std::string message, std::string hint = {}) const {
    return Status::failure(code, std::move(message), std::move(hint));
  }

  struct Child {
    Shape shape;
    uint32_t slot;
  };

 private:
  friend class OpCallSetup;
  const OpSpec& spec_;
  Shape& shape_;
  std::span<const Value> args_;
  Services& services_;
  const Frame* previousScope_ = nullptr;
  const Vec3* previousSize_ = nullptr;
  SplitBlock splitBlock_;
  std::span<const SelectorItem> selectors_;
  uint32_t slotCount_ = 0;
  std::span<const std::array<double, 3>> preferredSizes_;
  std::vector<Child>* children_ = nullptr;
  std::vector<uint32_t>* componentChild_ = nullptr;
  bool dropped_ = false;
  uint64_t site_ = 0;
  std::string_view file_;
};

/// For the runtime and for tests: fills in what an OpCall cannot get from its constructor.
class OpCallSetup {
 public:
  explicit OpCallSetup(OpCall& call) : call_(call) {}
  void previous(const Frame& scope, const Vec3& size) {
    call_.previousScope_ = &scope;
    call_.previousSize_ = &size;
  }
  void split(const SplitBlock& b) { call_.splitBlock_ = b; }
  void selectors(std::span<const SelectorItem> items) { call_.selectors_ = items; }
  void slots(uint32_t count) { call_.slotCount_ = count; }
  void preferredSizes(std::span<const std::array<double, 3>> sizes) {
    call_.preferredSizes_ = sizes;
  }
  void children(std::vector<OpCall::Child>& out) { call_.children_ = &out; }
  /// For each component the child that it went to, kNoChild for those not selected.
  void componentChildren(std::vector<uint32_t>& out) { call_.componentChild_ = &out; }
  void site(uint64_t site) { call_.site_ = site; }
  void file(std::string_view file) { call_.file_ = file; }
  bool dropped() const { return call_.dropped_; }

 private:
  OpCall& call_;
};

class FunctionCall {
 public:
  FunctionCall(std::span<const Value> args, const Shape& shape, Services& services)
      : args_(args), shape_(shape), services_(services) {}

  const Shape& shape() const { return shape_; }
  size_t argCount() const { return args_.size(); }
  bool has(size_t i) const { return i < args_.size(); }
  const Value& arg(size_t i) const { return args_[i]; }
  double number(size_t i) const { return args_[i].number; }
  double number(size_t i, double otherwise) const { return has(i) ? args_[i].number : otherwise; }
  std::string_view text(size_t i) const { return services_.pool().text(args_[i].id); }
  std::string_view text(size_t i, std::string_view otherwise) const {
    return has(i) ? text(i) : otherwise;
  }
  const Array& array(size_t i) const { return services_.pool().array(args_[i]); }
  Value result(std::string_view text) const { return services_.pool().string(text); }
  Value result(Array a) const { return services_.pool().intern(std::move(a)); }

  Services& services() const { return services_; }
  std::string_view file() const { return file_; }
  uint64_t randomAddress(uint64_t k) const {
    return hashCombine(hashCombine(shape_.path, site_), k);
  }
  /// Reports the author's mistake at this call; the caller then gets the returned value.
  Value fail(const char* code, std::string message, std::string hint, Value otherwise) const;

  void place(std::string_view file, uint64_t site) {
    file_ = file;
    site_ = site;
  }

 private:
  std::span<const Value> args_;
  const Shape& shape_;
  Services& services_;
  std::string_view file_;
  uint64_t site_ = 0;
};

}  // namespace gable
