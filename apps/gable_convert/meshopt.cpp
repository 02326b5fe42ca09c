// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include <meshoptimizer.h>

#include "jobs.h"

namespace {

// What the extension allows; the library does not look.
bool isAllowed(Meshopt mode, uint32_t count, uint32_t stride, MeshoptFilter filter) {
  if (mode == Meshopt::Vertices) {
    if (stride == 0 || stride % 4 != 0 || stride > 256) return false;
    if (filter == MeshoptFilter::Octahedral) return stride == 4 || stride == 8;
    return filter != MeshoptFilter::Quaternion || stride == 8;
  }
  const bool whole = mode == Meshopt::Indices || count % 3 == 0;
  return whole && (stride == 2 || stride == 4) && filter == MeshoptFilter::None;
}

}  // namespace

bool unpackMeshopt(Meshopt mode, uint32_t count, uint32_t stride, MeshoptFilter filter,
                   std::string_view bytes, std::string& out) {
  constexpr uint64_t kMostBytes = uint64_t{1} << 29;
  if (!isAllowed(mode, count, stride, filter) || uint64_t{count} * stride > kMostBytes)
    return false;
  out.resize(size_t{count} * stride);
  const auto* from = reinterpret_cast<const unsigned char*>(bytes.data());
  int wrong = 0;
  switch (mode) {
    case Meshopt::Vertices:
      wrong = meshopt_decodeVertexBuffer(out.data(), count, stride, from, bytes.size());
      break;
    case Meshopt::Triangles:
      wrong = meshopt_decodeIndexBuffer(out.data(), count, stride, from, bytes.size());
      break;
    case Meshopt::Indices:
      wrong = meshopt_decodeIndexSequence(out.data(), count, stride, from, bytes.size());
      break;
    default: return false;
  }
  if (wrong != 0) return false;
  switch (filter) {
    case MeshoptFilter::None: return true;
    case MeshoptFilter::Octahedral: meshopt_decodeFilterOct(out.data(), count, stride); return true;
    case MeshoptFilter::Quaternion:
      meshopt_decodeFilterQuat(out.data(), count, stride);
      return true;
    case MeshoptFilter::Exponential:
      meshopt_decodeFilterExp(out.data(), count, stride);
      return true;
  }
  return false;
}
