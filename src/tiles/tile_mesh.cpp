// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "tiles/tile_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <tuple>

#include "base/work.h"
#include "io/exporters/plan.h"
#include "io/exporters/surface.h"
#include "material/linear_light.h"
#include "scene/flatten.h"

namespace gable {
namespace {

uint32_t bitsOf(double v) { return std::bit_cast<uint32_t>(static_cast<float>(v)); }
float floatOf(uint32_t bits) { return std::bit_cast<float>(bits); }

// Linear light in 16 bits: in eight, dark colours would come out in steps.
std::array<uint32_t, 2> colorWords(const Vec3& linear) {
  const auto part = [&](size_t i) {
    return static_cast<uint32_t>(std::lround(std::clamp(linear[i], 0.0, 1.0) * 65535));
  };
  return {part(0) | part(1) << 16, part(2) | 0xffff0000u};
}

// A vertex as it is written, but for its uv coordinates.
using Head = std::array<uint32_t, 9>;

Head headOf(const Vec3& position, const Vec3& normal, const std::array<uint32_t, 2>& color,
            uint32_t feature) {
  return {bitsOf(position.x), bitsOf(position.y), bitsOf(position.z),
          bitsOf(normal.x),   bitsOf(normal.y),   bitsOf(normal.z),
          color[0],           color[1],           bitsOf(feature)};
}

Vec3 placeOf(const Head& h) { return {floatOf(h[0]), floatOf(h[1]), floatOf(h[2])}; }

// False for NaN as well.
bool hasArea(const Head& a, const Head& b, const Head& c) {
  const Vec3 n = cross(placeOf(b) - placeOf(a), placeOf(c) - placeOf(a));
  return dot(n, n) > 0;
}

// What a primitive shows of a material: all but its colour and its name.
Material lookOf(const Material& m) {
  Material look = m;
  look.color = {1, 1, 1};
  look.name = "Gable";
  look.ambient = look.specular = {};
  look.reflectivity = 0;
  look.shininess = look.bumpValue = 1;
  return look;
}

// Takes vertices and triangles in, keeps the bounds.
class Filler {
 public:
  explicit Filler(std::vector<TilePrimitive>& primitives) : primitives_(primitives) {}

  TilePrimitive& primitive(uint32_t variant, uint32_t uvCount) {
    const auto [at, fresh] = byVariant_.try_emplace(variant, primitives_.size());
    if (fresh) {
      primitives_.emplace_back();
      primitives_.back().variant = variant;
      primitives_.back().uvCount = uvCount;
    }
    return primitives_[at->second];
  }

  void add(TilePrimitive& p, const Head& head) {
    p.words.insert(p.words.end(), head.begin(), head.end());
    const Vec3 at = placeOf(head);
    for (size_t i = 0; i < 3; ++i) {
      p.min[i] = std::min(p.min[i], static_cast<float>(at[i]));
      p.max[i] = std::max(p.max[i], static_cast<float>(at[i]));
    }
  }

