// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A file by hard-coded loops: what a program that knows nothing but one workload needs.
//
//   bench_loops WORKLOAD FILE.glb|FILE.obj   writes the boxes of a workload of bench/workloads.h
//   bench_loops --lots WORKLOAD FILE.geojson writes its lots, for the rules
//   bench_loops --lots N FILE.geojson        lots of so many buildings of W2
//   bench_loops --list                       its workloads: name, rules, boxes
//
// Boxes are expanded into a buffer that stays in the cache, and written as soon as it is full. The
// head of a GLB needs the bounds of the vertices, so its place is kept and it is written last.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "scene/vertex_buffer.h"
#include "workloads.h"

using namespace gable;
using namespace gable::bench;

namespace {

constexpr size_t kBoxesAtOnce = 256, kVertices = 24, kIndices = 36, kHeadBytes = 1024;

class File {
 public:
  explicit File(const char* path) : file_(std::fopen(path, "wb")) {
    if (!file_) fail(path);
    std::setvbuf(file_, nullptr, _IONBF, 0);
  }
  ~File() {
    if (std::fclose(file_) != 0) fail("the file");
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  void write(const void* data, size_t bytes) {
    if (std::fwrite(data, 1, bytes, file_) != bytes) fail("the file");
  }
  void rewind() { std::rewind(file_); }

 private:
  [[noreturn]] static void fail(const char* what) {
    std::perror(what);
    std::exit(1);
  }
  std::FILE* file_;
};

void put32(std::string& out, uint32_t v) {
  out.append(reinterpret_cast<const char*>(&v), sizeof v);
}

void writeGlb(const Workload& w, File& file) {
  float least[3] = {1e30f, 1e30f, 1e30f}, most[3] = {-1e30f, -1e30f, -1e30f};
  VertexBuffer buffer;
  size_t boxes = 0;
  const auto flush = [&] {
    for (size_t v = 0; v < buffer.vertexCount(); ++v) {
      for (size_t a = 0; a < 3; ++a) {
        least[a] = std::min(least[a], buffer.vertices()[v].position[a]);
        most[a] = std::max(most[a], buffer.vertices()[v].position[a]);
      }
    }
    file.write(buffer.vertices(), buffer.vertexCount() * sizeof(BufferVertex));
    buffer.clear();
  };
  file.write(std::string(kHeadBytes, ' ').data(), kHeadBytes);
  boxesByLoops(w, [&](const Frame& axes, const Vec3& origin, const Vec3& size) {
    appendBox(axes, origin, size, buffer);
    ++boxes;
    if (buffer.vertexCount() == kBoxesAtOnce * kVertices) flush();
  });
  flush();
  appendBox({}, {}, {1, 1, 1}, buffer);
  const std::vector<uint32_t> pattern(buffer.indices(), buffer.indices() + kIndices);
  std::vector<uint32_t> indices;
  for (size_t b = 0; b < boxes; ++b) {
    for (const uint32_t i : pattern) indices.push_back(i + static_cast<uint32_t>(b * kVertices));
    if (indices.size() == kBoxesAtOnce * kIndices || b + 1 == boxes) {
      file.write(indices.data(), indices.size() * sizeof(uint32_t));
      indices.clear();
    }
  }
  const size_t vertexBytes = boxes * kVertices * sizeof(BufferVertex);
  const size_t bytes = vertexBytes + boxes * kIndices * sizeof(uint32_t);
  char json[kHeadBytes];
  // NOLINTNEXTLINE(cert-err33-c): the text fits, whatever the numbers.
  std::snprintf(
      json, sizeof json,
      "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{"
      "\"mesh\":0}],"
      "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_0\":2},"
      "\"indices\":3}]}],\"buffers\":[{\"byteLength\":%zu}],\"bufferViews\":[{\"buffer\":0,"
      "\"byteLength\":%zu,\"byteStride\":32,\"target\":34962},{\"buffer\":0,\"byteOffset\":%zu,"
      "\"byteLength\":%zu,\"target\":34963}],\"accessors\":[{\"bufferView\":0,\"componentType\":"
      "5126,"
      "\"count\":%zu,\"type\":\"VEC3\",\"min\":[%.9g,%.9g,%.9g],\"max\":[%.9g,%.9g,%.9g]},"
      "{\"bufferView\":0,\"byteOffset\":12,\"componentType\":5126,\"count\":%zu,\"type\":\"VEC3\"},"
      "{\"bufferView\":0,\"byteOffset\":24,\"componentType\":5126,\"count\":%zu,\"type\":\"VEC2\"},"
      "{\"bufferView\":1,\"componentType\":5125,\"count\":%zu,\"type\":\"SCALAR\"}]}",
      bytes, vertexBytes, vertexBytes, bytes - vertexBytes, boxes * kVertices,
      static_cast<double>(least[0]), static_cast<double>(least[1]), static_cast<double>(least[2]),
      static_cast<double>(most[0]), static_cast<double>(most[1]), static_cast<double>(most[2]),
      boxes * kVertices, boxes * kVertices, boxes * kIndices);
  std::string text = json;
  constexpr size_t kAround = 28;
  text.resize(kHeadBytes - kAround, ' ');
  std::string head = "glTF";
  put32(head, 2);
  put32(head, static_cast<uint32_t>(kHeadBytes + bytes));
  put32(head, static_cast<uint32_t>(text.size()));
  head += "JSON" + text;
  put32(head, static_cast<uint32_t>(bytes));
  head.append("BIN", 4);
  file.rewind();
  file.write(head.data(), head.size());
}

// With four decimals, as the prototypes of such writers have them.
void putNumber(std::string& out, double value) {
  auto n = static_cast<int64_t>(value * 10000 + (value < 0 ? -0.5 : 0.5));
  char digits[24];
  size_t at = sizeof digits;
  const bool negative = n < 0;
  if (negative) n = -n;
  for (int i = 0; i < 4; ++i, n /= 10) digits[--at] = static_cast<char>('0' + n % 10);
  digits[--at] = '.';
  do digits[--at] = static_cast<char>('0' + n % 10);
  while (n /= 10);
  if (negative) digits[--at] = '-';
  out.append(digits + at, sizeof digits - at);
}

void putWhole(std::string& out, size_t n) {
  char digits[24];
  size_t at = sizeof digits;
  do digits[--at] = static_cast<char>('0' + n % 10);
  while (n /= 10);
  out.append(digits + at, sizeof digits - at);
}

void writeObj(const Workload& w, File& file) {
  constexpr size_t kAtOnce = 1 << 18;
  constexpr int kFaces[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
  std::string out;
  out.reserve(kAtOnce + 4096);
  size_t boxes = 0;
  boxesByLoops(w, [&](const Frame& axes, const Vec3& origin, const Vec3& size) {
    for (int c = 0; c < 8; ++c) {
      const Vec3 p =
          origin + axes.direction({c & 4 ? size.x : 0, c & 2 ? size.y : 0, c & 1 ? size.z : 0});
      out += 'v';
      for (const double v : {p.x, p.y, p.z}) {
        out += ' ';
        putNumber(out, v);
      }
      out += '\n';
    }
    for (const auto& face : kFaces) {
      out += 'f';
      for (const int corner : face) {
        out += ' ';
        putWhole(out, boxes * 8 + static_cast<size_t>(corner) + 1);
      }
      out += '\n';
    }
    ++boxes;
    if (out.size() < kAtOnce) return;
    file.write(out.data(), out.size());
    out.clear();
  });
  file.write(out.data(), out.size());
}

void writeLots(const std::vector<Lot>& lots, File& file) {
  std::string out =
      R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:25832"}},"features":[)";
  for (size_t i = 0; i < lots.size(); ++i) {
    const Lot& l = lots[i];
    const double x = l.x, y = -l.z, x1 = l.x + l.w, y1 = y + l.d;
    char height[64] = "", text[512];
    // NOLINTBEGIN(cert-err33-c): the texts fit, whatever the numbers.
    if (l.height > 0) std::snprintf(height, sizeof height, "\"height\":%.17g", l.height);
    std::snprintf(
        text, sizeof text,
        "%s\n{\"type\":\"Feature\",\"properties\":{%s},\"geometry\":{\"type\":\"Polygon\","
        "\"coordinates\":[[[%.17g,%.17g],[%.17g,%.17g],[%.17g,%.17g],[%.17g,%.17g],"
        "[%.17g,%.17g]]]}}",
        i ? "," : "", height, x, y, x1, y, x1, y1, x, y1, x, y);
    // NOLINTEND(cert-err33-c)
    out += text;
  }
  out += "\n]}\n";
  file.write(out.data(), out.size());
}

int usage() {
  std::fputs(
      "bench_loops WORKLOAD FILE.glb|FILE.obj, bench_loops --lots WORKLOAD|N FILE.geojson, or "
      "bench_loops --list\n",
      stderr);
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<Workload> all = workloads();
  if (argc == 2 && std::strcmp(argv[1], "--list") == 0) {
    for (const Workload& w : all) std::printf("%s %s %zu\n", w.name, w.rules, w.boxes);
    return 0;
  }
  const bool lots = argc > 1 && std::strcmp(argv[1], "--lots") == 0;
  if (argc != (lots ? 4 : 3)) return usage();
  const std::string name = argv[argc - 2], path = argv[argc - 1];
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Workload& w) { return w.name == name; });
  if (lots) {
    const int count = std::atoi(name.c_str());
    if (found == all.end() && count < 1) return usage();
    File file(path.c_str());
    writeLots(found == all.end() ? houses(count) : found->lots, file);
    return 0;
  }
  if (found == all.end()) return usage();
  File file(path.c_str());
  if (path.ends_with(".glb"))
    writeGlb(*found, file);
  else if (path.ends_with(".obj"))
    writeObj(*found, file);
  else
    return usage();
  return 0;
}
