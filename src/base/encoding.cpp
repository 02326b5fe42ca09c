// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Windows-1252 as the WHATWG Encoding Standard has it: the five bytes without a character are
// control characters of the same number.

#include "base/encoding.h"

#include <array>
#include <cstdint>

#include "base/text.h"

namespace gable {
namespace {

/// The characters of 0x80 to 0x9f; all other bytes are their own code points.
constexpr std::array<uint16_t, 32> kHighControls = {
    0x20ac, 0x81,   0x201a, 0x192,  0x201e, 0x2026, 0x2020, 0x2021, 0x2c6,  0x2030, 0x160,
    0x2039, 0x152,  0x8d,   0x17d,  0x8f,   0x90,   0x2018, 0x2019, 0x201c, 0x201d, 0x2022,
    0x2013, 0x2014, 0x2dc,  0x2122, 0x161,  0x203a, 0x153,  0x9d,   0x17e,  0x178};

std::string ofWindows1252(std::string_view bytes) {
  std::string out;
  out.reserve(bytes.size() + bytes.size() / 8);
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    appendUtf8(out, byte >= 0x80 && byte < 0xa0 ? kHighControls[byte - 0x80] : byte);
  }
  return out;
}

/// `first` is the place of the low byte in a unit: 0 for little-endian text.
std::string ofUtf16(std::string_view bytes, size_t low) {
  const auto unit = [&](size_t at) {
    const auto byte = [&](size_t i) { return static_cast<unsigned char>(bytes[i]); };
    return static_cast<uint32_t>(byte(at + low) | byte(at + 1 - low) << 8);
  };
  std::string out;
  for (size_t at = 0; at + 1 < bytes.size(); at += 2) {
    uint32_t c = unit(at);
    const bool leads = c >= 0xd800 && c < 0xdc00 && at + 3 < bytes.size();
    if (const uint32_t next = leads ? unit(at + 2) : 0; next >= 0xdc00 && next < 0xe000) {
      c = 0x10000 + ((c - 0xd800) << 10) + (next - 0xdc00);
      at += 2;
    }
    appendUtf8(out, c);
  }
  return out;
}

}  // namespace

bool isUtf8(std::string_view text) {
  for (size_t at = 0; at < text.size();) {
    const size_t length = utf8Length(text, at);
    if (length == 0) return false;
    at += length;
  }
  return true;
}

std::string utf8Of(std::string bytes) {
  const std::string_view all = bytes;
  if (all.starts_with("\xff\xfe")) return ofUtf16(all.substr(2), 0);
  if (all.starts_with("\xfe\xff")) return ofUtf16(all.substr(2), 1);
  return isUtf8(all) ? bytes : ofWindows1252(all);
}

}  // namespace gable
