// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "numbers.h"

#include <charconv>
#include <cmath>
#include <cstdio>

bool parseNumber(std::string_view text, const NumberRange& range, double& out) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const char* const end = text.data() + text.size();
  double v = 0;
  const auto read = std::from_chars(text.data(), end, v);
  if (read.ec != std::errc() || read.ptr != end || !std::isfinite(v)) return false;
  if (v < range.least || v > range.most || (range.whole && v != std::floor(v))) return false;
  out = v;
  return true;
}

bool parseNumbers(std::string_view text, char separator, const NumberRange& range, double* out,
                  size_t count) {
  for (size_t i = 0; i < count; ++i) {
    size_t end = 0;
    while (end < text.size() && text[end] != separator && (separator != 'x' || text[end] != 'X')) {
      ++end;
    }
    if ((end < text.size()) != (i + 1 < count)) return false;
    if (!parseNumber(text.substr(0, end), range, out[i])) return false;
    if (end < text.size()) text.remove_prefix(end + 1);
  }
  return true;
}

bool parseExtent(std::string_view text, const NumberRange& range, double out[2]) {
  if (parseNumbers(text, 'x', range, out, 2)) return true;
  if (!parseNumber(text, range, out[0])) return false;
  out[1] = out[0];
  return true;
}

std::string rangeText(const NumberRange& range) {
  const NumberRange any;
  char text[120];
  const char* kind = range.whole ? "a whole number" : "a number";
  if (range.least == any.least && range.most == any.most) return kind;
  if (range.most >= any.most) {
    std::snprintf(text, sizeof text, "%s of %.10g or more", kind, range.least);
  } else {
    std::snprintf(text, sizeof text, "%s from %.10g to %.10g", kind, range.least, range.most);
  }
  return text;
}
