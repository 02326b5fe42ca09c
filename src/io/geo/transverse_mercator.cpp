// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Krueger's series in the third flattening n to the sixth order, in the form of Karney, Transverse
// Mercator with an accuracy of a few nanometers, Journal of Geodesy 85 (2011): geographic latitude
// to the conformal sphere in closed form, the sphere's transverse Mercator projection, and a
// trigonometric series from there to the ellipsoid's (equations 35 and 36). xi and eta are the
// northing and easting over the rectifying radius; primes mark the sphere's.
#include "io/geo/transverse_mercator.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/geo/wgs84.h"
#include "math/trig.h"

namespace gable {
namespace {

using wgs84::kFlattening;
using wgs84::kSemiMajor;
constexpr double kN = kFlattening / (2 - kFlattening);
constexpr double kN2 = kN * kN, kN3 = kN2 * kN, kN4 = kN2 * kN2, kN5 = kN4 * kN, kN6 = kN3 * kN3;
constexpr double kRectifyingRadius = kSemiMajor / (1 + kN) * (1 + kN2 / 4 + kN4 / 64 + kN6 / 256);

constexpr std::array<double, 6> kAlpha = {
    kN / 2 - kN2 * 2 / 3 + kN3 * 5 / 16 + kN4 * 41 / 180 - kN5 * 127 / 288 + kN6 * 7891 / 37800,
    kN2 * 13 / 48 - kN3 * 3 / 5 + kN4 * 557 / 1440 + kN5 * 281 / 630 - kN6 * 1983433 / 1935360,
    kN3 * 61 / 240 - kN4 * 103 / 140 + kN5 * 15061 / 26880 + kN6 * 167603 / 181440,
    kN4 * 49561 / 161280 - kN5 * 179 / 168 + kN6 * 6601661 / 7257600,
    kN5 * 34729 / 80640 - kN6 * 3418889 / 1995840,
    kN6 * 212378941 / 319334400};
constexpr std::array<double, 6> kBeta = {
    kN / 2 - kN2 * 2 / 3 + kN3 * 37 / 96 - kN4 / 360 - kN5 * 81 / 512 + kN6 * 96199 / 604800,
    kN2 / 48 + kN3 / 15 - kN4 * 437 / 1440 + kN5 * 46 / 105 - kN6 * 1118711 / 3870720,
    kN3 * 17 / 480 - kN4 * 37 / 840 - kN5 * 209 / 4480 + kN6 * 5569 / 90720,
    kN4 * 4397 / 161280 - kN5 * 11 / 504 - kN6 * 830251 / 7257600,
    kN5 * 4583 / 161280 - kN6 * 108847 / 3991680,
    kN6 * 20648693 / 638668800};

double eccentricity() { return std::sqrt(kFlattening * (2 - kFlattening)); }

double sinhOf(double x) { return (expOf(x) - expOf(-x)) / 2; }
double coshOf(double x) { return (expOf(x) + expOf(-x)) / 2; }
double atanhOf(double x) { return logOf((1 + x) / (1 - x)) / 2; }
double asinhOf(double x) { return x < 0 ? -asinhOf(-x) : logOf(x + std::sqrt(1 + x * x)); }

// Where the ellipsoid's projection lies relative to the sphere's, or back with the other series.
Vec2 corrected(double xi, double eta, const std::array<double, 6>& series, double sign) {
  Vec2 out{eta, xi};
  for (size_t j = 0; j < series.size(); ++j) {
    const double k = 2.0 * static_cast<double>(j + 1);
    const double angle = toDegrees(k * xi);
    out.y += sign * series[j] * sinDeg(angle) * coshOf(k * eta);
    out.x += sign * series[j] * cosDeg(angle) * sinhOf(k * eta);
  }
  return out;
}

// Degrees in [-180, 180].
double around(double degrees) {
  const double d = std::fmod(degrees, 360.0);
  return d > 180 ? d - 360 : d < -180 ? d + 360 : d;
}

// Easting and northing over the rectifying radius, from the central meridian and the equator.
Vec2 project(double longitude, double latitude) {
  const double e = eccentricity();
  const double limited = std::clamp(latitude, -90.0, 90.0);
  const double s = sinDeg(limited), c = cosDeg(limited);
  // The tangent of the conformal latitude is t / c (equation 9, with both sides times the cosine,
  // so that the poles are no exception).
  const double sigma = sinhOf(e * atanhOf(e * s));
  const double t = s * std::sqrt(1 + sigma * sigma) - sigma;
  const double forth = c * cosDeg(longitude), aside = c * sinDeg(longitude);
  const double xi = toRadians(atan2Deg(t, forth));
  const double eta = asinhOf(aside / std::sqrt(t * t + forth * forth));
  return corrected(xi, eta, kAlpha, 1);
}

}  // namespace

TransverseMercator::TransverseMercator(const LonLat& center)
    : center_{around(center.longitude), std::clamp(center.latitude, -89.0, 89.0)} {
  northOfCenter_ = project(0, center_.latitude).y;
}

Vec2 TransverseMercator::forward(const LonLat& p) const {
  const Vec2 q = project(around(p.longitude - center_.longitude), p.latitude);
  return {kRectifyingRadius * q.x, kRectifyingRadius * (q.y - northOfCenter_)};
}

LonLat TransverseMercator::inverse(Vec2 p) const {
  const Vec2 q =
      corrected(p.y / kRectifyingRadius + northOfCenter_, p.x / kRectifyingRadius, kBeta, -1);
  const double eta = q.x, xiDegrees = toDegrees(q.y);
  const double sh = sinhOf(eta), c = cosDeg(xiDegrees), s = sinDeg(xiDegrees);
  const double longitude = atan2Deg(sh, c);
  // The tangent of the conformal latitude, then Newton's method for the geographic one (equation 21
  // of the same paper); two steps reach the last digits, one more makes sure.
  const double e = eccentricity();
  const double wanted = s / std::sqrt(sh * sh + c * c);
  double tau = wanted;
  for (int i = 0; i < 5; ++i) {
    const double r = std::sqrt(1 + tau * tau);
    const double sigma = sinhOf(e * atanhOf(e * tau / r));
    const double here = tau * std::sqrt(1 + sigma * sigma) - sigma * r;
    tau += (wanted - here) / std::sqrt(1 + here * here) * (1 + (1 - e * e) * tau * tau) /
           ((1 - e * e) * r);
  }
  return {around(center_.longitude + longitude), atanDeg(tau)};
}

}  // namespace gable
