// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a derivation made, or a model file that was read: counts, leaves, meshes, files, pictures.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gable/diagnostic.h"
#include "gable/limits.h"
#include "gable/picture.h"
#include "gable/trace.h"
#include "gable/value.h"

namespace gable {

/// How glTF files show parts that occur several times. Auto: by nodes that share a mesh, at most
/// 20,000 of them; beyond, parts that save least are merged, or, where that would add more than a
/// GiB, equal ones become one node with EXT_mesh_gpu_instancing. Nodes: by a node each. Gpu: by
/// EXT_mesh_gpu_instancing. None: not at all, everything is one mesh, merged by material. Shapes: a
/// mesh for each initial shape, merged by material; equal ones share it.
enum class Instancing : uint8_t { Auto, Nodes, Gpu, None, Shapes };

/// What a vertex of a glTF file takes. Float: single precision. Compact: half of that, by
/// KHR_mesh_quantization, within half a millimetre, and no texture coordinates without a texture.
/// Bare: Compact without normals on flat surfaces. Auto: Float in small files, Compact in others.
enum class Vertices : uint8_t { Auto, Float, Compact, Bare };

/// Which levels of detail a CityJSON file has. One: blocks. Two: roofs and walls. Three: all that
/// rules made.
enum class Detail : uint8_t { All, One, Two, Three };

/// How things are called in a glTF file. Rules: as rules call them. The others have a name of its
/// own for each initial shape and its mesh, of letters, digits and _, and mark collision shapes:
/// Unique as House_collision, Godot as House-convcolonly or House-colonly, Unreal as UCX_House_00.
enum class Names : uint8_t { Rules, Unique, Godot, Unreal };

/// What a glTF file has for collisions, an initial shape each. Box: the smallest upright box. Hull:
/// its convex hull, of 98 corners at most. Mesh: its triangles without small parts.
enum class Collision : uint8_t { None, Box, Hull, Mesh };

/// How coarser levels of detail are kept. Names: in the file, House_LOD0, House_LOD1. Extension: in
/// the file, by MSFT_lod. Files: beside it, model_LOD1.glb.
enum class LevelForm : uint8_t { Names, Extension, Files };

struct WriteSettings {
  Instancing instancing = Instancing::Auto;
  Vertices vertices = Vertices::Auto;
  Detail detail = Detail::All;
  Names names = Names::Rules;
  Collision collision = Collision::None;
  /// glTF: coarser levels of detail besides the model itself, 0 to 3.
  int levels = 0;
  LevelForm levelForm = LevelForm::Names;
  /// glTF: texture coordinates are scaled, turned and moved as materials say, where all textures of
  /// a material want the same; else readers do so (KHR_texture_transform).
  bool bakedUv = false;
  /// glTF, OBJ and USD: no side of a picture is longer; 0 for any.
  uint32_t textureSize = 0;
  /// glTF, OBJ and USD: plain colours and pictures that do not repeat are in one picture with sides
  /// of so many pixels at most, so that their materials are few; 0 for none.
  uint32_t atlas = 0;
  FileLimits limits;
};

struct WriteResult {
  bool ok = false;
  /// Written, or drawn in a picture; instances expanded.
  uint64_t triangles = 0;
  /// Of all files that were written.
  uint64_t bytes = 0;
  DiagnosticList diagnostics;
  /// glTF: what its geometry would take more if parts that occur several times were written out.
  uint64_t savedBytes = 0;
  /// With WriteSettings::atlas: the materials that it has taken and those that they became; and
  /// those that stay because their pictures repeat, because they have other maps or light of their
  /// own, and for want of room.
  struct Atlas {
    uint32_t merged = 0, into = 0, repeating = 0, special = 0, large = 0;
  };
  std::optional<Atlas> atlas;
  /// The models that were written: the one asked for, then its coarser levels.
  std::vector<std::string> models;
};

/// A model file in memory.
struct EncodeResult {
  bool ok = false;
  std::string bytes;
  DiagnosticList diagnostics;
};

/// How a model becomes an asset that fills scopes: its volume is mapped to the unit cube.
struct PrepareSettings {
  /// The point of the model that becomes the origin; absent: the lower corner of its box.
  std::optional<Triple> pivot;
  /// Degrees about x, then y, then z, around the pivot.
  Triple rotate{};
  /// What fills a scope, from the pivot to +x, +y and +z; absent: the model's box.
  std::optional<Triple> volume;
  /// The file's up axis is z.
  bool zUp = false;
  /// The name of the model in the file; absent: as it is.
  std::optional<std::string> name;
};

struct BoundingBox {
  Triple min{}, max{};
};

/// All values that rules reported under one key.
struct ReportSummary {
  std::string key;
  uint64_t count = 0;
  struct Numbers {
    double sum = 0, min = 0, max = 0;
  };
  /// Of the values that are numbers, present when one is.
  std::optional<Numbers> numbers;
  /// Texts and bools with how often each was reported, sorted by text; the rest are numbers.
  std::vector<std::pair<std::string, uint64_t>> values;
};

/// What the rules reported for one initial shape.
struct ShapeReports {
  std::string name;
  /// What its file calls it; empty where it does not.
  std::string id;
  /// Sorted by key.
  std::vector<ReportSummary> reports;
};

/// Counts with instances expanded.
struct Statistics {
  uint64_t shapes = 0, leaves = 0, faces = 0, vertices = 0, triangles = 0;
  uint64_t instances = 0, prototypes = 0, materials = 0;
  /// As CityEngine's encoders count: polygons as they are, faces with holes as triangles, vertices
  /// of each leaf by themselves.
  struct Encoder {
    uint64_t faces = 0, vertices = 0;
  } encoder;
  /// Shapes that were taken over from DeriveSettings::before.
  uint64_t recalled = 0;
  /// Absent when there is no leaf.
  std::optional<BoundingBox> bounds;
  /// Sorted by key.
  std::vector<ReportSummary> reports;
  /// What `ifFree` decided, by group: sorted by name.
  struct Room {
    std::string group;
    uint64_t kept = 0, dropped = 0;
  };
  std::vector<Room> rooms;
};

struct MaterialInfo {
  std::string name;
  /// "#rrggbb", sRGB.
  std::string color;
  double opacity = 1, roughness = 1, metallic = 0;
  /// Absent: gives no light.
  std::optional<std::string> emissive;
  /// Layer ("colormap", "normalmap", ...) and path of each texture.
  std::vector<std::pair<std::string, std::string>> textures;
};

struct LeafInfo {
  std::string name;
  struct Source {
    std::string rule, file;
    uint32_t line = 0, column = 0;
  };
  std::optional<Source> source;
  uint64_t faces = 0, vertices = 0;
  /// Of its first surface.
  MaterialInfo material;
  std::vector<NamedValue> attributes;
  /// The box of its mesh in the world: an origin, three unit axes, a size.
  std::array<double, 12> frame{};
  Triple size{};
  /// The shared parts that it stands in, from the initial shape down, with their leaves.
  struct Part {
    std::string name;
    uint64_t firstLeaf = 0, endLeaf = 0;
  };
  std::vector<Part> parts;
};

/// What lies directly below a part of a model.
struct ModelParts {
  struct Part {
    std::string name;
    uint64_t firstLeaf = 0, endLeaf = 0;
    /// A leaf has nothing below it.
    bool leaf = false;
  };
  /// In path order, without those that have no leaves.
  std::vector<Part> parts;
  /// How many were left out behind them.
  uint64_t more = 0;
};

/// Triangles for a renderer, in the mesh's own frame. Leaves that share a mesh differ in their
/// place alone.
struct TriangleMesh {
  /// Three numbers a vertex; uvs two, or none at all.
  std::vector<double> positions;
  std::vector<float> normals, uvs;
  /// Three vertices a triangle, counter-clockwise from outside.
  std::vector<uint32_t> triangles;
  /// Triangles of one material slot lie together.
  struct Part {
    uint32_t slot = 0;
    uint32_t firstTriangle = 0, triangleCount = 0;
  };
  std::vector<Part> parts;
};

/// A leaf in the world: where its mesh stands and what it is made of.
struct PlacedMesh {
  /// Index into ModelGeometry::meshes, ModelGeometry::names.
  uint32_t mesh = 0, name = 0;
  /// A point p of the mesh lies at origin + x p.x + y p.y + z p.z: twelve numbers, origin, x, y, z.
  /// A transform may mirror.
  std::array<double, 12> transform{};
  /// Indices into ModelGeometry::materials by slot; a slot beyond the end has the first.
  std::vector<uint32_t> materials;
};

struct ModelGeometry {
  std::vector<TriangleMesh> meshes;
  std::vector<MaterialInfo> materials;
  std::vector<std::string> names;
  /// In path order, instances expanded.
  std::vector<PlacedMesh> leaves;
};

/// What a viewer holds of a model that it was sent in chunks.
struct DrawnChunks;

/// A model for a graphics card, as what has changed since the one before.
struct DrawUpdate {
  /// An update, or a draw list where the model is small, in pieces one behind the other; empty
  /// where a limit ends it.
  std::vector<std::string> bytes;
  /// Who applies the update holds this then; null for a draw list.
  std::shared_ptr<const DrawnChunks> drawn;
};

class Model {
 public:
  /// Reads a file as it is, to be drawn, compared, prepared or written in another format: .obj
  /// .gltf .glb, and .fbx .dae where gable-convert is built.
  static Model load(const std::string& path, const FileLimits& limits = {});
  /// Of a model that was read: the same as an asset, for i(.., unitCube) and post-process tables.
  Model prepared(const PrepareSettings& settings) const;
  /// Of a model that was read; absent when it is empty, and for a derived one, whose bounds
  /// statistics() has.
  std::optional<BoundingBox> bounds() const;

