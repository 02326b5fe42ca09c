// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The words that select components, with one sentence each.
#pragma once

#include <span>

#include "program/spec.h"

namespace gable {

extern const std::span<const SelectorSpec> kSelectors;

}  // namespace gable
