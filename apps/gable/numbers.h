// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Numbers of the command line. All options read them here, so all take the same and refuse the
// same: digits with a point and perhaps an exponent, within the range that the option has. Neither
// 1,5 nor 0x10, nan nor inf is such a number.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

struct NumberRange {
  double least = -1e12;
  double most = 1e12;
  /// No digits behind a point.
  bool whole = false;
};

bool parseNumber(std::string_view text, const NumberRange& range, double& out);
/// `count` numbers with `separator` between them: "30x40", "1,2,3". An X separates as an x does.
bool parseNumbers(std::string_view text, char separator, const NumberRange& range, double* out,
                  size_t count);
/// Width and depth or height with an x between them, "30x40"; one number is a square.
bool parseExtent(std::string_view text, const NumberRange& range, double out[2]);
/// "a number from 1 to 65536".
std::string rangeText(const NumberRange& range);
