// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// gable-convert fbx|dae    reads a model from standard input and writes it as OBJ
// gable-convert buffers    unpacks compressed buffers of a glTF file, one after the other
//
// gable calls it for what libraries read that may end the program on a broken file, so they run in
// a process of its own, which limits its memory and time and opens no file.
//
// A buffer comes as five words (kind, count, stride, filter, size) and its bytes, and goes as one
// word, the size of what it holds, and that. The kinds are 0 for Draco and those of Meshopt.

#include <exception>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "../limit_self.h"
#include "jobs.h"

namespace {

constexpr OwnLimits kLimits{rlim_t{4} << 30, 50};

// In the place of a size: the buffer is broken, or this program is built without its library.
constexpr uint32_t kBroken = 0xffffffff, kNotBuilt = 0xfffffffe;
constexpr uint32_t kDraco = 0;

std::string oneLine(const char* text) {
  std::string out = text;
  for (char& c : out) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  return out;
}

class Words {
 public:
  explicit Words(std::string_view bytes) : rest_(bytes) {}
  bool atEnd() const { return rest_.empty(); }
  uint32_t word() {
    const std::string_view four = bytes(4);
    uint32_t v = 0;
    for (size_t i = 4; i-- > 0;) v = v << 8 | static_cast<unsigned char>(four[i]);
    return v;
  }
  std::string_view bytes(size_t n) {
    if (n > rest_.size()) throw std::runtime_error("a buffer is cut off");
    const std::string_view out = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return out;
  }

 private:
  std::string_view rest_;
};

struct Buffer {
  uint32_t kind, count, stride, filter;
  std::string_view bytes;
};

// The size of what a buffer holds, or what is wrong with it.
uint32_t unpack(const Buffer& b, std::string& out) {
  bool ok = false;
  try {
    if (b.kind == kDraco) {
#ifdef GABLE_DRACO
      ok = unpackDraco(b.bytes, out);
#else
      return kNotBuilt;
#endif
    } else {
#ifdef GABLE_MESHOPT
      ok = unpackMeshopt(static_cast<Meshopt>(b.kind), b.count, b.stride,
                         static_cast<MeshoptFilter>(b.filter), b.bytes, out);
#else
      return kNotBuilt;
#endif
    }
  } catch (const std::exception&) {
    return kBroken;
  }
  return ok && out.size() < kNotBuilt ? static_cast<uint32_t>(out.size()) : kBroken;
}

void unpackAll(std::string_view input) {
  Words words(input);
  while (!words.atEnd()) {
    Buffer b{words.word(), words.word(), words.word(), words.word(), {}};
    b.bytes = words.bytes(words.word());
    std::string out, head;
    const uint32_t size = unpack(b, out);
    if (size == kBroken || size == kNotBuilt) out.clear();
    putWord(head, size);
    std::cout << head << out;
  }
}

void run(const std::string& format, const std::string& bytes) {
  if (format == "buffers") return unpackAll(bytes);
#ifdef GABLE_ASSIMP
  std::cout << modelAsObj(format, bytes);
#else
  throw std::runtime_error("gable-convert is built without Assimp (libassimp-dev)");
#endif
}

int fail(const char* why) {
  std::cout << oneLine(why);
  return 1;
}

}  // namespace

void putWord(std::string& out, uint32_t v) {
  for (int i = 0; i < 4; ++i, v >>= 8) out += static_cast<char>(v & 0xff);
}

int main(int argc, char** argv) {
  const std::string format = argc == 2 ? argv[1] : "";
  if (format != "fbx" && format != "dae" && format != "buffers") {
    return fail("usage: gable-convert fbx|dae|buffers");
  }
  limitSelf(kLimits);
  try {
    std::ios::sync_with_stdio(false);
    const std::string bytes{std::istreambuf_iterator<char>(std::cin), {}};
    run(format, bytes);
    std::cout.flush();
    return std::cout ? 0 : 1;
  } catch (const std::exception& e) {
    return fail(e.what());
  }
}
