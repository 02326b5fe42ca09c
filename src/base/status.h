// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Status: how a geometric operation ended. A failure leaves the shape as it was; the runtime turns
// it into a warning with the rule, the line and the shape's path.
#pragma once

#include <string>
#include <utility>

namespace gable {

class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(const Status& other) : failure_(other.failure_ ? copyOf(*other.failure_) : nullptr) {}
  Status(Status&& other) noexcept : failure_(std::exchange(other.failure_, nullptr)) {}
  Status& operator=(Status other) noexcept {
    std::swap(failure_, other.failure_);
    return *this;
  }
  ~Status() {
    if (failure_) [[unlikely]]
      drop(failure_);
  }
  /// `code` is a diagnostic code (a string literal), `message` one sentence, `hint` the remedy.
  [[gnu::cold]] static Status failure(const char* code, std::string message, std::string hint = {});

  bool ok() const { return !failure_; }
  explicit operator bool() const { return ok(); }
  /// Of a failure: null and empty where all went well.
  const char* code() const { return ok() ? nullptr : failure_->code; }
  std::string message() const { return ok() ? std::string() : failure_->message; }
  std::string hint() const { return ok() ? std::string() : failure_->hint; }

 private:
  struct Failure {
    const char* code;
    std::string message;
    std::string hint;
  };
  // Failing is rare: what it takes lies apart from the code that runs.
  [[gnu::cold]] static Failure* copyOf(const Failure& failure);
  [[gnu::cold]] static void drop(Failure* failure) noexcept;

  // Owned. What went well costs a null pointer.
  Failure* failure_ = nullptr;
};

}  // namespace gable
