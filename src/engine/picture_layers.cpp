// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The layers of a picture as files. What a program reads back exactly is a float map (PFM) or has
// whole numbers; what a person looks at is a PNG.

#include <bit>
#include <cmath>
#include <filesystem>

#include "base/elementary.h"
#include "base/files.h"
#include "base/json.h"
#include "engine/guard.h"
#include "engine/impl.h"
#include "io/image/image.h"

namespace gable {

namespace {

struct LayerFiles {
  const PictureData& picture;
  std::string folder;
  WriteResult out;

  size_t pixels() const {
    return static_cast<size_t>(picture.width) * static_cast<size_t>(picture.height);
  }

  void write(const char* name, const Result<std::string>& bytes) {
    if (!out.diagnostics.empty()) return;
    if (!bytes.ok()) {
      out.diagnostics.push_back(diagnosticOf(bytes.error()));
      return;
    }
    const Result<uint64_t> written = writeFile(folder + name, bytes.value());
    if (written.ok())
      out.bytes += written.value();
    else
      out.diagnostics.push_back(diagnosticOf(written.error()));
  }

  NumberImage image(int channels, int bits) const {
    NumberImage n;
    n.width = static_cast<uint32_t>(picture.width);
    n.height = static_cast<uint32_t>(picture.height);
    n.channels = channels;
    n.bits = bits;
    n.numbers.resize(pixels() * static_cast<size_t>(channels));
    return n;
  }

  // One float a pixel, rows from below, the low byte first.
  void writeFloats(const char* name, const std::vector<float>& values) {
    std::string bytes =
        "Pf\n" + std::to_string(picture.width) + " " + std::to_string(picture.height) + "\n-1.0\n";
    const size_t width = static_cast<size_t>(picture.width);
    for (size_t y = static_cast<size_t>(picture.height); y-- > 0;) {
      for (size_t x = 0; x < width; ++x) {
        const uint32_t word = std::bit_cast<uint32_t>(values[y * width + x]);
        for (int k = 0; k < 4; ++k) bytes += static_cast<char>(word >> (8 * k) & 0xff);
      }
    }
    write(name, bytes);
  }

  void writeDepth() {
    writeFloats("depth.pfm", picture.layers.depth);
    NumberImage n = image(1, 16);
    for (size_t i = 0; i < n.numbers.size(); ++i) {
      const float centimetres = std::round(picture.layers.depth[i] * 100);
      n.numbers[i] = static_cast<uint16_t>(std::min(65535.0f, std::max(0.0f, centimetres)));
    }
    write("depth.png", encodePng(n));
  }

  void writeNormals() {
    NumberImage n = image(3, 16);
    for (size_t i = 0; i < n.numbers.size(); ++i) {
      const float share = (picture.layers.normals[i] + 1) / 2;
      n.numbers[i] =
          static_cast<uint16_t>(std::lround(std::min(1.0f, std::max(0.0f, share)) * 65535));
    }
    write("normal.png", encodePng(n));
  }

  void writeAlbedo() {
    Image rgba{static_cast<uint32_t>(picture.width), static_cast<uint32_t>(picture.height), {}};
    rgba.rgba.assign(pixels() * 4, 255);
    for (size_t i = 0; i < pixels(); ++i) {
      for (size_t k = 0; k < 3; ++k) {
        const double v = std::min(1.0f, std::max(0.0f, picture.layers.albedo[3 * i + k]));
        const double srgb = v <= 0.0031308 ? 12.92 * v : 1.055 * powOf(v, 1 / 2.4) - 0.055;
        rgba.rgba[4 * i + k] = static_cast<uint8_t>(std::lround(255 * srgb));
      }
    }
    write("albedo.png", encodePng(rgba, 3));
  }

  void writeNumbers(const char* name, const std::vector<uint32_t>& ids) {
    NumberImage n = image(3, 8);
    for (size_t i = 0; i < pixels(); ++i) {
      for (size_t k = 0; k < 3; ++k) {
        n.numbers[3 * i + k] = static_cast<uint16_t>(ids[i] >> (8 * k) & 0xff);
      }
    }
    write(name, encodePng(n));
  }

  void writeNames() {
    std::string text;
    JsonWriter w(text, 2);
    const auto numbers = [&w](const char* name, const Triple& t) {
      w.key(name).beginArray().value(t[0]).value(t[1]).value(t[2]).endArray();
    };
    const auto names = [&w](const char* name, const std::vector<std::string>& list) {
      w.key(name).beginArray();
      for (const std::string& each : list) w.value(each);
      w.endArray();
    };
    const PictureData::Pose& p = picture.pose;
    w.beginObject().field("width", picture.width).field("height", picture.height);
    w.key("camera").beginObject();
    numbers("eye", p.eye);
    numbers("right", p.right);
    numbers("up", p.up);
    numbers("forward", p.forward);
    w.field("halfWidth", p.halfWidth).field("horizon", p.horizon).field("parallel", p.parallel);
    w.endObject();
    w.key("sun").beginObject();
    w.field("elevation", picture.sun.elevation).field("azimuth", picture.sun.azimuth).endObject();
    names("objects", picture.layers.objectNames);
    names("rules", picture.layers.ruleNames);
    names("materials", picture.layers.materialNames);
    w.endObject();
    write("layers.json", text + "\n");
  }
};

}  // namespace

WriteResult writePicture(const PictureData& picture, const std::string& path) {
  return guardedResult<WriteResult>([&] {
    LayerFiles files{picture, "", {}};
    files.write(path.c_str(), encodePng({static_cast<uint32_t>(picture.width),
                                         static_cast<uint32_t>(picture.height), picture.rgba},
                                        3, 3));
    files.out.ok = files.out.diagnostics.empty();
    return files.out;
  });
}

WriteResult writePictureLayers(const PictureData& picture, const std::string& folder) {
  return guardedResult<WriteResult>([&] {
    LayerFiles files{picture, folder, {}};
    if (!files.folder.empty() && files.folder.back() != '/') files.folder += '/';
    const PictureLayers& l = picture.layers;
    if (files.pixels() == 0 || l.depth.size() != files.pixels()) {
      files.out.diagnostics.push_back(
          diagnosticOf(Error{"picture-layers", "the picture has no layers",
                             "draw it with PictureSettings::layers set"}));
      return files.out;
    }
    std::error_code code;
    std::filesystem::create_directories(folder, code);
    files.writeDepth();
    files.writeNormals();
    files.writeAlbedo();
    files.writeNumbers("object.png", l.objects);
    files.writeNumbers("instance.png", l.instances);
    files.writeNumbers("rule.png", l.rules);
    files.writeNumbers("material.png", l.materials);
    files.writeNames();
    files.out.ok = files.out.diagnostics.empty();
    return files.out;
  });
}

}  // namespace gable
