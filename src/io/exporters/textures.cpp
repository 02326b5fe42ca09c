// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/textures.h"

#include <algorithm>

#include "base/files.h"
#include "base/work.h"
#include "io/image/image.h"
#include "io/image/jpeg.h"

namespace gable {
namespace {

constexpr uint64_t kMostTextureBytes = 1ULL << 30;
constexpr int kJpegQuality = 90;

// Letters, digits and a few marks stay; the rest could mean something to a shell or in a URI.
std::string plainName(const std::string& path) {
  std::string name = fileNameOf(path);
  for (char& c : name) {
    const bool good = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '.' || c == '-' || c == '_';
    if (!good) c = '_';
  }
  return name.empty() || name[0] == '.' ? "texture" + name : name;
}

std::string stemOf(const std::string& name) {
  const size_t dot = name.rfind('.');
  return dot == std::string::npos || dot == 0 ? name : name.substr(0, dot);
}

// The pixel of the smaller picture that lies where (x, y) does in one of width x height.
const uint8_t* sample(const Image& image, uint32_t x, uint32_t y, uint32_t width, uint32_t height) {
  return image.at(static_cast<uint32_t>(static_cast<uint64_t>(x) * image.width / width),
                  static_cast<uint32_t>(static_cast<uint64_t>(y) * image.height / height));
}

// A picture as large as the larger of the two in each direction, pixel by pixel from both.
template <class Mix>
Image mixed(const Image& a, const Image& b, Mix mix) {
  Image out;
  out.width = std::max(a.width, b.width);
  out.height = std::max(a.height, b.height);
  reserveWork(out.rgba, 4.0 * out.width * out.height);
  out.rgba.resize(static_cast<size_t>(out.width) * out.height * 4);
  uint8_t* p = out.rgba.data();
  for (uint32_t y = 0; y < out.height; ++y) {
    work(out.width);
    for (uint32_t x = 0; x < out.width; ++x, p += 4) {
      mix(sample(a, x, y, out.width, out.height), sample(b, x, y, out.width, out.height), p);
    }
  }
  return out;
}

}  // namespace

Result<std::string> TextureSet::load(const std::string& path) const {
  return read_ ? read_(path) : readFile(path, kMostTextureBytes);
}

Result<Image> TextureSet::fitted(Result<Image> image) const {
  if (!image.ok() || longest_ == 0) return image;
  while (std::max(image->width, image->height) > longest_) *image = halved(*image);
  return image;
}

std::string TextureSet::uniqueName(const std::string& wanted) {
  if (names_.insert(wanted).second) return wanted;
  const std::string stem = stemOf(wanted), rest = wanted.substr(stem.size());
  // Where the last search for this name ended.
  for (uint32_t& i = copies_.try_emplace(wanted, 2).first->second;; ++i) {
    std::string name = stem + "-" + std::to_string(i) + rest;
    if (names_.insert(name).second) return name;
  }
}

int TextureSet::remember(const std::string& key, ModelTexture texture) {
  texture.name = uniqueName(texture.name);
  all_.push_back(std::move(texture));
  return known_[key] = static_cast<int>(all_.size()) - 1;
}

int TextureSet::refuse(const std::string& key, const std::string& path, const std::string& why) {
  warnings_.push_back("the texture '" + path + "' is left out: " + why);
  return known_[key] = kNone;
}

int TextureSet::add(const std::string& path) {
  if (path.empty()) return kNone;
  const auto known = known_.find(path);
  if (known != known_.end()) return known->second;
  Result<std::string> bytes = load(path);
  if (!bytes.ok()) return refuse(path, path, bytes.error().message);
  const Result<ImageHeader> header = readImageHeader(*bytes);
  if (!header.ok()) return refuse(path, path, header.error().message);
  const bool jpeg = header.value().format == ImageFormat::Jpeg;
  const bool png = !jpeg;
  const bool large =
      longest_ > 0 && std::max(header.value().width, header.value().height) > longest_;
  if (large || (png && header.value().format != ImageFormat::Png)) {
    // Viewers read PNG and JPEG.
    Result<Image> image = fitted(decodeImage(*bytes));
    if (!image.ok()) return refuse(path, path, image.error().message);
    bytes = jpeg ? encodeJpeg(*image, kJpegQuality, false)
                 : encodePng(*image, header.value().hasAlpha ? 4 : 3);
    if (!bytes.ok()) return refuse(path, path, bytes.error().message);
  }
  // The name's extension is made to tell the truth.
  std::string name = plainName(path);
  const std::string extension = extensionOf(name);
  const bool honest = png ? extension == "png" : extension == "jpg" || extension == "jpeg";
  if (!honest) name = stemOf(name) + (png ? ".png" : ".jpg");
  return remember(
      path, {name, png ? "image/png" : "image/jpeg", std::move(*bytes), header.value().hasAlpha});
}

Result<TextureSet::Layer> TextureSet::readLayer(const std::string& path) const {
  if (path.empty()) return Layer{{1, 1, {255, 255, 255, 255}}, false};
  Result<std::string> bytes = load(path);
  if (!bytes.ok()) return bytes.error();
  Result<Image> image = fitted(decodeImage(*bytes));
  if (!image.ok()) return image.error();
  return Layer{std::move(*image), readImageHeader(*bytes).value().hasAlpha};
}

int TextureSet::addColorWithOpacity(const std::string& color, const std::string& opacity) {
  if (color == opacity) return add(color);
  const std::string key = color + "\n" + opacity;
  const auto known = known_.find(key);
  if (known != known_.end()) return known->second;
  Result<Layer> base = readLayer(color), cover = readLayer(opacity);
  if (!base.ok()) return refuse(key, color, base.error().message);
  if (!cover.ok()) return refuse(key, opacity, cover.error().message);
  const bool alpha = cover->hasAlpha;
  const Image both =
      mixed(base->image, cover->image, [&](const uint8_t* c, const uint8_t* o, uint8_t* out) {
        std::copy(c, c + 3, out);
        out[3] = alpha ? o[3] : o[0];
      });
  Result<std::string> png = encodePng(both, 4);
  if (!png.ok()) return refuse(key, color, png.error().message);
  const std::string name = stemOf(plainName(color.empty() ? opacity : color)) + "-alpha.png";
  return remember(key, {name, "image/png", std::move(*png), true});
}

int TextureSet::addMetallicRoughness(const std::string& roughness, const std::string& metallic) {
  if (roughness == metallic) return add(roughness);
  const std::string key = roughness + "\r" + metallic;
  const auto known = known_.find(key);
  if (known != known_.end()) return known->second;
  Result<Layer> rough = readLayer(roughness), metal = readLayer(metallic);
  if (!rough.ok()) return refuse(key, roughness, rough.error().message);
  if (!metal.ok()) return refuse(key, metallic, metal.error().message);
  const Image both =
      mixed(rough->image, metal->image, [](const uint8_t* r, const uint8_t* m, uint8_t* out) {
        out[0] = 255;
        out[1] = r[1];
        out[2] = m[2];
        out[3] = 255;
      });
  Result<std::string> png = encodePng(both, 3);
  if (!png.ok()) return refuse(key, roughness, png.error().message);
  const std::string name =
      stemOf(plainName(roughness.empty() ? metallic : roughness)) + "-metal-rough.png";
  return remember(key, {name, "image/png", std::move(*png), false});
}

}  // namespace gable
