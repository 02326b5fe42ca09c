// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "tiles/compress.h"

#include "base/check.h"

#ifdef GABLE_MESHOPT
#include <meshoptimizer.h>
#endif

namespace gable {

#ifdef GABLE_MESHOPT

bool canCompress() { return true; }

namespace {

// The versions that the extension takes; the library keeps them for all threads.
void chooseVersions() {
  static const bool chosen = [] {
    meshopt_encodeVertexVersion(0);
    meshopt_encodeIndexVersion(1);
    return true;
  }();
  (void)chosen;
}

}  // namespace

void settleOrder(std::string& vertices, size_t stride, std::vector<uint32_t>& indices) {
  const size_t count = vertices.size() / stride;
  std::vector<uint32_t> remap(count);
  const size_t different = meshopt_generateVertexRemap(remap.data(), indices.data(), indices.size(),
                                                       vertices.data(), count, stride);
  std::string kept(different * stride, '\0');
  meshopt_remapVertexBuffer(kept.data(), vertices.data(), count, stride, remap.data());
  meshopt_remapIndexBuffer(indices.data(), indices.data(), indices.size(), remap.data());
  meshopt_optimizeVertexCache(indices.data(), indices.data(), indices.size(), different);
  std::string ordered(kept.size(), '\0');
  const size_t used = meshopt_optimizeVertexFetch(ordered.data(), indices.data(), indices.size(),
                                                  kept.data(), different, stride);
  ordered.resize(used * stride);
  vertices.swap(ordered);
}

std::string compressedVertices(const std::string& vertices, size_t stride) {
  chooseVersions();
  const size_t count = vertices.size() / stride;
  std::string out(meshopt_encodeVertexBufferBound(count, stride), '\0');
  out.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(),
                                        vertices.data(), count, stride));
  return out;
}

std::string compressedTriangles(const std::vector<uint32_t>& indices, size_t vertexCount) {
  chooseVersions();
  std::string out(meshopt_encodeIndexBufferBound(indices.size(), vertexCount), '\0');
  out.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(),
                                       indices.data(), indices.size()));
  return out;
}

#else

bool canCompress() { return false; }

void settleOrder(std::string&, size_t, std::vector<uint32_t>&) { GABLE_CHECK(canCompress()); }

std::string compressedVertices(const std::string&, size_t) {
  GABLE_CHECK(canCompress());
  return {};
}

std::string compressedTriangles(const std::vector<uint32_t>&, size_t) {
  GABLE_CHECK(canCompress());
  return {};
}

#endif

}  // namespace gable
