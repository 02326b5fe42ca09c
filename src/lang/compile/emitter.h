// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Emitter: appends instructions to a program with their places and random addresses, and keeps the
// tables that instructions name without repetition.
//
// What has no room in an instruction, or on the stack of the machine, is the author's mistake: a
// diagnostic says so once, and the code is not for use.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "program/program.h"

namespace gable::lang {

class Emitter {
 public:
  Emitter(Program& program, Diagnostics& diagnostics) : p_(program), diagnostics_(diagnostics) {}

  uint32_t here() const { return static_cast<uint32_t>(p_.code.size()); }
  uint32_t emit(Code code, Span span, uint32_t a = 0, size_t x = 0, size_t y = 0,
                uint64_t site = 0);
  /// A jump whose target is set later by land().
  uint32_t jump(Code code, Span span) { return emit(code, span); }
  void land(uint32_t jump) { p_.code[jump].a = here(); }

  /// How many values the code so far may have on the stack, at most; what an expression or a part
  /// of a successor leaves there is told by settle().
  size_t depth() const { return depth_; }
  void settle(size_t depth) { depth_ = depth; }

  /// Begins a rule, function or initialiser: sites are counted anew.
  void beginUnit(std::string_view qualifiedName);
  /// The address of the next use of `what` in the unit: its name, the use's ordinal.
  uint64_t site(std::string_view what);

  uint32_t constant(const Value& v);
  /// Consecutive constants; gives the first one's number.
  uint32_t constantRun(const std::vector<Value>& values);
  /// The number of the next call with constant arguments, from 1; 0 when there are too many.
  uint32_t constantCall();
  uint32_t table(std::vector<uint32_t> entries);
  uint32_t operation(const OpSpec* spec, const Signature* form);
  uint32_t function(const FunctionSpec* spec, const Signature* form);
  uint32_t attribute(const AttributeSpec* spec);
  Program& program() { return p_; }

 private:
  void tooLarge(Code code, Span span, size_t x);
  template <class Entry>
  uint32_t numberOf(const void* spec, const Signature* form, Entry entry, std::vector<Entry>& list);

  Program& p_;
  Diagnostics& diagnostics_;
  size_t depth_ = 0;
  bool told_ = false;
  uint64_t unitHash_ = 0;
  std::map<std::string, uint32_t, std::less<>> uses_;
  std::unordered_map<uint64_t, std::vector<uint32_t>> constants_;
  std::map<std::pair<const void*, const Signature*>, uint32_t> specs_;
};

}  // namespace gable::lang
