// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// How scenes become triangles: meshes are triangulated once each; prototypes are costed from the
// innermost outwards (an instance's prototype has the smaller index), and one that stands several
// times becomes a part where that saves memory; then the roots are walked once.

#include "render/world.h"

#include <bit>
#include <cmath>
#include <map>
#include <optional>

#include "base/dispose.h"
#include "base/work.h"
#include "math/trig.h"
#include "render/triangles.h"

namespace gable::rt {

namespace {

/// Rough bytes of a stored triangle, acceleration structure included, and what a placement may cost
/// in place of its triangles: it takes a third of that itself, but each ray about it takes longer.
constexpr double kTriangleCost = 100, kPlacementCost = 1500;
/// Beyond this a coordinate is a mistake, and would spoil framing and precision for the rest.
constexpr double kFarthest = 1e7;

uint32_t materialOf(const Scene& scene, const Leaf& leaf, uint16_t slot, size_t materials) {
  if (leaf.materials >= scene.materialLists.size()) return 0;
  const std::vector<uint32_t>& list = scene.materialLists[leaf.materials];
  if (list.empty()) return 0;
  const uint32_t m = slot < list.size() ? list[slot] : list[0];
  return m < materials ? m : 0;
}

bool usable(const Vec3& p) {
  return std::abs(p.x) < kFarthest && std::abs(p.y) < kFarthest && std::abs(p.z) < kFarthest;
}

/// Which prototypes are placed instead of merged, and what is merged of all roots.
struct Plan {
  std::vector<bool> placed;
  double triangles = 0, positions = 0;
};

Plan planOf(const Scene& scene, const std::vector<MeshTriangles>& meshes) {
  const size_t n = scene.prototypes.size();
  std::vector<double> uses(n, 0), whole(n, 0), inlined(n, 0);
  for (const Root& root : scene.roots) uses[root.instance.prototype] += 1;
  for (size_t p = n; p-- > 0;) {
    const Prototype& prototype = scene.prototypes[p];
    work(1 + prototype.instanceCount);
    for (uint32_t i = 0; i < prototype.instanceCount; ++i) {
      uses[scene.instances[prototype.firstInstance + i].prototype] += uses[p];
    }
  }
  Plan plan;
  plan.placed.resize(n);
  struct Merged {
    double triangles = 0, positions = 0;
  };
  std::vector<Merged> merged(n);
  for (size_t p = 0; p < n; ++p) {
    const Prototype& prototype = scene.prototypes[p];
    work(1 + prototype.leafCount + prototype.instanceCount);
    for (uint32_t i = 0; i < prototype.leafCount; ++i) {
      const uint32_t mesh = scene.leaves[prototype.firstLeaf + i].mesh;
      merged[p].triangles += static_cast<double>(meshes[mesh].corners.size());
      merged[p].positions += static_cast<double>(scene.meshes[mesh]->positions.size());
    }
    whole[p] = inlined[p] = merged[p].triangles * kTriangleCost;
    for (uint32_t i = 0; i < prototype.instanceCount; ++i) {
      const uint32_t child = scene.instances[prototype.firstInstance + i].prototype;
      whole[p] += whole[child];
      inlined[p] += plan.placed[child] ? kPlacementCost : inlined[child];
      merged[p].triangles += merged[child].triangles;
      merged[p].positions += merged[child].positions;
    }
    plan.placed[p] = uses[p] > 1 && whole[p] + kPlacementCost * uses[p] < inlined[p] * uses[p];
    if (plan.placed[p]) merged[p] = {};
  }
  for (const Root& root : scene.roots) {
    plan.triangles += merged[root.instance.prototype].triangles;
    plan.positions += merged[root.instance.prototype].positions;
  }
  return plan;
}

/// Materials as shapes of a certain matter have them, made when they are met.
class SpecialMaterials {
 public:
  SpecialMaterials(const Scene& scene, std::vector<SurfaceMaterial>& materials)
      : materials_(materials), matters_(scene.names.size()) {
    for (size_t i = 0; i < matters_.size(); ++i) matters_[i] = matterNamed(scene.names[i]);
  }

