// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A square is built from its four quarters, those first. What a quarter gives back is still open
// (its content, which may be joined with that of its neighbours) or done (its node, and the coarse
// model from which the next larger one is made).
#include "tiles/tile_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <utility>

#include "base/bytes.h"
#include "base/files.h"
#include "base/json.h"
#include "base/spare_threads.h"
#include "io/exporters/plan.h"
#include "io/exporters/surface.h"
#include "scene/flatten.h"
#include "tiles/texture_tints.h"
#include "tiles/tile_images.h"

namespace gable {
namespace {

// A square's side over what may be left out of its coarse model. Viewers refine a tile when its
// error covers more than about sixteen pixels; with this they do at two or three sides' distance.
constexpr double kFineness = 160;
// Viewers place vertices in single precision, and files may quantise them: boxes are larger by
// this, in metres.
constexpr double kMargin = kMostQuantized;

// A coarse model with too many triangles is made anew, coarser by at least so much, so often at
// most.
constexpr double kCoarser = 2;
constexpr int kMostCoarser = 6;

// Squares that are smaller over what they show are not divided; where they hold half as much again
// as a tile may, only those that are smaller by far.
constexpr double kLeastShare = 1.0 / 16, kLeastFullShare = 1.0 / 64;
constexpr double kFull = 1.5;

double toleranceOf(const TileSquare& square) { return square.side / kFineness; }

// What a quarter of a square has come to.
struct Branch {
  enum class State : uint8_t { Nothing, Open, Done } state = State::Nothing;
  std::string name;
  TileContent content;
  TilePart part;
  std::optional<Error> error;

  TileNode& node() { return *part.root; }
};

// Widens a range by what a box reaches up and down.
void includeHeights(const Box3& box, const Frame& world, double& low, double& high) {
  if (box.empty()) return;
  double least = world.origin.y, most = world.origin.y;
  const std::array<double, 3> up = {world.x.y, world.y.y, world.z.y};
  for (size_t i = 0; i < 3; ++i) {
    least += std::min(box.min[i] * up[i], box.max[i] * up[i]);
    most += std::max(box.min[i] * up[i], box.max[i] * up[i]);
  }
  low = std::min(low, least);
  high = std::max(high, most);
}

Branch failed(const Error& e) {
  Branch b;
  b.error = e;
  return b;
}

// Squares that have been made, and the coarse one above them.
class Coverer {
 public:
  explicit Coverer(const TileTreeOptions& options) : options_(options), images_(options.folder) {}

  Branch cover(std::vector<Branch>& branches, const TileSquare& square, const std::string& name);
  /// Writes a tile of a branch.
  void write(Branch& b, const TileMesh& mesh);
  /// Of all tiles that it has written.
  std::vector<TileFile> images() const { return images_.files(); }

 private:
  std::string uriOf(const std::string& name, const char* ending) const;
  void addChild(Branch& out, Branch& child, Box3& box) const;
  void coarsen(CoarseModel& model, double tolerance) const;
  void divide(Branch& out, const std::vector<std::string>& names) const;

