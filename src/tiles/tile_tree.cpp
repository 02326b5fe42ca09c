// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A square is built from its four quarters, those first. What a quarter gives back is still open
// (its content, which may be joined with that of its neighbours) or done (its node, and the coarse
// model from which the next larger one is made).
#include "tiles/tile_tree.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "base/json.h"
#include "base/parallel.h"
#include "io/exporters/surface.h"
#include "io/image/image.h"
#include "tiles/tile_mesh.h"

namespace gable {
namespace {

// A square's side over what may be left out of its coarse model. Viewers refine a tile when its
// error covers more than about sixteen pixels; with this they do at two or three sides' distance.
constexpr double kFineness = 160;
constexpr int kDeepest = 30;
constexpr double kSmallestSide = 1;
// Viewers place vertices in single precision: boxes are larger by this, in metres.
constexpr double kMargin = 0.002;

struct Square {
  Vec2 low;
  double side = 0;

  double tolerance() const { return side / kFineness; }
  Vec2 middle() const { return {low.x + side / 2, low.y + side / 2}; }
  size_t quarterOf(Vec2 p) const {
    const Vec2 m = middle();
    return (p.x >= m.x ? 1u : 0u) + (p.y >= m.y ? 2u : 0u);
  }
  Square quarter(size_t q) const {
    const double half = side / 2;
    return {{low.x + (q & 1 ? half : 0), low.y + (q & 2 ? half : 0)}, half};
  }
  bool holds(const Box2& box) const {
    return box.min.x >= low.x && box.min.y >= low.y && box.max.x <= low.x + side &&
           box.max.y <= low.y + side;
  }
};

Square squareAround(const Box2& box) {
  if (box.empty()) return {{}, kSmallestSide};
  const Vec2 size = box.size();
  const double side = std::max({size.x, size.y, kSmallestSide});
  return {box.center() - Vec2{side, side} * 0.5, side};
}

// What a quarter of a square has come to.
struct Branch {
  enum class State : uint8_t { Nothing, Open, Done } state = State::Nothing;
  std::string name;
  TileContent content;
  TileNode node;
  CoarseModel coarse;
  uint64_t bytes = 0;
  std::vector<std::string> warnings;
  std::optional<Error> error;
};

// What textures look like from far away, by their paths.
class TextureTints {
 public:
  explicit TextureTints(const TextureReader& read) : read_(read) {}
  Vec3 of(const Material& m) {
    const std::string& path = m.map(TextureLayer::Color).path;
    if (path.empty()) return m.color;
    const auto [at, fresh] = known_.try_emplace(path, Vec3{1, 1, 1});
    if (fresh) at->second = meanOf(path);
    return scaled(m.color, at->second);
  }

 private:
  Vec3 meanOf(const std::string& path) const {
    const Result<std::string> bytes =
        read_ ? read_(path) : Result<std::string>(Error{"texture-not-found", "", ""});
    if (!bytes.ok()) return {1, 1, 1};
    const Result<Image> image = decodeImage(bytes.value());
    if (!image.ok()) return {1, 1, 1};
    Vec3 sum;
    const std::vector<uint8_t>& rgba = image.value().rgba;
    for (size_t i = 0; i + 3 < rgba.size(); i += 4) {
      sum += Vec3{double{1} * rgba[i], double{1} * rgba[i + 1], double{1} * rgba[i + 2]};
    }
    return rgba.empty() ? Vec3{1, 1, 1} : sum * (4.0 / 255 / static_cast<double>(rgba.size()));
  }

  const TextureReader& read_;
  std::map<std::string, Vec3> known_;
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

class Builder {
 public:
  Builder(TileSource& source, const TileTreeOptions& options)
      : source_(source), options_(options) {}

  Result<TileTree> run() {
    std::vector<size_t> all(source_.size());
    Box2 box;
    for (size_t i = 0; i < all.size(); ++i) {
      all[i] = i;
      box.include(source_.middle(i));
    }
    Branch root = build(squareAround(box), std::move(all), "0", 0);
    if (root.state == Branch::State::Open) {
      std::vector<Branch> one;
      one.push_back(std::move(root));
      finish(one, kSmallestSide);
      root = std::move(one[0]);
    }
    if (root.error) return *root.error;
    if (root.state == Branch::State::Done) tree_.root = std::move(root.node);
    tree_.warnings.assign(warnings_.begin(), warnings_.end());
    return std::move(tree_);
  }

 private:
  Branch failed(const Error& e) const {
    Branch b;
    b.error = e;
    return b;
  }

