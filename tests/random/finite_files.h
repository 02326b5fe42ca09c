// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Looks for numbers that are not finite in the bytes of a written model.
#pragma once

#include <string>
#include <string_view>

namespace gable {

/// What is wrong, in a few words; empty when all numbers are finite. An empty file is right.
std::string faultOfGlb(std::string_view file);
/// OBJ.
std::string faultOfText(std::string_view file);
/// Binary little-endian, as Gable writes it.
std::string faultOfPly(std::string_view file);

}  // namespace gable
