// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/gltf_compression.h"

#include <bit>

#include "base/child_process.h"
#include "base/work.h"
#include "io/importers/converted.h"

namespace gable {
namespace {

constexpr uint32_t kBroken = 0xffffffff, kNotBuilt = 0xfffffffe;

void putWord(std::string& out, uint32_t v) {
  for (int i = 0; i < 4; ++i, v >>= 8) out += static_cast<char>(v & 0xff);
}

// Reads words, the lowest byte first; from the end on there are zeros, and `cutOff` is set.
struct WordReader {
  std::string_view rest;
  bool cutOff = false;

  uint32_t word() {
    if (rest.size() < 4) {
      cutOff = true;
      return 0;
    }
    uint32_t v = 0;
    for (size_t i = 4; i-- > 0;) v = v << 8 | static_cast<unsigned char>(rest[i]);
    rest.remove_prefix(4);
    return v;
  }
  // Whether so many words are left.
  bool has(uint64_t words) const { return words <= rest.size() / 4; }
};

Error notBuilt(const std::string& path) {
  return {
      "asset-converter",
      "'" + path +
          "' is compressed, which needs the program gable-convert with Draco and meshoptimizer",
      "install libdraco-dev and libmeshoptimizer-dev and build again, or save the model without "
      "compression"};
}

}  // namespace

Result<std::vector<std::string>> unpackBuffers(const std::vector<PackedBuffer>& buffers,
                                               const std::string& path) {
  std::vector<std::string> out;
  if (buffers.empty()) return out;
  const std::string program = programBeside("gable-convert");
  if (program.empty()) return notBuilt(path);
  std::string input;
  for (const PackedBuffer& b : buffers) {
    workMemory(b.bytes.size());
    for (const uint32_t v : {uint32_t{b.kind}, b.count, b.stride, uint32_t{b.filter},
                             static_cast<uint32_t>(b.bytes.size())}) {
      putWord(input, v);
    }
    input += b.bytes;
  }
  const Result<std::string> made = runChild(program, {"buffers"}, input, {});
  if (!made.ok()) return converterFailed(made.error(), path);
  WordReader words{made.value()};
  for (size_t i = 0; i < buffers.size(); ++i) {
    const uint32_t size = words.word();
    if (size == kNotBuilt) return notBuilt(path);
    out.emplace_back();
    if (size == kBroken || words.cutOff || size > words.rest.size()) continue;
    out.back() = words.rest.substr(0, size);
    words.rest.remove_prefix(size);
  }
  return out;
}

bool readDracoMesh(std::string_view unpacked, DracoMesh& out) {
  WordReader words{unpacked};
  const uint64_t points = words.word(), triangles = words.word();
  if (!words.has(3 * triangles)) return false;
  for (uint64_t i = 0; i < 3 * triangles; ++i) {
    work();
    out.indices.push_back(words.word());
  }
  const uint32_t attributes = words.word();
  for (uint32_t a = 0; a < attributes; ++a) {
    const uint32_t id = words.word();
    DracoMesh::Attribute& to = out.attributes[id];
    to.components = words.word();
    if (to.components == 0 || to.components > 4 || !words.has(points * to.components)) return false;
    to.numbers.clear();
    for (uint64_t i = 0; i < points * to.components; ++i) {
      work();
      to.numbers.push_back(std::bit_cast<float>(words.word()));
    }
  }
  return !words.cutOff;
}

}  // namespace gable