  const TileTreeOptions& options_;
  TileImages images_;
};

void append(std::vector<std::string>& to, const std::vector<std::string>& more) {
  for (const std::string& s : more) {
    if (std::find(to.begin(), to.end(), s) == to.end()) to.push_back(s);
  }
}

// Its folder is made.
std::string Coverer::uriOf(const std::string& name, const char* ending) const {
  const std::string uri = "tiles/" + squarePath(name) + ending;
  // Where that fails, the file cannot be written, which is told.
  std::error_code ignored;
  std::filesystem::create_directories(options_.folder + folderOf(uri), ignored);
  return uri;
}

void Coverer::write(Branch& b, const TileMesh& mesh) {
  append(b.part.warnings, mesh.warnings);
  b.node().uri = uriOf(b.name, ".glb");
  b.node().box = mesh.box;
  b.node().cost = mesh.cost;
  const Result<TileFile> file =
      writeTile(mesh, options_.folder, b.node().uri, options_.form, images_);
  if (!file.ok()) {
    b.error = file.error();
    return;
  }
  b.part.bytes += file.value().bytes;
  ++b.part.tiles;
  b.part.files.push_back(file.value());
}

void Coverer::addChild(Branch& out, Branch& child, Box3& box) const {
  TilePart& part = child.part;
  out.part.coarse.append(std::move(part.coarse));
  box.include(part.root->box);
  out.node().levels = std::max(out.node().levels, part.root->levels + 1);
  out.node().nodes += part.root->nodes;
  out.node().children.push_back(std::move(*part.root));
  std::move(part.files.begin(), part.files.end(), std::back_inserter(out.part.files));
  addImages(out.part.images, part.images);
  out.part.tiles += part.tiles;
  out.part.bytes += part.bytes;
  out.part.triangles += part.triangles;
  out.part.coarseTriangles += part.coarseTriangles;
  append(out.part.warnings, part.warnings);
}

// Gives the children tilesets of their own where there are too many nodes.
void Coverer::divide(Branch& out, const std::vector<std::string>& names) const {
  TileNode& node = out.node();
  if (node.nodes <= options_.mostNodes) return;
  for (size_t i = 0; i < node.children.size(); ++i) {
    TileNode& child = node.children[i];
    if (child.children.empty()) continue;
    const std::string uri = uriOf(names[i], ".json");
    const std::string text = tilesetJson(child, {}, folderOf(uri));
    const Result<uint64_t> bytes = writeFile(options_.folder + uri, text);
    if (!bytes.ok()) {
      out.error = bytes.error();
      return;
    }
    out.part.files.push_back({uri, bytes.value(), checksum(text)});
    out.part.bytes += bytes.value();
    node.nodes -= child.nodes - 1;
    child.children.clear();
    child.nodes = 1;
    child.uri = uri;
  }
}

// With no more triangles than other tiles, where that can be: surfaces in many colours have many.
void Coverer::coarsen(CoarseModel& model, double tolerance) const {
  const CoarseModel below = std::move(model);
  model = coarsened(below, tolerance);
  for (int i = 0; i < kMostCoarser && model.triangles.size() > options_.triangles; ++i) {
    const double times = static_cast<double>(model.triangles.size()) /
                         static_cast<double>(std::max<uint64_t>(options_.triangles, 1));
    // Triangles are as many as there is room for them, which is a surface.
    tolerance *= std::max(kCoarser, std::sqrt(times));
    CoarseModel coarser = coarsened(below, tolerance);
    // Too much is better than nothing.
    if (coarser.triangles.empty()) return;
    model = std::move(coarser);
  }
}

Branch Coverer::cover(std::vector<Branch>& branches, const TileSquare& square,
                      const std::string& name) {
  Branch out;
  out.part.root.emplace();
  Box3 box;
  std::vector<std::string> names;
  for (Branch& b : branches) {
    if (b.error) return std::move(b);
    if (b.state != Branch::State::Done) continue;
    addChild(out, b, box);
    names.push_back(b.name);
  }
  if (names.empty()) return {};
  out.state = Branch::State::Done;
  out.name = name;
  coarsen(out.part.coarse, toleranceOf(square));
  out.node().error = out.part.coarse.error;
  const TileMesh mesh = meshOf(out.part.coarse);
  if (mesh.triangles > 0) {
    write(out, mesh);
    out.part.coarseTriangles += mesh.triangles;
  }
  out.node().box.include(box);
  if (!out.error) divide(out, names);
  return out;
}

// Those that have come to something; a single one stands for the whole square.
void dropNothing(std::vector<Branch>& branches) {
  branches.erase(std::remove_if(branches.begin(), branches.end(),
                                [](const Branch& b) { return b.state == Branch::State::Nothing; }),
                 branches.end());
}

// The tiles of one unit.
class Builder {
 public:
  Builder(TileSource& source, const TileTreeOptions& options)
      : source_(source),
        options_(options),
        coverer_(options),
        threads_(options.threads),
        tints_(options.readTexture) {}

  Result<TilePart> run(const TileSquare& square, const TileUnit& unit) {
    std::vector<Branch> one;
    one.push_back(build(square, {unit.shapes.begin(), unit.shapes.end()}, unit.name,
                        static_cast<int>(unit.name.size()) - 1));
    // What is not written by now is written for a square around this one.
    finish(one, toleranceOf(square) * 2);
    if (one[0].error) return *one[0].error;
    one[0].part.images = coverer_.images();
    return std::move(one[0].part);
  }

 private:
  // A scene, and what holds for all of its roots.
  struct Derived {
    std::shared_ptr<const Scene> scene;
    /// By root, ascending.
    std::vector<size_t> shapes;
    /// By mesh; by prototype: as sharedPrototypes() gives it, and with instances expanded.
    std::vector<uint32_t> triangles, shared;
    std::vector<uint64_t> leaves;
  };

