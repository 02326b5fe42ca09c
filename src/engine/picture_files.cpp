// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "engine/picture_files.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/files.h"
#include "engine/impl.h"
#include "io/image/image.h"
#include "material/linear_light.h"

namespace gable {

size_t PictureFiles::pixels() const {
  return static_cast<size_t>(picture_.width) * static_cast<size_t>(picture_.height);
}

void PictureFiles::write(const std::string& name, const Result<std::string>& bytes) {
  if (!out_.diagnostics.empty()) return;
  if (!bytes.ok()) {
    out_.diagnostics.push_back(diagnosticOf(bytes.error()));
    return;
  }
  const Result<uint64_t> written = writeFile(folder_ + name, bytes.value());
  if (written.ok())
    out_.bytes += written.value();
  else
    out_.diagnostics.push_back(diagnosticOf(written.error()));
}

NumberImage PictureFiles::image(int channels, int bits) const {
  NumberImage n;
  n.width = static_cast<uint32_t>(picture_.width);
  n.height = static_cast<uint32_t>(picture_.height);
  n.channels = channels;
  n.bits = bits;
  n.numbers.resize(pixels() * static_cast<size_t>(channels));
  return n;
}

void PictureFiles::writeColors(const std::string& name) {
  write(name, encodePng({static_cast<uint32_t>(picture_.width),
                         static_cast<uint32_t>(picture_.height), picture_.rgba},
                        3, 3));
}

void PictureFiles::writeFloats(const std::string& name, const std::vector<float>& values) {
  std::string bytes =
      "Pf\n" + std::to_string(picture_.width) + " " + std::to_string(picture_.height) + "\n-1.0\n";
  const size_t width = static_cast<size_t>(picture_.width);
  size_t at = bytes.size();
  bytes.resize(at + 4 * values.size());
  for (size_t y = static_cast<size_t>(picture_.height); y-- > 0;) {
    for (size_t x = 0; x < width; ++x) {
      const uint32_t word = std::bit_cast<uint32_t>(values[y * width + x]);
      for (int k = 0; k < 4; ++k) bytes[at++] = static_cast<char>(word >> (8 * k) & 0xff);
    }
  }
  write(name, bytes);
}

void PictureFiles::writeCentimetres(const std::string& name, const std::vector<float>& metres) {
  NumberImage n = image(1, 16);
  for (size_t i = 0; i < n.numbers.size(); ++i) {
    const float centimetres = std::round(metres[i] * 100);
    n.numbers[i] = static_cast<uint16_t>(std::min(65535.0f, std::max(0.0f, centimetres)));
  }
  write(name, encodePng(n, level_));
}

void PictureFiles::writeNormals(const std::string& name) {
  NumberImage n = image(3, 16);
  for (size_t i = 0; i < n.numbers.size(); ++i) {
    const float share = (picture_.layers.normals[i] + 1) / 2;
    n.numbers[i] =
        static_cast<uint16_t>(std::lround(std::min(1.0f, std::max(0.0f, share)) * 65535));
  }
  write(name, encodePng(n, level_));
}

namespace {

// sRGB of linear light by steps so fine that no byte is more than one off where colours are dark,
// and none elsewhere; a call of pow for each would take longer than the picture's own file.
class SrgbBytes {
 public:
  SrgbBytes() {
    for (size_t i = 0; i < bytes_.size(); ++i) {
      const double v = static_cast<double>(i) / (kSteps * kSteps) * static_cast<double>(i);
      bytes_[i] = static_cast<uint8_t>(std::lround(255 * srgbOf(v)));
    }
  }
  uint8_t of(float linear) const {
    const float v = std::sqrt(std::min(1.0f, std::max(0.0f, linear)));
    return bytes_[static_cast<size_t>(v * kSteps + 0.5f)];
  }

 private:
  static constexpr size_t kSteps = 4096;
  std::array<uint8_t, kSteps + 1> bytes_;
};

}  // namespace

void PictureFiles::writeAlbedo(const std::string& name) {
  Image rgba{static_cast<uint32_t>(picture_.width), static_cast<uint32_t>(picture_.height), {}};
  rgba.rgba.assign(pixels() * 4, 255);
  static const SrgbBytes srgb;
  for (size_t i = 0; i < pixels(); ++i) {
    for (size_t k = 0; k < 3; ++k) {
      rgba.rgba[4 * i + k] = srgb.of(picture_.layers.albedo[3 * i + k]);
    }
  }
  write(name, encodePng(rgba, 3, level_));
}

void PictureFiles::writeNumbers(const std::string& name, const std::vector<uint32_t>& numbers) {
  NumberImage n = image(3, 8);
  for (size_t i = 0; i < pixels(); ++i) {
    for (size_t k = 0; k < 3; ++k) {
      n.numbers[3 * i + k] = static_cast<uint16_t>(numbers[i] >> (8 * k) & 0xff);
    }
  }
  write(name, encodePng(n, level_));
}

WriteResult PictureFiles::result() const {
  WriteResult out = out_;
  out.ok = out.diagnostics.empty();
  return out;
}

void writeCamera(JsonWriter& w, const PictureData& picture) {
  const auto numbers = [&w](const char* name, const Triple& t) {
    w.key(name).beginArray().value(t[0]).value(t[1]).value(t[2]).endArray();
  };
  const PictureData::Pose& p = picture.pose;
  w.field("width", picture.width).field("height", picture.height);
  w.key("camera").beginObject();
  numbers("eye", p.eye);
  numbers("right", p.right);
  numbers("up", p.up);
  numbers("forward", p.forward);
  w.field("halfWidth", p.halfWidth).field("horizon", p.horizon).field("parallel", p.parallel);
  w.endObject();
  w.key("sun").beginObject();
  w.field("elevation", picture.sun.elevation).field("azimuth", picture.sun.azimuth).endObject();
}

}  // namespace gable