  Matter matterOf(const Leaf& leaf) const {
    return leaf.name < matters_.size() ? matters_[leaf.name] : Matter::Plain;
  }

  uint32_t of(const Leaf& leaf, uint32_t material) {
    const Matter matter = matterOf(leaf);
    if (matter == Matter::Plain) return material;
    const auto [at, isNew] = made_.try_emplace({material, matter}, material);
    if (isNew) {
      const SurfaceMaterial special = madeOf(materials_[material], matter);
      if (special.matter != materials_[material].matter) {
        at->second = static_cast<uint32_t>(materials_.size());
        materials_.push_back(special);
      }
    }
    return at->second;
  }

 private:
  std::vector<SurfaceMaterial>& materials_;
  std::vector<Matter> matters_;
  std::map<std::pair<uint32_t, Matter>, uint32_t> made_;
};

class Builder {
 public:
  Builder(const Scene& scene, World& world)
      : scene_(scene), world_(world), special_(scene, world.materials) {
    meshes_.reserve(scene.meshes.size());
    std::vector<bool> used(scene.meshes.size(), false);
    for (const Leaf& leaf : scene.leaves) used[leaf.mesh] = true;
    for (size_t m = 0; m < scene.meshes.size(); ++m) {
      work(used[m] ? 1 + scene.meshes[m]->corners.size() : 1);
      meshes_.push_back(used[m] ? triangulated(*scene.meshes[m]) : MeshTriangles{});
    }
    plan_ = planOf(scene, meshes_);
    partOf_.assign(scene.prototypes.size(), kNone);
  }

  // Small blocks, several a mesh: neither a picture nor who has stopped it waits until they are
  // free.
  ~Builder() { disposeLater(std::move(meshes_)); }
  Builder(const Builder&) = delete;
  Builder& operator=(const Builder&) = delete;

  void build() {
    makeRoom(world_.parts.emplace_back().solid);
    findOrigin();
    const Frame centred = Frame::moved(-world_.origin);
    for (const Root& root : scene_.roots) {
      place(root.instance, centred);
      ++root_;
    }
    finish();
  }

 private:
  /// Most of what is merged is solid. A list that grows is copied again and again.
  void makeRoom(TriangleSet& set) const {
    constexpr double kMost = 1 << 24;
    set.triangles.reserve(static_cast<size_t>(std::min(plan_.triangles, kMost)));
    set.positions.reserve(static_cast<size_t>(std::min(plan_.positions, kMost)));
  }

  void findOrigin() {
    bool found = false;
    for (const Root& root : scene_.roots) {
      if (found) break;
      forEachLeaf(scene_, scene_.prototypes[root.instance.prototype], root.instance.frame,
                  [&](const Leaf&, const Frame& at) {
                    if (found || !usable(at.origin)) return;
                    found = true;
                    world_.origin = {std::round(at.origin.x), std::round(at.origin.y),
                                     std::round(at.origin.z)};
                  });
    }
  }

  /// A prototype whose instances are being put into a part.
  struct Level {
    const Prototype* prototype;
    Frame at;
    uint32_t part;
    uint32_t next = 0;
    /// The part is finished with it, and stands here.
    std::optional<Frame> placement = {};
  };

  /// Puts a root into part 0. Instances nest as deep as rules do, so the levels are a list.
  void place(const Instance& root, const Frame& outer) {
    open(root, outer, 0);
    while (!levels_.empty()) {
      work();
      Level& level = levels_.back();
      if (level.next < level.prototype->instanceCount) {
        const Instance& next = scene_.instances[level.prototype->firstInstance + level.next++];
        open(next, Frame(level.at), level.part);
        continue;
      }
      const Level done = level;
      levels_.pop_back();
      if (done.placement) addPlacement(done.part, *done.placement);
    }
  }

