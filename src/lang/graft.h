// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Expressions written in the language, as parts of a tree that another notation builds.
#pragma once

#include <string_view>

#include "lang/tree.h"

namespace gable::lang {

/// Parses an expression and adds its nodes, all with that span; kNoNode when it is none.
NodeId graft(Tree& to, std::string_view expression, Span span);

}  // namespace gable::lang
