// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// CheckContext: what a thread is at, for the message of a check that fails meanwhile.
#pragma once

namespace gable {

/// Scopes nest; the innermost is told. `name` must outlive it.
class CheckContext {
 public:
  explicit CheckContext(const char* name);
  ~CheckContext();
  CheckContext(const CheckContext&) = delete;
  CheckContext& operator=(const CheckContext&) = delete;

 private:
  const char* const before_;
};

}  // namespace gable
