// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "memory.h"

#ifdef GABLE_WITH_MIMALLOC
#include <mimalloc.h>
#endif

void useLargePages() {
#ifdef GABLE_WITH_MIMALLOC
  mi_option_set_enabled_default(mi_option_large_os_pages, true);
#endif
}

void keepMemory() {
#ifdef GABLE_WITH_MIMALLOC
  mi_option_set_enabled_default(mi_option_allow_decommit, false);
#endif
}
