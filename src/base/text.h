// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Small helpers for text: lower case, the nearest known name for "did you mean", lines, and UTF-8.
// All functions are pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace gable {

/// A letter of ASCII in lower case, any other byte as it is; the same in every locale.
constexpr char lowerCase(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; }

/// The text with its letters of ASCII in lower case.
std::string lowerCase(std::string_view text);

/// All pieces, one behind the other.
std::string joined(const std::vector<std::string>& pieces);

/// The same text, but for the case of letters of ASCII.
bool equalButForCase(std::string_view a, std::string_view b);

/// Changes (insert, delete, replace, swap of neighbours) that lead from `a` to `b`; stops counting
/// at `limit` + 1. Optimal string alignment, O(|a| |b|), case counts.
size_t editDistance(std::string_view a, std::string_view b, size_t limit);

/// The candidate nearest to `name`, if near enough to be a slip: about one change in three letters.
/// A name that differs in case only is always near. Equal distances: the first candidate wins.
std::string nearestName(std::string_view name, const std::vector<std::string_view>& candidates);

/// "did you mean 'x'?" for a non-empty nearest name, else empty.
std::string didYouMean(std::string_view name, const std::vector<std::string_view>& candidates);

/// Takes the next line from the front of `rest`, without its end; false where nothing is left.
bool takeLine(std::string_view& rest, std::string_view& line);

/// Length in bytes of the UTF-8 sequence at `text[at]`; 0 if it is not a valid one.
size_t utf8Length(std::string_view text, size_t at);

/// Appends the code point in UTF-8; a surrogate or a value beyond 0x10ffff becomes U+FFFD.
void appendUtf8(std::string& out, uint32_t codePoint);

}  // namespace gable
