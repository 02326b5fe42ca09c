// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Collision shapes and coarse levels are meshes in the frame of an initial shape, each a prototype
// of one leaf. So the writer places and shares them as it does the shape itself. All of them have
// their origin at the foot of the shape, where engines turn and place it by.
#include "engine/game_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "geom/mesh/cleanup.h"
#include "geom/region/hull.h"
#include "geom/solid/convex_hull.h"
#include "io/exporters/plan.h"
#include "material/linear_light.h"
#include "scene/flatten.h"
#include "tiles/closing.h"

namespace gable {
namespace {

// What a level leaves out, over the size of the shape, and the largest size that counts: people
// walk about in what is larger.
constexpr std::array<double, 3> kFineness = {1.0 / 50, 1.0 / 20, 1.0 / 8};
constexpr double kLargest = 100;
// A level is shown where what it leaves out takes so many of so many rows of pixels.
constexpr double kSeen = 4, kRows = 1080;
// Collision meshes leave out less than a step that stops nobody.
constexpr double kStumble = 0.2;
// Physics engines take no shapes without a volume, in metres.
constexpr double kThinnest = 0.1;
// Colours of coarse levels have so many steps, so that their materials are few: of their lightness,
// of their differences to grey, which tell the hue, and of how rough they are.
constexpr double kLightSteps = 24, kHueSteps = 40, kRoughSteps = 10;
// A level has at most so many triangles of the finer one.
constexpr double kSaving = 0.8;

// Prefixes by which Unreal's importer knows meshes, and suffixes by which Godot's knows nodes,
// whatever digits stand behind them; and those that are put there.
constexpr std::string_view kUnrealMarks[] = {"UCX_", "UBX_", "USP_", "UCP_"};
constexpr std::string_view kGodotMarks[] = {
    "col",   "convcol", "colonly", "convcolonly", "rigid", "navmesh", "noimp",     "vehicle",
    "wheel", "loop",    "cycle",   "occ",         "room",  "occonly", "collision", "LOD"};

std::string plainName(const std::string& name) {
  std::string out = name;
  for (char& c : out) {
    const bool good = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (!good) c = '_';
  }
  std::string_view end = out;
  while (!end.empty() && ((end.back() >= '0' && end.back() <= '9') || end.back() == '_')) {
    end.remove_suffix(1);
  }
  const auto hasMark = [&](std::string_view mark) {
    return end.size() > mark.size() && end.ends_with(mark) &&
           end[end.size() - mark.size() - 1] == '_';
  };
  if (std::any_of(std::begin(kGodotMarks), std::end(kGodotMarks), hasMark)) out += "_part";
  const auto isMark = [&](std::string_view mark) { return out.starts_with(mark); };
  if (std::any_of(std::begin(kUnrealMarks), std::end(kUnrealMarks), isMark)) out = "Part_" + out;
  return out.empty() ? "Shape" : out;
}

class UniqueNames {
 public:
  std::string operator()(const std::string& wanted) {
    if (taken_.insert(wanted).second) return wanted;
    for (uint32_t& n = next_.try_emplace(wanted, 2).first->second;; ++n) {
      std::string name = wanted + "_" + std::to_string(n);
      if (taken_.insert(name).second) return name;
    }
  }