  bool ok() const;
  /// False when a model file could not be read.
  bool found() const;
  End end() const;
  const DiagnosticList& diagnostics() const;
  double deriveSeconds() const;
  Statistics statistics() const;
  /// By initial shape, in their order; those that a limit ended are left out.
  std::vector<ShapeReports> reportsByShape() const;
  /// The evaluated attributes of an initial shape.
  std::vector<NamedValue> attributes(size_t shape) const;
  const std::vector<std::string>& prints() const;
  /// A readable list of the leaves, the same for any number of jobs.
  std::string dump() const;
  /// The derivation tree; empty unless it was asked for.
  DerivationTrace trace() const;
  /// Leaves, instances expanded; the largest number when there are more.
  uint64_t leafCount() const;
  /// A leaf by its number in path order.
  std::optional<LeafInfo> leaf(uint64_t number) const;
  /// What lies directly below the part LeafInfo::parts[level - 1] of a leaf, which is nothing where
  /// it has no such part; at level 0 the initial shapes. The first `most` of it.
  ModelParts parts(uint64_t leaf, size_t level, uint64_t most = 100'000) const;
  /// Meshes, materials and the places of the first leaves, at most `mostLeaves`.
  ModelGeometry geometry(uint64_t mostLeaves = 1u << 24) const;
  /// The model for a graphics card: batches of instances and of merged triangles; the bytes are
  /// described in docs/dev/studio-protocol.md. Empty where a limit ends it.
  std::string drawList(const FileLimits& limits = {}) const;
  /// The same for a viewer that holds `before`, which may be null. `room`: the pieces of an update
  /// that nobody needs any more; their memory is used again.
  DrawUpdate drawUpdate(const DrawnChunks* before, const FileLimits& limits = {},
                        std::vector<std::string> room = {}) const;
  /// Readies memory for one derivation that goes on from this model, so that it need not wait for
  /// pages that the system clears: as many bytes as the model takes. For who has nothing else to
  /// do meanwhile; any thread. Nothing where the model was not remembered
  /// (DeriveSettings::remember).
  void prepareNext() const;
  /// The bytes of a texture by the path that a material names.
  std::optional<std::string> texture(const std::string& path) const;
  /// By extension: .glb .gltf .obj .usda .usdz .ply .stl .city.json .city.jsonl .ifc, and .png for
  /// a picture with default settings.
  WriteResult write(const std::string& path, const WriteSettings& settings = {}) const;
  /// The bytes of a format of one file: "glb", "ply", "stl" or "png".
  EncodeResult encode(const std::string& format, const WriteSettings& settings = {}) const;
  WriteResult picture(const std::string& path, const PictureSettings& settings = {}) const;

  struct Impl;
  explicit Model(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  const Impl& impl() const { return *impl_; }

 private:
  std::shared_ptr<const Impl> impl_;
};

}  // namespace gable
