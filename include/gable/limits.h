// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a derivation, and what is done with files, may use up; how a derivation came to its end.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

namespace gable {

/// Exceeding a limit ends the initial shape that did it with a diagnostic, and where the limit is
/// on all initial shapes together those that wait as well. What was made until then is kept.
struct Limits {
  /// Rule calls within rule calls.
  uint32_t depth = 1024;
  uint32_t functionDepth = 1024;
  /// Children of one shape.
  uint32_t width = 100000;
  uint32_t arraySize = 100000;
  /// Shapes made, instances not expanded, all initial shapes together.
  uint64_t shapes = 50'000'000;
  /// Positions in meshes of leaves, instances not expanded.
  uint64_t vertices = 200'000'000;
  /// Positions of the mesh of one shape.
  uint64_t shapeVertices = 4'000'000;
  /// Operations and calls, each weighed by the size of what it works on; all initial shapes
  /// together.
  uint64_t steps = 4'000'000'000;
  /// By how many bytes the process may grow while deriving.
  std::optional<uint64_t> bytes = uint64_t{4} << 30;
  /// Seconds of wall-clock time.
  std::optional<double> seconds;
};

/// What may be used up by reading, analysing, converting, writing or drawing a file. Exceeding it
/// ends that with a diagnostic that names the file, and there is no result.
struct FileLimits {
  /// Seconds of wall-clock time.
  std::optional<double> seconds = 600;
  /// By how many bytes the process may grow meanwhile.
  std::optional<uint64_t> bytes = uint64_t{4} << 30;
  /// Ends the work soon after it becomes true. May be null.
  const std::atomic<bool>* cancel = nullptr;
};

/// How a derivation came to its end.
enum class End : uint8_t { Done, LimitReached, Cancelled };

}  // namespace gable
