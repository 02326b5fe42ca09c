// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Edges of faces moved inward: the strips that they sweep, and what remains. Shared by setback and
// its kin, shapeL, shapeU, shapeO and offset.
//
// Where strips of two edges meet, the line between them runs to where the moved edges cross, as in
// the weighted straight skeleton. Strips and remainder of a face tile it and share their points.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/status.h"
#include "builtins/auto_tags.h"
#include "builtins/ops/shared/patchwork.h"

namespace gable {

/// Not moved.
constexpr uint32_t kNoGroup = 0xffffffff;

class SetBack {
 public:
  /// The mesh must outlive this. With `tagged`, edges get the tags of setback.
  SetBack(const Mesh& m, const Services& services, bool tagged);

  /// Moves the edges of a face. Both lists are by corner of the mesh: the distance of the edge that
  /// starts there (zero and less: not moved), and the number of the group that its strip belongs
  /// to. Fails where the skeleton does, and then adds nothing.
  Status addFace(size_t face, std::span<const double> distance, std::span<const uint32_t> group);

  /// The strips of a group; neighbours are united into one polygon.
  std::vector<PatchFace> strips(uint32_t group);
  /// What remains of all faces.
  std::vector<PatchFace> remainders();
  /// Each strip by itself, in the order of edges. They take the tags of their edge.
  std::vector<PatchFace> stripOfEachEdge();

 private:
  struct Strip {
    uint32_t group = kNoGroup;
    uint32_t corner = 0;
    // 0: the edge itself; 1: a step between neighbours; 2: an edge that stands still.
    int kind = 0;
    std::vector<uint32_t> loop;
    std::vector<std::vector<uint32_t>> holes;
  };
  struct Work {
    std::unique_ptr<PatchPlane> plane;
    std::vector<double> height;
    std::vector<Strip> strips;
    uint32_t inputCount = 0;
    // By point of the face: the corner that it is.
    std::vector<uint32_t> corner;
  };
  uint32_t tagsOf(uint32_t corner) const { return mesh_.edgeTagsAt(corner); }
  /// The tags of an edge, which is a part of the face's edge at `corner` or parallel to it.
  uint32_t tagged(uint32_t corner, std::string_view role) {
    return tagged_ ? tags_.with(tagsOf(corner), role) : tagsOf(corner);
  }
  uint32_t sideTags(const Work& w, const PatchEdge& e);
  void addEdges(const Work& w, const Strip& s, const std::vector<uint32_t>& loop,
                std::vector<PatchEdge>& out);
  std::vector<PatchEdge> faceOutline(const Work& w);

  const Mesh& mesh_;
  AutoTags tags_;
  bool tagged_;
  std::vector<Work> work_;
};

}  // namespace gable
