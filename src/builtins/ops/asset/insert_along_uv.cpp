// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The model is brought into (u, height, -v) space, where one copy fills each unit square. Faces of
// the shape are triangles of that space: copies are cut along the sides of each triangle, and each
// cut piece is carried to the surface by the triangle's affine map. Neighbouring triangles cut at
// the same coordinates, so their pieces meet; points that coincide are made one.

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include "base/work.h"
#include "builtins/lists.h"
#include "builtins/ops/shared/edit_mesh.h"
#include "builtins/ops/shared/insert.h"
#include "builtins/shared/materials.h"
#include "geom/mesh/clip.h"
#include "geom/mesh/topology.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// Faces that the result may have; more means coordinates that were never normalised.
constexpr size_t kMaxFaces = 1u << 21;
// Points nearer than this (metres) are one point of the result.
constexpr double kSamePoint = 1e-6;

// A triangle of the shape with its coordinates and directions of height.
struct Patch {
  Vec2 uv[3];
  Vec3 at[3];
  Vec3 up[3];
  double det = 0;

  bool usable() const { return std::fabs(det) > 1e-12; }
  Vec3 place(const Vec3& p) const {
    const Vec2 d = Vec2{p.x, -p.z} - uv[0];
    const double b = cross(d, uv[2] - uv[0]) / det, c = cross(uv[1] - uv[0], d) / det;
    const double a = 1 - b - c;
    const Vec3 height = normalized(up[0] * a + up[1] * b + up[2] * c) * p.y;
    return at[0] * a + at[1] * b + at[2] * c + height;
  }
};

// Collects placed pieces, with points that coincide made one.
class Collector {
 public:
  void add(const Mesh& piece, const Patch& patch, bool reversed) {
    std::vector<uint32_t> map(piece.positions.size());
    Mesh placed = piece;
    for (Vec3& p : placed.positions) p = patch.place(p);
    for (size_t i = 0; i < map.size(); ++i) map[i] = positionOf(placed.positions[i]);
    for (size_t f = 0; f < placed.faceCount(); ++f) {
      work(4);
      if (placed.area(f) > 0) builder_.copyFace(placed, f, map, reversed);
    }
  }
  size_t faces() const { return count_; }
  void count(size_t more) { count_ += more; }
  Mesh take() { return builder_.take(); }

 private:
  uint32_t positionOf(const Vec3& p) {
    const auto grid = [](double v) { return std::llround(v / kSamePoint); };
    const auto key = std::make_tuple(grid(p.x), grid(p.y), grid(p.z));
    const auto at = known_.find(key);
    if (at != known_.end()) return at->second;
    const uint32_t index = builder_.addPosition(p);
    known_.emplace(key, index);
    return index;
  }
  MeshBuilder builder_;
  std::map<std::tuple<long long, long long, long long>, uint32_t> known_;
  size_t count_ = 0;
};

// The triangles of the shape's triangles and quads; other faces carry nothing.
std::vector<Patch> patchesOf(const Mesh& m, int set, bool alongNormals) {
  const std::vector<Vec3> normals = alongNormals ? vertexNormals(m) : std::vector<Vec3>();
  std::vector<Patch> patches;
  for (size_t f = 0; f < m.faceCount(); ++f) {
    work();
    const MeshLoop& loop = m.loopsOf(f)[0];
    if (m.faces[f].loopCount != 1 || loop.cornerCount < 3 || loop.cornerCount > 4) continue;
    for (uint32_t i = 1; i + 1 < loop.cornerCount; ++i) {
      Patch p;
      const uint32_t corners[3] = {0, i, i + 1};
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t c = loop.firstCorner + corners[k];
        p.uv[k] = m.uvs[static_cast<size_t>(set)][c];
        p.at[k] = m.at(c);
        p.up[k] = alongNormals ? normals[m.corners[c]] : Vec3{0, 1, 0};
      }
      p.det = cross(p.uv[1] - p.uv[0], p.uv[2] - p.uv[0]);
      if (p.usable()) patches.push_back(p);
    }
  }
  return patches;
}

// The part of a copy that lies within the triangle.
Mesh clipped(Mesh copy, const Patch& patch) {
  for (size_t k = 0; k < 3; ++k) {
    if (copy.empty()) break;
    const Vec2 a = patch.uv[k], b = patch.uv[(k + 1) % 3];
    const Vec2 out = patch.det > 0 ? -perpendicular(b - a) : perpendicular(b - a);
    const Vec2 unit = normalized(out);
    copy = std::move(cutByPlane(copy, {{unit.x, 0, -unit.y}, dot(unit, a)}).back.mesh);
  }
  return copy;
}

