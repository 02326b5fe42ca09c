// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "base/status.h"

namespace gable {

Status Status::failure(const char* code, std::string message, std::string hint) {
  Status s;
  s.failure_ = new Failure{code, std::move(message), std::move(hint)};
  return s;
}

Status::Failure* Status::copyOf(const Failure& failure) { return new Failure(failure); }

void Status::drop(Failure* failure) noexcept { delete failure; }

}  // namespace gable