 private:
  std::vector<TilePrimitive>& primitives_;
  std::map<uint32_t, size_t> byVariant_;
};

// Of all vertices, where they count from.
Box3 boxOf(const std::vector<TilePrimitive>& primitives) {
  Box3 box;
  for (const TilePrimitive& p : primitives) {
    if (p.words.empty()) continue;
    box.include(Vec3{double{p.min[0]}, double{p.min[1]}, double{p.min[2]}});
    box.include(Vec3{double{p.max[0]}, double{p.max[1]}, double{p.max[2]}});
  }
  return box;
}

void measure(TileMesh& mesh) {
  const auto triangles = [](const std::vector<TilePrimitive>& primitives) {
    uint64_t sum = 0;
    for (const TilePrimitive& p : primitives) sum += p.indices.size() / 3;
    return sum;
  };
  Box3 box = boxOf(mesh.primitives);
  mesh.triangles = mesh.cost = triangles(mesh.primitives);
  for (const TileInstances& i : mesh.instances) {
    const uint64_t once = triangles(i.primitives);
    mesh.triangles += once * i.places.size();
    mesh.cost += costOf(once, i.places.size());
    const Box3 part = boxOf(i.primitives);
    for (const TileInstances::Place& p : i.places) {
      const Box3 placed = boundsAt(part, p.frame, {1, 1, 1});
      if (!placed.empty()) box.include(placed);
    }
  }
  if (box.empty()) return;
  mesh.box.include(mesh.center + box.min);
  mesh.box.include(mesh.center + box.max);
}

class FullFiller {
 public:
  FullFiller(const TileContent& content, const WriteOptions& options, TileMesh& mesh)
      : content_(content), mesh_(mesh) {
    mesh_.looks = std::make_shared<Scene>();
    canonize();
    mesh_.materials = std::make_shared<GltfMaterials>(*mesh_.looks, options, mesh_.warnings);
  }

  void run() {
    const std::vector<TileGroup> groups = groupsOf(content_);
    std::vector<bool> apart(content_.placements.size());
    for (const TileGroup& g : groups) {
      for (const uint32_t p : g.placements) apart[p] = true;
    }
    Filler rest(mesh_.primitives);
    for (const TileLeaf& l : content_.leaves) {
      if (l.placement != TileLeaf::kNone && apart[l.placement]) continue;
      add(l, mesh_.center, rest);
    }
    for (const TileGroup& g : groups) addGroup(g);
  }

 private:
  void addGroup(const TileGroup& g) {
    TileInstances out;
    const Scene& scene = *content_.scenes[g.scene];
    Filler filler(out.primitives);
    walk(
        scene, scene.prototypes[g.prototype], Frame{},
        [&](uint32_t leaf, const Frame& at, size_t) {
          TileLeaf l;
          l.scene = g.scene;
          l.leaf = leaf;
          l.world = at * scene.leaves[leaf].frame;
          add(l, {}, filler);
        },
        [](const Instance&, const Frame&, size_t) { return true; });
    if (std::all_of(out.primitives.begin(), out.primitives.end(),
                    [](const TilePrimitive& p) { return p.indices.empty(); })) {
      return;
    }
    for (const uint32_t p : g.placements) {
      const TilePlacement& placed = content_.placements[p];
      Frame at = placed.world;
      at.origin = at.origin - mesh_.center;
      out.places.push_back({at, placed.feature});
    }
    mesh_.instances.push_back(std::move(out));
  }

  // Materials are known before the first is asked for: those who look into the list keep pointers.
  void canonize() {
    std::map<uint64_t, std::vector<uint32_t>> known;
    std::vector<Material>& looks = mesh_.looks->materials;
    looks_.resize(content_.scenes.size());
    for (size_t s = 0; s < content_.scenes.size(); ++s) {
      for (const Material& m : content_.scenes[s]->materials) {
        const Material look = lookOf(m);
        std::vector<uint32_t>& same = known[contentHash(look)];
        const auto at =
            std::find_if(same.begin(), same.end(), [&](uint32_t i) { return looks[i] == look; });
        if (at == same.end()) {
          same.push_back(static_cast<uint32_t>(looks.size()));
          looks.push_back(look);
          looks_[s].push_back(same.back());
        } else {
          looks_[s].push_back(*at);
        }
      }
    }
  }

  const DrawSurface& surfaceOf(uint32_t scene, uint32_t mesh) {
    // Meshes of one leaf come and go; the primitives and those that follow one another stay.
    constexpr uint64_t kMostVertices = 1'000'000;
    const std::pair<uint32_t, uint32_t> key{scene, mesh};
    if (cached_ > kMostVertices) {
      surfaces_.clear();
      cached_ = 0;
    }
    const auto [at, fresh] = surfaces_.try_emplace(key);
    if (fresh) {
      at->second.build(*content_.scenes[scene]->meshes[mesh], triangulator_);
      cached_ += at->second.corners.size();
    }
    return at->second;
  }

