// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#pragma once

#include <span>
#include <string_view>

namespace gable::lang {

/// What goes from 0 to 1: shares, and components of colours. A number beyond is taken as 0 or 1.
struct Fractions {
  /// An operation or function; of `set` the parameters are attributes of shapes.
  std::string_view callee;
  std::span<const std::string_view> parameters;
};

/// By name of the callee. A test holds each name against the catalogue.
std::span<const Fractions> fractions();

bool isFraction(std::string_view callee, std::string_view parameter);

}  // namespace gable::lang
