// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The textures that a written model carries: read once, in the order of first use, checked to be
// pictures that every viewer reads (others than PNG and JPEG become PNG), and combined where a
// format wants two maps in one file.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "io/exporters/write_model.h"
#include "io/image/image.h"

namespace gable {

struct ModelTexture {
  /// A file name without folder, unique in the set.
  std::string name;
  /// "image/png" or "image/jpeg".
  std::string mime;
  std::string bytes;
  bool hasAlpha = false;
};

class TextureSet {
 public:
  static constexpr int kNone = -1;

  TextureSet(const WriteOptions& options, std::vector<std::string>& warnings)
      : read_(options.readTexture), longest_(options.textureSize), warnings_(warnings) {}

  /// The texture of a path; kNone, with one warning a path, when it cannot be used.
  int add(const std::string& path);
  /// Colour of one file, transparency of another (its alpha, or its brightness where it has none).
  int addColorWithOpacity(const std::string& color, const std::string& opacity);
  /// Roughness in green, metalness in blue, of the same channels of the two files; an empty path
  /// stands for the constant 1.
  int addMetallicRoughness(const std::string& roughness, const std::string& metallic);

  const std::vector<ModelTexture>& all() const { return all_; }

 private:
  struct Layer {
    Image image;
    bool hasAlpha = false;
  };
  Result<std::string> load(const std::string& path) const;
  /// The picture of a path; a white one for no path.
  Result<Layer> readLayer(const std::string& path) const;
  int remember(const std::string& key, ModelTexture texture);
  std::string uniqueName(const std::string& wanted);
  int refuse(const std::string& key, const std::string& path, const std::string& why);

  /// Made smaller, where it is too large.
  Result<Image> fitted(Result<Image> image) const;

  TextureReader read_;
  uint32_t longest_;
  std::vector<std::string>& warnings_;
  std::vector<ModelTexture> all_;
  std::map<std::string, int> known_;
  std::set<std::string> names_;
  std::map<std::string, uint32_t> copies_;
};

}  // namespace gable