// All copies of the model that the triangle covers. False when there are too many.
bool addPatch(const Patch& patch, const Mesh& unit, bool mirrored, Collector& out) {
  Box2 box;
  for (const Vec2 uv : patch.uv) box.include(uv);
  constexpr double kSlack = 1e-9;
  const double u0 = std::floor(box.min.x + kSlack), u1 = std::ceil(box.max.x - kSlack);
  const double v0 = std::floor(box.min.y + kSlack), v1 = std::ceil(box.max.y - kSlack);
  const double copies = (u1 - u0) * (v1 - v0) * static_cast<double>(unit.faceCount());
  if (!(copies <= static_cast<double>(kMaxFaces - std::min(out.faces(), kMaxFaces)))) return false;
  out.count(static_cast<size_t>(copies));
  const bool reversed = (patch.det < 0) != mirrored;
  for (double u = u0; u < u1; ++u) {
    for (double v = v0; v < v1; ++v) {
      work(16);
      Mesh copy = unit;
      for (Vec3& p : copy.positions) p = p + Vec3{u, 0, -(v + 1)};
      out.add(clipped(std::move(copy), patch), patch, reversed);
    }
  }
  return true;
}

enum class HeightDirection : uint8_t { ScopeY, VertexNormal };
enum class HeightAlignment : uint8_t { AlignPosition, KeepPosition };

}  // namespace

template <>
struct WordsOf<HeightDirection> {
  static constexpr const char* text = "scope.y vertex.normal";
};
template <>
struct WordsOf<HeightAlignment> {
  static constexpr const char* text = "alignPosition keepPosition";
};

namespace {

struct InsertAlongUv {
  double uvSet;
  std::string_view path;
  double height;
  HeightDirection direction = HeightDirection::ScopeY;
  HeightAlignment alignment = HeightAlignment::AlignPosition;
};

// Of a file or a built-in one; null with the reason.
Ref<AssetModel> modelOf(const OpCall& call, std::string_view path, std::string& why) {
  if (!path.starts_with("builtin:")) {
    return call.services().assets().model(path, call.file(), false, why);
  }
  why = "there is no built-in model of that name";
  Mesh mesh = builtinModel(path);
  if (mesh.empty()) return {};
  AssetModel made;
  made.mesh = makeRef<Mesh>(std::move(mesh));
  fitModel(made);
  return makeRef<AssetModel>(std::move(made));
}

Status applyInsert(OpCall& call, const InsertAlongUv& args) {
  Shape& s = call.shape();
  const auto set = static_cast<int>(args.uvSet);
  if (!hasUvSet(s, set)) {
    return call.fail("no-uv",
                     "the shape has no texture coordinates in uv set " + std::to_string(set),
                     howToMakeUvs(s, set));
  }
  std::string why;
  const Ref<AssetModel> model = modelOf(call, args.path, why);
  if (!model) {
    // The model would have been as high as that.
    if (s.size.y == 0) s.size.y = std::max(args.height, 0.0);
    insertPlaceholder(call, args.path, why,
                      args.path.starts_with("builtin:") ? kBuiltinModelNames : kWherePathsStart);
    return {};
  }
  tellLosses(call, args.path, *model);

  // The model in (u, height, -v) space.
  const Vec3 size = model->bounds.size();
  const double height = args.height;
  const double lift = args.alignment == HeightAlignment::KeepPosition ? model->bounds.min.y : 0;
  Mesh unit = *fittedMesh(*model);
  unit.normals.clear();
  for (Vec3& p : unit.positions) {
    p = {size.x > 0 ? p.x / size.x : 0, size.y > 0 ? (p.y + lift) / size.y * height : lift,
         size.z > 0 ? p.z / size.z : 0};
  }

  const MeshRef mesh = meshInScope(s);
  Collector out;
  for (const Patch& patch :
       patchesOf(*mesh, set, args.direction == HeightDirection::VertexNormal)) {
    if (!addPatch(patch, unit, height < 0, out)) {
      return call.fail("too-much-geometry", "insertAlongUV would make too many copies",
                       "normalise or scale the texture coordinates before");
    }
  }
  Mesh made = out.take();
  s.assetMaterials = 0;
  setMesh(s, std::move(made), ScopeFit::Refit);
  setModelMaterials(s, *model, call.services());
  return {};
}

constexpr ParamSpec kSet =
    param<&InsertAlongUv::uvSet>("uvSet", "The uv set, 0 to 9, whose unit squares are filled.")
        .between(0, kUvSets - 1);
constexpr ParamSpec kPath = param<&InsertAlongUv::path>(
    "filePath", "The model: x runs along u, z against v, y is the height.");
constexpr ParamSpec kHeight =
    param<&InsertAlongUv::height>("height", "Height of the result, in metres.");
constexpr ParamSpec kPlainParams[] = {kSet, kPath, kHeight};
constexpr ParamSpec kFullParams[] = {
    kSet,
    kPath,
    kHeight,
    param<&InsertAlongUv::direction>("heightDirection",
                                     "Up along the scope, or along the vertex normals."),
    param<&InsertAlongUv::alignment>(
        "heightAlignment", "Stand the model on the faces, or keep its height above its own zero."),
};
constexpr Signature kSignatures[] = {{kPlainParams}, {kFullParams}};

constexpr OpSpec kSpecs[] = {
    {"insertAlongUV", "asset",
     "Replaces triangles and quads by copies of a model, bent along the texture coordinates.",
     kSignatures, typed<applyInsert>, BlockKind::None, kUsesTrim},
};

}  // namespace

extern const OpList kOps_insert_along_uv;
const OpList kOps_insert_along_uv = kSpecs;

}  // namespace gable
