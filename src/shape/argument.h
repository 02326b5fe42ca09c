// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Arguments that an operation works out itself: numbers that are drawn anew for each piece,
// selections, and the figures that a block begins with.
//
// Every number is worked out under an address. An expression takes it for the address of the shape,
// so that rand() in it gives another value for each; a plain rand(a, b) is drawn evenly from the
// address itself, and its bounds are known.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "program/arguments.h"
#include "program/program.h"
#include "shape/op_call.h"

namespace gable {

class DrawnNumber {
 public:
  explicit DrawnNumber(double v = 0) : low_(v), high_(v) {}

  double at(uint64_t address) const;
  /// At least and at most, where it is a number or drawn evenly; else what a few draws gave.
  double low() const { return low_; }
  double high() const { return high_; }
  bool isConstant() const { return !code_ && low_ == high_; }
  Unit unit() const { return unit_; }
  /// Null when the bounds say all.
  const ValueCode* code() const { return code_; }

 private:
  friend std::vector<DrawnNumber> numbersOf(const Value&, const Services&, uint64_t, bool*);
  double low_, high_;
  Unit unit_ = Unit::Absolute;
  const ValueCode* code_ = nullptr;
  Services* services_ = nullptr;
};

/// The numbers of a Drawn or a DrawnList; `isList` says whether it was written as one. `address` is
/// for bounds that are expressions.
std::vector<DrawnNumber> numbersOf(const Value& v, const Services& services, uint64_t address,
                                   bool* isList = nullptr);
DrawnNumber numberOf(const Drawn& d, const Services& services, uint64_t address);

/// A term of a selection, worked out; in postfix order.
struct Term {
  ArgumentTerm::Kind kind = ArgumentTerm::Kind::Value;
  /// Term: its name. Its selections, `operands` of them, stand before it.
  std::string_view name;
  uint32_t operands = 0;
  /// Value: one. Term: its other arguments.
  std::vector<Value> values;

  bool is(std::string_view word) const { return kind == ArgumentTerm::Kind::Term && name == word; }
  double number(size_t i, double otherwise = 0) const {
    return i < values.size() ? values[i].number : otherwise;
  }
  std::string_view word(size_t i, const ValuePool& pool) const {
    return i < values.size() ? pool.text(values[i].id) : std::string_view();
  }
};
std::vector<Term> termsOf(const Selection& s, const Services& services, uint64_t address);

/// The figure that a slot begins with, for one piece.
struct DrawnFigure {
  /// Null for none.
  const OpSpec* spec = nullptr;
  const Signature* form = nullptr;
  std::vector<Value> values;
  /// Which of several it is, from 1; 0 when there is nothing to choose.
  uint32_t ordinal = 0;
};
/// Conditions are put to the shape `as`, shares are drawn from the address.
DrawnFigure drawFigure(const OpCall& call, uint32_t slot, uint64_t address, const Shape& as);

}  // namespace gable
