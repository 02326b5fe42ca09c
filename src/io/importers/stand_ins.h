// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What stands in for a part of a model and is not drawn with it: collision shapes and coarser
// levels of detail, known by the names that engines know them by.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace gable {

/// Whether engines take a node of that name for a collision shape and draw nothing: UCX_Wall_00
/// (Unreal; also UBX_, USP_, UCP_), Wall-colonly and Wall-convcolonly (Godot, which also takes `_`
/// and `$`), Wall_collision. Numbers that programs add behind are no part of it: Wall-colonly.001.
bool isCollisionName(std::string_view name);

/// The names of a file.
class StandIns {
 public:
  explicit StandIns(const std::vector<std::string_view>& names);

  /// Whether it is a coarser level: Wall_LOD1 and further ones where Wall_LOD0 is there.
  bool isCoarse(std::string_view name) const;

 private:
  /// What has a finest level: Wall.
  std::set<std::string, std::less<>> levelled_;
};

}  // namespace gable
