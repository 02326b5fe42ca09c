// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Pictures that tiles share: a file for each content, named by its checksum, in the folder
// `tiles/images`. So a viewer asks for it once, and whoever writes it writes the same.
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "io/exporters/textures.h"
#include "tiles/tile_mesh.h"

namespace gable {

class TileImages {
 public:
  /// `folder` is that of the tileset, and ends in a slash.
  explicit TileImages(std::string folder) : folder_(std::move(folder)) {}

  /// Writes those that have not been written here; their names from the folder. Threads may call it
  /// at a time. Code: file-unwritable.
  Result<std::vector<std::string>> write(const std::vector<ModelTexture>& images);

  /// All that have been written, by name.
  std::vector<TileFile> files() const;

 private:
  std::string folder_;
  std::mutex writing_;
  std::map<std::string, TileFile> files_;
};

/// Whether a path from the folder `tiles` is that of a shared picture.
bool isTileImage(std::string_view path);

/// Adds those of `more`; both are in the order of their names.
void addImages(std::vector<TileFile>& to, const std::vector<TileFile>& more);

/// The address of a file of the tileset in another one of it.
std::string addressFrom(std::string_view file, std::string_view target);

}  // namespace gable
