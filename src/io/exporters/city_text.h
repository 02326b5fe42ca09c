// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The parts of a CityJSON text that are long: vertices, boundaries with what is said of each
// surface, materials. Coordinates become whole millimetres from the file's origin.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/json.h"
#include "base/work.h"
#include "material/material.h"
#include "math/vec.h"

namespace gable {

/// What a coordinate is multiplied by, in metres.
constexpr double kCityScale = 0.001;

/// Vertices, each once. 32 bytes each.
class CityVertices {
 public:
  using Vertex = std::array<int64_t, 3>;
  /// Millimetres; the index of the vertex.
  uint32_t add(const Vertex& v);
  const std::vector<Vertex>& all() const { return all_; }
  void clear();
  /// "[[0,0,0],[..]]"; `flush` may empty the text whenever it has grown.
  template <class Flush>
  void write(std::string& out, Flush&& flush) const;

 private:
  void grow();
  std::vector<Vertex> all_;
  // Open addressing; index + 1, 0 for none.
  std::vector<uint32_t> slots_;
};

/// What is said of the surfaces of one geometry, in their order.
struct CitySurfaces {
  static constexpr uint32_t kNone = 0xffffffff;
  struct Semantic {
    const char* type = nullptr;
    std::string name;
  };
  std::vector<Semantic> semantics;
  /// By surface: its semantics and its material, or kNone.
  std::vector<uint32_t> semanticOf, materialOf;
  /// Of a MultiSolid: where the surfaces of each solid end.
  std::vector<size_t> listEnds;
};

/// A number of the file, as it stands in lists.
void appendNumber(std::string& out, int64_t v);
/// ,"semantics":{..},"material":{..} of surfaces that lie in `depth` lists: 1 for a MultiSurface, 2
/// for a Solid of one shell, 3 for a MultiSolid of such. Nothing where nothing is said.
void appendSurfaces(std::string& out, const CitySurfaces& surfaces, int depth);

/// The materials of a file, numbered as they are first used.
class CityMaterials {
 public:
  explicit CityMaterials(const std::vector<Material>& all) : all_(all) {}
  /// The number of a material of the scene, in the file; CitySurfaces::kNone where there is none.
  uint32_t use(uint32_t material);
  bool empty() const { return used_.empty(); }
  /// {"materials":[..]}
  void write(std::string& out) const;
  void clear();
  /// Whether one that was used has a picture, which is not written.
  bool hasTextures() const { return hasTextures_; }

 private:
  const std::vector<Material>& all_;
  std::vector<uint32_t> numbers_, used_;
  bool hasTextures_ = false;
};

// ---------------------------------------------------------------------------------------------

template <class Flush>
void CityVertices::write(std::string& out, Flush&& flush) const {
  out += '[';
  bool first = true;
  for (const Vertex& v : all_) {
    work();
    out += first ? "[" : ",[";
    first = false;
    for (size_t a = 0; a < 3; ++a) {
      if (a > 0) out += ',';
      appendNumber(out, v[a]);
    }
    out += ']';
    flush();
  }
  out += ']';
}

}  // namespace gable
