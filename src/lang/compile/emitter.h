// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Emitter: appends instructions to a program with their places and random addresses, and keeps the
// tables that instructions name without repetition.
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
  explicit Emitter(Program& program) : p_(program) {}

  uint32_t here() const { return static_cast<uint32_t>(p_.code.size()); }
  uint32_t emit(Code code, Span span, uint32_t a = 0, uint8_t x = 0, uint16_t y = 0,
                uint64_t site = 0);
  /// A jump whose target is set later by land().
  uint32_t jump(Code code, Span span) { return emit(code, span); }
  void land(uint32_t jump) { p_.code[jump].a = here(); }

  /// Begins a rule, function or initialiser: sites are counted anew.
  void beginUnit(std::string_view qualifiedName);
  /// The address of the next use of `what` in the unit: its name, the use's ordinal.
  uint64_t site(std::string_view what);

  uint32_t constant(const Value& v);
  /// Consecutive constants; gives the first one's number.
  uint32_t constantRun(const std::vector<Value>& values);
  uint32_t table(std::vector<uint32_t> entries);
  uint32_t operation(const OpSpec* spec, const Signature* form);
  uint32_t function(const FunctionSpec* spec, const Signature* form);
  uint32_t attribute(const AttributeSpec* spec);
  Program& program() { return p_; }

 private:
  template <class Entry>
  uint32_t numberOf(const void* spec, const Signature* form, Entry entry, std::vector<Entry>& list);

  Program& p_;
  uint64_t unitHash_ = 0;
  std::map<std::string, uint32_t, std::less<>> uses_;
  std::unordered_map<uint64_t, std::vector<uint32_t>> constants_;
  std::map<std::pair<const void*, const Signature*>, uint32_t> specs_;
};

}  // namespace gable::lang
