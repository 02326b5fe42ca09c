// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The textures that exist without a file and are drawn when they are asked for: those of library
// materials, patterns and leaves.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "io/image/image.h"
#include "render/render.h"

namespace gable {

/// The paths of the textures that are drawn at once with that of `path`, itself among them: those
/// of a library material come from one field. Empty where it names no drawn texture.
std::vector<std::string> drawnWith(const std::string& path);
/// Their pictures, in that order. A library material takes a tenth of a second.
std::vector<Image> drawTextures(const std::vector<std::string>& paths);
/// The picture of a path as a file: JPEG of a library material, else PNG.
std::string encodeTexture(const std::string& path, Image image);

/// As the renderer has them; shared by all pictures that are drawn with it.
using TexturePicture = std::shared_ptr<const TextureImage>;
TexturePicture texturePicture(Image image);

/// Pictures of drawn textures, each drawn once. Any number of threads may ask; one waits for what
/// another is drawing.
class DrawnTextures {
 public:
  /// Null where the path names no drawn texture.
  TexturePicture find(const std::string& path);
  /// Draws those of many paths on several threads, `jobs` as in parallelFor(). What another thread
  /// is drawing is left to it until the others are done.
  void draw(const std::vector<std::string>& paths, unsigned jobs);
  /// All that drawnWith() says where they have been drawn already, else none.
  std::vector<TexturePicture> known(const std::string& path);

 private:
  struct Entry {
    std::atomic<bool> begun{false}, done{false};
    std::once_flag once;
    std::vector<std::string> paths;
    std::vector<TexturePicture> pictures;
  };
  /// Null where the path names no drawn texture.
  Entry* entryOf(const std::string& path);
  static void make(Entry& entry);

  std::mutex mutex_;
  /// By the first of the paths that are drawn at once.
  std::map<std::string, Entry> entries_;
};

}  // namespace gable
