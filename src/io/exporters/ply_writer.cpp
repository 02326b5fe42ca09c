// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Binary PLY: all vertices with colours, then all faces as polygons. The scene is gone through
// twice, once for each, so that nothing is kept. The head holds the counts; its room is made up
// with a comment. Faces with holes, or with more corners than the one-byte count can say, become
// triangles.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/files.h"
#include "base/work.h"
#include "io/exporters/triangle_cache.h"
#include "io/exporters/write_model.h"
#include "scene/flatten.h"

namespace gable {
namespace {

constexpr size_t kHeadRoom = 512;
constexpr uint32_t kMostCorners = 255;
// Beyond, single precision is coarser than a millimetre.
constexpr double kSingleReach = 8192;

class PlyWriter {
 public:
  PlyWriter(const Scene& scene, const std::string& path)
      : scene_(scene), path_(path), out_(path), triangles_(scene) {}

  Result<WriteReport> write();

 private:
  struct Rgba {
    uint8_t c[4];
  };
  Rgba colorOf(const Leaf& leaf, uint32_t slot) const;
  static bool manySlots(const Mesh& m);
  void place(const Leaf& leaf, const Frame& world);
  bool hasArea(const uint32_t* positions, size_t count) const;
  void putVertex(const Vec3& p, const Rgba& color);
  void addVertices(const Leaf& leaf, const Frame& world);
  void addFaces(const Leaf& leaf, const Frame& world);
  void putFace(const Mesh& m, const uint32_t* corners, size_t count, bool byCorner, bool turn);
  void putHead();

