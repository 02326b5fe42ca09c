// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Values of the rule language, as attributes and reports hold them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace gable {

/// A number, a bool or a text; or an array of them, row by row.
struct RuleValue {
  using Scalar = std::variant<double, bool, std::string>;
  struct Size {
    uint32_t rows = 0, columns = 0;
  };
  /// One item where it is a single value, none where it has no value.
  std::vector<Scalar> items;
  /// Present where it is an array; items then has rows times columns entries.
  std::optional<Size> array;
};

struct NamedValue {
  std::string name;
  RuleValue value;
};

}  // namespace gable
