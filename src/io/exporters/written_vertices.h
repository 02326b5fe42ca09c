// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// WrittenVertices: the vertices of a primitive that were written last, by their bytes, so that
// faces beside each other share the corners in which they are equal to the bit: the panes of a
// wall, whose normals are one.
//
// A table of fixed size has a place for each hash, and the last vertex keeps it. What is forgotten
// is written once more: so a vertex costs the same however many there are, and neighbours, which
// follow each other closely, are found.
#pragma once

#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include "base/hash.h"

namespace gable {

class WrittenVertices {
 public:
  /// Begins a primitive, whose vertices have so many bytes.
  void begin(uint32_t vertexBytes) {
    if (vertexBytes != vertexBytes_) bytes_.assign(kPlaces * size_t{vertexBytes}, 0);
    vertexBytes_ = vertexBytes;
    ++primitive_;
  }

  /// The number under which an equal vertex was added to the primitive; else `next`, under which
  /// this one is added.
  uint32_t add(const char* vertex, uint32_t next) {
    const size_t at = hashBytes({vertex, vertexBytes_}) % kPlaces;
    Place& place = places_[at];
    char* const bytes = bytes_.data() + at * vertexBytes_;
    if (place.primitive == primitive_ && std::memcmp(bytes, vertex, vertexBytes_) == 0) {
      return place.number;
    }
    place = {primitive_, next};
    std::memcpy(bytes, vertex, vertexBytes_);
    return next;
  }

 private:
  static constexpr size_t kPlaces = 8192;
  struct Place {
    uint64_t primitive = 0;
    uint32_t number = 0;
  };
  uint32_t vertexBytes_ = 0;
  uint64_t primitive_ = 0;
  std::vector<Place> places_ = std::vector<Place>(kPlaces);
  std::vector<char> bytes_;
};

}  // namespace gable
