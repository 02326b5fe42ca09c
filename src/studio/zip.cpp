// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The zip format without compression: a header before each file, a directory behind all of them.

#include "studio/zip.h"

#include <array>
#include <cstdint>

namespace gable::studio {

namespace {

std::array<uint32_t, 256> crcTable() {
  std::array<uint32_t, 256> table{};
  for (uint32_t i = 0; i < 256; ++i) {
    uint32_t c = i;
    for (int k = 0; k < 8; ++k) c = (c & 1) != 0 ? 0xedb88320u ^ (c >> 1) : c >> 1;
    table[i] = c;
  }
  return table;
}

uint32_t crcOf(const std::string& bytes) {
  static const std::array<uint32_t, 256> kTable = crcTable();
  uint32_t c = 0xffffffffu;
  for (const char b : bytes) c = kTable[(c ^ static_cast<unsigned char>(b)) & 0xff] ^ (c >> 8);
  return c ^ 0xffffffffu;
}

void put16(std::string& out, uint32_t v) {
  out.push_back(static_cast<char>(v & 0xff));
  out.push_back(static_cast<char>((v >> 8) & 0xff));
}

void put32(std::string& out, uint64_t v) {
  put16(out, static_cast<uint32_t>(v & 0xffff));
  put16(out, static_cast<uint32_t>((v >> 16) & 0xffff));
}

// What a file's header and its entry in the directory share: version to name length.
void putFile(std::string& out, const std::string& name, const std::string& bytes, uint32_t crc) {
  constexpr uint32_t kVersion = 20, kUtf8Names = 1u << 11, kStored = 0;
  // The first day that the format knows: no clock comes into the bytes.
  constexpr uint32_t kTime = 0, kDate = 1 << 5 | 1;
  for (const uint32_t v : {kVersion, kUtf8Names, kStored, kTime, kDate}) put16(out, v);
  for (const uint64_t v : {uint64_t{crc}, uint64_t{bytes.size()}, uint64_t{bytes.size()}}) {
    put32(out, v);
  }
  put16(out, static_cast<uint32_t>(name.size()));
  put16(out, 0);
}

}  // namespace

std::string zipped(const std::vector<std::pair<std::string, std::string>>& files) {
  std::string out, directory;
  for (const auto& [name, bytes] : files) {
    const uint32_t crc = crcOf(bytes);
    const uint64_t at = out.size();
    out += "PK\x03\x04";
    putFile(out, name, bytes, crc);
    out += name + bytes;
    directory += "PK\x01\x02";
    put16(directory, 20);
    putFile(directory, name, bytes, crc);
    for (int i = 0; i < 3; ++i) put16(directory, 0);
    put32(directory, 0);
    put32(directory, at);
    directory += name;
  }
  const uint64_t start = out.size();
  const auto count = static_cast<uint32_t>(files.size());
  out += directory + "PK\x05\x06";
  for (const uint32_t v : {0u, 0u, count, count}) put16(out, v);
  put32(out, directory.size());
  put32(out, start);
  put16(out, 0);
  return out;
}

}  // namespace gable::studio