  Result<Derived> derive(std::vector<size_t> shapes) {
    const Result<std::shared_ptr<const Scene>> scene = source_.derive(shapes);
    if (!scene.ok()) return scene.error();
    const Scene& s = *scene.value();
    Derived out{scene.value(), std::move(shapes), {}, {}, prototypeLeafCounts(s)};
    out.triangles.resize(s.meshes.size());
    for (size_t m = 0; m < out.triangles.size(); ++m) {
      for (const SlotTally& t : slotTallies(*s.meshes[m])) out.triangles[m] += t.triangles;
    }
    out.shared = sharedPrototypes(s, out.triangles);
    return out;
  }

  Branch build(const TileSquare& square, std::vector<size_t> shapes, const std::string& name,
               int depth) {
    if (shapes.empty()) return {};
    if (options_.together && !whole_) {
      Result<Derived> whole = derive(shapes);
      if (!whole.ok()) return failed(whole.error());
      whole_ = std::move(whole.value());
    }
    if (shapes.size() <= options_.batch || depth >= kDeepestSquare) {
      if (whole_) return split(square, contentOf(*whole_, shapes), name, depth);
      const Result<Derived> batch = derive(shapes);
      if (!batch.ok()) return failed(batch.error());
      return split(square, contentOf(batch.value(), shapes), name, depth);
    }
    std::array<std::vector<size_t>, 4> quarters;
    for (const size_t s : shapes) quarters[square.quarterOf(source_.middle(s))].push_back(s);
    shapes = {};
    std::vector<Branch> branches(4);
    const auto buildOne = [&](size_t q) {
      branches[q] = build(square.quarter(q), std::move(quarters[q]),
                          name + static_cast<char>('0' + q), depth + 1);
    };
    if (whole_) {
      each(4, buildOne);
    } else {
      for (size_t q = 0; q < 4 && !(q > 0 && branches[q - 1].error); ++q) buildOne(q);
    }
    return join(square, std::move(branches), name);
  }

  // What some of the shapes of a scene have become.
  TileContent contentOf(const Derived& derived, const std::vector<size_t>& shapes) const {
    const std::shared_ptr<const Scene>& scene = derived.scene;
    TileContent out;
    out.scenes.push_back(scene);
    std::vector<const Instance*> roots;
    uint64_t leaves = 0;
    for (const size_t s : shapes) {
      const auto at = std::lower_bound(derived.shapes.begin(), derived.shapes.end(), s);
      const auto r = static_cast<size_t>(at - derived.shapes.begin());
      if (r >= scene->roots.size()) break;
      roots.push_back(&scene->roots[r].instance);
      leaves = saturatingAdd(leaves, derived.leaves[roots.back()->prototype]);
    }
    reserveWork(out.leaves, static_cast<double>(leaves));
    for (size_t i = 0; i < roots.size(); ++i) {
      const Instance& root = *roots[i];
      const auto feature = static_cast<uint32_t>(out.features.size());
      double low = std::numeric_limits<double>::infinity(), high = -low;
      // The level at which the placement began that leaves are part of; none below it.
      size_t within = std::numeric_limits<size_t>::max();
      const auto place = [&](const Instance& in, const Frame& world, size_t level) {
        if (level <= within) within = std::numeric_limits<size_t>::max();
        if (level < within && derived.shared[in.prototype] != TileLeaf::kNone) {
          within = level;
          out.placements.push_back({0, derived.shared[in.prototype], feature, world});
        }
        return true;
      };
      place(root, root.frame, 0);
      const auto add = [&](uint32_t leaf, const Frame& world, size_t level) {
        const Leaf& l = scene->leaves[leaf];
        if (level < within) within = std::numeric_limits<size_t>::max();
        const bool placed = within != std::numeric_limits<size_t>::max();
        const TileLeaf t{
            0,
            leaf,
            feature,
            derived.triangles[l.mesh],
            placed ? static_cast<uint32_t>(out.placements.size() - 1) : TileLeaf::kNone,
            world * l.frame};
        out.leaves.push_back(t);
        includeHeights(localBox(*scene, l), t.world, low, high);
      };
      const size_t before = out.leaves.size();
      walk(*scene, scene->prototypes[root.prototype], root.frame, add, place);
      if (out.leaves.size() == before) continue;
      out.features.push_back(source_.feature(shapes[i]));
      out.features.back().middle = source_.middle(shapes[i]);
      out.features.back().height = high - low;
    }
    out.measure();
    return out;
  }