  /// Begins with an instance in `part`; only part 0 may hold placements.
  void open(const Instance& instance, const Frame& outer, uint32_t part) {
    const Frame at = outer * instance.frame;
    const Prototype& prototype = scene_.prototypes[instance.prototype];
    if (part != 0 || !plan_.placed[instance.prototype]) {
      levels_.push_back({&prototype, at, part});
      addLeaves(levels_.back());
      return;
    }
    uint32_t& index = partOf_[instance.prototype];
    if (index != kNone) return addPlacement(index, at);
    index = static_cast<uint32_t>(world_.parts.size());
    world_.parts.emplace_back();
    levels_.push_back({&prototype, Frame(), index, 0, at});
    addLeaves(levels_.back());
  }

  void addPlacement(uint32_t part, const Frame& at) {
    if (world_.parts[part].triangles() == 0 || !usable(at.origin)) return;
    world_.placements.push_back(
        {part, root_, 0, toVec3f(at.x), toVec3f(at.y), toVec3f(at.z), toVec3f(at.origin)});
  }

  void addLeaves(const Level& level) {
    for (uint32_t i = 0; i < level.prototype->leafCount; ++i) {
      const Leaf& leaf = scene_.leaves[level.prototype->firstLeaf + i];
      addLeaf(level.prototype->firstLeaf + i, level.at * leaf.frame, level.part);
    }
  }

  void addLeaf(uint32_t index, const Frame& at, uint32_t partIndex) {
    const Leaf& leaf = scene_.leaves[index];
    Part& part = world_.parts[partIndex];
    const Mesh& mesh = *scene_.meshes[leaf.mesh];
    const MeshTriangles& triangles = meshes_[leaf.mesh];
    work(1 + triangles.corners.size());
    // A leaf without triangles has its number, too.
    if (triangles.corners.empty()) {
      part.pieces.push_back({index, root_, {}, 0});
      return;
    }

    points_.clear();
    Box3 box;
    for (const Vec3& p : mesh.positions) {
      points_.push_back(at.point(scaled(p, leaf.scale)));
      if (usable(points_.back())) box.include(points_.back());
    }
    part.bounds.include(box);
    const uint32_t piece = static_cast<uint32_t>(part.pieces.size());
    Piece place{index, root_, {}, 0};
    if (!box.empty()) {
      place.middle = toVec3f(box.center());
      place.size = maxOf(toVec3f(box.size()));
    }
    part.pieces.push_back(place);
    if (partIndex == 0 && !box.empty()) addFoot(leaf, box.min.y, footArea(points_));

    uint32_t firstOf[2] = {kNone, kNone};
    for (size_t t = 0; t < triangles.corners.size(); ++t) {
      const std::array<uint32_t, 3>& corners = triangles.corners[t];
      const MeshFace& face = mesh.faces[triangles.faces[t]];
      const uint32_t material =
          special_.of(leaf, materialOf(scene_, leaf, face.materialSlot, scene_.materials.size()));
      std::array<uint32_t, 3> at3;
      for (size_t k = 0; k < 3; ++k) at3[k] = mesh.corners[corners[k]];
      if (!usable(points_[at3[0]]) || !usable(points_[at3[1]]) || !usable(points_[at3[2]])) {
        continue;
      }
      noteWall(part, at3);

      const bool isClear = world_.materials[material].clear;
      TriangleSet& set = isClear ? part.clear : part.solid;
      uint32_t& first = firstOf[isClear];
      if (first == kNone) {
        first = static_cast<uint32_t>(set.positions.size());
        for (const Vec3& p : points_) set.positions.push_back(usable(p) ? toVec3f(p) : Vec3f{});
      }
      set.triangles.push_back({{first + at3[0], first + at3[1], first + at3[2]},
                               material,
                               piece,
                               addAttributes(set, leaf, at, mesh, triangles, t, material)});
    }
  }

