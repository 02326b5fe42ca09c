// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "tiles/tile_streams.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/work.h"
#include "io/exporters/write_model.h"
#include "tiles/compress.h"

namespace gable {
namespace {

using namespace gltf;

constexpr double kMostSteps = 65535;
// Features are counted in 16 bits where there are no more.
constexpr size_t kShortFeatures = 65536;

template <class T>
void put(char* to, T value) {
  std::memcpy(to, &value, sizeof value);
}

// The vertices of a primitive as bytes.
std::string packed(const TilePrimitive& p, const TileLayout& l, const TileSteps& steps) {
  std::string out(uint64_t{p.vertexCount()} * l.stride, '\0');
  for (uint32_t v = 0; v < p.vertexCount(); ++v) {
    const uint32_t* from = p.words.data() + size_t{v} * p.floats();
    char* to = out.data() + size_t{v} * l.stride;
    const auto real = [from](size_t i) { return double{std::bit_cast<float>(from[i])}; };
    for (size_t i = 0; i < 3; ++i) {
      if (steps.on) {
        const double step = std::round((real(i) - double{steps.low[i]}) / steps.size);
        put(to + 2 * i, static_cast<uint16_t>(std::clamp(step, 0.0, kMostSteps)));
      }
      if (l.normal.component == kFloat) continue;
      const double n = std::clamp(real(3 + i), -1.0, 1.0) * 127;
      to[l.normal.offset + i] = static_cast<char>(static_cast<int8_t>(std::lround(n)));
    }
    if (!steps.on) std::memcpy(to, from, 12);
    if (l.normal.component == kFloat) std::memcpy(to + l.normal.offset, from + 3, 12);
    std::memcpy(to + l.color.offset, from + 6, 8);
    if (l.features && l.feature.component == kFloat) {
      std::memcpy(to + l.feature.offset, from + 8, 4);
    } else if (l.features) {
      put(to + l.feature.offset, static_cast<uint16_t>(real(8)));
    }
    std::memcpy(to + l.uv.offset, from + 9, size_t{8} * p.uvCount);
  }
  return out;
}

}  // namespace

TileStream::TileStream() {
  low.fill(std::numeric_limits<float>::infinity());
  high.fill(-std::numeric_limits<float>::infinity());
}

TileStreams::TileStreams(const TileMesh& mesh, const TileForm& form) : mesh_(mesh), form_(form) {
  steps_.push_back(stepsOf(mesh.primitives, true));
  for (const TileInstances& i : mesh.instances) steps_.push_back(stepsOf(i.primitives, false));
  for (const TilePrimitive& p : mesh.primitives) add(p, 0);
  for (size_t i = 0; i < mesh.instances.size(); ++i) {
    for (const TilePrimitive& p : mesh.instances[i].primitives) add(p, i + 1);
  }
  for (TileStream& s : streams_) measure(s);
}

// Positions are integers where that moves none by more than it may. Viewers bound instances by
// their positions before they are scaled, so those that are not compressed stay metres.
TileSteps TileStreams::stepsOf(const std::vector<TilePrimitive>& primitives, bool own) const {
  TileSteps out;
  std::array<float, 3> most;
  out.low.fill(std::numeric_limits<float>::infinity());
  most.fill(-std::numeric_limits<float>::infinity());
  for (const TilePrimitive& p : primitives) {
    for (size_t i = 0; i < 3; ++i) {
      out.low[i] = std::min(out.low[i], p.min[i]);
      most[i] = std::max(most[i], p.max[i]);
    }
  }
  double side = 0;
  for (size_t i = 0; i < 3; ++i) side = std::max(side, double{most[i]} - double{out.low[i]});
  out.size = side / kMostSteps;
  const double moved = form_.compressed ? kMostQuantized : WriteOptions::kMostQuantized;
  const bool may = !form_.floats && (own || form_.compressed);
  out.on = may && out.size > 0 && out.size <= 2 * moved;
  return out;
}

std::vector<size_t> TileStreams::of(size_t mesh) const {
  std::vector<size_t> out;
  for (const TileRange& r : ranges_) {
    if (r.mesh == mesh) out.push_back(r.stream);
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

// Attributes begin at multiples of four bytes, as glTF wants it.
TileLayout TileStreams::layoutOf(const TilePrimitive& p, size_t mesh) const {
  TileLayout l;
  const auto field = [&l](int component, uint32_t bytes, bool normalized) {
    const TileField f{l.stride, component, normalized};
    l.stride += (bytes + 3) / 4 * 4;
    return f;
  };
  l.position = steps_[mesh].on ? field(kUnsignedShort, 6, false) : field(kFloat, 12, false);
  l.normal = form_.floats ? field(kFloat, 12, false) : field(kByte, 3, true);
  l.color = field(kUnsignedShort, 8, true);
  // Instances have it once each.
  l.features = mesh == 0;
  if (l.features) {
    const bool few = !form_.floats && mesh_.features.size() <= kShortFeatures;
    l.feature = few ? field(kUnsignedShort, 2, false) : field(kFloat, 4, false);
  }
  l.uvCount = p.uvCount;
  l.uv = field(kFloat, 8 * p.uvCount, false);
  return l;
}

size_t TileStreams::streamOf(const TileLayout& layout, size_t mesh) {
  for (size_t s = 0; s < streams_.size(); ++s) {
    const TileLayout& l = streams_[s].layout;
    const bool like = l.features == layout.features && l.uvCount == layout.uvCount &&
                      l.position.component == layout.position.component;
    const bool apart = form_.instancing == TileInstancing::Nodes;
    if (like && (!apart || meshOfStream_[s] == mesh)) return s;
  }
  streams_.emplace_back();
  streams_.back().layout = layout;
  meshOfStream_.push_back(mesh);
  return streams_.size() - 1;
}

void TileStreams::add(const TilePrimitive& p, size_t mesh) {
  if (p.indices.empty()) return;
  work(p.vertexCount());
  const TileLayout layout = layoutOf(p, mesh);
  TileRange range{&p, mesh, streamOf(layout, mesh), 0, 0};
  TileStream& stream = streams_[range.stream];
  std::string vertices = packed(p, layout, steps_[mesh]);
  std::vector<uint32_t> indices = p.indices;
  if (form_.compressed) settleOrder(vertices, layout.stride, indices);
  const uint32_t base = stream.count();
  range.firstIndex = stream.indices.size();
  range.indexCount = indices.size();
  for (const uint32_t i : indices) stream.indices.push_back(base + i);
  stream.vertices += vertices;
  ranges_.push_back(range);
}

void TileStreams::measure(TileStream& stream) const {
  const bool steps = stream.layout.position.component == kUnsignedShort;
  for (size_t at = 0; at < stream.vertices.size(); at += stream.layout.stride) {
    std::array<float, 3> v{};
    std::array<uint16_t, 3> q{};
    if (steps) {
      std::memcpy(q.data(), stream.vertices.data() + at, sizeof q);
      for (size_t i = 0; i < 3; ++i) v[i] = static_cast<float>(q[i]);
    } else {
      std::memcpy(v.data(), stream.vertices.data() + at, sizeof v);
    }
    for (size_t i = 0; i < 3; ++i) {
      stream.low[i] = std::min(stream.low[i], v[i]);
      stream.high[i] = std::max(stream.high[i], v[i]);
    }
  }
}

}  // namespace gable
