// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Vertices and triangles for EXT_meshopt_compression, by the library meshoptimizer where the build
// has it. The same input gives the same bytes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gable {

/// Whether the build has the library; nothing below may be called where it has not.
bool canCompress();

/// Equal vertices become one, and vertices and triangles stand in an order that compresses well and
/// is drawn fast. A vertex has `stride` bytes.
void settleOrder(std::string& vertices, size_t stride, std::vector<uint32_t>& indices);

/// For the modes ATTRIBUTES and TRIANGLES. `stride` is a multiple of four, at most 256; there are
/// vertices, and whole triangles.
std::string compressedVertices(const std::string& vertices, size_t stride);
std::string compressedTriangles(const std::vector<uint32_t>& indices, size_t vertexCount);

}  // namespace gable
