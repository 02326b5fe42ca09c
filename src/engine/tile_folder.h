// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The folder of a place's tiles: whose it is, and which of its files are of no use any more.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/result.h"
#include "tiles/tile_tree.h"

namespace gable {

class TileFolder {
 public:
  explicit TileFolder(std::string path);

  /// Ends in a slash.
  const std::string& path() const { return path_; }
  std::string plan() const { return path_ + "plan/"; }

  /// Refuses a folder that is not ours to write to; else makes it and marks it as being written.
  std::optional<Error> open();

  /// Writes the tileset, which comes last; then goes what an earlier one, and the plan, have left
  /// behind.
  Result<uint64_t> close(const TilePart& all, const std::vector<double>& transform);

 private:
  std::optional<Error> readBefore();

  std::string path_;
  std::set<std::string> before_;
};

}  // namespace gable
