// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The determinant is first taken in doubles and trusted where it exceeds Shewchuk's static bound
// ("Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997).
// Otherwise its six products are expanded into twelve doubles without error and summed into a
// non-overlapping expansion, whose last component carries the sign.
#include "math/predicates.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gable {
namespace {

class Expansion {
 public:
  void addProduct(double a, double b) {
    const double p = a * b;
    add(std::fma(a, b, -p));
    add(p);
  }
  int sign() const {
    for (size_t i = count_; i-- > 0;) {
      if (parts_[i] != 0) return parts_[i] > 0 ? 1 : -1;
    }
    return 0;
  }

 private:
  // Grow-expansion: every partial sum is split into its rounded value and its error.
  void add(double v) {
    double q = v;
    for (size_t i = 0; i < count_; ++i) {
      const double sum = q + parts_[i];
      const double bb = sum - q;
      const double error = (q - (sum - bb)) + (parts_[i] - bb);
      parts_[i] = error;
      q = sum;
    }
    parts_[count_++] = q;
  }
  std::array<double, 12> parts_{};
  size_t count_ = 0;
};

}  // namespace

int exactOrientation(Vec2 a, Vec2 b, Vec2 c) {
  Expansion e;
  e.addProduct(a.x, b.y);
  e.addProduct(-a.x, c.y);
  e.addProduct(-b.x, a.y);
  e.addProduct(b.x, c.y);
  e.addProduct(c.x, a.y);
  e.addProduct(-c.x, b.y);
  return e.sign();
}

bool onSegment(Vec2 a, Vec2 b, Vec2 p) {
  if (p.x < std::min(a.x, b.x) || p.x > std::max(a.x, b.x)) return false;
  if (p.y < std::min(a.y, b.y) || p.y > std::max(a.y, b.y)) return false;
  return orientation(a, b, p) == 0;
}

}  // namespace gable
