// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "base/interned.h"

#include "base/work.h"

namespace gable {

const char* const kTableFull = "too-many-values";

void tableIsFull() {
  giveUp(kTableFull, "there are more different values than can be kept",
         "give shapes fewer different materials, tags, texts, lists or attributes");
}

}  // namespace gable
