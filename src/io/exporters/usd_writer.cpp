// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// USD as text. The plan of nodes is that of glTF: what is shown once stands where it is; what is
// shown several times is a prim of the class "Prototypes", and each place of it an instanceable
// prim that refers to it. Below, a mesh holds what one rule made of one material. Layers refer to
// prims of their own, so that bindings of materials reach outside of prototypes.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/files.h"
#include "base/number.h"
#include "base/work.h"
#include "io/exporters/plan.h"
#include "io/exporters/surface.h"
#include "io/exporters/usd_materials.h"
#include "scene/flatten.h"

namespace gable {
namespace {

// A mesh of more vertices is several.
constexpr size_t kMostVertices = 1'000'000;
// Merged into one unit.
constexpr double kMostLeaves = 1e8;
constexpr int kDecimals = 9;

using Point = std::array<float, 3>;

Point pointOf(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

Vec3 vecOf(const Point& p) { return {p[0], p[1], p[2]}; }

// In single precision.
bool isNumber(double v) { return std::isfinite(static_cast<float>(v)); }

bool hasArea(const Point& a, const Point& b, const Point& c) {
  const Vec3 n = cross(vecOf(b) - vecOf(a), vecOf(c) - vecOf(a));
  return isFinite(n) && dot(n, n) > 0;
}

// What the files of textures beside a layer begin with.
std::string textureStem(const std::string& path) {
  const std::string file = fileNameOf(path);
  return path.substr(0, path.size() - file.size()) +
         usdFileName(file.substr(0, file.size() - extensionOf(path).size() - 1));
}

// What becomes one mesh: the leaves of a unit that one place in the rules made of one material.
struct MeshGroup {
  uint32_t name = 0, source = 0, binding = 0;
  // Leaf of the unit's content, and slot.
  std::vector<std::pair<uint32_t, uint16_t>> draws;
};

struct MeshText {
  std::vector<Point> points;
  std::vector<Vec3> normals;
  std::array<std::vector<Vec2>, kUvSets> uvs;
  std::vector<uint32_t> indices;
};

class UsdWriter {
 public:
  UsdWriter(const Scene& scene, const std::string& path, const WriteOptions& options)
      : scene_(scene),
        path_(path),
        stem_(textureStem(path)),
        packed_(extensionOf(path) == "usdz"),
        plan_(scene,
              {options.instancing != WriteOptions::Instancing::None,
               options.instancing == WriteOptions::Instancing::Auto ? WriteOptions::kMostNodes : 0,
               0}),
        out_(path),
        layer_(out_),
        materials_(scene, options, report_.warnings),
        meshTriangles_(plan_.units().size()) {}

  Result<WriteReport> write();

 private:
  struct OpenPrim {
    uint32_t unit = 0;
    size_t child = 0;
    UsdNames names;
  };

  void writeLayer();
  void writeHead();
  void countUses();
  void writePrototypes();
  void writeTree(uint32_t unit);
  void writePlace(const Frame& frame, const Vec3& scale);
  void writeReference(const std::string& name, uint32_t unit, const Frame& frame,
                      const Vec3& scale);
  void writeMeshes(uint32_t unit, UsdNames& names);
  std::vector<MeshGroup> groupsOf();
  const DrawSurface& surfaceOf(uint32_t mesh, bool laid);
  void add(const PlannedLeaf& planned, uint16_t slot, uint32_t binding, MeshText& mesh);
  void writeMesh(const MeshGroup& group, const std::string& name, const MeshText& mesh);
  void writePoints(const char* head, size_t count, const std::function<Vec3(size_t)>& at,
                   const char* end);
  std::string nameOf(uint32_t unit) const;
  void countTriangles();
  std::optional<Error> writeTextures(UsdArchive& archive);

  const Scene& scene_;
  std::string path_, stem_;
  bool packed_;
  WriteReport report_;
  ScenePlan plan_;
  FileWriter out_;
  UsdLayer layer_;
  UsdMaterials materials_;
  // By unit.
  std::vector<uint64_t> meshTriangles_;
  std::vector<uint32_t> uses_;
  std::vector<std::string> prototypes_;
  // Of the unit at hand.
  UnitContent content_;
  FaceTriangulator triangulator_;
  // Meshes that the unit draws twice, be it in two slots, are kept: by mesh, and whether laid.
  std::map<uint32_t, uint32_t> draws_;
  std::map<std::pair<uint32_t, bool>, DrawSurface> surfaces_;
  DrawSurface single_;
  uint64_t brokenFaces_ = 0;
};

std::string UsdWriter::nameOf(uint32_t unit) const {
  const ScenePlan::Unit& u = plan_.units()[unit];
  if (u.leaf == ScenePlan::kNone && u.prototype == ScenePlan::kNone) return "all";
  const uint32_t name =
      u.leaf != ScenePlan::kNone ? scene_.leaves[u.leaf].name : scene_.prototypes[u.prototype].name;
  return name < scene_.names.size() ? scene_.names[name] : "part";
}

void UsdWriter::countUses() {
  uses_.assign(plan_.units().size(), 0);
  prototypes_.resize(uses_.size());
  const auto use = [&](uint32_t unit) { uses_[unit] += uses_[unit] < 2 ? 1 : 0; };
  for (const PlannedRoot& r : plan_.roots()) use(r.unit);
  for (const ScenePlan::Unit& u : plan_.units()) {
    for (const PlannedChild& c : u.children) use(c.unit);
  }
}

void UsdWriter::writePlace(const Frame& f, const Vec3& scale) {
  if (f == Frame{} && scale == Vec3{1, 1, 1}) return;
  std::string text = "matrix4d xformOp:transform = (";
  const auto row = [&](const Vec3& v, const char* last) {
    text += text.back() == '(' ? "(" : ", (";
    for (size_t i = 0; i < 3; ++i) {
      char number[kNumberRoom];
      text.append(number, writeFixed(number, v[i], kDecimals));
      text += ", ";
    }
    text += std::string(last) + ")";
  };
  row(f.x * scale.x, "0");
  row(f.y * scale.y, "0");
  row(f.z * scale.z, "0");
  row(f.origin, "1");
  layer_.line(text + ")");
  layer_.line("uniform token[] xformOpOrder = [\"xformOp:transform\"]");
}

void UsdWriter::writeReference(const std::string& name, uint32_t unit, const Frame& frame,
                               const Vec3& scale) {
  layer_.line("def Xform \"" + name + "\" (");
  layer_.line("    instanceable = true");
  layer_.line("    references = </Prototypes/" + prototypes_[unit] + ">");
  layer_.line(")");
  layer_.open("");
  writePlace(frame, scale);
  layer_.close();
}

// What a unit holds, below the prim that is open. Units nest as deep as rules do, so those at work
// are a list.
void UsdWriter::writeTree(uint32_t unit) {
  std::vector<OpenPrim> open(1);
  open[0].unit = unit;
  writeMeshes(unit, open[0].names);
  while (!out_.failed()) {
    work();
    OpenPrim& top = open.back();
    const std::vector<PlannedChild>& children = plan_.units()[top.unit].children;
    if (top.child == children.size()) {
      open.pop_back();
      if (open.empty()) return;
      layer_.close();
      continue;
    }
    const PlannedChild& c = children[top.child++];
    const std::string name = top.names.unique(nameOf(c.unit));
    if (uses_[c.unit] > 1) {
      writeReference(name, c.unit, c.frame, c.scale);
      continue;
    }
    layer_.open("def Xform \"" + name + "\"");
    writePlace(c.frame, c.scale);
    open.emplace_back();
    open.back().unit = c.unit;
    writeMeshes(c.unit, open.back().names);
  }
}

void UsdWriter::writePrototypes() {
  UsdNames names;
  for (uint32_t u = 0; u < uses_.size(); ++u) {
    if (uses_[u] > 1) prototypes_[u] = names.unique(nameOf(u));
  }
  if (std::all_of(uses_.begin(), uses_.end(), [](uint32_t n) { return n < 2; })) return;
  layer_.open("class \"Prototypes\"");
  for (uint32_t u = 0; u < uses_.size() && !out_.failed(); ++u) {
    if (uses_[u] < 2) continue;
    layer_.open("def Xform \"" + prototypes_[u] + "\"");
    writeTree(u);
    layer_.close();
  }
  layer_.close();
}

std::vector<MeshGroup> UsdWriter::groupsOf() {
  std::vector<MeshGroup> groups;
  draws_.clear();
  surfaces_.clear();
  std::map<std::array<uint32_t, 3>, size_t> known;
  for (uint32_t i = 0; i < content_.leaves.size(); ++i) {
    work();
    const Leaf& leaf = scene_.leaves[content_.leaves[i].leaf];
    const Mesh& m = *scene_.meshes[leaf.mesh];
    uint32_t mask = 0;
    for (int s = 0; s < kUvSets; ++s) mask |= m.hasUv(s) ? 1u << s : 0;
    for (const SlotTally& slot : slotTallies(m)) {
      const uint32_t b = materials_.binding(materialIndexOf(scene_, leaf, slot.slot), mask);
      const auto [at, isNew] = known.try_emplace({leaf.name, leaf.source, b}, groups.size());
      if (isNew) groups.push_back({leaf.name, leaf.source, b, {}});
      groups[at->second].draws.emplace_back(i, slot.slot);
      uint32_t& draws = draws_[leaf.mesh];
      draws += draws < 2 ? 1 : 0;
    }
  }
  return groups;
}

// Faces of what is laid stay apart: each has coordinates of its own.
const DrawSurface& UsdWriter::surfaceOf(uint32_t mesh, bool laid) {
  if (draws_[mesh] < 2) {
    single_.build(*scene_.meshes[mesh], triangulator_, laid);
    return single_;
  }
  const auto [at, isNew] = surfaces_.try_emplace({mesh, laid});
  if (isNew) at->second.build(*scene_.meshes[mesh], triangulator_, laid);
  return at->second;
}

void UsdWriter::add(const PlannedLeaf& planned, uint16_t slot, uint32_t binding, MeshText& mesh) {
  const Leaf& leaf = scene_.leaves[planned.leaf];
  const Mesh& m = *scene_.meshes[leaf.mesh];
  const bool own = planned.placement == ScenePlan::kNone;
  const Frame world = own ? Frame{} : content_.placements[planned.placement] * leaf.frame;
  const Vec3 scale = own ? Vec3{1, 1, 1} : leaf.scale;
  const bool turn = ((scale.x < 0) != (scale.y < 0)) != (scale.z < 0);
  const bool laid = materials_.isLaid(binding);
  const uint32_t uvMask = materials_.uvMask(binding);
  const DrawSurface& surface = surfaceOf(leaf.mesh, laid);
  const SurfacePart* part = surface.part(slot);
  if (!part) return;
  std::vector<uint32_t> placed;
  for (uint32_t f = part->firstFace; f < part->firstFace + part->faceCount; ++f) {
    const SurfaceFace& face = surface.faces[f];
    work(face.vertexCount + face.triangleCount);
    std::vector<Point> points(face.vertexCount);
    for (uint32_t v = 0; v < face.vertexCount; ++v) {
      const uint32_t corner = surface.corners[face.firstVertex + v];
      points[v] = pointOf(world.point(scaled(m.positions[m.corners[corner]], scale)));
    }
    const bool finite = std::all_of(points.begin(), points.end(),
                                    [](const Point& p) { return isFinite(vecOf(p)); });
    if (!finite) {
      ++brokenFaces_;
      continue;
    }
    placed.assign(face.vertexCount, ScenePlan::kNone);
    const FaceAxes axes = laid ? layingOf(m, surface, face, world, scale) : FaceAxes{};
    const auto place = [&](uint32_t v) {
      if (placed[v] == ScenePlan::kNone) {
        placed[v] = static_cast<uint32_t>(mesh.points.size());
        const uint32_t vertex = face.firstVertex + v, corner = surface.corners[vertex];
        mesh.points.push_back(points[v]);
        mesh.normals.push_back(world.direction(scaledNormal(surface.normals[vertex], scale)));
        if (laid) {
          const Vec2 uv = axes.at(vecOf(points[v]));
          mesh.uvs[0].push_back(isNumber(uv.x) && isNumber(uv.y) ? uv : Vec2{});
        }
        for (int s = 0; s < kUvSets && !laid; ++s) {
          if (uvMask >> s & 1)
            mesh.uvs[static_cast<size_t>(s)].push_back(m.uvs[static_cast<size_t>(s)][corner]);
        }
      }
      mesh.indices.push_back(placed[v]);
    };
    for (uint32_t t = face.firstTriangle; t < face.firstTriangle + face.triangleCount; ++t) {
      const std::array<uint32_t, 3>& abc = surface.triangles[t];
      if (!hasArea(points[abc[0]], points[abc[1]], points[abc[2]])) continue;
      for (const size_t k : {0, turn ? 2 : 1, turn ? 1 : 2}) place(abc[k]);
    }
  }
}

void UsdWriter::writePoints(const char* head, size_t count, const std::function<Vec3(size_t)>& at,
                            const char* end) {
  layer_.raw(head);
  for (size_t i = 0; i < count; ++i) {
    work();
    layer_.raw(i ? ", " : "");
    layer_.raw(usdVec(at(i)));
  }
  layer_.raw(end);
}

void UsdWriter::writeMesh(const MeshGroup& group, const std::string& name, const MeshText& mesh) {
  const std::string& symbol = group.name < scene_.names.size() ? scene_.names[group.name] : name;
  layer_.line("def Mesh \"" + name + "\" (");
  layer_.line("    prepend apiSchemas = [\"MaterialBindingAPI\"]");
  layer_.line("    customData = {");
  layer_.line("        string name = " + usdText(symbol));
  if (group.source < scene_.sources.size() && !scene_.sources[group.source].rule.empty()) {
    const SourcePlace& s = scene_.sources[group.source];
    layer_.line("        string rule = " + usdText(s.rule));
    layer_.line("        string file = " + usdText(s.file));
    layer_.line("        int line = " + std::to_string(s.line));
  }
  layer_.line("    }");
  layer_.line(")");
  layer_.open("");
  Box3 box;
  for (const Point& p : mesh.points) box.include(vecOf(p));
  layer_.line("float3[] extent = [" + usdVec(box.min) + ", " + usdVec(box.max) + "]");
  layer_.line("uniform token subdivisionScheme = \"none\"");
  if (materials_.material(group.binding).doubleSided) layer_.line("uniform bool doubleSided = 1");
  layer_.line("rel material:binding = <" + materials_.path(group.binding) + ">");
  layer_.raw("int[] faceVertexCounts = [");
  for (size_t i = 0; i < mesh.indices.size() / 3; ++i) layer_.raw(i ? ", 3" : "3");
  layer_.raw("]\nint[] faceVertexIndices = [");
  for (size_t i = 0; i < mesh.indices.size(); ++i) {
    layer_.raw(i ? ", " : "");
    layer_.raw(std::to_string(mesh.indices[i]));
  }
  layer_.raw("]\n");
  writePoints(
      "point3f[] points = [", mesh.points.size(), [&](size_t i) { return vecOf(mesh.points[i]); },
      "]\n");
  writePoints(
      "normal3f[] normals = [", mesh.normals.size(), [&](size_t i) { return mesh.normals[i]; },
      "] (interpolation = \"vertex\")\n");
  for (uint32_t s = 0; s < kUvSets; ++s) {
    const std::vector<Vec2>& uv = mesh.uvs[s];
    if (uv.empty()) continue;
    layer_.raw("texCoord2f[] primvars:" + UsdMaterials::primvar(s) + " = [");
    for (size_t i = 0; i < uv.size(); ++i) {
      const std::string three = usdVec({uv[i].x, uv[i].y, 0});
      layer_.raw(i ? ", " : "");
      layer_.raw(three.substr(0, three.rfind(',')) + ")");
    }
    layer_.raw("] (interpolation = \"vertex\")\n");
  }
  layer_.close();
}

void UsdWriter::writeMeshes(uint32_t unit, UsdNames& names) {
  plan_.collect(unit, content_);
  for (const MeshGroup& group : groupsOf()) {
    const std::string& symbol = group.name < scene_.names.size() ? scene_.names[group.name] : "";
    MeshText mesh;
    const auto put = [&] {
      if (mesh.indices.empty()) return;
      meshTriangles_[unit] += mesh.indices.size() / 3;
      writeMesh(group, names.unique(symbol), mesh);
      mesh = MeshText{};
    };
    for (const auto& [leaf, slot] : group.draws) {
      if (out_.failed()) return;
      workMemory(mesh.points.capacity() * sizeof(Point));
      add(content_.leaves[leaf], slot, group.binding, mesh);
      if (mesh.points.size() > kMostVertices) put();
    }
    put();
  }
}

void UsdWriter::writeHead() {
  layer_.line("#usda 1.0");
  layer_.line("(");
  layer_.line("    customLayerData = {");
  layer_.line("        string generator = \"Gable\"");
  if (scene_.geoOrigin.present) {
    layer_.line("        double longitude = " + shortestText(scene_.geoOrigin.longitude));
    layer_.line("        double latitude = " + shortestText(scene_.geoOrigin.latitude));
  }
  layer_.line("    }");
  layer_.line("    defaultPrim = \"World\"");
  layer_.line("    metersPerUnit = 1");
  layer_.line("    upAxis = \"Y\"");
  layer_.line(")");
}

void UsdWriter::writeLayer() {
  writeHead();
  countUses();
  writePrototypes();
  layer_.line("def Xform \"World\" (");
  layer_.line("    kind = \"assembly\"");
  layer_.line(")");
  layer_.open("");
  UsdNames names;
  names.unique("Materials");
  for (const PlannedRoot& root : plan_.roots()) {
    if (out_.failed()) break;
    const bool named =
        root.root != PlannedRoot::kAll && scene_.roots[root.root].name < scene_.names.size();
    const std::string symbol = named ? scene_.names[scene_.roots[root.root].name] : "all";
    const std::string name = names.unique(symbol);
    if (uses_[root.unit] > 1) {
      writeReference(name, root.unit, root.frame, {1, 1, 1});
      continue;
    }
    layer_.line("def Xform \"" + name + "\" (");
    layer_.line("    customData = {");
    layer_.line("        string name = " + usdText(symbol));
    layer_.line("    }");
    layer_.line("    kind = \"component\"");
    layer_.line(")");
    layer_.open("");
    writePlace(root.frame, {1, 1, 1});
    writeTree(root.unit);
    layer_.close();
  }
  materials_.write(layer_, packed_ ? "textures/" : "./" + fileNameOf(stem_) + "-");
  layer_.close();
  layer_.flush();
}

// Triangles with places expanded. A unit is counted when all that show it are.
void UsdWriter::countTriangles() {
  const auto count = static_cast<uint32_t>(plan_.units().size());
  std::vector<uint64_t> shown(count);
  std::vector<uint32_t> waiting(count), ready;
  for (const PlannedRoot& r : plan_.roots()) ++shown[r.unit];
  for (const auto& unit : plan_.units()) {
    for (const PlannedChild& c : unit.children) ++waiting[c.unit];
  }
  for (uint32_t u = 0; u < count; ++u) {
    if (waiting[u] == 0) ready.push_back(u);
  }
  while (!ready.empty()) {
    const uint32_t u = ready.back();
    ready.pop_back();
    report_.triangles =
        saturatingAdd(report_.triangles, saturatingMultiply(meshTriangles_[u], shown[u]));
    for (const PlannedChild& c : plan_.units()[u].children) {
      shown[c.unit] = saturatingAdd(shown[c.unit], shown[u]);
      if (--waiting[c.unit] == 0) ready.push_back(c.unit);
    }
  }
}

std::optional<Error> UsdWriter::writeTextures(UsdArchive& archive) {
  for (const ModelTexture& t : materials_.images()) {
    if (packed_) {
      archive.add("textures/" + t.name, t.bytes);
      continue;
    }
    const std::string file = stem_ + "-" + t.name;
    const Result<uint64_t> bytes = writeFile(file, t.bytes);
    if (!bytes.ok()) return bytes.error();
    report_.bytes += bytes.value();
    report_.files.push_back(file);
  }
  return {};
}

Result<WriteReport> UsdWriter::write() {
  for (uint32_t u = 0; u < plan_.units().size(); ++u) {
    if (plan_.tooLarge() || plan_.contentSize(u) > kMostLeaves) {
      return Error{"model-too-large", "'" + path_ + "' would show more leaves than can be written",
                   "generate fewer shapes at a time"};
    }
  }
  UsdArchive archive(out_);
  if (packed_) archive.begin("model.usda");
  writeLayer();
  if (packed_) archive.end(layer_.bytes(), layer_.checkSum());
  if (auto error = writeTextures(archive)) return *error;
  if (packed_) {
    archive.finish();
    if (out_.offset() > UsdArchive::kMostBytes) {
      return Error{"model-too-large",
                   "'" + path_ + "' would hold " + std::to_string(out_.offset() >> 20) +
                       " MiB, but a .usdz file ends at 4096 MiB",
                   "write .usda, or generate fewer shapes at a time"};
    }
  }
  const Result<uint64_t> bytes = out_.finish();
  if (!bytes.ok()) return bytes.error();
  report_.bytes += bytes.value();
  report_.files.insert(report_.files.begin(), path_);
  if (brokenFaces_ > 0) {
    report_.warnings.push_back(std::to_string(brokenFaces_) +
                               " faces are left out: their coordinates are too large or undefined");
  }
  countTriangles();
  return report_;
}

}  // namespace

Result<WriteReport> writeUsd(const Scene& scene, const std::string& path,
                             const WriteOptions& options) {
  return UsdWriter(scene, path, options).write();
}

}  // namespace gable