  uint32_t addAttributes(TriangleSet& set, const Leaf& leaf, const Frame& at, const Mesh& mesh,
                         const MeshTriangles& triangles, size_t t, uint32_t material) {
    const std::array<uint32_t, 3>& corners = triangles.corners[t];
    uint32_t head = 0;
    if (!triangles.normals.empty() && triangles.smooth[t]) head |= 1;
    const uint16_t wanted = world_.materials[material].uvSets;
    for (int s = 0; wanted && s < kUvSets; ++s) {
      // A layer whose own set is missing falls back to set 0.
      if ((wanted >> s & 1) == 0) continue;
      if (mesh.hasUv(s))
        head |= 2u << s;
      else if (mesh.hasUv(0))
        head |= 2u;
    }
    if (head == 0) return kNone;
    const uint32_t first = static_cast<uint32_t>(set.pool.size());
    set.pool.push_back(head);
    if (head & 1) {
      const auto inverse = [](double s) { return s != 0 ? 1 / s : 0.0; };
      const Vec3 unscale{inverse(leaf.scale.x), inverse(leaf.scale.y), inverse(leaf.scale.z)};
      for (const uint32_t c : corners) {
        const Vec3 n = normalized(at.direction(scaled(triangles.normals[c], unscale)));
        set.pool.push_back(packNormal(toVec3f(n)));
      }
    }
    for (int s = 0; s < kUvSets; ++s) {
      if ((head >> (s + 1) & 1) == 0) continue;
      for (const uint32_t c : corners) {
        const Vec2 uv = mesh.uvs[static_cast<size_t>(s)][c];
        set.pool.push_back(std::bit_cast<uint32_t>(static_cast<float>(uv.x)));
        set.pool.push_back(std::bit_cast<uint32_t>(static_cast<float>(uv.y)));
      }
    }
    return first;
  }

  void noteWall(Part& part, const std::array<uint32_t, 3>& at3) {
    const Vec3 n = cross(points_[at3[1]] - points_[at3[0]], points_[at3[2]] - points_[at3[0]]);
    const double flat = std::sqrt(n.x * n.x + n.z * n.z);
    if (!(flat > 3 * std::abs(n.y))) return;
    const double c = n.z / flat, s = n.x / flat;
    const double c2 = c * c - s * s, s2 = 2 * s * c;
    part.wallArea += flat;
    part.wallCos += flat * (c2 * c2 - s2 * s2);
    part.wallSin += flat * 2 * s2 * c2;
  }

  void addFoot(const Leaf& leaf, double height, double area) {
    /// More than a basin has, in square metres.
    constexpr double kBodyOfWater = 50;
    feet_.push_back({height, area});
    if (area > kBodyOfWater && special_.matterOf(leaf) == Matter::Water)
      lowestWater_ = std::min(lowestWater_, height);
  }

  /// Area of the box about the points within half a metre above the lowest.
  template <class Points>
  static double footArea(const Points& points) {
    double lowest = kFarthest;
    for (const auto& p : points) lowest = std::min(lowest, static_cast<double>(p.y));
    Box2 foot;
    for (const auto& p : points) {
      if (!(static_cast<double>(p.y) <= lowest + 0.5) || std::abs(p.x) > kFarthest) continue;
      foot.include({static_cast<double>(p.x), static_cast<double>(p.z)});
    }
    const Vec2 size = foot.size();
    return size.x * size.y + 1e-6;
  }

  /// Bounds, foot and wall directions with placements expanded.
  void finish() {
    // Whoever reads four floats at the last position stays inside the buffer.
    for (Part& part : world_.parts) {
      work(1 + part.solid.positions.size());
      part.footArea =
          footArea(part.solid.triangles.empty() ? part.clear.positions : part.solid.positions);
      part.solid.positions.emplace_back();
      part.clear.positions.emplace_back();
    }
    uint64_t pieces = world_.parts[0].pieces.size();
    for (Placement& placement : world_.placements) {
      placement.firstPiece = static_cast<uint32_t>(pieces);
      pieces += world_.parts[placement.part].pieces.size();
    }
    Box3 bounds = world_.parts[0].bounds;
    world_.triangles = world_.parts[0].triangles();
    double area = world_.parts[0].wallArea, c4 = world_.parts[0].wallCos,
           s4 = world_.parts[0].wallSin;
    for (const Placement& placement : world_.placements) {
      work();
      const Part& part = world_.parts[placement.part];
      const Box3 box = placedBox(part.bounds, placement);
      bounds.include(box);
      feet_.push_back({box.min.y, part.footArea});
      world_.triangles += part.triangles();
      area += part.wallArea;
      if (std::abs(placement.y.y) < 0.99f) continue;
      const double yaw =
          atan2Deg(static_cast<double>(placement.z.x), static_cast<double>(placement.z.z));
      const double c = cosDeg(4 * yaw), s = sinDeg(4 * yaw);
      c4 += part.wallCos * c - part.wallSin * s;
      s4 += part.wallCos * s + part.wallSin * c;
    }
    if (bounds.empty()) {
      bounds.include(Vec3{-5, 0, -5});
      bounds.include(Vec3{5, 6, 5});
    }
    world_.bounds = bounds;
    // However small its share of a whole town: no canal lies below the ground.
    world_.footHeight = std::min(foot(), lowestWater_);
    if (area > 0) {
      world_.wallAngle = atan2Deg(s4, c4) / 4;
      world_.wallAgreement = std::sqrt(c4 * c4 + s4 * s4) / area;
    }
  }

