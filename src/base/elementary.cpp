// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// All of it is computed with numbers of two doubles, whose sum has about 105 bits: T. J. Dekker, "A
// floating-point technique for extending the available precision", 1971. Series are Taylor's; their
// small terms are added up in plain doubles, since the error of those lies below 2^-75 of the
// result. The exponential is reduced to an argument below 2^-9 and squared back; the logarithm and
// the arcs start from a plain estimate, to which one step of Newton's method adds the other half.
// The file is compiled without contraction to fused operations, as all others are.

#include "base/elementary.h"

#include <cmath>
#include <cstddef>
#include <limits>

namespace gable {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// The exact value is hi + lo, and hi is that rounded to nearest.
struct Wide {
  double hi = 0, lo = 0;
};

constexpr Wide kPi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
constexpr Wide kHalfPi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
/// ln 2 in a part of 40 bits, so that a multiple of it is exact, and the rest.
constexpr double kLn2High = 0x1.62e42fefa2000p-1;
constexpr Wide kLn2Low{0x1.9ef35793c7673p-41, 0x1.f97b57a079a19p-103};
constexpr Wide kOneOverLn10{0x1.bcb7b1526e50ep-2, 0x1.95355baaafad3p-57};

/// 1 / n!
constexpr Wide kInverseFactorials[] = {{1, 0},
                                       {1, 0},
                                       {0x1p-1, 0},
                                       {0x1.5555555555555p-3, 0x1.5555555555555p-57},
                                       {0x1.5555555555555p-5, 0x1.5555555555555p-59},
                                       {0x1.1111111111111p-7, 0x1.1111111111111p-63},
                                       {0x1.6c16c16c16c17p-10, -0x1.f49f49f49f49fp-65},
                                       {0x1.a01a01a01a01ap-13, 0x1.a01a01a01a01ap-73},
                                       {0x1.a01a01a01a01ap-16, 0x1.a01a01a01a01ap-76},
                                       {0x1.71de3a556c734p-19, -0x1.c154f8ddc6c00p-73},
                                       {0x1.27e4fb7789f5cp-22, 0x1.cbbc05b4fa99ap-76},
                                       {0x1.ae64567f544e4p-26, -0x1.c062e06d1f209p-80},
                                       {0x1.1eed8eff8d898p-29, -0x1.2aec959e14c06p-83},
                                       {0x1.6124613a86d09p-33, 0x1.f28e0cc748ebep-87},
                                       {0x1.93974a8c07c9dp-37, 0x1.05d6f8a2efd1fp-92},
                                       {0x1.ae7f3e733b81fp-41, 0x1.1d8656b0ee8cbp-97},
                                       {0x1.ae7f3e733b81fp-45, 0x1.1d8656b0ee8cbp-101},
                                       {0x1.952c77030ad4ap-49, 0x1.ac981465ddc6cp-103},
                                       {0x1.6827863b97d97p-53, 0x1.eec01221a8b0bp-107},
                                       {0x1.2f49b46814157p-57, 0x1.2650f61dbdcb4p-112},
                                       {0x1.e542ba4020225p-62, 0x1.ea72b4afe3c2fp-120},
                                       {0x1.71b8ef6dcf572p-66, -0x1.d043ae40c4647p-120},
                                       {0x1.0ce396db7f853p-70, -0x1.aebcdbd20331cp-124},
                                       {0x1.761b41316381ap-75, -0x1.3423c7d91404fp-130}};

/// The sum, exactly.
Wide twoSum(double a, double b) {
  const double sum = a + b, other = sum - a;
  return {sum, (a - (sum - other)) + (b - other)};
}

/// The same where |a| is not below |b|.
Wide fastTwoSum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// The product, exactly, short of overflow.
Wide twoProduct(double a, double b) {
  constexpr double kSplit = 0x1p27 + 1;
  const double product = a * b;
  const double a1 = kSplit * a, aHigh = a1 - (a1 - a), aLow = a - aHigh;
  const double b1 = kSplit * b, bHigh = b1 - (b1 - b), bLow = b - bHigh;
  return {product, ((aHigh * bHigh - product) + aHigh * bLow + aLow * bHigh) + aLow * bLow};
}

Wide operator-(const Wide& a) { return {-a.hi, -a.lo}; }

Wide operator+(const Wide& a, const Wide& b) {
  const Wide high = twoSum(a.hi, b.hi), low = twoSum(a.lo, b.lo);
  const Wide sum = fastTwoSum(high.hi, high.lo + low.hi);
  return fastTwoSum(sum.hi, sum.lo + low.lo);
}

Wide operator+(const Wide& a, double b) {
  const Wide sum = twoSum(a.hi, b);
  return fastTwoSum(sum.hi, sum.lo + a.lo);
}

Wide operator*(const Wide& a, const Wide& b) {
  const Wide product = twoProduct(a.hi, b.hi);
  return fastTwoSum(product.hi, product.lo + (a.hi * b.lo + a.lo * b.hi));
}

Wide operator*(const Wide& a, double b) {
  const Wide product = twoProduct(a.hi, b);
  return fastTwoSum(product.hi, product.lo + a.lo * b);
}

Wide operator/(const Wide& a, const Wide& b) {
  const double first = a.hi / b.hi;
  const Wide rest = a + -(b * first);
  const double second = rest.hi / b.hi;
  const Wide more = rest + -(b * second);
  return fastTwoSum(first, second) + more.hi / b.hi;
}

Wide squareRoot(const Wide& a) {
  if (a.hi <= 0) return {};
  const double root = std::sqrt(a.hi);
  const Wide rest = a + -twoProduct(root, root);
  return fastTwoSum(root, rest.hi / (2 * root));
}

/// The sum of x^(2 k) / (first + 2 k)! with alternating signs, with eleven or so terms: half of
/// them in full.
Wide alternating(const Wide& square, size_t first) {
  double small = 0;
  for (size_t n = first + 20; n > first + 12; n -= 2) {
    small = kInverseFactorials[n].hi - square.hi * small;
  }
  Wide sum{small, 0};
  for (size_t n = first + 12;; n -= 2) {
    sum = kInverseFactorials[n] + -(square * sum);
    if (n == first) return sum;
  }
}

Wide sinWide(double x) { return alternating(twoProduct(x, x), 1) * x; }
Wide cosWide(double x) { return alternating(twoProduct(x, x), 0); }

/// Most results can be had for a quarter of the work: with the first terms of a series as a Wide
/// and the small rest as a double. `error` bounds what that leaves out. True where it cannot change
/// how the sum is rounded (A. Ziv, "Fast evaluation of elementary mathematical functions with
/// correctly rounded last bit", 1991).
bool isRounded(const Wide& sum, double error) {
  return sum.hi + (sum.lo + error) == sum.hi && sum.hi + (sum.lo - error) == sum.hi;
}

/// A bound on the error of a sum in plain doubles, for each unit of the sum.
constexpr double kPlainError = 0x1p-49;

/// The sum of square^k / (first + 2 k)! with alternating signs from k = 0, as a double; the square
/// is at most 0.62.
double plainAlternating(double square, size_t first) {
  double sum = 0;
  for (size_t n = first + 14;; n -= 2) {
    sum = kInverseFactorials[n].hi - square * sum;
    if (n == first) return sum;
  }
}

/// A value that is off by `error` at most.
struct Bounded {
  Wide value;
  double error = 0;

