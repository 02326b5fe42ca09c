// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Numbers as text, the same characters on every machine and in every locale, and fast: writers of
// text formats spend most of their time here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace gable {

/// Room that each of the write functions below may need.
constexpr size_t kNumberRoom = 40;

/// The shortest text that reads back as the same double. -0 is written 0, an integer without a
/// point. NaN and the infinities come out as nan, inf and -inf. Returns the end of the text.
char* writeShortest(char* out, double v);
/// The same for a float: the fewest digits that give the float back.
char* writeShortest(char* out, float v);
void appendShortest(std::string& out, double v);
std::string shortestText(double v);

/// Decimal digits of an integer.
char* writeInteger(char* out, uint64_t v);

/// `v` rounded to `decimals` places (0 to 9), half away from zero, without trailing zeros: 1.5, -3,
/// 0. Values that a 53-bit count of units cannot hold fall back to writeShortest.
char* writeFixed(char* out, double v, int decimals);

/// Reads a whole text as a number ("-1.5e3", "+2", ".5"); false when anything else stands there, or
/// when it is NaN or infinite.
bool parseNumber(std::string_view text, double& value);
/// Reads a number at `p`, which ends at or before `end`; returns the first character after it, or
/// `p` when there is none.
const char* readNumber(const char* p, const char* end, double& value);

}  // namespace gable
