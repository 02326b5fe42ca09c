// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A meeting point solves a x + b y - s t = -c for three planes; by Cramer's rule its time is
// det(a b c) / det(a b s), and a fourth plane's value there is det4(a b s c) / det(a b s). Rows
// carry a common factor each, which no sign depends on, so rows are scaled to use all bits of an
// edge however short. Sizes: a, b 52 bits, c 104, s 156; times compare with 490 bits.
#include "geom/skeleton/planes.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"

namespace gable::skeleton {

namespace {

// Filters work on values of magnitude 1 whose errors stay under a dozen roundings; 64 roundings
// (2^-53 each) cover every expression here with room.
constexpr double kRounding = 0x1p-47;
constexpr int kNormalBits = 51;
constexpr double kStandStill = 0x1p-63;

}  // namespace

PlaneId Planes::add(GridPoint from, GridPoint to, double weight) {
  Plane p;
  p.a = from.y - to.y;
  p.b = to.x - from.x;
  int shift = 0;
  while (std::max(std::abs(p.a), std::abs(p.b)) << shift < (int64_t{1} << kNormalBits)) ++shift;
  p.a *= int64_t{1} << shift;
  p.b *= int64_t{1} << shift;
  p.c = -(static_cast<Int128>(p.a) * from.x + static_cast<Int128>(p.b) * from.y);

  // s = length * weight * 2^103, plus a hair of its own.
  const WideInt square = WideInt(static_cast<Int128>(p.a) * p.a + static_cast<Int128>(p.b) * p.b);
  const WideInt len = rootOf(square << 100);
  const double w = std::max(weight, kStandStill);
  const uint64_t hair = mix64(planes_.size() + 1) >> 4;
  if (w < 0x1p-40) {
    int exponent = 0;
    const double m = std::frexp(w, &exponent);
    const auto scaled = static_cast<int64_t>(std::ldexp(m, 53));
    p.s = (len * scaled) >> -exponent;
  } else {
    p.s = len * WideInt(static_cast<Int128>(std::ldexp(w, 53)));
  }
  p.s = p.s + WideInt(static_cast<Int128>(hair));

  const double length = std::sqrt(static_cast<double>(p.a) * static_cast<double>(p.a) +
                                  static_cast<double>(p.b) * static_cast<double>(p.b));
  p.na = static_cast<double>(p.a) / length;
  p.nb = static_cast<double>(p.b) / length;
  p.nc = static_cast<double>(p.c) / length;
  // From s itself: where the weight is next to nothing, the hair is a part that counts.
  p.ns = quotient(p.s, len << 53);
  planes_.push_back(p);
  return static_cast<PlaneId>(planes_.size() - 1);
}

PlaneId Planes::addLevel(double time) {
  // c / s is the time: s = 2^103 in the same scale, c = time, both times 2^20 for its fraction.
  Plane p;
  p.c = static_cast<Int128>(std::ldexp(time, 20));
  p.s = WideInt(1) << (kTimeBits + 20);
  p.nc = time;
  p.ns = 1;
  planes_.push_back(p);
  return static_cast<PlaneId>(planes_.size() - 1);
}

int Planes::turn(PlaneId p, PlaneId q) const {
  const double d = minorOf(p, q);
  if (std::abs(d) > kRounding) return d > 0 ? 1 : -1;
  const Int128 m = minor(p, q);
  return m > 0 ? 1 : m < 0 ? -1 : 0;
}

bool Planes::sameDirection(PlaneId p, PlaneId q) const {
  return planes_[p].na * planes_[q].na + planes_[p].nb * planes_[q].nb > 0;
}

int Planes::compareSpeed(PlaneId p, PlaneId q) const {
  return planes_[p].ns < planes_[q].ns ? -1 : planes_[p].ns > planes_[q].ns ? 1 : 0;
}

WideInt Planes::detOffsets(PlaneId p, PlaneId q, PlaneId r) const {
  return WideInt(minor(p, q)) * WideInt(planes_[r].c) +
         WideInt(minor(q, r)) * WideInt(planes_[p].c) -
         WideInt(minor(p, r)) * WideInt(planes_[q].c);
}

WideInt Planes::detSpeeds(PlaneId p, PlaneId q, PlaneId r) const {
  return WideInt(minor(p, q)) * planes_[r].s + WideInt(minor(q, r)) * planes_[p].s -
         WideInt(minor(p, r)) * planes_[q].s;
}

int Planes::speedSign(PlaneId p, PlaneId q, PlaneId r) const {
  const Plane &a = planes_[p], &b = planes_[q], &c = planes_[r];
  const double den = minorOf(p, q) * c.ns + minorOf(q, r) * a.ns - minorOf(p, r) * b.ns;
  const double error = kRounding * (a.ns + b.ns + c.ns);
  if (std::abs(den) > error) return den > 0 ? 1 : -1;
  return detSpeeds(p, q, r).sign();
}

std::optional<EventTime> Planes::meeting(PlaneId p, PlaneId q, PlaneId r) const {
  const Plane &a = planes_[p], &b = planes_[q], &c = planes_[r];
  const double pq = minorOf(p, q), qr = minorOf(q, r), pr = minorOf(p, r);
  const double num = pq * c.nc + qr * a.nc - pr * b.nc;
  const double den = pq * c.ns + qr * a.ns - pr * b.ns;
  const double numError = kRounding * (std::abs(a.nc) + std::abs(b.nc) + std::abs(c.nc));
  const double denError = kRounding * (a.ns + b.ns + c.ns);
  EventTime t;
  t.planes[0] = p;
  t.planes[1] = q;
  t.planes[2] = r;
  if (std::abs(den) > 4 * denError) {
    t.value = num / den;
    t.error = 1.01 * (numError + std::abs(t.value) * denError) / (std::abs(den) - denError);
    return t;
  }
  const WideInt exactDen = detSpeeds(p, q, r);
  if (exactDen.is_zero()) return std::nullopt;
  const WideInt exactNum = detOffsets(p, q, r);
  t.value = std::ldexp(quotient(exactNum, exactDen), kTimeBits);
  t.error = std::abs(t.value) * 0x1p-50;
  return t;
}

ExactTime Planes::exact(const EventTime& t) const {
  ExactTime e{detOffsets(t.planes[0], t.planes[1], t.planes[2]),
              detSpeeds(t.planes[0], t.planes[1], t.planes[2])};
  if (e.den.sign() < 0) {
    e.num = -e.num;
    e.den = -e.den;
  }
  return e;
}

int Planes::compareTimes(const EventTime& a, const EventTime& b) const {
  if (a.value + a.error < b.value - b.error) return -1;
  if (a.value - a.error > b.value + b.error) return 1;
  const ExactTime x = exact(a), y = exact(b);
  return WideInt(x.num * y.den).compare(y.num * x.den);
}

WideInt Planes::detFour(PlaneId p, PlaneId q, PlaneId r, PlaneId l) const {
  // Laplace along the column pairs (a, b) and (s, c).
  return WideInt(minor(p, q)) * lift(r, l) - WideInt(minor(p, r)) * lift(q, l) +
         WideInt(minor(p, l)) * lift(q, r) + WideInt(minor(q, r)) * lift(p, l) -
         WideInt(minor(q, l)) * lift(p, r) + WideInt(minor(r, l)) * lift(p, q);
}

int Planes::side(PlaneId p, PlaneId q, PlaneId r, PlaneId l) const {
  const Plane &a = planes_[p], &b = planes_[q], &c = planes_[r], &d = planes_[l];
  const auto liftOf = [](const Plane& u, const Plane& v) { return u.ns * v.nc - v.ns * u.nc; };
  const double det = minorOf(p, q) * liftOf(c, d) - minorOf(p, r) * liftOf(b, d) +
                     minorOf(p, l) * liftOf(b, c) + minorOf(q, r) * liftOf(a, d) -
                     minorOf(q, l) * liftOf(a, c) + minorOf(r, l) * liftOf(a, b);
  const double speeds = a.ns + b.ns + c.ns + d.ns;
  const double error =
      4 * kRounding * speeds * (std::abs(a.nc) + std::abs(b.nc) + std::abs(c.nc) + std::abs(d.nc));
  const int top = std::abs(det) > error ? (det > 0 ? 1 : -1) : detFour(p, q, r, l).sign();
  return top == 0 ? 0 : top * speedSign(p, q, r);
}

Planes::Point Planes::point(PlaneId p, PlaneId q, PlaneId r) const {
  const WideInt den = detSpeeds(p, q, r);
  if (den.is_zero()) return {};
  const WideInt qr = lift(q, r), pr = lift(p, r), pq = lift(p, q);
  const auto wide = [](int64_t v) { return WideInt(static_cast<Int128>(v)); };
  const Plane &a = planes_[p], &b = planes_[q], &c = planes_[r];
  const WideInt x = wide(b.b) * pr - wide(a.b) * qr - wide(c.b) * pq;
  const WideInt y = wide(a.a) * qr - wide(b.a) * pr + wide(c.a) * pq;
  return {quotient(x, den), quotient(y, den),
          std::ldexp(quotient(detOffsets(p, q, r), den), kTimeBits)};
}

}  // namespace gable::skeleton
