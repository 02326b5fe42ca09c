// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Elementary functions that give the same bits with every compiler and optimisation level: the
// arguments are reduced exactly in degrees, quarter turns are exact, and no call is folded at
// compile time (the file is built without built-ins).
#pragma once

#include "math/vec.h"

namespace gable {

double sinDeg(double degrees);
double cosDeg(double degrees);
double tanDeg(double degrees);
double asinDeg(double v);
double acosDeg(double v);
double atanDeg(double v);
double atan2Deg(double y, double x);
double expOf(double v);
double logOf(double v);
double log10Of(double v);
double powOf(double base, double exponent);

constexpr double kPi = 3.14159265358979323846;
constexpr double toRadians(double degrees) { return degrees * (kPi / 180); }
constexpr double toDegrees(double radians) { return radians * (180 / kPi); }

}  // namespace gable
