// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A grammar of the web language as a neutral tree:
//
//   rule            Name(p0, p1) --> local(a = p0, b = p1, v = v) { repeat(n) { ... } }
//   variants        a choice in percent
//   rule call       a plain call: what the rule does to its copy of the place ends with it
//   R v ( a b )     set(v, rand(a, b)), v being an attribute
//   ?( c ) a : b    repeat(1) { case c : a else : b }
//   T S A           affineMove, affineScale, affineTurn
//   DSX ... DTZ     attributes that affineSidedBox takes
//   GDSX ... GDTZ   affineTogether([...], [...]) { the rest of the bracket }
//   I               affineBox or affineSidedBox, and a move where the body reaches along an axis
//
// Variables are attributes, so all that a rule calls sees them.
#pragma once

#include "dialects/progen3d/lower.h"
#include "dialects/progen3d/web_grammar.h"

namespace gable::progen3d::web {

lang::Tree lower(const Grammar& grammar, uint32_t file, const Catalogue& catalogue,
                 const FileExists& exists, Diagnostics& diagnostics);

}  // namespace gable::progen3d::web
