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

/// What the scene of a file shows.
struct GltfShown {
  /// Parents before children. Each node is there once, however often the file names it.
  std::vector<GltfPlacement> placements;
  /// How many nodes of the scene are left out with their meshes: collision shapes by their names
  /// (stand_ins.h), and coarser levels of detail by their names or by MSFT_lod, with all below
  /// them.
  size_t left = 0;
};

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

  /// Of the scene that the file names, or of all its nodes where it has none.
  GltfShown shown() const;

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
  std::vector<size_t> roots() const;
  /// A node of the scene: the number of its parent's visit, and where it is.
  struct Visit {
    size_t node = 0, parent = kNone;
    Affine world;
  };
  /// Parents before children.
  std::vector<Visit> visits() const;
  /// That of its mesh where it has none.
  const std::string& nameOf(size_t node) const;
  /// By node, whether MSFT_lod names it as a coarser level of another.
  std::vector<bool> coarserLevels() const;

  JsonValue json_;
  std::vector<std::string> buffers_;
  /// In the place of buffer views, and of accessors; the indices of an accessor are its one.
  std::map<size_t, std::string> unpackedViews_;
  std::map<size_t, DracoMesh::Attribute> unpackedAttributes_;
  std::map<size_t, std::vector<uint32_t>> unpackedIndices_;
  std::vector<std::string> warnings_;
};

}  // namespace gable
