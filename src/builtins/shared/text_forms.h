// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What texts of several operations and functions must be; see TextForm.
#pragma once

#include "material/material.h"
#include "program/spec.h"

namespace gable {

inline constexpr TextForm kColourText{"a colour",
                                      [](std::string_view text) {
                                        Vec3 rgb;
                                        double opacity = 0;
                                        return parseColor(text, rgb, opacity);
                                      },
                                      "write \"#rrggbb\" or \"#rrggbboo\""};

/// The analysis looks for the material (lang/sema/assets.cpp): the project may have it.
inline constexpr TextForm kMaterialText{"a material", [](std::string_view) { return true; },
                                        "'gable asset material' lists them"};

inline constexpr TextForm kNotEmptyText{
    "a name", [](std::string_view text) { return !text.empty(); }, "write at least one letter"};

}  // namespace gable
