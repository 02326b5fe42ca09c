// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Status: how a geometric operation ended. A failure leaves the shape as it was; the runtime turns
// it into a warning with the rule, the line and the shape's path.
#pragma once

#include <memory>
#include <string>
#include <utility>

namespace gable {

class [[nodiscard]] Status {
 public:
  Status() = default;
  /// `code` is a diagnostic code (a string literal), `message` one sentence, `hint` the remedy.
  static Status failure(const char* code, std::string message, std::string hint = {}) {
    Status s;
    s.failure_ = std::make_shared<Failure>(Failure{code, std::move(message), std::move(hint)});
    return s;
  }

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
  // What went well costs a null pointer.
  std::shared_ptr<const Failure> failure_;
};

}  // namespace gable
