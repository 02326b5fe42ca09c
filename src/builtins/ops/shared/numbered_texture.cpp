// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/shared/numbered_texture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "base/allowance.h"
#include "base/number.h"
#include "base/text.h"
#include "material/builtin_textures.h"

namespace gable {

namespace {

/// The edit of a material by a texture number; other edits count from 1000 (builtins/shared).
constexpr uint32_t kNumberedTextureEdit = 2000;

bool isImage(const std::string& path) {
  const std::string low = lowerCase(path);
  return low.ends_with(".png") || low.ends_with(".jpg") || low.ends_with(".jpeg");
}

std::vector<std::string> numberedImages(Assets& assets) {
  std::vector<std::string> out = assets.search("textures/*", "");
  out.erase(
      std::remove_if(out.begin(), out.end(), [](const std::string& p) { return !isImage(p); }),
      out.end());
  if (out.empty()) {
    for (size_t i = 0; i < kBuiltinTextures.size(); ++i) out.push_back(builtinTexturePath(i));
  }
  std::sort(out.begin(), out.end());
  return out;
}

bool tellsMissing(Services& services, double index) {
  const UncountedWork uncounted;
  const size_t count = numberedImages(services.assets()).size();
  if (index >= 0 && index < static_cast<double>(count)) return false;
  services.warn("unknown-texture",
                "there is no texture number " + shortestText(index) + "; the body is plain",
                "write a number from 0 to " + std::to_string(count - 1));
  return true;
}

std::string stemOf(const std::string& path) {
  const size_t slash = path.find_last_of('/');
  const std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
  return name.substr(0, name.find_last_of('.'));
}

}  // namespace

void wearNumberedTexture(Shape& s, Services& services, double number, double quarters,
                         double scale) {
  Services::TextureMemo& last = services.textureMemo();
  if (last.known && last.before == s.material && last.number == number &&
      last.quarters == quarters && last.scale == scale) {
    s.material = last.after;
    return;
  }
  const double index = std::trunc(number);
  const double turns = std::trunc(quarters);
  const MaterialEdit edit{s.material, kNumberedTextureEdit, std::bit_cast<uint64_t>(index),
                          std::bit_cast<uint64_t>(turns), std::bit_cast<uint64_t>(scale)};
  s.material = services.materials().edited(edit, [&](Material& m) {
    // Whoever comes first looks the images up.
    const UncountedWork uncounted;
    const std::vector<std::string> images = numberedImages(services.assets());
    if (!(index >= 0 && index < static_cast<double>(images.size()))) return;
    TextureMap& map = m.map(TextureLayer::Color);
    map.path = images[static_cast<size_t>(index)];
    m.name = stemOf(map.path);
    if (std::isfinite(scale)) map.su = map.sv = 2 * scale;
    if (std::isfinite(turns)) map.rw = 90 * std::fmod(turns, 4);
    // Where the picture is transparent, so is the body.
    const bool alpha = services.assets().image(map.path, "").hasAlpha;
    m.map(TextureLayer::Opacity) = alpha ? map : TextureMap{};
  });
  // A number without an image is told for each shape, so that it is not remembered.
  if (s.material == edit.base && tellsMissing(services, index)) return;
  last = {true, edit.base, s.material, number, quarters, scale};
}

}  // namespace gable