 private:
  std::set<std::string> taken_;
  std::map<std::string, uint32_t> next_;
};

std::string collisionName(const std::string& shape, Names names, Collision collision) {
  if (names == Names::Unreal) return "UCX_" + shape + "_00";
  if (names != Names::Godot) return shape + "_collision";
  return shape + (collision == Collision::Mesh ? "-colonly" : "-convcolonly");
}

// The smallest upright box of points: a hull of eight corners.
ConvexHull uprightBox(const std::vector<Vec3>& points) {
  std::vector<Vec2> plan;
  double low = points[0].y, high = low;
  for (const Vec3& p : points) {
    plan.push_back({p.x, p.z});
    low = std::min(low, p.y);
    high = std::max(high, p.y);
  }
  OrientedRect rect = smallestRect(plan);
  const auto widen = [](double& size) {
    const double more = std::max(0.0, kThinnest - size);
    size += more;
    return more / 2;
  };
  const double alongX = widen(rect.width), alongY = widen(rect.height);
  rect.origin = rect.origin - rect.x * alongX - rect.y() * alongY;
  // The upper side stays: people stand on it.
  low = std::min(low, high - kThinnest);
  std::vector<Vec3> corners;
  for (const Vec2 c : rect.ring()) {
    corners.push_back({c.x, low, c.y});
    corners.push_back({c.x, high, c.y});
  }
  return convexHull3(corners);
}

ConvexHull hullOf(const std::vector<Vec3>& points) {
  const Box3 box = [&] {
    Box3 all;
    for (const Vec3& p : points) all.include(p);
    return all;
  }();
  const Vec3 size = box.size();
  ConvexHull hull;
  if (std::min({size.x, size.y, size.z}) >= kThinnest) hull = convexHull3(points);
  return hull.triangles.empty() ? uprightBox(points) : hull;
}

Mesh hullMesh(const ConvexHull& hull) {
  MeshBuilder builder;
  for (const Vec3& p : hull.corners) builder.addPosition(p);
  for (const auto& t : hull.triangles) builder.addPolygon(t);
  return builder.take();
}

size_t triangleCount(const Mesh& m) {
  size_t count = 0;
  for (const MeshFace& f : m.faces) {
    size_t corners = 0;
    for (uint32_t l = 0; l < f.loopCount; ++l) corners += m.loops[f.firstLoop + l].cornerCount;
    count += corners + 2 * f.loopCount - std::min<size_t>(corners, 4);
  }
  return count;
}

// Parts of one colour in one plane are one face: nothing that can be seen changes.
void joinFaces(Mesh& mesh) {
  constexpr double kFlat = 0.5;
  mergePositions(mesh, 0);
  mergeCoplanarFaces(mesh, kFlat);
  removeCollinearVertices(mesh, kFlat);
}

class GameSceneMaker {
 public:
  GameSceneMaker(const Scene& scene, const WriteSettings& settings, const FinishOf& finishOf)
      : settings_(settings), finishOf_(finishOf), same_(firstOfEqual(scene)) {
    out_.scene = scene;
  }

  GameScene run() {
    const bool files = settings_.levels > 0 && settings_.levelForm == LevelForm::Files;
    out_.files.resize(files ? 1 + static_cast<size_t>(settings_.levels) : 1);
    plainNames();
    const std::vector<Root> roots = out_.scene.roots;
    for (const Root& root : roots) add(root);
    out_.scene.roots.clear();
    if (settings_.levels > 0 && settings_.levelForm == LevelForm::Extension) finishLevels();
    return std::move(out_);
  }

 private:
  // What stands for a prototype: none where there is nothing.
  struct StandIns {
    /// The prototype itself, about its foot.
    uint32_t shape = 0;
    Vec3 foot;
    std::optional<uint32_t> collision;
    std::vector<std::optional<uint32_t>> levels;
    std::string name;
  };

  bool renames() const { return settings_.names != Names::Rules; }

  uint32_t addName(const std::string& name) {
    out_.scene.names.push_back(name);
    return static_cast<uint32_t>(out_.scene.names.size()) - 1;
  }

  // Those of rules stay in number, so leaves and prototypes keep theirs.
  void plainNames() {
    if (!renames()) return;
    for (std::string& name : out_.scene.names) name = plainName(name);
  }

  std::string nameOf(const Root& root) {
    const auto& names = out_.scene.names;
    const std::string name = root.name < names.size() ? names[root.name] : std::string();
    return renames() ? unique_(name.empty() ? "Shape" : name) : name;
  }

