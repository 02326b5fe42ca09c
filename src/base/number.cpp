// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Shortest texts come from std::to_chars, whose result is fixed by the standard. Fixed-point texts
// are integers of 10^-decimals, written two digits at a time from a table; numbers of up to 19
// significant digits are read back with integer arithmetic where that is exact (Clinger 1990: both
// the digits and the power of ten fit a double), else by std::from_chars.
#include "base/number.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>

namespace gable {
namespace {

constexpr std::array<double, 23> kPowers = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                            1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                            1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
constexpr std::array<uint32_t, 10> kIntegerPowers = {
    1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000, 1000000000};

struct DigitPairs {
  char text[200];
  constexpr DigitPairs() : text() {
    for (int i = 0; i < 100; ++i) {
      text[2 * i] = static_cast<char>('0' + i / 10);
      text[2 * i + 1] = static_cast<char>('0' + i % 10);
    }
  }
};
constexpr DigitPairs kPairs;

int digitCount(uint64_t v) {
  int n = 1;
  for (;;) {
    if (v < 10) return n;
    if (v < 100) return n + 1;
    if (v < 1000) return n + 2;
    if (v < 10000) return n + 3;
    v /= 10000;
    n += 4;
  }
}

// Writes exactly `count` digits of v ending before `end`.
void writeDigits(char* end, uint64_t v, int count) {
  while (count >= 2) {
    const uint64_t rest = v / 100;
    std::memcpy(end - 2, kPairs.text + 2 * (v - rest * 100), 2);
    v = rest;
    end -= 2;
    count -= 2;
  }
  if (count == 1) end[-1] = static_cast<char>('0' + v % 10);
}

template <class T>
char* writeShortestOf(char* out, T v) {
  if (v == 0) v = 0;
  return std::to_chars(out, out + kNumberRoom, v).ptr;
}

bool isDigit(char c) { return c >= '0' && c <= '9'; }

// Whether a well-formed number has its first digit other than 0 behind the decimal point.
bool isTiny(const char* p, const char* end) {
  int64_t place = 0, first = 0;
  bool point = false, found = false;
  for (; p < end && *p != 'e' && *p != 'E'; ++p) {
    if (*p == '.') {
      point = true;
    } else {
      if (point) --place;
      if (!point && found) ++first;
      if (*p != '0' && !found) {
        found = true;
        first = place;
      }
    }
  }
  int64_t exponent = 0;
  bool negative = false;
  for (; p < end; ++p) {
    if (*p == '-') negative = true;
    if (isDigit(*p) && exponent < 1'000'000'000) exponent = exponent * 10 + (*p - '0');
  }
  return first + (negative ? -exponent : exponent) < 0;
}

}  // namespace

char* writeShortest(char* out, double v) { return writeShortestOf(out, v); }
char* writeShortest(char* out, float v) { return writeShortestOf(out, v); }

void appendShortest(std::string& out, double v) {
  char text[kNumberRoom];
  out.append(text, writeShortest(text, v));
}

std::string shortestText(double v) {
  char text[kNumberRoom];
  return {text, writeShortest(text, v)};
}

char* writeInteger(char* out, uint64_t v) {
  if (v < 10) {
    *out = static_cast<char>('0' + v);
    return out + 1;
  }
  const int n = digitCount(v);
  writeDigits(out + n, v, n);
  return out + n;
}

char* writeFixed(char* out, double v, int decimals) {
  const double units = std::fabs(v) * kPowers[static_cast<size_t>(decimals)];
  if (!(units < 9e15)) return writeShortest(out, v);
  const auto scaled = static_cast<uint64_t>(units + 0.5);
  if (scaled == 0) {
    *out = '0';
    return out + 1;
  }
  if (v < 0) *out++ = '-';
  const uint32_t power = kIntegerPowers[static_cast<size_t>(decimals)];
  const uint64_t whole = scaled / power;
  auto part = static_cast<uint32_t>(scaled - whole * power);
  out = writeInteger(out, whole);
  if (part == 0) return out;
  *out++ = '.';
  writeDigits(out + decimals, part, decimals);
  out += decimals;
  while (out[-1] == '0') --out;
  return out;
}

const char* readNumber(const char* p, const char* end, double& value) {
  const char* start = p;
  bool negative = false;
  if (p < end && (*p == '-' || *p == '+')) negative = *p++ == '-';
  const char* digits = p;
  uint64_t mantissa = 0;
  int count = 0, shift = 0;
  for (; p < end && isDigit(*p); ++p) {
    if (count < 19) mantissa = mantissa * 10 + static_cast<uint64_t>(*p - '0');
    if (mantissa) ++count;
  }
  bool any = p > digits;
  if (p < end && *p == '.') {
    const char* fraction = ++p;
    for (; p < end && isDigit(*p); ++p) {
      if (count < 19) {
        mantissa = mantissa * 10 + static_cast<uint64_t>(*p - '0');
        --shift;
      }
      if (mantissa) ++count;
    }
    any = any || p > fraction;
  }
  if (!any) return start;
  const bool hasExponent = [&] {
    if (p >= end || (*p != 'e' && *p != 'E')) return false;
    const char* q = p + 1;
    if (q < end && (*q == '-' || *q == '+')) ++q;
    return q < end && isDigit(*q);
  }();
  if (!hasExponent && count <= 19 && mantissa <= (1ULL << 53) && shift >= -22) {
    const double v = static_cast<double>(mantissa) / kPowers[static_cast<size_t>(-shift)];
    value = negative ? -v : v;
    return p;
  }
  double v = 0;
  const auto [after, error] = std::from_chars(digits, end, v);
  if (after == digits) return start;
  // Out of range, but a number still: too small is zero, too large is infinite.
  if (error == std::errc::result_out_of_range) v = isTiny(digits, after) ? 0 : HUGE_VAL;
  value = negative ? -v : v;
  return after;
}

bool parseNumber(std::string_view text, double& value) {
  const char* end = text.data() + text.size();
  double v = 0;
  if (text.empty() || readNumber(text.data(), end, v) != end || !std::isfinite(v)) return false;
  value = v;
  return true;
}

}  // namespace gable
