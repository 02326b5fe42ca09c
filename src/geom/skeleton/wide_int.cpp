// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "geom/skeleton/wide_int.h"

#include <cmath>

namespace gable::skeleton {

namespace {

// The value is the result * 2^exponent with |result| in [0.5, 1), or 0. Only the first 64 bits
// count, so that the conversion rounds once.
double mantissa(const WideInt& v, int& exponent) {
  exponent = 0;
  if (v.is_zero()) return 0;
  const WideInt magnitude = abs(v);
  const unsigned top = msb(magnitude);
  const unsigned drop = top < 64 ? 0 : top - 63;
  const double m =
      std::frexp(static_cast<double>(static_cast<uint64_t>(magnitude >> drop)), &exponent);
  exponent += static_cast<int>(drop);
  return v.sign() < 0 ? -m : m;
}

}  // namespace

double quotient(const WideInt& num, const WideInt& den) {
  int en = 0, ed = 0;
  const double mn = mantissa(num, en), md = mantissa(den, ed);
  return std::ldexp(mn / md, en - ed);
}

// A root in doubles, one step of Newton's method, whose error is half a unit or so, and what is
// left to do in steps of one. The library finds a root bit by bit.
WideInt rootOf(const WideInt& square) {
  if (square.is_zero()) return 0;
  int exponent = 0;
  const double m = mantissa(square, exponent);
  const bool odd = exponent % 2 != 0;
  const double first = std::ldexp(std::sqrt(odd ? 2 * m : m), (exponent - (odd ? 1 : 0)) / 2);
  WideInt root(first);
  root +=
      static_cast<int64_t>(std::llround(static_cast<double>(square - root * root) / (2 * first)));
  while (root * root > square) --root;
  for (WideInt next = root + 1; next * next <= square; ++next) root = next;
  return root;
}

}  // namespace gable::skeleton