  void add(const Root& root) {
    const std::string name = nameOf(root);
    const StandIns& parts = standInsOf(root.instance.prototype, name);
    std::vector<Root>& model = out_.files[0];
    const auto place = [&](std::vector<Root>& to, uint32_t prototype, const std::string& called) {
      Root stand = root;
      stand.name = addName(called);
      stand.instance.prototype = prototype;
      stand.instance.frame = root.instance.frame * Frame::moved(parts.foot);
      to.push_back(stand);
    };
    const bool inNames = settings_.levels > 0 && settings_.levelForm == LevelForm::Names;
    place(model, parts.shape, inNames ? name + "_LOD0" : name);
    std::vector<uint32_t> numbers;
    for (size_t i = 0; i < parts.levels.size(); ++i) {
      if (!parts.levels[i]) continue;
      const bool apart = settings_.levelForm == LevelForm::Files;
      if (!apart) numbers.push_back(static_cast<uint32_t>(model.size()));
      place(apart ? out_.files[i + 1] : model, *parts.levels[i],
            apart ? name : name + "_LOD" + std::to_string(i + 1));
    }
    if (parts.collision) {
      place(model, *parts.collision, collisionName(name, settings_.names, settings_.collision));
    }
    levels_.resize(model.size());
    levels_[model.size() - 1 - numbers.size() - (parts.collision ? 1 : 0)] = std::move(numbers);
  }

  void finishLevels() {
    levels_.resize(out_.files[0].size());
    out_.levels = std::move(levels_);
    for (size_t i = 0; i < static_cast<size_t>(settings_.levels); ++i) {
      out_.coverage.push_back(kSeen / (kRows * kFineness[i]));
    }
    out_.coverage.push_back(0);
  }

  // Made under the name of the first root that shows it.
  const StandIns& standInsOf(uint32_t prototype, const std::string& name) {
    const uint32_t first = same_[prototype];
    const auto [at, fresh] = standIns_.try_emplace(first);
    StandIns& parts = at->second;
    if (!fresh) return parts;
    parts.name = name;
    parts.shape = first;
    TileContent content = contentOf(first);
    const Box3 box = boxOf(content);
    if (box.empty()) return parts;
    parts.foot = footOf(box);
    parts.shape = aboutFoot(first, parts.foot);
    if (renames()) out_.scene.prototypes[parts.shape].name = addName(name);
    if (settings_.collision == Collision::None && settings_.levels == 0) return parts;
    for (TileLeaf& l : content.leaves) l.world = Frame::moved(-parts.foot) * l.world;
    addCollision(parts, content);
    addLevels(parts, content, box.size());
    return parts;
  }

  Box3 boxOf(const TileContent& content) const {
    Box3 box;
    for (const TileLeaf& l : content.leaves) {
      const Leaf& leaf = out_.scene.leaves[l.leaf];
      const Box3 mesh = out_.scene.meshes[leaf.mesh]->bounds();
      if (!mesh.empty()) box.include(boundsAt(mesh, l.world, leaf.scale));
    }
    return box;
  }

  // The middle of the underside, in steps that single precision has exactly.
  static Vec3 footOf(const Box3& box) {
    constexpr double kStep = 1.0 / 16;
    Vec3 foot = box.center();
    foot.y = box.min.y;
    for (size_t i = 0; i < 3; ++i) foot[i] = std::floor(foot[i] / kStep) * kStep;
    return foot;
  }

  uint32_t aboutFoot(uint32_t prototype, const Vec3& foot) {
    Scene& s = out_.scene;
    Prototype about;
    about.name = s.prototypes[prototype].name;
    about.firstLeaf = static_cast<uint32_t>(s.leaves.size());
    about.firstInstance = static_cast<uint32_t>(s.instances.size());
    about.instanceCount = 1;
    s.instances.push_back({Frame::moved(-foot), prototype, 0});
    s.prototypes.push_back(about);
    return static_cast<uint32_t>(s.prototypes.size()) - 1;
  }

