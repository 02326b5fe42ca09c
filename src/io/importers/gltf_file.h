// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A glTF 2.0 or GLB file, opened: its JSON, its buffers, and checked access to both. Every index
// and every range is checked where it is used, so that no file can lead outside its own bytes.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/json.h"
#include "io/importers/asset.h"
#include "io/importers/gltf_compression.h"
#include "math/affine.h"
#include "math/vec.h"

namespace gable {

/// A node with a mesh, in the scene.
struct GltfPlacement {
  size_t mesh = 0;
  Affine world;
  std::string name;
  /// What its node says of itself, or null; it lives as long as the file.
  const JsonValue* extras = nullptr;
};

/// Takes away what stands in for something and is not drawn (stand_ins.h), and gives how many.
size_t dropStandIns(std::vector<GltfPlacement>& placements);

class GltfFile {
 public:
  static constexpr size_t kNone = ~size_t{0};

  /// Codes: asset-broken.
  static Result<GltfFile> open(std::string_view bytes, const AssetOptions& options);

  const JsonValue& json() const { return json_; }
  /// The value as an index, or kNone.
  static size_t index(const JsonValue& v);

  /// Numbers of an accessor by its index, `components` wanted of each element; normalised integers
  /// become fractions. False when the accessor does not fit its description or the buffer.
  bool read(size_t accessor, int components, std::vector<double>& out) const;
  /// Indices; the plain count from 0 where the primitive has none.
  bool readIndices(const JsonValue& primitive, size_t vertexCount,
                   std::vector<uint32_t>& out) const;
  /// The bytes of a buffer view; empty when there is none.
  std::string_view view(size_t index) const;

  /// Nodes of the scene that show a mesh, parents before children. Each node is placed once,
  /// however often the file names it.
  std::vector<GltfPlacement> placements() const;

  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  struct Elements {
    const char* data = nullptr;
    size_t stride = 0, count = 0;
    int component = 0, components = 0;
    bool normalized = false;
  };
  /// The bytes that a buffer view, or an extension like one, names.
  std::string_view rangeOf(const JsonValue& view) const;
  bool describe(const JsonValue& accessor, Elements& out) const;
  /// Unpacks what is compressed. Codes as unpackBuffers, where the file cannot do without it.
  std::optional<Error> unpack(const AssetOptions& options);
  bool readUnpacked(const JsonValue& accessor, const DracoMesh::Attribute& from, int components,
                    std::vector<double>& out) const;
  void takeDraco(const JsonValue& primitive, const DracoMesh& mesh);
  bool applySparse(const JsonValue& accessor, const Elements& e, std::vector<double>& out) const;
  void loadBuffers(std::string_view chunk, const AssetOptions& options);
  static Affine localOf(const JsonValue& node);

  JsonValue json_;
  std::vector<std::string> buffers_;
  /// In the place of buffer views, and of accessors; the indices of an accessor are its one.
  std::map<size_t, std::string> unpackedViews_;
  std::map<size_t, DracoMesh::Attribute> unpackedAttributes_;
  std::map<size_t, std::vector<uint32_t>> unpackedIndices_;
  std::vector<std::string> warnings_;
};

}  // namespace gable
