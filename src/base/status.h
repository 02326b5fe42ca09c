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
  /// `code` is a diagnostic code (a string literal), `message` one sentence, `hint` the remedy.
  static Status failure(const char* code, std::string message, std::string hint = {}) {
    Status s;
    s.code_ = code;
    s.message_ = std::move(message);
    s.hint_ = std::move(hint);
    return s;
  }

  bool ok() const { return code_ == nullptr; }
  explicit operator bool() const { return ok(); }
  const char* code() const { return code_; }
  const std::string& message() const { return message_; }
  const std::string& hint() const { return hint_; }

 private:
  const char* code_ = nullptr;
  std::string message_;
  std::string hint_;
};

}  // namespace gable