  static Box3 placedBox(const Box3& b, const Placement& p) {
    Box3 box;
    if (b.empty()) return box;
    for (int k = 0; k < 8; ++k) {
      const Vec3 c{k & 1 ? b.max.x : b.min.x, k & 2 ? b.max.y : b.min.y, k & 4 ? b.max.z : b.min.z};
      box.include(toVec3(p.origin) + toVec3(p.x) * c.x + toVec3(p.y) * c.y + toVec3(p.z) * c.z);
    }
    return box;
  }

  /// The height below which a hundredth of all footprint area begins, unless that lies far above
  /// the lowest point: then the scene has terrain, and its lowest point counts. Single twigs, posts
  /// and footings that reach below the lowest initial shape are no terrain.
  double foot() {
    constexpr double kLeastTerrain = 1;
    if (feet_.empty()) return world_.bounds.min.y;
    const double plane =
        scene_.place.empty() ? -kFarthest : scene_.place.min.y - world_.origin.y - 0.1;
    double total = 0, sum = 0;
    for (const auto& [y, area] : feet_) total += area;
    // Few lie so low: from a heap they come in order without the others.
    const auto isHigher = [](const auto& a, const auto& b) {
      work();
      return b < a;
    };
    std::make_heap(feet_.begin(), feet_.end(), isHigher);
    const double first = feet_[0].first;
    std::optional<double> lowest;
    for (auto end = feet_.end(); end != feet_.begin(); --end) {
      std::pop_heap(feet_.begin(), end, isHigher);
      const auto& [y, area] = *(end - 1);
      sum += area;
      if (!lowest && (y >= plane || sum >= kLeastTerrain)) lowest = y;
      if (lowest && sum >= 0.01 * total) return y - *lowest < 1.5 ? y : *lowest;
    }
    return lowest.value_or(first);
  }

