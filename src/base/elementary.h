// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Elementary functions made of additions, multiplications, divisions and square roots alone, which
// IEEE 754 rounds the same way everywhere. So they give the same bits with every compiler, every
// optimisation and every C library; whatever a rule computes is computed with these. Results are
// the exact values rounded to nearest, but for about one argument in a million, where they are the
// neighbour. Special arguments give what C says. Each costs a few hundred operations.
#pragma once

namespace gable {

/// Radians in [-pi/4, pi/4]; larger arguments are the caller's to reduce.
double sinSmall(double radians);
double cosSmall(double radians);
/// Radians.
double asinOf(double v);
double acosOf(double v);
double atan2Of(double y, double x);
double expOf(double v);
double logOf(double v);
double log10Of(double v);
double powOf(double base, double exponent);

}  // namespace gable
