// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Calls of operations on regions as they were written when selections, figures and options were
// texts, and operations under former names: what to write in their place.
//
//   peel("outer & !W", 1)                          peel(outer && !side(west), 1)
//   place(centre, "circle(2)") { Bed }             place(centre) { circle(2) Bed }
//   grid(2, 2, 2, "romb(3)") { .. }                grid(2, 2, 2) { junction : rhombus(3) .. }
//   romb(3) Plaza                                  rhombus(3) Plaza
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lang/tree.h"

namespace gable::lang {

struct TextEdit {
  uint32_t begin = 0, end = 0;
  std::string text;
};

/// The name that the operation `name` has now; empty where it is no former name.
std::string_view modernOperation(std::string_view name);

/// The operations, and the function, that took texts.
std::span<const std::string_view> oldRegionOperations();

/// Whether a call of an operation on regions, or of region.selects, has texts among its arguments.
bool isOldRegionCall(const Tree& tree, NodeId call);

/// What to change, in the order of the text; empty when it cannot be said exactly.
std::vector<TextEdit> modernRegionCall(const Tree& tree, NodeId call, std::string_view source);

/// The text with all such calls and names rewritten; those that cannot be stay, and are listed.
struct ModernText {
  std::string text;
  std::vector<NodeId> left;
  /// Calls within what others rewrote are still to be rewritten, in the new text.
  bool again = false;
};
ModernText withModernRegions(const Tree& tree, std::string_view source);

}  // namespace gable::lang