  const Scene& scene_;
  World& world_;
  SpecialMaterials special_;
  std::vector<MeshTriangles> meshes_;
  Plan plan_;
  std::vector<uint32_t> partOf_;
  std::vector<Level> levels_;
  std::vector<Vec3> points_;
  std::vector<std::pair<double, double>> feet_;
  double lowestWater_ = kFarthest;
  /// Of the root that is being placed.
  uint32_t root_ = 0;
};

/// Points are rounded to floats, boxes are not.
bool isWithinPlan(const Box3& box, const Vec3f& p) {
  const Vec3 at = toVec3(p), size = box.size();
  const double slack = 1e-3 + 1e-6 * std::max(size.x, size.z);
  return at.x >= box.min.x - slack && at.x <= box.max.x + slack && at.z >= box.min.z - slack &&
         at.z <= box.max.z + slack;
}

/// The points of a set for framing, about `most` of them.
void addFraming(const TriangleSet& set, const Placement* placement, const Cut* cut, size_t most,
                std::vector<Vec3f>& points) {
  const auto at = [&](uint32_t i) {
    const Vec3f& q = set.positions[i];
    return placement
               ? placement->origin + placement->x * q.x + placement->y * q.y + placement->z * q.z
               : q;
  };
  const size_t step = 1 + set.positions.size() / most;
  for (size_t i = 0; i + 1 < set.positions.size(); i += step) {
    const Vec3f p = at(static_cast<uint32_t>(i));
    if (!cut || cut->beyond(p) <= 0) points.push_back(p);
  }
  if (!cut) return;
  const size_t stride = 1 + set.triangles.size() / most;
  for (size_t i = 0; i < set.triangles.size(); i += stride) {
    const std::array<uint32_t, 3>& corners = set.triangles[i].corners;
    for (size_t k = 0; k < 3; ++k) {
      const Vec3f a = at(corners[k]), b = at(corners[(k + 1) % 3]);
      if ((cut->beyond(a) > 0) != (cut->beyond(b) > 0)) points.push_back(cut->between(a, b));
    }
  }
}

/// `place` is in the world. A model that reaches far beyond it shows land around it.
Box3 subjectOf(const World& world, Box3 place) {
  constexpr double kFarBeyond = 400;
  if (place.empty()) return world.bounds;
  place.min = place.min - world.origin;
  place.max = place.max - world.origin;
  const Vec3 before = place.min - world.bounds.min, behind = world.bounds.max - place.max;
  if (std::max({before.x, before.z, behind.x, behind.z}) < kFarBeyond) return world.bounds;
  // Steps and eaves may reach out of their lot.
  const Vec3 size = place.size(), out = Vec3{size.x, 0, size.z} * 0.05;
  place.min = place.min - out;
  place.max = place.max + out;
  Box3 subject;
  for (const Vec3f& p : framingPoints(world)) {
    if (isWithinPlan(place, p)) subject.include(toVec3(p));
  }
  return subject.empty() ? world.bounds : subject;
}

}  // namespace

World makeWorld(const Scene& scene, const TextureSource* textures) {
  World world;
  makeMaterials(scene.materials, textures, world.materials, world.textures);
  Builder(scene, world).build();
  world.subject = subjectOf(world, scene.place);
  return world;
}

std::vector<Vec3f> framingPoints(const World& world, const Cut* cut, size_t limit) {
  std::vector<Vec3f> points;
  const Part& merged = world.parts[0];
  for (const TriangleSet* set : {&merged.solid, &merged.clear}) {
    addFraming(*set, nullptr, cut, std::max<size_t>(1, limit / 2), points);
  }
  const size_t each =
      world.placements.empty() ? 0 : std::max<size_t>(8, limit / world.placements.size());
  for (const Placement& p : world.placements) {
    work(1 + each);
    const Part& part = world.parts[p.part];
    addFraming(part.solid.triangles.empty() ? part.clear : part.solid, &p, cut, each, points);
  }
  std::vector<Vec3f> within;
  for (const Vec3f& p : points) {
    work();
    if (!world.subject.empty() && isWithinPlan(world.subject, p)) within.push_back(p);
  }
  // A camera needs something to frame.
  if (points.empty() && cut) return framingPoints(world, nullptr, limit);
  return within.empty() ? points : within;
}

uint32_t packNormal(const Vec3f& n) {
  const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  if (!(sum > 0)) return 0;
  float u = n.x / sum, v = n.y / sum;
  if (n.z < 0) {
    const float pu = u;
    u = (1 - std::abs(v)) * std::copysign(1.0f, u);
    v = (1 - std::abs(pu)) * std::copysign(1.0f, v);
  }
  const auto word = [](float f) {
    return static_cast<uint32_t>(std::lround(std::clamp(f * 0.5f + 0.5f, 0.0f, 1.0f) * 65535));
  };
  return word(u) | word(v) << 16;
}

Vec3f unpackNormal(uint32_t packed) {
  const float u = static_cast<float>(packed & 0xffff) / 65535 * 2 - 1;
  const float v = static_cast<float>(packed >> 16) / 65535 * 2 - 1;
  Vec3f n{u, v, 1 - std::abs(u) - std::abs(v)};
  if (n.z < 0) {
    n.x = (1 - std::abs(v)) * std::copysign(1.0f, u);
    n.y = (1 - std::abs(u)) * std::copysign(1.0f, v);
  }
  return normalized(n);
}

}  // namespace gable::rt
