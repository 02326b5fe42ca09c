// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Trigonometry in degrees that gives the same bits everywhere (base/elementary.h): arguments are
// reduced exactly in degrees, and quarter turns are exact.
#pragma once

#include "base/elementary.h"
#include "math/vec.h"

namespace gable {

double sinDeg(double degrees);
double cosDeg(double degrees);
double tanDeg(double degrees);
double asinDeg(double v);
double acosDeg(double v);
double atanDeg(double v);
double atan2Deg(double y, double x);

constexpr double kPi = 3.14159265358979323846;
constexpr double toRadians(double degrees) { return degrees * (kPi / 180); }
constexpr double toDegrees(double radians) { return radians * (180 / kPi); }

}  // namespace gable
