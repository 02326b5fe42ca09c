// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Wavefront: shrinks closed chains of planes until nothing is left and records where its vertices
// went. The chains enter as planes only; their corners are where consecutive planes meet.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geom/skeleton/planes.h"

namespace gable::skeleton {

constexpr uint32_t kNone = 0xffffffff;

/// What a trace of the wavefront leaves behind. Faces are numbered as the edges put in.
struct Trace {
  /// A point of the skeleton; the first ones are the corners put in, in order.
  struct Node {
    Planes::Point at;
  };
  /// A path of a wavefront vertex: part of the loop of `left` as from -> to, of `right` reversed.
  struct Arc {
    uint32_t from = 0, to = 0;
    uint32_t left = 0, right = 0;
  };
  /// Two faces of one plane whose wavefronts grew together at a node.
  struct Merge {
    uint32_t left = 0, right = 0, node = 0;
  };
  /// A piece of wavefront left at the top level: runs from -> to along face.
  struct Top {
    uint32_t from = 0, to = 0, face = 0;
  };
  std::vector<Node> nodes;
  std::vector<Arc> arcs;
  std::vector<Merge> merges;
  std::vector<Top> tops;
};

/// One edge put in: its plane and the node (corner) it starts at.
struct WaveInput {
  PlaneId plane = 0;
  uint32_t startNode = 0;
};

/// Unbounded: part of the ground lies between edges that stand still. Stuck: the chains crossed.
enum class WaveEnd : uint8_t { Done, Unbounded, Stuck };

/// Runs rings of edges (each a list, its corners as nodes of `trace` already) to the end or to the
/// level plane `top` (kNone for none). O(n r + m log m) for r reflex corners and m events.
WaveEnd runWavefront(const Planes& planes, const std::vector<std::vector<WaveInput>>& rings,
                     uint32_t top, Trace& trace);

}  // namespace gable::skeleton
