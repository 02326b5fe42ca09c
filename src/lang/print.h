// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A tree as rule text: what conversion from other notations writes. One declaration a line with
// blank lines between rules; format.h lays it out.
//
// Promises, for a tree without Missing nodes, styles and imports:
//  1. The text parses to the same tree, without diagnostics of the parser.
//  2. Equal trees and remarks give equal text.
//  3. Remarks stand above the declaration that they belong to, in their order.
// A choice of a sequence must stand last in it, or in brackets, since its last branch goes on to
// the end of the sequence. O(n log n) in declarations.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "lang/tree.h"

namespace gable::lang {

/// A comment of the text that the tree was made of, as a comment of Gable's language; `begin` is
/// its place there.
struct Remark {
  uint32_t begin = 0;
  std::string text;
  /// Something stands before it on its line.
  bool behind = false;
};

/// `remarks` are in the order of their places.
std::string print(const Tree& tree, std::span<const Remark> remarks = {});

}  // namespace gable::lang
