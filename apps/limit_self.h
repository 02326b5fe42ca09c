// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// For programs that read broken or hostile files for gable, in a process of their own: what the
// process may use. It reads a pipe and writes one; a pipe is no file, and no file is written.
#pragma once

#include <sys/resource.h>

struct OwnLimits {
  rlim_t bytes = 0;
  rlim_t seconds = 0;
};

inline void limitSelf(const OwnLimits& own) {
  const auto limit = [](int what, rlim_t most) {
    const rlimit l{most, most};
    setrlimit(static_cast<__rlimit_resource>(what), &l);
  };
  limit(RLIMIT_AS, own.bytes);
  limit(RLIMIT_CPU, own.seconds);
  limit(RLIMIT_FSIZE, 0);
  limit(RLIMIT_CORE, 0);
}
