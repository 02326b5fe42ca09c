// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// AttributeValues: the rule attributes of the initial shape at work. Each is given from outside, or
// evaluated once on that shape at its first use.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostic.h"
#include "program/program.h"

namespace gable {

/// Whether values can be given to an attribute by its name.
bool takesValues(const AttributeCode& a);
/// Whether a value that is given to it is of use for its type: text may be a number or a length.
bool takesValue(const AttributeCode& attribute, const Value& value, const ValuePool& pool);

class AttributeValues {
 public:
  using Given = std::vector<std::pair<std::string, Value>>;

  explicit AttributeValues(size_t count = 0) : slots_(count) {}

  /// Forgets all values.
  void begin();
  /// Takes values by name for the program's attributes. Where one is of no use for its type, the
  /// attribute keeps its initialiser.
  void give(const Given& values, const Program& program, const ValuePool& pool);

  bool isKnown(uint32_t a) const { return slots_[a].state == State::Known; }
  /// Its initialiser is at work.
  bool isBusy(uint32_t a) const { return slots_[a].state == State::Busy; }
  const Value& value(uint32_t a) const { return slots_[a].value; }
  void beginEvaluation(uint32_t a) { slots_[a].state = State::Busy; }
  void set(uint32_t a, const Value& v) { slots_[a] = {v, State::Known}; }
  /// A limit may have struck while it was evaluated.
  void giveUpEvaluation(uint32_t a) {
    if (isBusy(a)) slots_[a].state = State::Unset;
  }
  /// The values that are known by now, for another worker.
  AttributeValues known() const;
  /// By attribute, a hash of the value; 0 where there is none.
  std::vector<uint64_t> hashes() const;

 private:
  enum class State : uint8_t { Unset, Busy, Known };

  struct Slot {
    Value value;
    State state = State::Unset;
  };
  std::vector<Slot> slots_;
};

}  // namespace gable