  bool isRounded() const { return gable::isRounded(value, error); }
};

/// Of radians in [-pi/4, pi/4].
Bounded sinBounded(double radians) {
  const Wide square = twoProduct(radians, radians);
  const double rest = square.hi * square.hi * plainAlternating(square.hi, 5);
  const Wide less = (-(kInverseFactorials[3] * square) + rest) * radians;
  const Wide sum = fastTwoSum(radians, less.hi);
  return {fastTwoSum(sum.hi, sum.lo + less.lo), std::fabs(rest * radians) * kPlainError};
}

Bounded cosBounded(double radians) {
  const Wide square = twoProduct(radians, radians);
  const double rest = square.hi * square.hi * square.hi * plainAlternating(square.hi, 6);
  const Wide terms = kInverseFactorials[4] * (square * square) + -rest;
  return {Wide{-square.hi / 2, -square.lo / 2} + terms + 1.0, rest * kPlainError + 0x1p-90};
}

/// e^x as a number times 2^power; |x| below 800.
Wide expWide(const Wide& x, int& power) {
  const double turns = std::floor(x.hi / kLn2High + 0.5);
  power = static_cast<int>(turns);
  constexpr int kSquarings = 8;
  const Wide reduced = (x + -turns * kLn2High) + kLn2Low * -turns;
  const Wide r{std::ldexp(reduced.hi, -kSquarings), std::ldexp(reduced.lo, -kSquarings)};
  double small = 0;
  for (size_t n = 10; n >= 7; --n) small = kInverseFactorials[n].hi + r.hi * small;
  Wide sum{small, 0};
  for (size_t n = 6; n >= 1; --n) sum = kInverseFactorials[n] + r * sum;
  // e^r - 1 keeps its digits where 1 would swallow them.
  Wide less = sum * r;
  for (int i = 0; i < kSquarings; ++i) less = Wide{2 * less.hi, 2 * less.lo} + less * less;
  return less + 1.0;
}

double scaled(const Wide& value, int power) { return std::ldexp(value.hi, power); }

/// ln m for m in [sqrt(1/2), sqrt(2)].
Wide logNearOne(double m) {
  const Wide s = Wide{m - 1, 0} / twoSum(m, 1);
  const Wide square = s * s;
  if (std::fabs(m - 1) < 0x1p-4) {
    constexpr Wide kThird{0x1.5555555555555p-2, 0x1.5555555555555p-56};
    constexpr Wide kFifth{0x1.999999999999ap-3, -0x1.999999999999ap-57};
    double small = 0;
    for (int n = 19; n >= 7; n -= 2) small = 1.0 / n + square.hi * small;
    const Wide sum = kThird + square * (kFifth + square * small);
    return Wide{2 * s.hi, 2 * s.lo} * (square * sum + 1.0);
  }
  double series = 0;
  for (int n = 27; n >= 1; n -= 2) series = 1.0 / n + square.hi * series;
  const double estimate = 2 * s.hi * series;
  int power = 0;
  const Wide inverse = expWide({-estimate, 0}, power);
  const Wide product = Wide{scaled(inverse, power), std::ldexp(inverse.lo, power)} * m;
  const Wide rest = product + -1.0;
  return twoSum(estimate, rest.hi - rest.hi * rest.hi / 2) + rest.lo;
}

/// ln v of a finite v above 0.
Wide logWide(double v) {
  int power = 0;
  double m = std::frexp(v, &power);
  if (m < 0x1.6a09e667f3bcdp-1) {
    m *= 2;
    --power;
  }
  const Wide log = logNearOne(m);
  if (power == 0) return log;
  return (kLn2Low * power + log) + power * kLn2High;
}

/// About the arc whose tangent is t, for t in [0, 1].
double arcEstimate(double t) {
  const bool upper = t > 0.4142135623730950;
  const double u = upper ? (t - 1) / (t + 1) : t;
  double series = 0;
  for (int n = 33; n >= 1; n -= 2) series = 1.0 / n - u * u * series;
  return u * series + (upper ? kHalfPi.hi / 2 : 0);
}

/// The arc whose tangent is y / x, for 0 <= y <= x, x above 0; `full` for all digits. What sine and
/// cosine are off by counts at most as much in the arc.
Bounded atanWide(const Wide& y, const Wide& x, bool full) {
  const double t = y.hi / x.hi;
  // The cube of so small an arc is of no account.
  if (t < 0x1p-35) return {y / x};
  const double estimate = arcEstimate(t);
  const Bounded s = full ? Bounded{sinWide(estimate)} : sinBounded(estimate);
  const Bounded c = full ? Bounded{cosWide(estimate)} : cosBounded(estimate);
  const Wide rest = (y * c.value + -(x * s.value)) / (x * c.value + y * s.value);
  return {rest + estimate, s.error + c.error};
}

/// The arc of a point in the upper half plane, not the origin; y not below 0.
Bounded arcWide(const Wide& y, const Wide& x, bool full) {
  const Wide across{std::fabs(x.hi), x.hi < 0 ? -x.lo : x.lo};
  const bool isFlat = across.hi >= y.hi;
  Bounded arc = isFlat ? atanWide(y, across, full) : atanWide(across, y, full);
  if (!isFlat) arc.value = kHalfPi + -arc.value;
  if (x.hi < 0) arc.value = kPi + -arc.value;
  return arc;
}

double arcOf(const Wide& y, const Wide& x) {
  const Bounded quick = arcWide(y, x, false);
  return quick.isRounded() ? quick.value.hi : arcWide(y, x, true).value.hi;
}

bool isOdd(double v) { return std::fabs(std::fmod(v, 2)) == 1; }

double powOfZero(double base, double exponent) {
  const bool odd = isOdd(exponent);
  if (exponent > 0) return odd ? base : 0.0;
  return odd ? std::copysign(kInfinity, base) : kInfinity;
}

double powOfInfinity(double base, double exponent) {
  const double sign = base < 0 && isOdd(exponent) ? -1 : 1;
  return sign * (exponent > 0 ? kInfinity : 0.0);
}

}  // namespace

