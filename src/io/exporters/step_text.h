// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The text of STEP files (ISO 10303-21), as IFC has it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace gable {

/// 'text' with quotes; what is not printable ASCII by its code points. What is not UTF-8 becomes
/// U+FFFD. Cut behind `most` code points.
std::string stepText(std::string_view text, size_t most = 100'000);

/// A real number, which has a point: 1., -0.25, 1.E+20. 0. for what is not finite.
std::string stepReal(double v);
/// The same, rounded to so many decimals.
void appendStepReal(std::string& out, double v, int decimals);

/// A GlobalId of IFC by a number of 128 bits: 22 letters of a base of 64. Equal seeds give equal
/// ids, different ones different ids as far as hashes go.
std::string stepGuid(uint64_t a, uint64_t b);

}  // namespace gable
