// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/usage.h"

#include "base/memory.h"
#include "runtime/derive.h"

namespace gable {

Usage::Usage(const Limits& limits, const std::atomic<bool>* cancel)
    : limits_(limits),
      cancel_(cancel),
      start_(std::chrono::steady_clock::now()),
      bytesBefore_(residentBytes()) {}

bool Usage::cancelled() const { return cancel_ && cancel_->load(std::memory_order_relaxed); }

void Usage::startAgain() {
  for (std::atomic<uint64_t>* count : {&shapes_, &steps_, &vertices_, &turns_}) *count = 0;
  exhausted_ = byCount_ = false;
}

Usage::Excess Usage::exceed(const char* code, std::string message, std::string hint) {
  exhaust();
  return {code, std::move(message), std::move(hint)};
}

Usage::Excess Usage::exceedCount(const char* code, std::string message, std::string hint) {
  byCount_.store(true, std::memory_order_relaxed);
  return exceed(code, std::move(message), std::move(hint));
}

std::optional<Usage::Excess> Usage::spend(const Use& use) {
  const auto add = [](std::atomic<uint64_t>& total, uint64_t more) {
    return more == 0 ? total.load(std::memory_order_relaxed)
                     : total.fetch_add(more, std::memory_order_relaxed) + more;
  };
  const uint64_t shapes = add(shapes_, use.shapes), steps = add(steps_, use.steps);
  const uint64_t vertices = add(vertices_, use.vertices), turns = add(turns_, use.turns);
  if (shapes > limits_.shapes) {
    return exceedCount("too-many-shapes",
                       "the rules make more than " + std::to_string(limits_.shapes) + " shapes",
                       "end a recursion earlier, or raise the limit on shapes (--max-shapes)");
  }
  if (turns > limits_.shapes) {
    return exceedCount(
        "too-many-turns",
        "the rules run more than " + std::to_string(limits_.shapes) + " rules and turns in place",
        "repeat less often, or raise the limit on shapes (--max-shapes)");
  }
  if (vertices > limits_.vertices) {
    return exceedCount(
        "too-many-vertices",
        "the leaves have more than " + std::to_string(limits_.vertices) + " vertices",
        "insert simpler models, or raise the limit on vertices (--max-vertices)");
  }
  if (steps > limits_.steps) {
    return exceedCount("too-many-steps",
                       "the derivation takes more than " + std::to_string(limits_.steps) + " steps",
                       "end a recursion earlier, or raise the limit on steps (--max-steps)");
  }
  return lookAtClock();
}

std::optional<Usage::Excess> Usage::lookAtClock() {
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
  if (limits_.seconds && spent.count() > *limits_.seconds) {
    return exceed("out-of-time",
                  "the derivation takes longer than " + numberText(*limits_.seconds) + " seconds",
                  "raise the limit on seconds (--max-seconds), or derive fewer shapes");
  }
  return {};
}

std::optional<Usage::Excess> Usage::lookAtMemory(uint64_t bytes) {
  if (!limits_.bytes) return {};
  const uint64_t held = residentBytes(), most = bytesBefore_ + *limits_.bytes;
  if (held <= most && bytes <= most - held) return {};
  return exceed(
      "out-of-memory",
      "the derivation takes more than " + std::to_string(*limits_.bytes >> 20) + " megabytes",
      "raise the limit on memory (--max-memory), or derive fewer shapes");
}

Usage::Excess Usage::tablesAreFull() {
  return exceed("too-many-values",
                "the rules make more different materials, tags, texts, lists or values of "
                "attributes than can be kept",
                "give shapes fewer different ones, or derive fewer shapes at once");
}

}  // namespace gable
