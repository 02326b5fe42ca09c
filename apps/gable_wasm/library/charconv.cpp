// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Numbers as texts over snprintf and strtod of musl, which round rightly. A text of 15 digits (6 of
// a float) holds every shorter one, so the shortest that reads back as the number is among those of
// 15, 16 and 17 digits. Beside a power of two the numbers below lie closer than those above: there
// the next text of as many digits may read back where the nearest does not.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "cxx20.h"

namespace std {
namespace {

/// The number is 0.d1d2d3... times a power of ten.
struct Decimal {
  char digits[24];
  int count = 0;
  int exponent = 0;
};

double readBack(const char* text, double) { return std::strtod(text, nullptr); }
float readBack(const char* text, float) { return std::strtof(text, nullptr); }

template <class T>
bool readsAs(const Decimal& d, T value) {
  char text[48];
  std::snprintf(text, sizeof text, "0.%.*se%d", d.count, d.digits, d.exponent);
  return readBack(text, value) == value;
}

// `value` is positive.
Decimal rounded(double value, int count) {
  char text[48];
  std::snprintf(text, sizeof text, "%.*e", count - 1, value);
  Decimal d;
  const char* p = text;
  for (; *p != 'e'; ++p) {
    if (*p != '.') d.digits[d.count++] = *p;
  }
  d.exponent = std::atoi(p + 1) + 1;
  return d;
}

// The next larger text of as many digits.
bool raise(Decimal& d) {
  for (int i = d.count; i-- > 0;) {
    if (d.digits[i]++ < '9') return true;
    d.digits[i] = '0';
  }
  return false;
}

template <class T>
Decimal shortest(T value) {
  constexpr bool kDouble = sizeof(T) == sizeof(double);
  constexpr int kAlways = kDouble ? 15 : 6, kMost = kDouble ? 17 : 9;
  Decimal d;
  // Numbers below the smallest normal one have fewer digits.
  const bool normal = value >= numeric_limits<T>::min();
  for (int count = normal ? kAlways : 1; count <= kMost; ++count) {
    d = rounded(static_cast<double>(value), count);
    if (readsAs(d, value)) break;
    int unused;
    if (std::frexp(value, &unused) == T(0.5) && raise(d) && readsAs(d, value)) break;
  }
  while (d.count > 1 && d.digits[d.count - 1] == '0') --d.count;
  return d;
}

string scientificText(const Decimal& d) {
  string text(1, d.digits[0]);
  if (d.count > 1) text.append(1, '.').append(d.digits + 1, static_cast<size_t>(d.count - 1));
  char exponent[16];
  std::snprintf(exponent, sizeof exponent, "e%c%02d", d.exponent > 0 ? '+' : '-',
                std::abs(d.exponent - 1));
  return text + exponent;
}

// All digits of a large whole number are written, as printf does.
string fixedText(const Decimal& d, double value) {
  const auto count = static_cast<size_t>(d.count);
  if (d.exponent >= d.count) {
    char text[400];
    std::snprintf(text, sizeof text, "%.0f", value);
    return text;
  }
  if (d.exponent > 0) {
    const auto whole = static_cast<size_t>(d.exponent);
    return string(d.digits, whole) + '.' + string(d.digits + whole, count - whole);
  }
  return "0." + string(static_cast<size_t>(-d.exponent), '0') + string(d.digits, count);
}

to_chars_result put(char* first, char* last, const string& text) {
  if (static_cast<size_t>(last - first) < text.size()) return {last, errc::value_too_large};
  std::memcpy(first, text.data(), text.size());
  return {first + text.size(), errc()};
}

template <class T>
to_chars_result write(char* first, char* last, T value, chars_format format) {
  const string sign = std::signbit(value) ? "-" : "";
  if (std::isnan(value)) return put(first, last, sign + "nan");
  if (std::isinf(value)) return put(first, last, sign + "inf");
  const bool either = format == chars_format::general;
  if (value == 0) {
    return put(first, last, sign + (format == chars_format::scientific ? "0e+00" : "0"));
  }
  const T size = std::fabs(value);
  const Decimal d = shortest(size);
  const string scientific = scientificText(d);
  if (format == chars_format::scientific) return put(first, last, sign + scientific);
  // Of the two the shorter one, else the fixed one; only a text of few digits can be that.
  const string fixed = either && (d.exponent > 40 || d.exponent < -40)
                           ? string()
                           : fixedText(d, static_cast<double>(size));
  const bool isFixed = !either || (!fixed.empty() && fixed.size() <= scientific.size());
  return put(first, last, sign + (isFixed ? fixed : scientific));
}

const char* digitsEnd(const char* p, const char* last) {
  while (p < last && *p >= '0' && *p <= '9') ++p;
  return p;
}

// Where the number that begins at `first` ends; `first` where there is none.
const char* numberEnd(const char* first, const char* last) {
  const char* p = first < last && *first == '-' ? first + 1 : first;
  const char* const begin = p;
  p = digitsEnd(p, last);
  ptrdiff_t digits = p - begin;
  if (p < last && *p == '.') {
    const char* const fraction = p + 1;
    p = digitsEnd(fraction, last);
    digits += p - fraction;
  }
  if (digits == 0) return first;
  if (p < last && (*p == 'e' || *p == 'E')) {
    const char* q = p + 1;
    if (q < last && (*q == '-' || *q == '+')) ++q;
    const char* const end = digitsEnd(q, last);
    if (end > q) return end;
  }
  return p;
}

bool hasDigits(const string& text) {
  for (const char c : text) {
    if (c == 'e' || c == 'E') return false;
    if (c >= '1' && c <= '9') return true;
  }
  return false;
}

}  // namespace

// Without a format the shorter text is written: what `general` stands for in write().
to_chars_result to_chars(char* first, char* last, double value) {
  return write(first, last, value, chars_format::general);
}
to_chars_result to_chars(char* first, char* last, float value) {
  return write(first, last, value, chars_format::general);
}

to_chars_result to_chars(char* first, char* last, double value, chars_format format) {
  return write(first, last, value, format);
}

to_chars_result to_chars(char* first, char* last, double value, chars_format format,
                         int precision) {
  const char* const form = format == chars_format::scientific ? "%.*e"
                           : format == chars_format::fixed    ? "%.*f"
                                                              : "%.*g";
  char text[400];
  std::snprintf(text, sizeof text, form, precision, value);
  return put(first, last, text);
}

from_chars_result from_chars(const char* first, const char* last, double& value) {
  const char* const end = numberEnd(first, last);
  if (end == first) return {first, errc::invalid_argument};
  const string text(first, end);
  const double read = std::strtod(text.c_str(), nullptr);
  if (std::isinf(read) || (read == 0 && hasDigits(text))) {
    return {end, errc::result_out_of_range};
  }
  value = read;
  return {end, errc()};
}

}  // namespace std