  // Positions count from `center`.
  void add(const TileLeaf& l, const Vec3& center, Filler& filler) {
    const Scene& scene = *content_.scenes[l.scene];
    const Leaf& leaf = scene.leaves[l.leaf];
    const Mesh& mesh = *scene.meshes[leaf.mesh];
    uint32_t uvMask = 0;
    for (int s = 0; s < kUvSets; ++s) uvMask |= mesh.hasUv(s) ? 1u << s : 0;
    const DrawSurface& surface = surfaceOf(l.scene, leaf.mesh);
    work(surface.corners.size());
    for (const SurfacePart& part : surface.parts) {
      const uint32_t material = materialIndexOf(scene, leaf, part.slot);
      const uint32_t look = material == kNoMaterial ? kNoMaterial : looks_[l.scene][material];
      const uint32_t variant = mesh_.materials->variant(look, uvMask);
      const VertexLayout& layout = mesh_.materials->layout(variant);
      TilePrimitive& primitive = filler.primitive(variant, layout.uvCount);
      const auto color = colorWords(linearOf(materialOf(scene, leaf, part.slot).color));
      for (uint32_t f = 0; f < part.faceCount; ++f) {
        setHeads(l, leaf, mesh, surface, surface.faces[part.firstFace + f], center, color);
        addFace(leaf, mesh, surface, surface.faces[part.firstFace + f], layout, filler, primitive);
      }
    }
  }

  void setHeads(const TileLeaf& l, const Leaf& leaf, const Mesh& mesh, const DrawSurface& surface,
                const SurfaceFace& face, const Vec3& center, const std::array<uint32_t, 2>& color) {
    heads_.clear();
    for (uint32_t v = face.firstVertex; v < face.firstVertex + face.vertexCount; ++v) {
      const Vec3 p = l.world.point(scaled(mesh.at(surface.corners[v]), leaf.scale));
      const Vec3 n = l.world.direction(scaledNormal(surface.normals[v], leaf.scale));
      heads_.push_back(headOf(p - center, n, color, l.feature));
    }
  }

  void addFace(const Leaf& leaf, const Mesh& mesh, const DrawSurface& surface,
               const SurfaceFace& face, const VertexLayout& layout, Filler& filler,
               TilePrimitive& primitive) {
    if (!std::all_of(heads_.begin(), heads_.end(),
                     [](const Head& h) { return isFinite(placeOf(h)); })) {
      return;
    }
    const uint32_t base = primitive.vertexCount();
    const size_t first = primitive.indices.size();
    const bool mirrored = leaf.scale.x * leaf.scale.y * leaf.scale.z < 0;
    for (uint32_t t = 0; t < face.triangleCount; ++t) {
      const auto& tri = surface.triangles[face.firstTriangle + t];
      if (!hasArea(heads_[tri[0]], heads_[tri[1]], heads_[tri[2]])) continue;
      for (const uint32_t v : {tri[0], tri[mirrored ? 2 : 1], tri[mirrored ? 1 : 2]}) {
        primitive.indices.push_back(base + v);
      }
    }
    if (primitive.indices.size() == first) return;
    for (uint32_t v = 0; v < face.vertexCount; ++v) {
      filler.add(primitive, heads_[v]);
      for (uint32_t i = 0; i < layout.uvCount; ++i) {
        const std::vector<Vec2>& uv = mesh.uvs[layout.uvSets[i]];
        const Vec2 at = uv.empty() ? Vec2{} : uv[surface.corners[face.firstVertex + v]];
        primitive.words.push_back(bitsOf(at.x));
        primitive.words.push_back(bitsOf(1 - at.y));
      }
    }
  }