  Branch build(const Square& square, std::vector<size_t> shapes, const std::string& name,
               int depth) {
    if (shapes.empty()) return {};
    if (shapes.size() <= options_.batch || options_.together || depth >= kDeepest) {
      Result<std::shared_ptr<const Scene>> scene = source_.derive(shapes);
      if (!scene.ok()) return failed(scene.error());
      return split(square, contentOf(scene.value(), shapes), name, depth);
    }
    std::array<std::vector<size_t>, 4> quarters;
    for (const size_t s : shapes) quarters[square.quarterOf(source_.middle(s))].push_back(s);
    shapes = {};
    std::vector<Branch> branches;
    for (size_t q = 0; q < 4; ++q) {
      branches.push_back(build(square.quarter(q), std::move(quarters[q]),
                               name + static_cast<char>('0' + q), depth + 1));
      if (branches.back().error) return std::move(branches.back());
    }
    return join(square, std::move(branches), name);
  }

  TileContent contentOf(const std::shared_ptr<const Scene>& scene,
                        const std::vector<size_t>& shapes) const {
    TileContent out;
    out.scenes.push_back(scene);
    std::vector<uint32_t> triangles(scene->meshes.size());
    for (size_t m = 0; m < triangles.size(); ++m) {
      for (const SlotTally& s : slotTallies(*scene->meshes[m])) triangles[m] += s.triangles;
    }
    for (size_t i = 0; i < shapes.size() && i < scene->roots.size(); ++i) {
      const Instance& root = scene->roots[i].instance;
      double low = std::numeric_limits<double>::infinity(), high = -low;
      const auto add = [&](uint32_t leaf, const Frame& world, size_t) {
        const Leaf& l = scene->leaves[leaf];
        TileLeaf t{0, leaf, static_cast<uint32_t>(out.features.size()), triangles[l.mesh],
                   world * l.frame};
        out.triangles += t.triangles;
        out.leaves.push_back(t);
        includeHeights(localBox(*scene, l), t.world, low, high);
        if (out.leaves.size() % 65536 == 0) workMemory(65536 * sizeof(TileLeaf));
      };
      const size_t before = out.leaves.size();
      walk(*scene, scene->prototypes[root.prototype], root.frame, add,
           [](const Instance&, const Frame&, size_t) { return true; });
      if (out.leaves.size() == before) continue;
      out.features.push_back(source_.feature(shapes[i]));
      out.features.back().middle = source_.middle(shapes[i]);
      out.features.back().height = high - low;
    }
    return out;
  }

  // Where the leaves of a content belong: features of one tile by their middle, larger ones leaf by
  // leaf.
  std::vector<Vec2> pointsOf(const TileContent& content) const {
    std::vector<uint64_t> triangles(content.features.size());
    for (const TileLeaf& l : content.leaves) triangles[l.feature] += l.triangles;
    std::vector<Vec2> points;
    points.reserve(content.leaves.size());
    for (const TileLeaf& l : content.leaves) {
      work();
      if (triangles[l.feature] <= options_.triangles) {
        points.push_back(content.features[l.feature].middle);
        continue;
      }
      const Scene& scene = *content.scenes[l.scene];
      const Box3 box = localBox(scene, scene.leaves[l.leaf]);
      const Vec3 p = box.empty() ? l.world.origin : l.world.point(box.center());
      points.push_back({p.x, p.z});
    }
    return points;
  }

  Branch split(Square square, TileContent content, const std::string& name, int depth) {
    Branch out;
    if (content.leaves.empty()) return out;
    if (content.triangles <= options_.triangles || depth >= kDeepest) {
      out.state = Branch::State::Open;
      out.name = name;
      out.content = std::move(content);
      return out;
    }
    const std::vector<Vec2> points = pointsOf(content);
    Box2 box;
    for (const Vec2 p : points) box.include(p);
    // What reaches beyond the square is divided all the same.
    if (!square.holds(box)) square = squareAround(box);
    std::array<TileContent, 4> quarters;
    std::array<std::vector<uint32_t>, 4> numbers;
    for (size_t q = 0; q < 4; ++q) {
      quarters[q].scenes = content.scenes;
      numbers[q].assign(content.features.size(), 0xffffffff);
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
      quarters[q].triangles += l.triangles;
      quarters[q].leaves.push_back(l);
    }
    content = {};
    std::vector<Branch> branches;
    for (size_t q = 0; q < 4; ++q) {
      branches.push_back(split(square.quarter(q), std::move(quarters[q]),
                               name + static_cast<char>('0' + q), depth + 1));
      if (branches.back().error) return std::move(branches.back());
    }
    return join(square, std::move(branches), name);
  }

