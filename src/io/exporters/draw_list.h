// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A scene for a graphics card: few batches, each one draw call. What stands often (boxes,
// rectangles, models of assets) is drawn as instances of one geometry; what stands seldom is merged
// in world coordinates. Materials that differ in colour alone share a batch: colours are data.
//
// Every triangle knows its leaf: the sum of the vertex's and the instance's leaf number is the
// leaf's place in path order, so that a viewer can pick, mark and hide leaves without other tables.
// A float holds the numbers up to 2^24 exactly; kMostLeaves keeps below that.
//
// The bytes: "GBL1", a 32-bit count of JSON bytes, the JSON padded with blanks to four, then the
// arrays that the JSON points into by byte offsets; docs/dev/studio-protocol.md has the fields.
// All little-endian. The same scene gives the same bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "scene/scene.h"

namespace gable {

constexpr uint64_t kMostLeaves = 1u << 22;

/// Linear in the flattened leaves; leaves beyond kMostLeaves are left out and the JSON says so.
/// `jobs`: threads, 0 for as many as are worth it; the bytes are the same for any number.
std::string drawList(const Scene& scene, unsigned jobs = 0);

}  // namespace gable
