// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Grammar to neutral tree: each rule becomes a rule of Gable's language, each Operator one of its
// operations.
//
// Frames. GBBG's frame is left-handed, Gable's right-handed: the world is mirrored, z -> -z. A
// scope keeps its box and its x and y axes; its z axis is turned round, so that its origin, which
// is the root in GBBG, lies at the other end of z. So a width counted from the root along Z counts
// from the far end here, angles about x and y change their sign, and what GBBG leaves in place at
// the root stays in place at the scope's front.
#pragma once

#include "dialects/gbbg/check.h"
#include "dialects/gbbg/grammar.h"
#include "lang/tree.h"
#include "program/spec.h"

namespace gable::gbbg {

/// `size` is the length of the file's text.
lang::Tree lower(const Grammar& grammar, Vocabulary& vocabulary, const Catalogue& catalogue,
                 uint32_t file, uint32_t size);

}  // namespace gable::gbbg
