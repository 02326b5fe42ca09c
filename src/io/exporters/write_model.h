// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Writes a scene as a model file that other programs open. The format follows the extension:
//   .glb .gltf   nodes that share meshes, PBR materials, textures inside (.glb) or beside (.gltf)
//   .obj         polygons in groups by leaf name, with an .mtl beside it
//   .usda .usdz  prims by rule, instanceable prims for what stands several times, UsdPreviewSurface
//                with textures beside (.usda) or inside (.usdz)
//   .ply .stl    one mesh, binary
//   .city.json .city.jsonl   CityJSON 2.0, whole or a feature a line: objects by what leaves are
//                (city_kinds.h), with semantic surfaces and levels of detail
//   .ifc         IFC4 as STEP text: a building an initial shape, elements in storeys
//
// Promises: equal scenes give equal bytes on every machine; no coordinate is NaN or infinite and no
// triangle has zero area in the numbers as written; a file is complete or not there at all. Memory
// grows with the scene and its textures, not with what its instances expand to.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"
#include "scene/scene.h"
#include "shape/geo_frame.h"

namespace gable {

/// The bytes of a texture by the path that a material names.
using TextureReader = std::function<Result<std::string>(const std::string& path)>;

/// Leaves of a root that their rules say something of, by @Label or by a tag: those of one labelled
/// shape, without what has a label of its own within it.
struct LabelledLeaves {
  /// Their places among the leaves of the root in path order, instances expanded.
  uint64_t first = 0, end = 0;
  /// From 1; the pieces of one shape have one number.
  uint32_t shape = 0;
  std::string label;
};

struct WriteOptions {
  /// Without a reader, files stand for themselves: paths are opened as they are.
  TextureReader readTexture;
  /// glTF: how parts that occur several times are shown.
  enum class Instancing : uint8_t {
    /// By nodes that share a mesh, as long as there are at most kMostNodes: beyond, parts that save
    /// least are merged. Where that would add more than a GiB, as Gpu, from one node down.
    Auto,
    /// By a node each.
    Nodes,
    /// By nodes; equal children of a node become one node with EXT_mesh_gpu_instancing.
    Gpu,
    /// Not at all: everything is one mesh, merged by material.
    None,
    /// A mesh for each initial shape, merged by material; equal ones share it.
    Shapes,
  };
  static constexpr uint64_t kMostNodes = 20'000;
  Instancing instancing = Instancing::Auto;
  /// glTF: every root has a node of its own, however many there are; not with Instancing::None.
  bool apart = false;
  /// glTF, where roots are apart: by root, the roots that show it from farther away, the finest
  /// first (MSFT_lod). Those are in no scene of their own. Empty: there are none.
  std::vector<std::vector<uint32_t>> levels;
  /// The share of a view's height from which on each level is shown, the finest first.
  std::vector<double> coverage;
  /// glTF: as WriteSettings::bakedUv.
  bool bakedUv = false;
  /// Pictures are halved until no side is longer; 0 for any.
  uint32_t textureSize = 0;
  /// glTF: what a vertex takes.
  enum class Vertices : uint8_t {
    /// Float where the parts of a scene, each once, take at most kMostFloat bytes; else Compact.
    Auto,
    /// Single precision.
    Float,
    /// Integers of KHR_mesh_quantization: normals in bytes, positions in 16 bits where a mesh is
    /// small enough that no vertex moves by more than kMostQuantized along an axis; no uv sets but
    /// those of textures, in 16 bits unless a surface repeats its picture more than a hundred
    /// times, within a texel of a picture with 512; no tangents, which readers make.
    Compact,
    /// The same, and meshes that are lit flat have no normals: a reader makes them, as glTF
    /// demands. Faces share vertices round edges as well.
    Bare,
  };
  static constexpr uint64_t kMostFloat = 4 << 20;
  /// In metres, half a step.
  static constexpr double kMostQuantized = 1.0 / 2048;
  Vertices vertices = Vertices::Auto;
  /// Keep uv set 0 on surfaces whose material has no texture, unless vertices are compact.
  bool keepUv = true;
  /// CityJSON: which levels of detail.
  enum class Detail : uint8_t { All, One, Two, Three };
  Detail detail = Detail::All;
  /// City models and building models: what is known of an initial shape, by the number of its root;
  /// of equal names the first counts. Without a function nothing is.
  std::function<std::vector<AttributeValue>(size_t root)> attributesOf;
  /// City models and building models: the labels of a root's leaves, ascending and without
  /// overlaps. Without a function there are none.
  std::function<std::vector<LabelledLeaves>(size_t root)> labelsOf;
  /// Threads, where a format takes several; 0: as many as there are processors.
  unsigned jobs = 0;
  /// Where the world lies on the Earth; null where the scene's origin says it, or nobody knows.
  const GeoFrame* geo = nullptr;
};

struct WriteReport {
  /// Instances expanded; those without area left out.
  uint64_t triangles = 0;
  /// Of all files written.
  uint64_t bytes = 0;
  /// glTF: what its geometry would take more with nothing shared.
  uint64_t savedBytes = 0;
  std::vector<std::string> files;
  /// One sentence each: a texture that was not found, a surface left out.
  std::vector<std::string> warnings;
};

/// Codes: format-unknown, model-too-large, file-unwritable.
Result<WriteReport> writeModel(const Scene& scene, const std::string& path,
                               const WriteOptions& options = {});

/// The extensions that writeModel takes, without the first dot.
const std::vector<std::string>& modelExtensions();

/// The one of them that a path ends with, whatever the case of its letters; empty for none.
std::string modelFormatOf(const std::string& path);

/// The formats one by one.
Result<WriteReport> writeGltf(const Scene& scene, const std::string& path,
                              const WriteOptions& options);
Result<WriteReport> writeObj(const Scene& scene, const std::string& path,
                             const WriteOptions& options);
Result<WriteReport> writeUsd(const Scene& scene, const std::string& path,
                             const WriteOptions& options);
Result<WriteReport> writePly(const Scene& scene, const std::string& path,
                             const WriteOptions& options);
Result<WriteReport> writeStl(const Scene& scene, const std::string& path,
                             const WriteOptions& options);
Result<WriteReport> writeCityJson(const Scene& scene, const std::string& path,
                                  const WriteOptions& options);
Result<WriteReport> writeIfc(const Scene& scene, const std::string& path,
                             const WriteOptions& options);

}  // namespace gable
