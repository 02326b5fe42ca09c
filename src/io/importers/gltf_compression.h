// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Compressed buffers of glTF files (EXT_meshopt_compression, KHR_draco_mesh_compression), which the
// program gable-convert unpacks: its libraries were not made for broken files.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace gable {

/// The kinds and filters are numbers of the stream to gable-convert.
struct PackedBuffer {
  enum Kind : uint32_t { Draco, Vertices, Triangles, Indices };
  enum Filter : uint32_t { None, Octahedral, Quaternion, Exponential };
  Kind kind = Draco;
  uint32_t count = 0, stride = 0;
  Filter filter = None;
  std::string_view bytes;
};

/// What the buffers hold, in their order; empty where one is broken. Codes: asset-converter (the
/// program or a library of it is missing), asset-broken, asset-too-large.
Result<std::vector<std::string>> unpackBuffers(const std::vector<PackedBuffer>& buffers,
                                               const std::string& path);

/// A mesh out of Draco's.
struct DracoMesh {
  struct Attribute {
    uint32_t components = 0;
    std::vector<float> numbers;
  };
  std::vector<uint32_t> indices;
  std::map<uint32_t, Attribute> attributes;
};
/// From what unpackBuffers gives; false when it is cut off.
bool readDracoMesh(std::string_view unpacked, DracoMesh& out);

}  // namespace gable
