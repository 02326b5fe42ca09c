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

Vec3 meanLight(const std::vector<uint8_t>& rgba) {
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

double meanNumber(const std::vector<uint8_t>& rgba) {
  uint64_t sum = 0;
  for (size_t i = 1; i < rgba.size(); i += 4) sum += rgba[i];
  return rgba.empty() ? 1 : static_cast<double>(sum) * 4 / 255 / static_cast<double>(rgba.size());
}

}  // namespace

Finish TextureTints::of(const Material& m) {
  const Vec3 picture = meanLight(m.map(TextureLayer::Color).path);
  Finish finish;
  for (size_t i = 0; i < 3; ++i) finish.color[i] = linearOf(m.color[i]) * picture[i];
  // Numbers, not light: glTF has them in green, as single channels have.
  finish.roughness = m.roughness * meanNumber(m.map(TextureLayer::Roughness).path);
  return finish;
}

template <class Mean, class Make>
Mean TextureTints::known(std::map<std::string, Mean>& means, const std::string& path, Make&& make) {
  {
    const std::lock_guard lock(knowing_);
    const auto at = means.find(path);
    if (at != means.end()) return at->second;
  }
  // Reading may be stopped, so it holds no lock.
  const Mean mean = make(rgbaOf(path));
  const std::lock_guard lock(knowing_);
  return means.emplace(path, mean).first->second;
}

Vec3 TextureTints::meanLight(const std::string& path) {
  return path.empty() ? Vec3{1, 1, 1} : known(colors_, path, gable::meanLight);
}

double TextureTints::meanNumber(const std::string& path) {
  return path.empty() ? 1 : known(numbers_, path, gable::meanNumber);
}

std::vector<uint8_t> TextureTints::rgbaOf(const std::string& path) const {
  if (!read_) return {};
  const Result<std::string> bytes = read_(path);
  if (!bytes.ok()) return {};
  const Result<Image> image = decodeImage(bytes.value());
  return image.ok() ? image.value().rgba : std::vector<uint8_t>{};
}

}  // namespace gable