  const Scene& scene_;
  std::string path_;
  FileWriter out_;
  TriangleCache triangles_;
  bool wide_ = false;
  // Coordinates of the leaf at hand, as they are written.
  std::vector<Vec3> placed_;
  std::vector<uint32_t> scratch_;
  uint64_t vertices_ = 0, faces_ = 0, triangleCount_ = 0, base_ = 0;
};

PlyWriter::Rgba PlyWriter::colorOf(const Leaf& leaf, uint32_t slot) const {
  const Material& m = materialOf(scene_, leaf, slot);
  const auto byte = [](double v) {
    return static_cast<uint8_t>(std::lround(std::min(std::max(v, 0.0), 1.0) * 255));
  };
  return {{byte(m.color.x), byte(m.color.y), byte(m.color.z), byte(m.opacity)}};
}

// Such meshes have vertices by corner, so that each has one colour.
bool PlyWriter::manySlots(const Mesh& m) {
  for (const MeshFace& f : m.faces) {
    if (f.materialSlot != m.faces[0].materialSlot) return true;
  }
  return false;
}

void PlyWriter::place(const Leaf& leaf, const Frame& world) {
  const Mesh& m = *scene_.meshes[leaf.mesh];
  work(m.corners.size());
  placed_.resize(m.positions.size());
  for (size_t i = 0; i < placed_.size(); ++i) {
    Vec3 p = world.point(scaled(m.positions[i], leaf.scale));
    if (!wide_) {
      p = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    }
    placed_[i] = p;
  }
}

bool PlyWriter::hasArea(const uint32_t* positions, size_t count) const {
  Vec3 sum;
  const Vec3 o = placed_[positions[0]];
  for (size_t i = 1; i + 1 < count; ++i) {
    sum += cross(placed_[positions[i]] - o, placed_[positions[i + 1]] - o);
  }
  return dot(sum, sum) > 0 && isFinite(sum);
}

void PlyWriter::putVertex(const Vec3& p, const Rgba& color) {
  char* at = out_.reserve(28);
  // What is not finite belongs to no face; it is written as the origin.
  const Vec3 q = isFinite(p) ? p : Vec3{};
  if (wide_) {
    std::memcpy(at, &q, 24);
    at += 24;
  } else {
    const float f[3] = {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)};
    std::memcpy(at, f, 12);
    at += 12;
  }
  std::memcpy(at, color.c, 4);
  out_.advanceTo(at + 4);
  ++vertices_;
}

void PlyWriter::addVertices(const Leaf& leaf, const Frame& world) {
  place(leaf, world);
  const Mesh& m = *scene_.meshes[leaf.mesh];
  if (!manySlots(m)) {
    const Rgba color = colorOf(leaf, m.faces.empty() ? 0 : m.faces[0].materialSlot);
    for (const Vec3& p : placed_) putVertex(p, color);
    return;
  }
  std::vector<uint16_t> slots(m.corners.size());
  for (size_t f = 0; f < m.faceCount(); ++f) {
    for (const MeshLoop& l : m.loopsOf(f)) {
      std::fill_n(slots.begin() + l.firstCorner, l.cornerCount, m.faces[f].materialSlot);
    }
  }
  for (size_t c = 0; c < slots.size(); ++c) {
    putVertex(placed_[m.corners[c]], colorOf(leaf, slots[c]));
  }
}

void PlyWriter::putFace(const Mesh& m, const uint32_t* corners, size_t count, bool byCorner,
                        bool turn) {
  scratch_.resize(count);
  for (size_t i = 0; i < count; ++i) scratch_[i] = m.corners[corners[i]];
  if (!hasArea(scratch_.data(), count)) return;
  char* at = out_.reserve(1 + 4 * count);
  *at++ = static_cast<char>(count);
  for (size_t i = 0; i < count; ++i) {
    const size_t k = turn ? (count - i) % count : i;
    const auto index = static_cast<int32_t>(base_ + (byCorner ? corners[k] : scratch_[k]));
    std::memcpy(at, &index, 4);
    at += 4;
  }
  out_.advanceTo(at);
  ++faces_;
  triangleCount_ += count - 2;
}

void PlyWriter::addFaces(const Leaf& leaf, const Frame& world) {
  place(leaf, world);
  const Mesh& m = *scene_.meshes[leaf.mesh];
  const bool byCorner = manySlots(m);
  const bool turn = ((leaf.scale.x < 0) != (leaf.scale.y < 0)) != (leaf.scale.z < 0);
  std::vector<uint32_t> corners;
  for (size_t f = 0; f < m.faceCount(); ++f) {
    const auto loops = m.loopsOf(f);
    if (loops.size() == 1 && loops[0].cornerCount <= kMostCorners) {
      if (loops[0].cornerCount < 3) continue;
      corners.resize(loops[0].cornerCount);
      for (uint32_t i = 0; i < loops[0].cornerCount; ++i) corners[i] = loops[0].firstCorner + i;
      putFace(m, corners.data(), corners.size(), byCorner, turn);
      continue;
    }
    const MeshTriangles& t = triangles_.of(leaf.mesh);
    for (size_t i = f ? t.faceEnds[f - 1] : 0; i < t.faceEnds[f]; ++i) {
      putFace(m, t.triangles[i].data(), 3, byCorner, turn);
    }
  }
  base_ += byCorner ? m.corners.size() : m.positions.size();
}

void PlyWriter::putHead() {
  const std::string type = wide_ ? "double" : "float";
  std::string head =
      "ply\nformat binary_little_endian 1.0\ncomment written by Gable, metres, y up\n";
  head += "element vertex " + std::to_string(vertices_) + "\n";
  for (const char* axis : {"x", "y", "z"}) head += "property " + type + " " + axis + "\n";
  for (const char* c : {"red", "green", "blue", "alpha"}) {
    head += std::string("property uchar ") + c + "\n";
  }
  head += "element face " + std::to_string(faces_) + "\n";
  head += "property list uchar int vertex_indices\n";
  const std::string end = "end_header\n";
  head += "comment ";
  head.append(kHeadRoom - head.size() - end.size() - 1, '-');
  head += "\n" + end;
  out_.patch(0, head.data(), head.size());
}

Result<WriteReport> PlyWriter::write() {
  const SceneCounts counts = count(scene_);
  // Vertices by corner are at most six times as many as triangles.
  if (counts.vertices > 0x7fffffff || counts.triangles > 0x7fffffff / 3) {
    return Error{"model-too-large", "'" + path_ + "' would have more vertices than PLY can number",
                 "write .glb, or generate fewer shapes at a time"};
  }
  const Box3& b = counts.bounds;
  for (size_t i = 0; i < 3 && !b.empty(); ++i) {
    wide_ = wide_ || std::max(std::fabs(b.min[i]), std::fabs(b.max[i])) > kSingleReach;
  }
  out_.fill(' ', kHeadRoom);
  forEachLeaf(scene_, [&](const Leaf& leaf, const Frame& world) { addVertices(leaf, world); });
  forEachLeaf(scene_, [&](const Leaf& leaf, const Frame& world) { addFaces(leaf, world); });
  putHead();
  const Result<uint64_t> bytes = out_.finish();
  if (!bytes.ok()) return bytes.error();
  WriteReport report;
  report.triangles = triangleCount_;
  report.bytes = bytes.value();
  report.files = {path_};
  return report;
}

}  // namespace

Result<WriteReport> writePly(const Scene& scene, const std::string& path, const WriteOptions&) {
  return PlyWriter(scene, path).write();
}

}  // namespace gable
