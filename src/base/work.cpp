// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "base/work.h"

#include <new>
#include <stdexcept>

namespace gable {

const char* const kWorkStopped = "work-stopped";

void giveUp(const char* code, std::string message, std::string hint) {
  throw Unwinding(Status::failure(code, std::move(message), std::move(hint)));
}

namespace detail {

void lookAtLimits(uint64_t bytes) {
  WorkState& state = workState;
  WorkMeter* const meter = state.meter;
  if (!meter) {
    state.left = std::numeric_limits<int64_t>::max();
    return;
  }
  const auto units = static_cast<uint64_t>(kWorkBetweenLooks - state.left);
  state.left = kWorkBetweenLooks;
  if (!meter->look(units, bytes)) throw Unwinding(Status::failure(kWorkStopped, {}));
}

Status statusOfException() {
  const std::string hint = "give it smaller numbers or simpler geometry";
  try {
    throw;
  } catch (const Unwinding& u) {
    return u.why();
  } catch (const std::bad_alloc&) {
    return Status::failure("out-of-memory", "there is not enough memory for it", hint);
  } catch (const std::length_error&) {
    return Status::failure("out-of-memory", "it would take more memory than there is", hint);
  } catch (const std::exception& e) {
    return Status::failure("cannot-be-done", "it cannot be done (" + std::string(e.what()) + ")",
                           hint);
  }
}

}  // namespace detail

}  // namespace gable
