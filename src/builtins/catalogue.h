// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The catalogue of everything that is built in, sorted by name. Made at the first call; any thread
// may ask.
#pragma once

#include "program/spec.h"

namespace gable {

const Catalogue& builtinCatalogue();

}  // namespace gable
