// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Result<T>: a value or the reason why there is none. Used where a file or a request can be wrong.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "base/check.h"

namespace gable {

struct Error {
  /// Stable, kebab-case, as in Diagnostic.
  std::string code;
  std::string message;
  std::string hint;
};

template <class T>
class Result {
 public:
  Result(T value) : value_(std::move(value)) {}
  Result(Error error) : error_(std::move(error)) {}

  bool ok() const { return value_.has_value(); }
  explicit operator bool() const { return ok(); }
  T& value() {
    GABLE_CHECK(ok());
    return *value_;
  }
  const T& value() const {
    GABLE_CHECK(ok());
    return *value_;
  }
  T& operator*() { return value(); }
  T* operator->() { return &value(); }
  const Error& error() const { return error_; }

 private:
  std::optional<T> value_;
  Error error_;
};

}  // namespace gable
