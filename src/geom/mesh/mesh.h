// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Mesh: polygons with holes over shared positions; the geometry of a shape that is no primitive.
//
// A face is a list of loops, the outer one first, holes after it; a loop is a run of corners; a
// corner names a position and carries the uv coordinates of up to ten sets, an optional normal and
// the tags of the edge that starts at it. Seen from the face's normal side the outer loop is
// counter-clockwise and holes are clockwise. Vertices, which are positions, may have tags as well.
// Units are metres, the frame is the owner's. A face of one loop with two corners stands for an
// edge and with one corner for a point (component splits make such shapes).
//
// Tags and materials are opaque numbers here: the folders above give them their meaning.
// A Mesh never changes once it is shared (MeshRef); build one with MeshBuilder or edit a copy.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "base/ref.h"
#include "math/box.h"
#include "math/frame.h"
#include "math/vec.h"

namespace gable {

constexpr int kUvSets = 10;

struct MeshLoop {
  uint32_t firstCorner = 0;
  uint32_t cornerCount = 0;
};

struct MeshFace {
  uint32_t firstLoop = 0;
  uint32_t loopCount = 0;
  /// Slot of the owner's material list: 0 is the shape's own material.
  uint16_t materialSlot = 0;
  /// True when corners without normals are to be lit smoothly across edges.
  bool smooth = false;
  /// An interned tag set, 0 for none.
  uint32_t tags = 0;
};

/// A hash that is computed once; copies of the owner compute their own.
class CachedHash {
 public:
  CachedHash() = default;
  CachedHash(const CachedHash&) {}
  CachedHash& operator=(const CachedHash&) {
    value_.store(0, std::memory_order_relaxed);
    return *this;
  }
  template <class Compute>
  uint64_t get(Compute&& compute) const {
    uint64_t v = value_.load(std::memory_order_relaxed);
    if (v == 0) value_.store(v = compute(), std::memory_order_relaxed);
    return v;
  }

 private:
  mutable std::atomic<uint64_t> value_{0};
};

class Mesh : public RefCounted {
 public:
  std::vector<Vec3> positions;
  std::vector<MeshFace> faces;
  std::vector<MeshLoop> loops;
  std::vector<uint32_t> corners;
  /// Each either empty or as long as corners.
  std::array<std::vector<Vec2>, kUvSets> uvs;
  /// More sets of the same kind, which rules do not see: what operations note of corners while they
  /// wait for others (mesh/origins.h). Cuts and copies keep them as they keep uv coordinates.
  std::vector<std::vector<Vec2>> notes;
  std::vector<Vec3> normals;
  std::vector<uint32_t> edgeTags;
  /// By position, and no longer than positions: those beyond its end have none.
  std::vector<uint32_t> vertexTags;

  bool empty() const { return faces.empty(); }
  size_t faceCount() const { return faces.size(); }
  /// The uv sets, and the notes as the sets behind them.
  int setCount() const { return kUvSets + static_cast<int>(notes.size()); }
  const std::vector<Vec2>& set(int s) const {
    const auto i = static_cast<size_t>(s);
    return i < kUvSets ? uvs[i] : notes[i - kUvSets];
  }
  std::vector<Vec2>& set(int s) {
    const auto i = static_cast<size_t>(s);
    return i < kUvSets ? uvs[i] : notes[i - kUvSets];
  }
  bool hasUv(int s) const { return !set(s).empty(); }

  std::span<const MeshLoop> loopsOf(size_t face) const {
    return {loops.data() + faces[face].firstLoop, faces[face].loopCount};
  }
  std::span<const uint32_t> cornersOf(const MeshLoop& loop) const {
    return {corners.data() + loop.firstCorner, loop.cornerCount};
  }
  const Vec3& at(uint32_t corner) const { return positions[corners[corner]]; }
  /// The tag set of the edge that starts at a corner, and that of a position.
  uint32_t edgeTagsAt(uint32_t corner) const { return edgeTags.empty() ? 0 : edgeTags[corner]; }
  uint32_t vertexTagsAt(uint32_t position) const {
    return position < vertexTags.size() ? vertexTags[position] : 0;
  }

  /// Newell's normal of a face's outer loop times twice its area; zero for a degenerate face.
  Vec3 areaNormal(size_t face) const;
  Vec3 normal(size_t face) const { return normalized(areaNormal(face)); }
  /// Area of the outer loop less that of the holes.
  double area(size_t face) const;
  double area() const;
  Box3 bounds() const;
  /// A hash of everything that an operation can see.
  uint64_t contentHash() const;
  /// The same, computed at the first call only: for meshes that no longer change.
  uint64_t sharedHash() const {
    return cachedHash_.get([this] { return contentHash() | 1; });
  }
  /// Counts, indices and vector lengths agree, and no coordinate is NaN or infinite.
  bool valid() const;

 private:
  CachedHash cachedHash_;
};

using MeshRef = Ref<Mesh>;

/// Makes meshes loop by loop. Positions are shared where the caller passes the same index.
class MeshBuilder {
 public:
  uint32_t addPosition(const Vec3& p, uint32_t vertexTags = 0);
  /// A position of another mesh with its tags.
  uint32_t copyPosition(const Mesh& from, uint32_t position) {
    return addPosition(from.positions[position], from.vertexTagsAt(position));
  }
  /// Opens a face; its attributes apply until the next beginFace.
  void beginFace(uint16_t materialSlot = 0, uint32_t tags = 0, bool smooth = false);
  void beginLoop();
  /// Adds a corner to the open loop and gives its index.
  uint32_t addCorner(uint32_t position, uint32_t edgeTags = 0);
  /// Sets a uv or a note of a corner; unset ones of the set become (0, 0).
  void setUv(uint32_t corner, int set, Vec2 uv);
  void setNormal(uint32_t corner, const Vec3& n);
  /// A face of one loop.
  void addPolygon(std::span<const uint32_t> positions, uint16_t materialSlot = 0,
                  uint32_t tags = 0);
  /// Copies a face of another mesh with all of its attributes; `map` turns its positions to ours
  /// (kNoPosition where not copied yet). With `reversed` the face turns round.
  void copyFace(const Mesh& from, size_t face, std::vector<uint32_t>& map, bool reversed = false);
  static constexpr uint32_t kNoPosition = 0xffffffff;

  Mesh& mesh() { return mesh_; }
  Mesh take();

 private:
  Mesh mesh_;
};

/// A box [0,size] with outward faces in the order of CGA's primitiveCube: bottom, top, front (+z),
/// right (+x), back, left; 8 shared positions: 0..3 the bottom from the back left corner along +x,
/// 4..7 the top above them. With uv, set 0 runs (0,0) (1,0) (1,1) (0,1) along each ring, which on
/// the four sides is u to the right and v up seen from outside.
Mesh makeBoxMesh(const Vec3& size, bool withUv);

/// A rectangle [0,w] x [0,h]: in the xy plane (normal +z), or in the xz plane (normal +y).
enum class QuadPlane : uint8_t { Xy, Xz };
Mesh makeQuadMesh(double w, double h, QuadPlane plane, bool withUv);

/// Turns a face round: loops keep their first corner, edge tags stay with their edges, corner
/// normals are negated.
void reverseFace(Mesh& m, size_t face);

/// Applies a scale per axis and then a frame; turns faces round when the scale mirrors. Normals
/// follow by the inverse transpose.
Mesh transformed(const Mesh& m, const Vec3& scale, const Frame& frame);

/// Appends all of `from` to `to`; material slots of `from` are shifted by `slotOffset`.
void append(Mesh& to, const Mesh& from, uint16_t slotOffset = 0);

}  // namespace gable
