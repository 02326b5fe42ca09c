// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// WideInt: signed integers of up to 640 bits on the stack, for exact signs of the determinants in
// planes.h. The widest product there has 490 bits; an overflow is our mistake and is checked.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace gable::skeleton {

__extension__ using Int128 = __int128;
__extension__ using UInt128 = unsigned __int128;

class WideInt {
 public:
  WideInt() = default;
  WideInt(Int128 v);

  bool isZero() const { return size_ == 0; }
  /// -1, 0 or 1.
  int sign() const { return size_ == 0 ? 0 : negative_ ? -1 : 1; }
  int bits() const;
  bool bit(int i) const;

  friend WideInt operator+(const WideInt& a, const WideInt& b) { return added(a, b, b.negative_); }
  friend WideInt operator-(const WideInt& a, const WideInt& b) { return added(a, b, !b.negative_); }
  friend WideInt operator-(WideInt a) {
    a.negative_ = !a.negative_;
    return a;
  }
  friend WideInt operator*(const WideInt& a, const WideInt& b);
  WideInt shiftedLeft(int bits) const;
  WideInt shiftedRight(int bits) const;
  friend int compare(const WideInt& a, const WideInt& b) { return (a - b).sign(); }

  /// The value as mantissa * 2^exponent with |mantissa| in [0.5, 1), or 0.
  double mantissa(int& exponent) const;

 private:
  static WideInt added(const WideInt& a, const WideInt& b, bool bNegative);
  static int compareMagnitude(const WideInt& a, const WideInt& b);
  void trim() {
    while (size_ > 0 && limb_[static_cast<size_t>(size_ - 1)] == 0) --size_;
  }

  static constexpr int kLimbs = 10;
  std::array<uint64_t, kLimbs> limb_;
  int size_ = 0;
  bool negative_ = false;
};

/// floor(sqrt(v)) of a value that is not negative.
WideInt squareRoot(const WideInt& v);
/// num / den as the nearest double, or one beside it.
double quotient(const WideInt& num, const WideInt& den);

}  // namespace gable::skeleton