double sinSmall(double radians) {
  // Below, the cube is less than half a unit in the last place; zero keeps its sign.
  if (std::fabs(radians) < 0x1p-27) return radians;
  const Bounded quick = sinBounded(radians);
  return quick.isRounded() ? quick.value.hi : sinWide(radians).hi;
}

double cosSmall(double radians) {
  const Bounded quick = cosBounded(radians);
  return quick.isRounded() ? quick.value.hi : cosWide(radians).hi;
}

double atan2Of(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return kNan;
  double across = std::fabs(x), up = std::fabs(y);
  double arc = 0;
  if (std::isinf(across) || std::isinf(up)) {
    const double quarter = kHalfPi.hi / 2;
    if (std::isinf(across))
      arc = std::isinf(up) ? quarter : 0;
    else
      arc = kHalfPi.hi;
    if (x < 0) arc = std::isinf(up) && std::isinf(across) ? 3 * quarter : kPi.hi - arc;
  } else if (up == 0) {
    arc = std::signbit(x) ? kPi.hi : 0;
  } else if (x > 0 && up / across < 0x1p-40) {
    arc = up / across;
  } else {
    // Scaled to where nothing overflows; what gets lost is far below the last place.
    int power = 0;
    std::frexp(across > up ? across : up, &power);
    across = std::ldexp(across, -power);
    up = std::ldexp(up, -power);
    arc = arcOf({up, 0}, {x < 0 ? -across : across, 0});
  }
  return std::copysign(arc, y);
}