  // By prototype: the first of its content where that is placed several times and is no small part
  // of a tile, else kNone.
  std::vector<uint32_t> sharedPrototypes(const Scene& scene,
                                         const std::vector<uint32_t>& meshTriangles) const {
    constexpr double kLeast = 64;
    const size_t count = scene.prototypes.size();
    const std::vector<uint32_t> same = firstOfEqual(scene);
    std::vector<double> triangles(count), placed(count);
    for (size_t i = 0; i < count; ++i) {
      const Prototype& p = scene.prototypes[i];
      for (uint32_t k = 0; k < p.leafCount; ++k) {
        triangles[i] += meshTriangles[scene.leaves[p.firstLeaf + k].mesh];
      }
      for (uint32_t k = 0; k < p.instanceCount; ++k) {
        triangles[i] += triangles[scene.instances[p.firstInstance + k].prototype];
      }
    }
    for (const Root& r : scene.roots) ++placed[same[r.instance.prototype]];
    for (size_t i = count; i-- > 0;) {
      const Prototype& p = scene.prototypes[i];
      for (uint32_t k = 0; k < p.instanceCount; ++k) {
        placed[same[scene.instances[p.firstInstance + k].prototype]] += placed[i];
      }
    }
    std::vector<uint32_t> out(count, TileLeaf::kNone);
    if (options_.form.instancing == TileInstancing::None) return out;
    for (size_t i = 0; i < count; ++i) {
      const size_t p = same[i];
      if (placed[p] > 1 && triangles[p] >= kLeast &&
          triangles[p] <= static_cast<double>(options_.triangles)) {
        out[i] = same[i];
      }
    }
    return out;
  }

  // By leaf, in the world. A box of a mesh is found once: it costs as much as its vertices.
  static std::vector<Box3> boxesOf(const TileContent& content) {
    std::map<const Mesh*, Box3> meshes;
    std::vector<Box3> out(content.leaves.size());
    for (size_t i = 0; i < out.size(); ++i) {
      work();
      const TileLeaf& l = content.leaves[i];
      const Scene& scene = *content.scenes[l.scene];
      const Leaf& leaf = scene.leaves[l.leaf];
      const Mesh* mesh = scene.meshes[leaf.mesh].get();
      const auto [at, isNew] = meshes.try_emplace(mesh);
      if (isNew) at->second = mesh->bounds();
      out[i].include(l.world.origin);
      if (!at->second.empty()) out[i] = boundsAt(at->second, l.world, leaf.scale);
    }
    return out;
  }

  // Where the leaves of a content belong: features of one tile by their middle, larger ones leaf by
  // leaf, and a placement as one. Their origins would not do: the fronts of a corner share one.
  std::vector<Vec2> pointsOf(const TileContent& content, const std::vector<Box3>& boxes) const {
    std::vector<uint64_t> triangles(content.features.size());
    for (const TileLeaf& l : content.leaves) triangles[l.feature] += l.triangles;
    std::vector<Box3> placed(content.placements.size());
    for (size_t i = 0; i < boxes.size(); ++i) {
      const uint32_t placement = content.leaves[i].placement;
      if (placement != TileLeaf::kNone) placed[placement].include(boxes[i]);
    }
    std::vector<Vec2> points;
    points.reserve(boxes.size());
    for (size_t i = 0; i < boxes.size(); ++i) {
      work();
      const TileLeaf& l = content.leaves[i];
      if (triangles[l.feature] <= options_.triangles) {
        points.push_back(content.features[l.feature].middle);
        continue;
      }
      const Vec3 p = (l.placement != TileLeaf::kNone ? placed[l.placement] : boxes[i]).center();
      points.push_back({p.x, p.z});
    }
    return points;
  }

  // Whether quarters of a square would show nearly what it shows: what lies about one point, and
  // reaches far from it.
  bool isSmallFor(const TileSquare& square, const TileContent& content,
                  const std::vector<Box3>& boxes) const {
    const double most = kFull * static_cast<double>(options_.triangles);
    const bool isFull = static_cast<double>(content.triangles) > most;
    Box3 box;
    for (const Box3& b : boxes) box.include(b);
    const Vec3 size = box.size();
    return square.side <
           (isFull ? kLeastFullShare : kLeastShare) * std::max({size.x, size.y, size.z});
  }

  static Branch open(TileContent content, const std::string& name) {
    Branch out;
    out.state = Branch::State::Open;
    out.name = name;
    out.content = std::move(content);
    return out;
  }

