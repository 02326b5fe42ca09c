// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Expressions written in the language, as parts of a tree that another notation builds.
#pragma once

#include <functional>
#include <string_view>

#include "lang/tree.h"

namespace gable::lang {

/// Parses an expression and adds its nodes; kNoNode when it is none. `place` says where a word or a
/// number of it stands in the other notation's text, or gives `span` back for what is not written
/// there.
NodeId graft(Tree& to, std::string_view expression, Span span,
             const std::function<Span(std::string_view)>& place);

}  // namespace gable::lang
