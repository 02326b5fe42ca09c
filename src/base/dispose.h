// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Frees what is large while nobody waits: millions of small blocks take tenths of a second, which
// who has stopped the work need not see. A process that ends meanwhile does not wait either.
#pragma once

#include <new>
#include <thread>
#include <utility>

namespace gable {

/// Destroys the value on a thread of its own; here, where the machine gives no thread or no memory.
/// The destructor must be good at any time, also when those of static objects have run.
template <class T>
void disposeLater(T value) noexcept {
  T* const held = new (std::nothrow) T(std::move(value));
  if (!held) return;
  try {
    std::thread([held] { delete held; }).detach();
  } catch (...) {
    delete held;
  }
}

}  // namespace gable
