// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Sign and magnitude with schoolbook products: the numbers have two to eight limbs, where nothing
// cleverer pays.
#include "geom/skeleton/wide_int.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/check.h"

namespace gable::skeleton {

namespace {
size_t at(int i) { return static_cast<size_t>(i); }
}  // namespace

WideInt::WideInt(Int128 v) : negative_(v < 0) {
  const UInt128 m = v < 0 ? -static_cast<UInt128>(v) : static_cast<UInt128>(v);
  limb_[0] = static_cast<uint64_t>(m);
  limb_[1] = static_cast<uint64_t>(m >> 64);
  size_ = 2;
  trim();
}

int WideInt::bits() const {
  return size_ == 0 ? 0 : size_ * 64 - std::countl_zero(limb_[at(size_ - 1)]);
}

bool WideInt::bit(int i) const {
  return i / 64 < size_ && ((limb_[at(i / 64)] >> (i % 64)) & 1u) != 0;
}

int WideInt::compareMagnitude(const WideInt& a, const WideInt& b) {
  if (a.size_ != b.size_) return a.size_ < b.size_ ? -1 : 1;
  for (int i = a.size_ - 1; i >= 0; --i) {
    if (a.limb_[at(i)] != b.limb_[at(i)]) return a.limb_[at(i)] < b.limb_[at(i)] ? -1 : 1;
  }
  return 0;
}

WideInt WideInt::added(const WideInt& a, const WideInt& b, bool bNegative) {
  WideInt r;
  if (a.negative_ == bNegative) {
    const int n = std::max(a.size_, b.size_);
    GABLE_CHECK_LT(n, kLimbs);
    UInt128 carry = 0;
    for (int i = 0; i < n; ++i) {
      if (i < a.size_) carry += a.limb_[at(i)];
      if (i < b.size_) carry += b.limb_[at(i)];
      r.limb_[at(i)] = static_cast<uint64_t>(carry);
      carry >>= 64;
    }
    r.limb_[at(n)] = static_cast<uint64_t>(carry);
    r.size_ = n + 1;
    r.negative_ = bNegative;
    r.trim();
    return r;
  }
  const int order = compareMagnitude(a, b);
  if (order == 0) return r;
  const WideInt& big = order > 0 ? a : b;
  const WideInt& small = order > 0 ? b : a;
  uint64_t borrow = 0;
  for (int i = 0; i < big.size_; ++i) {
    const UInt128 take = static_cast<UInt128>(i < small.size_ ? small.limb_[at(i)] : 0) + borrow;
    const UInt128 have = big.limb_[at(i)];
    r.limb_[at(i)] = static_cast<uint64_t>(have - take);
    borrow = have < take ? 1 : 0;
  }
  r.size_ = big.size_;
  r.negative_ = order > 0 ? a.negative_ : bNegative;
  r.trim();
  return r;
}

WideInt operator*(const WideInt& a, const WideInt& b) {
  WideInt r;
  if (a.size_ == 0 || b.size_ == 0) return r;
  const int n = a.size_ + b.size_;
  GABLE_CHECK_LE(n, WideInt::kLimbs);
  std::fill_n(r.limb_.begin(), n, uint64_t{0});
  for (int i = 0; i < a.size_; ++i) {
    uint64_t carry = 0;
    for (int j = 0; j < b.size_; ++j) {
      const UInt128 p =
          static_cast<UInt128>(a.limb_[at(i)]) * b.limb_[at(j)] + r.limb_[at(i + j)] + carry;
      r.limb_[at(i + j)] = static_cast<uint64_t>(p);
      carry = static_cast<uint64_t>(p >> 64);
    }
    r.limb_[at(i + b.size_)] = carry;
  }
  r.size_ = n;
  r.negative_ = a.negative_ != b.negative_;
  r.trim();
  return r;
}

WideInt WideInt::shiftedLeft(int bits) const {
  WideInt r;
  if (size_ == 0) return r;
  const int limbs = bits / 64, rest = bits % 64;
  GABLE_CHECK_LT(size_ + limbs, kLimbs);
  std::fill_n(r.limb_.begin(), size_ + limbs + 1, uint64_t{0});
  for (int i = 0; i < size_; ++i) {
    r.limb_[at(i + limbs)] |= limb_[at(i)] << rest;
    if (rest != 0) r.limb_[at(i + limbs + 1)] |= limb_[at(i)] >> (64 - rest);
  }
  r.size_ = size_ + limbs + 1;
  r.negative_ = negative_;
  r.trim();
  return r;
}

WideInt WideInt::shiftedRight(int bits) const {
  WideInt r;
  const int limbs = bits / 64, rest = bits % 64;
  if (limbs >= size_) return r;
  for (int i = limbs; i < size_; ++i) {
    uint64_t v = limb_[at(i)] >> rest;
    if (rest != 0 && i + 1 < size_) v |= limb_[at(i + 1)] << (64 - rest);
    r.limb_[at(i - limbs)] = v;
  }
  r.size_ = size_ - limbs;
  r.negative_ = negative_;
  r.trim();
  return r;
}

double WideInt::mantissa(int& exponent) const {
  exponent = 0;
  if (size_ == 0) return 0;
  const int n = bits();
  const int drop = std::max(0, n - 64);
  const WideInt top = shiftedRight(drop);
  const double m = std::frexp(static_cast<double>(top.limb_[0]), &exponent);
  exponent += drop;
  return negative_ ? -m : m;
}

WideInt squareRoot(const WideInt& v) {
  WideInt root;
  WideInt rest;
  const int top = (v.bits() + 1) / 2;
  for (int i = top - 1; i >= 0; --i) {
    // Digit by digit: append two bits of v to the rest and try the next bit of the root.
    rest = rest.shiftedLeft(2) + WideInt((v.bit(2 * i + 1) ? 2 : 0) + (v.bit(2 * i) ? 1 : 0));
    const WideInt trial = root.shiftedLeft(2) + WideInt(1);
    root = root.shiftedLeft(1);
    if (compare(rest, trial) >= 0) {
      rest = rest - trial;
      root = root + WideInt(1);
    }
  }
  return root;
}

double quotient(const WideInt& num, const WideInt& den) {
  int en = 0, ed = 0;
  const double mn = num.mantissa(en), md = den.mantissa(ed);
  return std::ldexp(mn / md, en - ed);
}

}  // namespace gable::skeleton
