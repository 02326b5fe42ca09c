// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Small TIFF files of heights, little-endian and uncompressed, for tests.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

namespace gable {

struct TiffSample {
  enum class Kind : uint8_t { Float, Int16 } kind = Kind::Float;
  bool tiled = false;
  uint32_t width = 0, height = 0;
  /// In place of the true ones, where they are set.
  uint32_t claimedWidth = 0, claimedHeight = 0;
  std::vector<double> values, pixelScale, tiepoints;
  std::vector<uint16_t> geoKeys;
  std::string noData;
};

namespace tiff_sample {

template <class T>
void put(std::string& out, T v) {
  char bytes[sizeof v];
  std::memcpy(bytes, &v, sizeof v);
  out.append(bytes, sizeof v);
}

inline void putHeight(std::string& out, const TiffSample& s, double v) {
  if (s.kind == TiffSample::Kind::Float) {
    put(out, static_cast<float>(v));
  } else {
    put(out, static_cast<int16_t>(v));
  }
}

}  // namespace tiff_sample

inline std::string tiffOf(const TiffSample& s) {
  using tiff_sample::put;
  const uint32_t size = s.kind == TiffSample::Kind::Float ? 4 : 2;
  std::string out = "II*";
  out.append(5, '\0');
  const uint32_t tile = 16;
  const auto first = static_cast<uint32_t>(out.size());
  for (uint32_t r = 0; r < (s.tiled ? tile : s.height); ++r) {
    for (uint32_t c = 0; c < (s.tiled ? tile : s.width); ++c) {
      const bool inside = r < s.height && c < s.width;
      tiff_sample::putHeight(out, s, inside ? s.values[r * s.width + c] : 0);
    }
  }
  const auto bytes = static_cast<uint32_t>(out.size()) - first;
  struct Entry {
    uint16_t type;
    uint32_t count, value;
  };
  std::map<uint16_t, Entry> tags;
  tags[256] = {4, 1, s.claimedWidth ? s.claimedWidth : s.width};
  tags[257] = {4, 1, s.claimedHeight ? s.claimedHeight : s.height};
  tags[258] = {3, 1, size * 8};
  tags[259] = {3, 1, 1};
  tags[262] = {3, 1, 1};
  tags[277] = {3, 1, 1};
  tags[339] = {3, 1, s.kind == TiffSample::Kind::Float ? 3u : 2u};
  if (s.tiled) {
    tags[322] = tags[323] = {3, 1, tile};
    tags[324] = {4, 1, first};
    tags[325] = {4, 1, bytes};
  } else {
    tags[273] = {4, 1, first};
    tags[278] = {4, 1, s.height};
    tags[279] = {4, 1, bytes};
  }
  const auto putList = [&](uint16_t tag, uint16_t type, const auto& list) {
    if (list.empty()) return;
    tags[tag] = {type, static_cast<uint32_t>(list.size()), static_cast<uint32_t>(out.size())};
    for (const auto v : list) put(out, v);
    if (out.size() % 2) out += '\0';
  };
  putList(33550, 12, s.pixelScale);
  putList(33922, 12, s.tiepoints);
  putList(34735, 3, s.geoKeys);
  if (!s.noData.empty()) {
    std::string text = s.noData;
    text += '\0';
    putList(42113, 2, text);
  }
  const auto directory = static_cast<uint32_t>(out.size());
  std::memcpy(out.data() + 4, &directory, 4);
  put(out, static_cast<uint16_t>(tags.size()));
  for (const auto& [tag, e] : tags) {
    put(out, tag);
    put(out, e.type);
    put(out, e.count);
    put(out, e.value);
  }
  put(out, uint32_t{0});
  return out;
}

}  // namespace gable
