// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What annotations say, as data: how an attribute is shown and limited, which rules start, what is
// hidden. They never change a derivation.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gable::lang {

/// @Range in all three spellings: (min=.., max=..), (0, 10[, step]) and ("A", "B"), which is Enum.
struct RangeNote {
  double min = 0;
  double max = 0;
  /// 0: any value between.
  double step = 0;
  /// Values outside are moved to the nearest inside.
  bool restricted = true;
};

/// One value of @Enum: a number or a text.
struct EnumValue {
  bool isNumber = false;
  double number = 0;
  std::string text;
};

struct EnumNote {
  std::vector<EnumValue> values;
  /// Values come from this attribute instead.
  std::string valuesAttribute;
  bool restricted = true;
};

/// @Group; the path is empty for a bare @Group, which leaves all groups.
struct GroupNote {
  std::vector<std::string> path;
  std::optional<double> order;
};

enum class UnitNote : uint8_t { None, Angle, Distance, Percent };

/// What kind of file @File, @Directory and @MaterialFile ask for.
enum class FileNote : uint8_t { None, File, Directory, MaterialFile };

/// What the start shape is expected to be: @InPolygon and its kin.
enum class InputNote : uint8_t { None, Mesh, Polygon, Line, Point, PointCloud };

/// One @Handle: its arguments as they are written, with their names.
using HandleNote = std::vector<std::pair<std::string, std::string>>;

struct Annotations {
  std::string description;
  std::string displayName;
  std::optional<double> order;
  /// The group in force: that of the declaration, else of the one before it in the file.
  GroupNote group;
  std::optional<RangeNote> range;
  std::optional<EnumNote> choices;
  UnitNote unit = UnitNote::None;
  FileNote file = FileNote::None;
  std::vector<std::string> extensions;
  InputNote input = InputNote::None;
  bool color = false;
  bool hidden = false;
  /// @Hidden(a, b) before an import: only these of its attributes.
  std::vector<std::string> hiddenNames;
  bool startRule = false;
  /// @PreferredSize(x, y, z) of a rule: what splitRepeat, splitGrid and margin fit its shapes to;
  /// 0 along an axis: any size.
  std::optional<std::array<double, 3>> preferredSize;
  /// @Label("window") of a rule: what its shapes are, in data sets.
  std::string label;
  std::vector<HandleNote> handles;
  /// @Out(granularity=separatedShapes).
  bool separateShapes = false;
};

}  // namespace gable::lang