  const TileContent& content_;
  TileMesh& mesh_;
  // By scene and material: the index of its look.
  std::vector<std::vector<uint32_t>> looks_;
  FaceTriangulator triangulator_;
  std::map<std::pair<uint32_t, uint32_t>, DrawSurface> surfaces_;
  uint64_t cached_ = 0;
  std::vector<Head> heads_;
};

// Triangles of a part that lie in one plane share vertices.
class CoarseFiller {
 public:
  CoarseFiller(const CoarseModel& model, TileMesh& mesh)
      : model_(model), mesh_(mesh), filler_(mesh.primitives) {
    mesh_.looks = std::make_shared<Scene>();
    mesh_.looks->materials.push_back(lookOf(Material{}));
    mesh_.materials = std::make_shared<GltfMaterials>(*mesh_.looks, WriteOptions{}, mesh_.warnings);
  }

  void run() {
    TilePrimitive& primitive = filler_.primitive(mesh_.materials->variant(0, 0), 0);
    for (const CoarsePart& p : model_.parts) {
      work(p.triangleCount);
      known_.clear();
      const auto color = colorWords(p.finish.color);
      for (uint32_t t = 0; t < p.triangleCount; ++t) {
        addTriangle(p, model_.triangles[p.firstTriangle + t], color, primitive);
      }
    }
    if (primitive.indices.empty()) mesh_.primitives.clear();
  }

 private:
  void addTriangle(const CoarsePart& p, const std::array<uint32_t, 3>& tri,
                   const std::array<uint32_t, 2>& color, TilePrimitive& primitive) {
    const auto at = [&](size_t i) {
      return model_.vertices[p.firstVertex + tri[i]] - mesh_.center;
    };
    const Vec3 n = normalized(cross(at(1) - at(0), at(2) - at(0)));
    std::array<Head, 3> heads;
    for (size_t i = 0; i < 3; ++i) heads[i] = headOf(at(i), n, color, p.feature);
    if (!hasArea(heads[0], heads[1], heads[2])) return;
    const auto step = [](double v) { return static_cast<int32_t>(std::lround(v * 500)); };
    for (size_t i = 0; i < 3; ++i) {
      const auto [known, fresh] =
          known_.try_emplace({tri[i], step(n.x), step(n.y), step(n.z)}, primitive.vertexCount());
      if (fresh) filler_.add(primitive, heads[i]);
      primitive.indices.push_back(known->second);
    }
  }

  const CoarseModel& model_;
  TileMesh& mesh_;
  Filler filler_;
  std::map<std::tuple<uint32_t, int32_t, int32_t, int32_t>, uint32_t> known_;
};

// To the eighth of a metre: such numbers are exact in files.
Vec3 centerOf(const Box3& box) {
  if (box.empty()) return {};
  const Vec3 c = box.center();
  const auto rounded = [](double v) { return std::round(v * 8) / 8; };
  return {rounded(c.x), rounded(c.y), rounded(c.z)};
}

}  // namespace

TilePrimitive::TilePrimitive() {
  min.fill(std::numeric_limits<float>::infinity());
  max.fill(-std::numeric_limits<float>::infinity());
}

TileMesh meshOf(const TileContent& content, const WriteOptions& options) {
  TileMesh mesh;
  mesh.features = content.features;
  Box3 box;
  for (const TileLeaf& l : content.leaves) {
    const Scene& scene = *content.scenes[l.scene];
    const Box3 local = localBox(scene, scene.leaves[l.leaf]);
    if (!local.empty()) box.include(l.world.point(local.center()));
  }
  mesh.center = centerOf(box);
  FullFiller(content, options, mesh).run();
  measure(mesh);
  return mesh;
}

TileMesh meshOf(const CoarseModel& model) {
  TileMesh mesh;
  mesh.features = model.features;
  Box3 box;
  for (const Vec3& v : model.vertices) box.include(v);
  mesh.center = centerOf(box);
  CoarseFiller(model, mesh).run();
  measure(mesh);
  return mesh;
}

}  // namespace gable
