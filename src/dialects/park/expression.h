// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Expressions of conditions and arguments, as nodes of the neutral tree.
#pragma once

#include <string_view>

#include "dialects/gbbg/tree_builder.h"
#include "dialects/park/grammar.h"

namespace gable::park {

/// Reads or, and, comparisons, + - * /, !, brackets, numbers, constants and the names that a region
/// knows of itself (w, h, area, ix, iy, nx, ny, bx, by, mx, my, piece, choice, depth, border), and
/// before all those the parameters of the rule around. A mistake is reported and gives a node that
/// stands for nothing.
lang::NodeId expression(const Grammar& g, const std::vector<std::string>& parameters,
                        std::string_view text, Span span, gbbg::TreeBuilder& builder,
                        Diagnostics& diagnostics);

/// The attribute that a region's own name stands for; null for other names.
const char* attributeOf(std::string_view name);

inline constexpr const char* kExpressionHint =
    "write numbers, constants, w, h, area, ix, iy, nx, ny, bx, by, border";

}  // namespace gable::park