  TileContent contentOf(uint32_t prototype) const {
    TileContent content;
    // Not owned: the scene outlives the content.
    content.scenes.push_back(std::shared_ptr<const Scene>(std::shared_ptr<void>(), &out_.scene));
    content.features.emplace_back();
    const auto leafOf = [&](uint32_t leaf, const Frame& at, size_t) {
      TileLeaf l;
      l.leaf = leaf;
      l.world = at * out_.scene.leaves[leaf].frame;
      content.leaves.push_back(l);
    };
    walk(out_.scene, out_.scene.prototypes[prototype], Frame{}, leafOf,
         [](const Instance&, const Frame&, size_t) { return true; });
    return content;
  }

  std::vector<Vec3> pointsOf(const TileContent& content) const {
    std::vector<Vec3> points;
    for (const TileLeaf& l : content.leaves) {
      const Leaf& leaf = out_.scene.leaves[l.leaf];
      const Mesh& mesh = *out_.scene.meshes[leaf.mesh];
      work(mesh.corners.size());
      for (const uint32_t c : mesh.corners) {
        points.push_back(l.world.point(scaled(mesh.positions[c], leaf.scale)));
      }
    }
    return points;
  }

  void addCollision(StandIns& parts, const TileContent& content) {
    if (settings_.collision == Collision::None) return;
    const std::string name = collisionName(parts.name, settings_.names, settings_.collision);
    if (settings_.collision == Collision::Mesh) {
      const CoarseModel model = coarsened(partsOf(content, kStumble, finishOf_), kStumble);
      parts.collision = addCoarse(meshOf(model, false), name);
      return;
    }
    const std::vector<Vec3> points = pointsOf(content);
    if (points.empty()) return;
    const bool box = settings_.collision == Collision::Box;
    parts.collision = addPrototype(hullMesh(box ? uprightBox(points) : hullOf(points)), {}, name);
  }

  void addLevels(StandIns& parts, const TileContent& content, const Vec3& extent) {
    if (settings_.levels == 0) return;
    const double size = std::min(length(extent), kLargest), finest = kFineness[0] * size;
    size_t last = 0;
    for (const TileLeaf& l : content.leaves) {
      last += triangleCount(*out_.scene.meshes[out_.scene.leaves[l.leaf].mesh]);
    }
    std::optional<uint32_t> finer = parts.shape;
    CoarseModel model = partsOf(content, finest, finishOf_);
    // All triangles: what is too long to be held against them does without.
    std::optional<CoarseModel> full;
    if (std::max({extent.x, extent.y, extent.z}) <= kLongestClosed * finest) {
      full = partsOf(content, 0, finishOf_);
    }
    const bool apart = settings_.levelForm == LevelForm::Files;
    for (int i = 0; i < settings_.levels; ++i) {
      model = coarsened(model, kFineness[static_cast<size_t>(i)] * size, full ? &*full : &model);
      full.reset();
      const std::string name = apart ? parts.name : parts.name + "_LOD" + std::to_string(i + 1);
      Coarse level = meshOf(model, true);
      const size_t count = triangleCount(level.mesh);
      // What saves little is the finer one once more.
      if (count == 0 || static_cast<double>(count) < kSaving * static_cast<double>(last)) {
        finer = addCoarse(std::move(level), name);
        last = count;
      }
      parts.levels.push_back(finer);
    }
  }

  struct Coarse {
    Mesh mesh;
    /// Materials by slot; none for the default.
    std::vector<uint32_t> slots;
  };

  // Absent where nothing is left.
  std::optional<uint32_t> addCoarse(Coarse coarse, const std::string& name) {
    if (coarse.mesh.empty()) return std::nullopt;
    return addPrototype(std::move(coarse.mesh), coarse.slots, name);
  }

