// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A tree as rule text: what conversion from other notations writes. One declaration a line with
// blank lines between rules; format.h lays it out.
//
// Promises, for a tree without Missing nodes, styles and imports:
//  1. The text parses to the same tree, without diagnostics of the parser.
//  2. Equal trees give equal text.
// A choice of a sequence must stand last in it, or in brackets, since its last branch goes on to
// the end of the sequence. Linear in the tree.
#pragma once

#include <string>

#include "lang/tree.h"

namespace gable::lang {

std::string print(const Tree& tree);

}  // namespace gable::lang
