// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Canonical form of the notations in which an author's lines are kept: only blanks change, so that
// every comment stays where it stands.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace gable {

enum class SignSpacing : uint8_t {
  /// Blanks between signs mean something: runs of them become one, and none is added or removed.
  AsWritten,
  /// One blank around '->' and '|', and behind ',' and none before it.
  Even,
};

/// Lines without blanks at their ends; at most one empty line in a row; one '\n' at the end, unless
/// the text is empty. What stands in brackets is two blanks deeper than the line that opens them,
/// and an indented line outside of brackets has two. Comments and "..." stay as they are. Laying
/// out twice gives what once gives. Linear in the text.
std::string withLaidOutLines(std::string_view text, SignSpacing spacing);

}  // namespace gable
