// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "tiles/texture_tints.h"

#include "io/image/image.h"

namespace gable {

Vec3 TextureTints::of(const Material& m) {
  const std::string& path = m.map(TextureLayer::Color).path;
  if (path.empty()) return m.color;
  const auto [at, fresh] = known_.try_emplace(path, Vec3{1, 1, 1});
  if (fresh) at->second = meanOf(path);
  return scaled(m.color, at->second);
}

Vec3 TextureTints::meanOf(const std::string& path) const {
  const Result<std::string> bytes =
      read_ ? read_(path) : Result<std::string>(Error{"texture-not-found", "", ""});
  if (!bytes.ok()) return {1, 1, 1};
  const Result<Image> image = decodeImage(bytes.value());
  if (!image.ok()) return {1, 1, 1};
  Vec3 sum;
  const std::vector<uint8_t>& rgba = image.value().rgba;
  for (size_t i = 0; i + 3 < rgba.size(); i += 4) {
    sum += Vec3{double{1} * rgba[i], double{1} * rgba[i + 1], double{1} * rgba[i + 2]};
  }
  return rgba.empty() ? Vec3{1, 1, 1} : sum * (4.0 / 255 / static_cast<double>(rgba.size()));
}

}  // namespace gable