  Coarse meshOf(const CoarseModel& model, bool colored) {
    MeshBuilder builder;
    std::vector<uint32_t> slots;
    std::map<uint32_t, uint16_t> slotOf;
    for (const CoarsePart& p : model.parts) {
      const uint32_t material = colored ? materialOf(p.finish) : 0;
      const auto slot =
          slotOf.try_emplace(material, static_cast<uint16_t>(slotOf.size())).first->second;
      if (slot == slots.size()) slots.push_back(material);
      std::vector<uint32_t> positions;
      for (uint32_t v = 0; v < p.vertexCount; ++v) {
        positions.push_back(builder.addPosition(model.vertices[p.firstVertex + v]));
      }
      for (uint32_t t = 0; t < p.triangleCount; ++t) {
        std::array<uint32_t, 3> triangle = model.triangles[p.firstTriangle + t];
        for (uint32_t& corner : triangle) corner = positions[corner];
        builder.addPolygon(triangle, slot);
      }
    }
    Coarse coarse{builder.take(), colored ? slots : std::vector<uint32_t>{}};
    joinFaces(coarse.mesh);
    return coarse;
  }

  // In steps of lightness, and of orange against blue and green against purple (YCoCg): steps of
  // red, green and blue would turn greys pink and green.
  uint32_t materialOf(const Finish& finish) {
    const Vec3 color = srgbOf(finish.color);
    const double between = (color.x + color.z) / 2;
    const std::array<int, 4> steps = {
        static_cast<int>(std::lround((between + color.y) / 2 * kLightSteps)),
        static_cast<int>(std::lround((color.x - color.z) * kHueSteps)),
        static_cast<int>(std::lround((color.y - between) * kHueSteps)),
        static_cast<int>(std::lround(finish.roughness * kRoughSteps))};
    const auto [at, fresh] =
        materials_.try_emplace(steps, static_cast<uint32_t>(out_.scene.materials.size()));
    if (!fresh) return at->second;
    const double light = steps[0] / kLightSteps, orange = steps[1] / kHueSteps,
                 green = steps[2] / kHueSteps;
    const double base = light - green / 2;
    Material m;
    m.color = {base + orange / 2, light + green / 2, base - orange / 2};
    for (size_t i = 0; i < 3; ++i) m.color[i] = std::clamp(m.color[i], 0.0, 1.0);
    m.roughness = std::clamp(steps[3] / kRoughSteps, 0.0, 1.0);
    out_.scene.materials.push_back(m);
    return at->second;
  }

  uint32_t addPrototype(Mesh mesh, const std::vector<uint32_t>& slots, const std::string& name) {
    Scene& s = out_.scene;
    Leaf leaf;
    leaf.mesh = static_cast<uint32_t>(s.meshes.size());
    leaf.materials = static_cast<uint32_t>(s.materialLists.size());
    leaf.name = addName(name);
    leaf.source = static_cast<uint32_t>(s.sources.size());
    s.meshes.push_back(makeRef<Mesh>(std::move(mesh)));
    s.materialLists.push_back(slots);
    Prototype prototype;
    prototype.name = leaf.name;
    prototype.firstLeaf = static_cast<uint32_t>(s.leaves.size());
    prototype.leafCount = 1;
    prototype.firstInstance = static_cast<uint32_t>(s.instances.size());
    s.leaves.push_back(leaf);
    s.prototypes.push_back(prototype);
    return static_cast<uint32_t>(s.prototypes.size()) - 1;
  }

  const WriteSettings& settings_;
  const FinishOf& finishOf_;
  std::vector<uint32_t> same_;
  GameScene out_;
  UniqueNames unique_;
  std::map<uint32_t, StandIns> standIns_;
  std::map<std::array<int, 4>, uint32_t> materials_;
  std::vector<std::vector<uint32_t>> levels_;
};

}  // namespace

bool asksForGameScene(const WriteSettings& s) {
  return s.names != Names::Rules || s.collision != Collision::None || s.levels > 0;
}

GameScene gameSceneOf(const Scene& scene, const WriteSettings& settings, const FinishOf& finishOf) {
  return GameSceneMaker(scene, settings, finishOf).run();
}

}  // namespace gable
