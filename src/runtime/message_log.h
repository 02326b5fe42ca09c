// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// MessageLog: what one worker has to tell of the initial shapes that it derives.
//
// The same warning at the same place is told once: not again where the worker told it of an initial
// shape before this one, or in the same unit of work (an initial shape or a portion of one). Of one
// unit no more are told than anybody is shown of all.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "base/diagnostic.h"

namespace gable {

/// Whether a message is told once a place in the rules, whatever it says: it names values, which
/// differ from shape to shape.
inline bool isToldOncePerPlace(std::string_view code) {
  return code == "tint-capped" || code == "split-overflow";
}

class MessageLog {
 public:
  /// Begins a unit of work on an initial shape.
  void beginUnit() { ++unit_; }
  /// `shapePath` is called for what is told alone.
  template <class ShapePath>
  void add(Severity severity, const char* code, const Span& at, std::string message,
           std::string hint, uint32_t initialShape, ShapePath&& shapePath) {
    if (!isNews(code, at, message, initialShape)) return;
    messages_.add({severity, code, at, std::move(message), std::move(hint), shapePath(), {}});
  }
  /// Messages about the input, which no rule has made.
  Diagnostics& input() { return messages_; }

  /// Warnings and notes that came, repetitions counted.
  uint64_t warnings() const { return warnings_; }
  /// Messages that wait to be taken.
  size_t count() const { return messages_.all().size(); }
  /// Those since the last time. What was told before is not told again.
  Diagnostics take() { return std::exchange(messages_, {}); }

 private:
  bool isNews(const char* code, const Span& at, const std::string& message, uint32_t initialShape);

  struct Told {
    uint32_t initialShape;
    uint64_t unit;
  };
  Diagnostics messages_;
  std::unordered_map<uint64_t, Told> told_;
  uint64_t unit_ = 0, warnings_ = 0;
};

}  // namespace gable
