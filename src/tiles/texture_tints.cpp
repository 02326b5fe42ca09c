// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Light is mixed, not the numbers of pictures, and what is transparent gives none.
#include "tiles/texture_tints.h"

#include <array>

#include "io/image/image.h"
#include "material/linear_light.h"

namespace gable {

namespace {

Vec3 meanOf(const std::vector<uint8_t>& rgba) {
  std::array<double, 256> linear{};
  for (size_t i = 0; i < linear.size(); ++i) linear[i] = linearOf(static_cast<double>(i) / 255);
  Vec3 sum;
  double weight = 0;
  for (size_t i = 0; i + 3 < rgba.size(); i += 4) {
    const double alpha = rgba[i + 3];
    sum += Vec3{linear[rgba[i]], linear[rgba[i + 1]], linear[rgba[i + 2]]} * alpha;
    weight += alpha;
  }
  return weight > 0 ? sum * (1 / weight) : Vec3{1, 1, 1};
}

}  // namespace

Vec3 TextureTints::of(const Material& m) {
  const std::string& path = m.map(TextureLayer::Color).path;
  if (path.empty()) return m.color;
  const auto [at, fresh] = known_.try_emplace(path, Vec3{1, 1, 1});
  if (fresh) at->second = meanOf(path);
  Vec3 out;
  for (size_t i = 0; i < 3; ++i) out[i] = srgbOf(linearOf(m.color[i]) * at->second[i]);
  return out;
}

Vec3 TextureTints::meanOf(const std::string& path) const {
  const Result<std::string> bytes =
      read_ ? read_(path) : Result<std::string>(Error{"texture-not-found", "", ""});
  if (!bytes.ok()) return {1, 1, 1};
  const Result<Image> image = decodeImage(bytes.value());
  return image.ok() ? gable::meanOf(image.value().rgba) : Vec3{1, 1, 1};
}

}  // namespace gable