  // What belongs to the quarters of a square, which becomes one around all of it.
  std::array<TileContent, 4> quartersOf(TileSquare& square, const TileContent& content,
                                        std::vector<Box3> boxes) const {
    const std::vector<Vec2> points = pointsOf(content, boxes);
    boxes = {};
    Box2 box;
    for (const Vec2 p : points) box.include(p);
    // What reaches beyond the square is divided all the same.
    if (!square.holds(box)) square = squareAround(box);
    std::array<TileContent, 4> quarters;
    std::array<std::vector<uint32_t>, 4> numbers, placed;
    std::array<size_t, 4> count{};
    for (const Vec2 p : points) ++count[square.quarterOf(p)];
    for (size_t q = 0; q < 4; ++q) {
      quarters[q].scenes = content.scenes;
      quarters[q].leaves.reserve(count[q]);
      numbers[q].assign(content.features.size(), 0xffffffff);
      placed[q].assign(content.placements.size(), 0xffffffff);
    }
    for (size_t i = 0; i < points.size(); ++i) {
      const size_t q = square.quarterOf(points[i]);
      TileLeaf l = content.leaves[i];
      uint32_t& number = numbers[q][l.feature];
      if (number == 0xffffffff) {
        number = static_cast<uint32_t>(quarters[q].features.size());
        quarters[q].features.push_back(content.features[l.feature]);
      }
      l.feature = number;
      if (l.placement != TileLeaf::kNone) {
        uint32_t& placement = placed[q][l.placement];
        if (placement == 0xffffffff) {
          placement = static_cast<uint32_t>(quarters[q].placements.size());
          quarters[q].placements.push_back(content.placements[l.placement]);
          quarters[q].placements.back().feature = number;
        }
        l.placement = placement;
      }
      quarters[q].leaves.push_back(l);
    }
    return quarters;
  }

  Branch split(TileSquare square, TileContent content, const std::string& name, int depth) {
    if (content.leaves.empty()) return {};
    if (content.triangles <= options_.triangles || depth >= kDeepestSquare) {
      return open(std::move(content), name);
    }
    std::vector<Box3> boxes = boxesOf(content);
    if (isSmallFor(square, content, boxes)) return open(std::move(content), name);
    std::array<TileContent, 4> quarters = quartersOf(square, content, std::move(boxes));
    content = {};
    std::vector<Branch> branches(4);
    each(4, [&](size_t q) {
      quarters[q].measure();
      branches[q] = split(square.quarter(q), std::move(quarters[q]),
                          name + static_cast<char>('0' + q), depth + 1);
    });
    return join(square, std::move(branches), name);
  }

  // The square of four quarters: one tile where they are small together, else a coarse one above.
  Branch join(const TileSquare& square, std::vector<Branch> branches, const std::string& name) {
    for (Branch& b : branches) {
      if (b.error) return std::move(b);
    }
    dropNothing(branches);
    if (branches.empty()) return {};
    if (branches.size() == 1) return std::move(branches[0]);
    const auto isOpen = [](const Branch& b) { return b.state == Branch::State::Open; };
    uint64_t triangles = 0;
    for (const Branch& b : branches) triangles += b.content.triangles;
    if (std::all_of(branches.begin(), branches.end(), isOpen) && triangles <= options_.triangles) {
      for (size_t i = 1; i < branches.size(); ++i) {
        branches[0].content.append(std::move(branches[i].content));
      }
      branches[0].name = name;
      return std::move(branches[0]);
    }
    finish(branches, toleranceOf(square));
    return coverer_.cover(branches, square, name);
  }

  // On the threads that are idle, too.
  void each(size_t count, const std::function<void(size_t)>& task) {
    threads_.run(count, [&](size_t i) {
      std::optional<WorkScope> scope;
      if (options_.meter) scope.emplace(*options_.meter);
      task(i);
    });
  }

  // Writes the tiles of those that are open.
  void finish(std::vector<Branch>& branches, double tolerance) {
    each(branches.size(), [&](size_t i) {
      if (branches[i].state == Branch::State::Open) finishOne(branches[i], tolerance);
    });
  }

  void finishOne(Branch& b, double tolerance) {
    WriteOptions options;
    options.readTexture = options_.readTexture;
    options.keepUv = false;
    const TileMesh mesh = meshOf(b.content, options);
    b.state = mesh.triangles > 0 ? Branch::State::Done : Branch::State::Nothing;
    if (mesh.triangles > 0) {
      const auto finishOf = [&](const Material& m) { return tints_.of(m); };
      b.part.coarse = partsOf(b.content, tolerance, finishOf);
      b.part.root.emplace();
      b.part.triangles = mesh.triangles;
      coverer_.write(b, mesh);
    }
    b.content = {};
  }