  // The square of four quarters: one tile where they are small together, else a coarse one above.
  Branch join(const Square& square, std::vector<Branch> branches, const std::string& name) {
    branches.erase(
        std::remove_if(branches.begin(), branches.end(),
                       [](const Branch& b) { return b.state == Branch::State::Nothing; }),
        branches.end());
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
    finish(branches, square.tolerance());
    return cover(branches, square, name);
  }

  // Writes the tiles of those that are open.
  void finish(std::vector<Branch>& branches, double tolerance) {
    parallelFor(branches.size(), options_.jobs, [&](size_t i, unsigned) {
      std::optional<WorkScope> scope;
      if (options_.meter) scope.emplace(*options_.meter);
      if (branches[i].state == Branch::State::Open) finishOne(branches[i], tolerance);
    });
    for (Branch& b : branches) {
      if (b.state == Branch::State::Done && b.node.children.empty() && b.bytes > 0) {
        ++tree_.tiles;
        tree_.bytes += std::exchange(b.bytes, 0);
        tree_.triangles += b.node.triangles;
      }
      warnings_.insert(b.warnings.begin(), b.warnings.end());
    }
  }

  void finishOne(Branch& b, double tolerance) const {
    WriteOptions options;
    options.readTexture = options_.readTexture;
    options.keepUv = false;
    const TileMesh mesh = meshOf(b.content, options);
    b.state = mesh.triangles > 0 ? Branch::State::Done : Branch::State::Nothing;
    if (mesh.triangles > 0) {
      TextureTints tints(options_.readTexture);
      b.coarse = partsOf(b.content, tolerance, [&](const Material& m) { return tints.of(m); });
      writeNode(b, mesh);
    }
    b.content = {};
  }

  void writeNode(Branch& b, const TileMesh& mesh) const {
    b.warnings = mesh.warnings;
    b.node.uri = "tiles/" + b.name + ".glb";
    b.node.box = mesh.box;
    b.node.triangles = mesh.triangles;
    const Result<uint64_t> bytes = writeTile(mesh, options_.folder + b.node.uri);
    if (bytes.ok()) {
      b.bytes = bytes.value();
    } else {
      b.error = bytes.error();
    }
  }

  Branch cover(std::vector<Branch>& branches, const Square& square, const std::string& name) {
    Branch out;
    CoarseModel all;
    Box3 box;
    for (Branch& b : branches) {
      if (b.error) return std::move(b);
      if (b.state != Branch::State::Done) continue;
      all.append(std::move(b.coarse));
      box.include(b.node.box);
      out.node.children.push_back(std::move(b.node));
    }
    if (out.node.children.empty()) return {};
    out.state = Branch::State::Done;
    out.name = name;
    out.coarse = coarsened(all, square.tolerance());
    out.node.error = out.coarse.error;
    const TileMesh mesh = meshOf(out.coarse);
    if (mesh.triangles > 0) {
      writeNode(out, mesh);
      ++tree_.tiles;
      tree_.bytes += out.bytes;
      tree_.coarseTriangles += mesh.triangles;
    }
    out.node.box.include(box);
    return out;
  }

  TileSource& source_;
  const TileTreeOptions& options_;
  TileTree tree_;
  std::set<std::string> warnings_;
};

void writeNode(JsonWriter& w, const TileNode& node) {
  w.beginObject().key("boundingVolume").beginObject().key("box").beginArray();
  // From y up to z up: east, north, up.
  const Vec3 c = node.box.center();
  const Vec3 half = node.box.size() * 0.5 + Vec3{kMargin, kMargin, kMargin};
  for (const double v : {c.x, -c.z, c.y, half.x, 0.0, 0.0, 0.0, half.z, 0.0, 0.0, 0.0, half.y}) {
    w.value(v == 0 ? 0.0 : v);
  }
  w.endArray().endObject();
  w.field("geometricError", node.error);
  if (!node.uri.empty()) w.key("content").beginObject().field("uri", node.uri).endObject();
}

}  // namespace

Result<TileTree> writeTileTree(TileSource& source, const TileTreeOptions& options) {
  return Builder(source, options).run();
}

std::string tilesetJson(const TileNode& root, const std::vector<double>& transform) {
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
  writeNode(w, root);
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
      writeNode(w, child);
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
