// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Binary STL: an 80-byte head, the number of triangles, 50 bytes a triangle, little-endian.
#include <cmath>
#include <cstring>

#include "base/files.h"
#include "base/work.h"
#include "io/exporters/triangle_cache.h"
#include "io/exporters/write_model.h"

namespace gable {
namespace {

struct StlTriangle {
  float numbers[12];
};

bool fill(StlTriangle& t, const Vec3* p) {
  for (int i = 0; i < 3; ++i) {
    for (size_t k = 0; k < 3; ++k) t.numbers[3 + 3 * i + k] = static_cast<float>(p[i][k]);
  }
  const float* f = t.numbers + 3;
  const Vec3 a{f[0], f[1], f[2]}, b{f[3], f[4], f[5]}, c{f[6], f[7], f[8]};
  const Vec3 n = cross(b - a, c - a);
  // Also false for what is not finite.
  if (!(dot(n, n) > 0) || !isFinite(a) || !isFinite(b) || !isFinite(c)) return false;
  const Vec3 unit = normalized(n);
  for (size_t k = 0; k < 3; ++k) t.numbers[k] = static_cast<float>(unit[k]);
  return true;
}

class StlWriter {
 public:
  StlWriter(const Scene& scene, const std::string& path)
      : scene_(scene), out_(path), triangles_(scene) {}

  void add(const Leaf& leaf, const Frame& world) {
    const Mesh& m = *scene_.meshes[leaf.mesh];
    const MeshTriangles& t = triangles_.of(leaf.mesh);
    work(m.corners.size());
    placed_.resize(m.positions.size());
    for (size_t i = 0; i < placed_.size(); ++i) {
      placed_[i] = world.point(scaled(m.positions[i], leaf.scale));
    }
    const bool mirrors = ((leaf.scale.x < 0) != (leaf.scale.y < 0)) != (leaf.scale.z < 0);
    for (const auto& tri : t.triangles) {
      const Vec3 p[3] = {placed_[m.corners[tri[0]]], placed_[m.corners[tri[mirrors ? 2 : 1]]],
                         placed_[m.corners[tri[mirrors ? 1 : 2]]]};
      StlTriangle out;
      if (!fill(out, p)) continue;
      char* at = out_.reserve(50);
      std::memcpy(at, out.numbers, 48);
      std::memset(at + 48, 0, 2);
      out_.advance(50);
      ++count_;
    }
  }

  Result<WriteReport> write(const std::string& path) {
    char head[84] = "binary STL written by Gable";
    out_.append(head, sizeof head);
    forEachLeaf(scene_, [&](const Leaf& leaf, const Frame& world) {
      if (count_ <= kMost && !out_.failed()) add(leaf, world);
    });
    if (count_ > kMost) {
      return Error{"model-too-large", "'" + path + "' would have more triangles than STL can count",
                   "write .glb, or generate fewer shapes at a time"};
    }
    const auto count = static_cast<uint32_t>(count_);
    out_.patch(80, &count, sizeof count);
    const Result<uint64_t> bytes = out_.finish();
    if (!bytes.ok()) return bytes.error();
    WriteReport report;
    report.triangles = count_;
    report.bytes = bytes.value();
    report.files = {path};
    return report;
  }

 private:
  static constexpr uint64_t kMost = 0xffffffff;
  const Scene& scene_;
  FileWriter out_;
  TriangleCache triangles_;
  std::vector<Vec3> placed_;
  uint64_t count_ = 0;
};

}  // namespace

Result<WriteReport> writeStl(const Scene& scene, const std::string& path, const WriteOptions&) {
  return StlWriter(scene, path).write(path);
}

}  // namespace gable