  TileSource& source_;
  const TileTreeOptions& options_;
  Coverer coverer_;
  SpareThreads threads_;
  TextureTints tints_;
  /// Of all shapes of the unit, where they are derived together.
  std::optional<Derived> whole_;
};

// The tiles above units.
class Top {
 public:
  Top(const TileDivision& division, const TileParts& parts, const TileTreeOptions& options)
      : division_(division), parts_(parts), coverer_(options) {}

  Result<TilePart> run() {
    Branch root = assemble("0");
    if (root.error) return *root.error;
    return std::move(root.part);
  }

 private:
  // Units come in the order of this walk, so the next one is in this square or in none. It goes as
  // deep as squares are divided.
  Branch assemble(const std::string& name) {
    const std::vector<TileUnit>& units = division_.units;
    if (next_ == units.size() || !units[next_].name.starts_with(name)) return {};
    Branch out;
    if (units[next_].name == name) {
      Result<TilePart> part = parts_(next_++);
      if (!part.ok()) return failed(part.error());
      if (!part->root) return {};
      out.state = Branch::State::Done;
      out.name = name;
      out.part = std::move(*part);
      return out;
    }
    std::vector<Branch> branches;
    for (size_t q = 0; q < 4; ++q) {
      branches.push_back(assemble(name + static_cast<char>('0' + q)));
      if (branches.back().error) return std::move(branches.back());
    }
    dropNothing(branches);
    if (branches.empty()) return {};
    if (branches.size() == 1) return std::move(branches[0]);
    return coverer_.cover(branches, division_.squareOf(name), name);
  }

  const TileDivision& division_;
  const TileParts& parts_;
  Coverer coverer_;
  size_t next_ = 0;
};

void writeNode(JsonWriter& w, const TileNode& node, const std::string& folder) {
  w.beginObject().key("boundingVolume").beginObject().key("box").beginArray();
  // From y up to z up: east, north, up.
  const Vec3 c = node.box.center();
  const Vec3 half = node.box.size() * 0.5 + Vec3{kMargin, kMargin, kMargin};
  for (const double v : {c.x, -c.z, c.y, half.x, 0.0, 0.0, 0.0, half.z, 0.0, 0.0, 0.0, half.y}) {
    w.value(v == 0 ? 0.0 : v);
  }
  w.endArray().endObject();
  w.field("geometricError", node.error);
  if (node.uri.empty()) return;
  const std::string uri = node.uri.starts_with(folder) ? node.uri.substr(folder.size()) : node.uri;
  w.key("content").beginObject().field("uri", uri).endObject();
}

}  // namespace

Result<TilePart> writeTileUnit(TileSource& source, const TileSquare& square, const TileUnit& unit,
                               const TileTreeOptions& options) {
  return Builder(source, options).run(square, unit);
}

Result<TilePart> writeTileTop(const TileDivision& division, const TileParts& parts,
                              const TileTreeOptions& options) {
  return Top(division, parts, options).run();
}

std::string tilesetJson(const TileNode& root, const std::vector<double>& transform,
                        const std::string& folder) {
  std::string out;
  JsonWriter w(out);
  w.beginObject().key("asset").beginObject();
  w.field("version", "1.1").field("generator", "Gable").endObject();
  // Without the tileset the whole place is missing.
  w.field("geometricError", std::max(length(root.box.size()), root.error));
  w.key("root");
  // As deep as the tree, with a list of our own.
  struct Open {
    const TileNode* node;
    size_t next = 0;
  };
  std::vector<Open> open{{&root}};
  writeNode(w, root, folder);
  w.field("refine", "REPLACE");
  if (!transform.empty()) {
    w.key("transform").beginArray();
    for (const double v : transform) w.value(v);
    w.endArray();
  }
  if (!root.children.empty()) w.key("children").beginArray();
  while (!open.empty()) {
    Open& top = open.back();
    if (top.next < top.node->children.size()) {
      const TileNode& child = top.node->children[top.next++];
      writeNode(w, child, folder);
      if (!child.children.empty()) w.key("children").beginArray();
      open.push_back({&child});
      continue;
    }
    if (!top.node->children.empty()) w.endArray();
    w.endObject();
    open.pop_back();
  }
  w.endObject();
  return out;
}

}  // namespace gable