double asinOf(double v) {
  const double size = std::fabs(v);
  if (!(size <= 1)) return kNan;
  if (size < 0x1p-27) return v;
  const Wide rest = squareRoot(twoSum(1, -size) * twoSum(1, size));
  return std::copysign(arcOf({size, 0}, rest), v);
}

double acosOf(double v) {
  const double size = std::fabs(v);
  if (!(size <= 1)) return kNan;
  const Wide rest = squareRoot(twoSum(1, -size) * twoSum(1, size));
  return arcOf(rest, {v, 0});
}

double expOf(double v) {
  if (std::isnan(v)) return kNan;
  if (v > 710) return kInfinity;
  if (v < -746) return 0;
  int power = 0;
  const Wide e = expWide({v, 0}, power);
  return scaled(e, power);
}

double logOf(double v) {
  if (v == 0) return -kInfinity;
  if (!(v > 0)) return kNan;
  return std::isinf(v) ? v : logWide(v).hi;
}

double log10Of(double v) {
  if (v == 0) return -kInfinity;
  if (!(v > 0)) return kNan;
  return std::isinf(v) ? v : (logWide(v) * kOneOverLn10).hi;
}

double powOf(double base, double exponent) {
  if (exponent == 0 || base == 1) return 1;
  if (std::isnan(base) || std::isnan(exponent)) return kNan;
  const double size = std::fabs(base);
  if (std::isinf(exponent)) {
    if (size == 1) return 1;
    return (size > 1) == (exponent > 0) ? kInfinity : 0;
  }
  if (base == 0) return powOfZero(base, exponent);
  if (std::isinf(base)) return powOfInfinity(base, exponent);
  if (base < 0 && std::fmod(exponent, 1) != 0) return kNan;
  const double sign = base < 0 && isOdd(exponent) ? -1 : 1;
  if (size == 1) return sign;
  const Wide log = logWide(size);
  // Beyond, even the number next to 1 leaves the range.
  if (std::fabs(exponent) > 0x1p64) {
    return sign * ((log.hi > 0) == (exponent > 0) ? kInfinity : 0);
  }
  const Wide product = log * exponent;
  if (product.hi > 710) return sign * kInfinity;
  if (product.hi < -746) return sign * 0.0;
  int power = 0;
  const Wide e = expWide(product, power);
  return sign * scaled(e, power);
}

}  // namespace gable
