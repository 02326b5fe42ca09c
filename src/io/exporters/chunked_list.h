// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// ChunkedList: the draw list of a scene as what has changed since the one before. A large scene is
// cut into chunks of some hundred leaves that follow each other; a chunk is known by a hash of all
// that is drawn of it, so that an edit sends the chunks that it changes and no others. Where chunks
// end depends on what they hold: what is put in or taken out moves no ends but those beside it.
//
// The bytes: "GBU2", a 32-bit count of JSON bytes, the JSON padded with blanks to four, then the
// arrays; docs/dev/studio-protocol.md has the fields. Applied to what the list before has left, the
// update gives what it gives without one before, to the byte.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "io/exporters/draw_plan.h"
#include "scene/scene.h"

namespace gable {

/// Scenes with fewer leaves are drawn by drawList(): they are sent as a whole.
constexpr uint64_t kLeavesWorthChunks = 1 << 14;

/// What somebody who has applied an update holds, without the arrays.
struct DrawnChunks {
  struct BatchName {
    /// Of the look and the geometry.
    uint64_t key = 0;
    DrawLook look;
  };
  std::vector<BatchName> batches;
  /// By chunk: the hash of what it holds, and the end of its batches in `used`.
  std::vector<uint64_t> keys;
  std::vector<uint32_t> usedEnd;
  std::vector<uint32_t> used;
};

struct ChunkedList {
  /// In pieces, one behind the other.
  std::vector<std::string> bytes;
  /// Null where the bytes are a draw list, since chunks are not worth it.
  std::shared_ptr<const DrawnChunks> drawn;
};

/// `before` may be null: all chunks are sent then. `jobs` as in drawList(). `room`: pieces that
/// nobody needs any more; their memory is used again.
ChunkedList chunkedList(const Scene& scene, const DrawnChunks* before, unsigned jobs = 0,
                        std::vector<std::string> room = {});

}  // namespace gable
