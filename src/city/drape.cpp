// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A face over one facet of the ground stays whole. A face that is a piece of the ground becomes its
// facets. Any other is taken apart into triangles, each of which is cut by the upright planes
// through the sides of the facets that it meets (I. E. Sutherland and G. W. Hodgman, "Reentrant
// polygon clipping", 1974), unless the ground bends by millimetres only below it. Corners carry
// their barycentric coordinates, which give texture coordinates and normals at the end.
//
// A prototype that is a thing on narrow feet is moved as a whole, one on wide feet turned with the
// ground where that is even, and anything where the ground is level: so it stays shared.
#include "city/drape.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include "base/work.h"
#include "city/footing.h"
#include "geom/mesh/face_triangles.h"

namespace gable {
namespace {

constexpr uint32_t kNothing = TerrainSurface::kNothing;
// What stands is taller than this, and not wider than so many times its height and a bit.
constexpr double kLeastTall = 0.5, kWidest = 1.2, kWider = 0.5;
// So are its parts that are no wider and begin as far above the ground.
constexpr double kWidestAbove = 3;
// What reaches below the ground lies in it.
constexpr double kBelow = -0.1;
constexpr double kSame = 1e-6;
// A thing is so high, and not wider than so many times its height and a bit; its feet are narrow.
constexpr double kWidestThing = 1.6, kWidestFoot = 1.5;
// What is no wider is turned with the ground, where that bends by so little below it.
constexpr double kWidestTurned = 6, kEven = 0.05;
// Wider parts are taken apart without a look at the ground.
constexpr double kWidestLevel = 40;
// The cosine of the lean of what is upright.
constexpr double kUpright = 1 - 1e-9;
// Faces of what is shared: an instance takes room, too.
constexpr size_t kLeastShared = 10;
// A triangle that all its pieces would leave by no more stays whole, in metres: less than paint
// lies above its road.
constexpr double kFlat = 0.003;
// In square metres: what is smaller is no piece of a face.
constexpr double kLeastArea = 1e-10;

Vec2 plan(const Vec3& p) { return {p.x, -p.z}; }

struct Corner {
  Vec3 at;
  std::array<double, 3> share;
};
using Part = std::vector<Corner>;

Part clipped(const Part& part, Vec2 a, Vec2 b) {
  Part out;
  const Vec2 d = b - a;
  const double l = std::max(length(d), 1e-12);
  const auto side = [&](const Corner& c) { return cross(d, plan(c.at) - a) / l; };
  for (size_t i = 0; i < part.size(); ++i) {
    const Corner &p = part[i], &q = part[(i + 1) % part.size()];
    const double sp = side(p), sq = side(q);
    if (sp >= 0) out.push_back(p);
    if ((sp > 0 && sq < 0) || (sp < 0 && sq > 0)) {
      const double t = sp / (sp - sq);
      Corner c{p.at + (q.at - p.at) * t, {}};
      for (size_t k = 0; k < 3; ++k) c.share[k] = p.share[k] + t * (q.share[k] - p.share[k]);
      out.push_back(c);
    }
  }
  return out;
}

double areaOf(const Part& part) {
  Vec3 sum;
  for (size_t i = 1; i + 1 < part.size(); ++i) {
    sum += cross(part[i].at - part[0].at, part[i + 1].at - part[0].at);
  }
  return 0.5 * length(sum);
}

Vec2 middleOf(const Part& part) {
  Vec2 sum;
  for (const Corner& c : part) sum = sum + plan(c.at);
  return sum * (1 / static_cast<double>(part.size()));
}

// A mesh in world coordinates, laid on the ground.
class MeshDrape {
 public:
  MeshDrape(const Mesh& from, const TerrainSurface& ground) : from_(from), ground_(ground) {}

  Mesh take() {
    std::vector<uint32_t> map(from_.positions.size(), MeshBuilder::kNoPosition);
    for (size_t f = 0; f < from_.faceCount(); ++f) {
      work();
      const uint32_t facet = commonFacet(f);
      if (facet != kNothing) {
        addWhole(f, [&](Vec2 p) { return ground_.heightOn(facet, p); });
      } else if (!addAsPiece(f)) {
        addCut(f);
      }
    }
    return out_.take();
  }

 private:
  // The facet that holds all corners of a face.
  uint32_t commonFacet(size_t face) const {
    uint32_t facet = kNothing;
    for (const MeshLoop& loop : from_.loopsOf(face)) {
      for (const uint32_t c : from_.cornersOf(loop)) {
        work();
        const Vec2 p = plan(from_.positions[c]);
        if (facet == kNothing) facet = ground_.facetAt(p);
        if (facet == kNothing || !ground_.holds(facet, p)) return kNothing;
      }
    }
    return facet;
  }

  template <class HeightAt>
  void addWhole(size_t face, HeightAt&& heightAt) {
    beginFace(face, false);
    for (const MeshLoop& loop : from_.loopsOf(face)) {
      out_.beginLoop();
      for (uint32_t i = 0; i < loop.cornerCount; ++i) {
        const uint32_t corner = loop.firstCorner + i;
        Vec3 p = from_.at(corner);
        p.y += heightAt(plan(p));
        const uint32_t c = out_.addCorner(out_.addPosition(p));
        copyCorner(c, {corner, corner, corner}, {1, 0, 0});
      }
    }
  }

  void beginFace(size_t face, bool smooth) {
    const MeshFace& f = from_.faces[face];
    out_.beginFace(f.materialSlot, f.tags, smooth || f.smooth);
  }
  void copyCorner(uint32_t to, const std::array<uint32_t, 3>& corners,
                  const std::array<double, 3>& share) {
    for (int set = 0; set < kUvSets; ++set) {
      if (!from_.hasUv(set)) continue;
      Vec2 uv;
      for (size_t k = 0; k < 3; ++k) uv = uv + from_.set(set)[corners[k]] * share[k];
      out_.setUv(to, set, uv);
    }
    if (from_.normals.empty()) return;
    Vec3 n;
    for (size_t k = 0; k < 3; ++k) n += from_.normals[corners[k]] * share[k];
    if (dot(n, n) > 0) out_.setNormal(to, normalized(n));
  }

  // Where a face is a piece of the ground, corner by corner, and level.
  bool addAsPiece(size_t face) {
    const uint32_t piece = pieceOf(face);
    if (piece == kNothing) return false;
    const TerrainSurface::Piece& p = ground_.pieces()[piece];
    const double above = from_.at(from_.loopsOf(face)[0].firstCorner).y;
    if (p.level) {
      const double level = ground_.points()[p.firstPoint].z;
      addWhole(face, [&](Vec2) { return level; });
      return true;
    }
    std::map<uint32_t, uint32_t> positions;
    for (uint32_t f = p.firstFacet; f < p.firstFacet + p.facetCount; ++f) {
      work();
      beginFace(face, true);
      out_.beginLoop();
      for (const uint32_t v : ground_.facets()[f].points) {
        const auto [at, isNew] = positions.emplace(v, 0);
        const Vec3& q = ground_.points()[v];
        if (isNew) at->second = out_.addPosition({q.x, q.z + above, -q.y});
        out_.addCorner(at->second);
      }
    }
    return true;
  }
  uint32_t pieceOf(size_t face) const {
    for (int set = 0; set < kUvSets; ++set) {
      if (from_.hasUv(set)) return kNothing;
    }
    if (!from_.normals.empty() || !(from_.areaNormal(face).y > 0)) return kNothing;
    std::vector<Vec2> corners;
    const double above = from_.at(from_.loopsOf(face)[0].firstCorner).y;
    for (const MeshLoop& loop : from_.loopsOf(face)) {
      for (const uint32_t c : from_.cornersOf(loop)) {
        if (std::fabs(from_.positions[c].y - above) > kSame) return kNothing;
        corners.push_back(plan(from_.positions[c]));
      }
    }
    return pieceAround(corners, from_.area(face));
  }
  // The piece that has all these corners, which are as many as it has but for those in between.
  uint32_t pieceAround(const std::vector<Vec2>& corners, double size) const {
    std::vector<uint32_t> candidates;
    Box2 box;
    const Vec2 reach{kSame, kSame};
    box.include(corners[0] - reach);
    box.include(corners[0] + reach);
    ground_.near(box, [&](uint32_t f) { candidates.push_back(ground_.facets()[f].piece); });
    std::sort(candidates.begin(), candidates.end());
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
    for (const uint32_t piece : candidates) {
      if (isOutline(piece, corners, size)) return piece;
    }
    return kNothing;
  }
  // Whether the corners go along the piece's outline one by one; the outline has more of them.
  bool isOutline(uint32_t piece, const std::vector<Vec2>& corners, double size) const {
    const TerrainSurface::Piece& p = ground_.pieces()[piece];
    if (corners.size() > p.pointCount) return false;
    double planArea = 0;
    for (uint32_t f = p.firstFacet; f < p.firstFacet + p.facetCount; ++f) {
      const auto& v = ground_.facets()[f].points;
      planArea += 0.5 * cross(point(v[1]) - point(v[0]), point(v[2]) - point(v[0]));
    }
    if (!(std::fabs(planArea - size) <= 1e-4 + 1e-9 * planArea)) return false;
    std::vector<Vec2> own;
    work(p.pointCount);
    for (uint32_t i = 0; i < p.pointCount; ++i) own.push_back(point(p.firstPoint + i));
    const auto less = [](Vec2 a, Vec2 b) { return a.x < b.x; };
    std::sort(own.begin(), own.end(), less);
    for (const Vec2 c : corners) {
      work();
      const auto at = std::lower_bound(own.begin(), own.end(), c - Vec2{2 * kSame, 0}, less);
      bool found = false;
      for (auto i = at; i != own.end() && i->x <= c.x + kSame && !found; ++i) {
        work();
        found = length(*i - c) <= kSame;
      }
      if (!found) return false;
    }
    return true;
  }
  Vec2 point(uint32_t i) const { return {ground_.points()[i].x, ground_.points()[i].y}; }

  void addCut(size_t face) {
    std::vector<std::array<uint32_t, 3>> triangles;
    triangulator_.add(from_, face, triangles);
    for (const auto& t : triangles) {
      Part whole;
      Box2 box;
      for (size_t k = 0; k < 3; ++k) {
        whole.push_back({from_.at(t[k]), {k == 0 ? 1.0 : 0, k == 1 ? 1.0 : 0, k == 2 ? 1.0 : 0}});
        box.include(plan(whole.back().at));
      }
      double left = areaOf(whole);
      pieces_.clear();
      ground_.near(box, [&](uint32_t facet) {
        const auto& v = ground_.facets()[facet].points;
        Part part = whole;
        for (size_t i = 0; i < 3 && part.size() > 2; ++i) {
          part = clipped(part, point(v[i]), point(v[(i + 1) % 3]));
        }
        if (part.size() < 3) return;
        const double size = areaOf(part);
        if (size < kLeastArea) return;
        // An upright face along an edge of the ground goes to one of its sides.
        const Vec2 middle = middleOf(part);
        if (isUpright(part) && ground_.facetAt(middle) != facet) return;
        left -= size;
        for (Corner& c : part) c.at.y += ground_.heightOn(facet, plan(c.at));
        pieces_.push_back(std::move(part));
      });
      if (isFlat(whole, left)) {
        addPart(face, t, whole);
      } else {
        for (const Part& part : pieces_) addPart(face, t, part);
      }
      // What is beyond the border of the place goes with the ground nearest to it.
      if (left > 1e-3 + 0.02 * areaOf(whole)) addBeyond(face, t, whole);
    }
  }
  void addBeyond(size_t face, const std::array<uint32_t, 3>& corners, const Part& whole) {
    const double height = ground_.heightAt(middleOf(whole));
    const bool outside = std::none_of(whole.begin(), whole.end(), [&](const Corner& c) {
      return ground_.facetAt(plan(c.at)) != kNothing;
    });
    if (!outside) return;
    Part raised = whole;
    for (Corner& c : raised) c.at.y += height;
    addPart(face, corners, raised);
  }
  // Whether the pieces, which cover a triangle, are one plane but for millimetres: then its corners
  // get their heights.
  bool isFlat(Part& whole, double left) const {
    if (pieces_.size() < 2 || left > 1e-6 + 1e-6 * areaOf(whole)) return false;
    std::array<double, 3> above{};
    std::array<bool, 3> known{};
    for (const Part& part : pieces_) {
      for (const Corner& c : part) {
        for (size_t k = 0; k < 3; ++k) {
          if (c.share[k] < 1 - 1e-9) continue;
          above[k] = c.at.y - whole[k].at.y;
          known[k] = true;
        }
      }
    }
    if (!known[0] || !known[1] || !known[2]) return false;
    for (const Part& part : pieces_) {
      for (const Corner& c : part) {
        double y = 0;
        for (size_t k = 0; k < 3; ++k) y += c.share[k] * (whole[k].at.y + above[k]);
        if (!(std::fabs(c.at.y - y) <= kFlat)) return false;
      }
    }
    for (size_t k = 0; k < 3; ++k) whole[k].at.y += above[k];
    return true;
  }
  static bool isUpright(const Part& part) {
    double sum = 0;
    for (size_t i = 1; i + 1 < part.size(); ++i) {
      sum += cross(plan(part[i].at) - plan(part[0].at), plan(part[i + 1].at) - plan(part[0].at));
    }
    return std::fabs(sum) < 1e-7 * std::max(areaOf(part), 1e-6);
  }
  void addPart(size_t face, const std::array<uint32_t, 3>& corners, const Part& part) {
    beginFace(face, false);
    out_.beginLoop();
    for (const Corner& c : part) {
      copyCorner(out_.addCorner(out_.addPosition(c.at)), corners, c.share);
    }
  }

  const Mesh& from_;
  const TerrainSurface& ground_;
  MeshBuilder out_;
  FaceTriangulator triangulator_;
  // Of the triangle at hand, raised.
  std::vector<Part> pieces_;
};

class SceneDrape {
 public:
  SceneDrape(const Scene& from, const TerrainSurface& ground)
      : from_(from), ground_(ground), footings_(from) {}

  Scene drape(const std::function<bool(const std::string&)>& lies) {
    out_ = from_;
    std::map<uint32_t, bool> known;
    for (uint32_t i = 0; i < out_.roots.size(); ++i) {
      const uint32_t name = out_.roots[i].name;
      const auto [at, isNew] = known.emplace(name, false);
      if (isNew) at->second = name < from_.names.size() && lies(from_.names[name]);
      if (at->second) layDown(i);
    }
    for (const Laid& l : laid_) put(l);
    return std::move(out_);
  }

 private:
  struct Laid {
    uint32_t root = 0;
    std::vector<Leaf> leaves;
    // By leaf.
    std::vector<bool> stands;
    // Moved as they are.
    std::vector<Instance> whole;
  };
  // What leaves have in common that differ by their place alone.
  using Kind = std::tuple<uint32_t, uint32_t, uint32_t, uint32_t, uint32_t, double, double, double>;
  static Kind kindOf(const Leaf& l) {
    return {l.mesh, l.materials, l.name, l.source, l.attributes, l.scale.x, l.scale.y, l.scale.z};
  }

  void layDown(uint32_t root) {
    const Instance& at = from_.roots[root].instance;
    const Prototype& old = from_.prototypes[at.prototype];
    if (old.empty) return;
    laid_.push_back({root, {}, {}, {}});
    Laid& to = laid_.back();
    const auto visit = [&](uint32_t leaf, const Frame& world, size_t) {
      Leaf moved = from_.leaves[leaf];
      moved.frame = world * moved.frame;
      addLeaf(moved, to);
    };
    const auto enter = [&](const Instance& instance, const Frame& world, size_t) {
      Frame laid = world;
      if (!raiseWhole(footings_.of(instance.prototype), laid)) return true;
      to.whole.push_back({laid, instance.prototype, static_cast<uint32_t>(to.leaves.size())});
      return false;
    };
    walk(from_, old, at.frame, visit, enter);
  }

  // Whether a prototype at `at` is moved as one, and to where.
  bool raiseWhole(const Footing& thing, Frame& at) const {
    if (thing.box.empty()) return false;
    const Vec3 size = thing.box.size(), foot = thing.foot.size();
    const double wide = std::max(size.x, size.z);
    if (wide < kWidestLevel && raiseLevel(thing.box, at)) return true;
    const bool isThing = size.y > kLeastTall && at.y.y > kUpright && !thing.lies &&
                         at.origin.y + thing.box.min.y > kBelow;
    if (!isThing) return false;
    if (wide < kWidestThing * size.y + kWider && std::max(foot.x, foot.z) < kWidestFoot) {
      at.origin.y += ground_.heightAt(plan(at.point(thing.foot.center())));
      return true;
    }
    return wide < kWidestTurned && turn(thing.foot, at);
  }
  // Where the ground is level below all of it: as each of its faces would be.
  bool raiseLevel(const Box3& box, Frame& at) const {
    Box2 below;
    for (unsigned k = 0; k < 8; ++k) {
      below.include(plan(at.point({k & 1 ? box.max.x : box.min.x, k & 2 ? box.max.y : box.min.y,
                                   k & 4 ? box.max.z : box.min.z})));
    }
    // As a box along x.
    Box2 heights;
    ground_.near(below, [&](uint32_t f) {
      for (const uint32_t p : ground_.facets()[f].points) {
        heights.include({ground_.points()[p].z, 0});
      }
    });
    if (heights.empty() || heights.max.x - heights.min.x > kSame) return false;
    at.origin.y += heights.min.x;
    return true;
  }
  // With the plane through the ground below its feet.
  bool turn(const Box3& foot, Frame& at) const {
    const Vec3 middle = foot.center(), size = foot.size();
    if (!(size.x > kSame) || !(size.z > kSame)) return false;
    const auto heightAt = [&](double x, double z) {
      return ground_.heightAt(plan(at.point({x, middle.y, z})));
    };
    const double low = heightAt(foot.min.x, foot.min.z), right = heightAt(foot.max.x, foot.min.z),
                 front = heightAt(foot.min.x, foot.max.z), far = heightAt(foot.max.x, foot.max.z);
    const double mean = 0.25 * (low + right + front + far);
    const double twist = 0.25 * std::fabs(low + far - right - front);
    if (twist > kEven || std::fabs(heightAt(middle.x, middle.z) - mean) > kEven) return false;
    const double alongX = 0.5 * (right + far - low - front) / size.x,
                 alongZ = 0.5 * (front + far - low - right) / size.z;
    const Vec3 goal = at.point(middle) + Vec3{0, mean, 0};
    const Vec3 up = normalized(Vec3{0, 1, 0} - at.x * alongX - at.z * alongZ);
    const Vec3 x = normalized(at.x - up * dot(at.x, up));
    at = Frame::of({}, x, up, cross(x, up));
    at.origin = goal - at.direction(middle);
    return true;
  }

  // The root gets a prototype of its own, with leaves in world coordinates. Of a leaf that stands
  // in several places there is one, and instances of it.
  void put(const Laid& laid) {
    Root& root = out_.roots[laid.root];
    Prototype own = from_.prototypes[root.instance.prototype];
    std::vector<Leaf> leaves;
    std::vector<Instance> instances;
    auto whole = laid.whole.begin();
    const auto putWhole = [&](size_t before) {
      for (; whole != laid.whole.end() && whole->leavesBefore <= before; ++whole) {
        instances.push_back({whole->frame, whole->prototype, static_cast<uint32_t>(leaves.size())});
      }
    };
    for (size_t i = 0; i < laid.leaves.size(); ++i) {
      work();
      putWhole(i);
      const Leaf& leaf = laid.leaves[i];
      const auto count = counts_.find(kindOf(leaf));
      if (laid.stands[i] && count != counts_.end() && count->second > 1) {
        instances.push_back({leaf.frame, alone(leaf), static_cast<uint32_t>(leaves.size())});
      } else {
        leaves.push_back(leaf);
      }
    }
    putWhole(laid.leaves.size());
    own.firstLeaf = static_cast<uint32_t>(out_.leaves.size());
    own.leafCount = static_cast<uint32_t>(leaves.size());
    own.firstInstance = static_cast<uint32_t>(out_.instances.size());
    own.instanceCount = static_cast<uint32_t>(instances.size());
    own.empty = leaves.empty() && instances.empty();
    out_.leaves.insert(out_.leaves.end(), leaves.begin(), leaves.end());
    out_.instances.insert(out_.instances.end(), instances.begin(), instances.end());
    root.instance.prototype = static_cast<uint32_t>(out_.prototypes.size());
    root.instance.frame = Frame();
    out_.prototypes.push_back(own);
  }
  uint32_t alone(const Leaf& leaf) {
    const auto [at, isNew] = alone_.emplace(kindOf(leaf), 0);
    if (!isNew) return at->second;
    at->second = static_cast<uint32_t>(out_.prototypes.size());
    Prototype p;
    p.name = leaf.name;
    p.firstLeaf = static_cast<uint32_t>(out_.leaves.size());
    p.leafCount = 1;
    p.firstInstance = static_cast<uint32_t>(out_.instances.size());
    p.shapes = 1;
    out_.leaves.push_back(leaf);
    out_.leaves.back().frame = Frame();
    out_.prototypes.push_back(p);
    return at->second;
  }

  void addLeaf(Leaf leaf, Laid& to) {
    const Mesh& mesh = *from_.meshes[leaf.mesh];
    const Mesh world = transformed(mesh, leaf.scale, leaf.frame);
    const Box3 box = world.bounds();
    if (box.empty()) return;
    const Vec3 size = box.size();
    const double wide = std::max(size.x, size.z);
    const bool isTall = size.y > kLeastTall && wide < kWidest * size.y + kWider;
    const bool isAbove = box.min.y > kLeastTall && wide < kWidestAbove;
    const bool stands = box.min.y > kBelow && (isTall || isAbove);
    if (stands) {
      leaf.frame.origin.y += ground_.heightAt(plan(box.center()));
      if (mesh.faceCount() >= kLeastShared) ++counts_[kindOf(leaf)];
    } else {
      MeshDrape drape(world, ground_);
      Mesh laid = drape.take();
      if (laid.empty()) return;
      leaf.mesh = static_cast<uint32_t>(out_.meshes.size());
      leaf.frame = Frame();
      leaf.scale = {1, 1, 1};
      out_.meshes.push_back(makeRef<Mesh>(std::move(laid)));
    }
    to.leaves.push_back(leaf);
    to.stands.push_back(stands);
  }

  const Scene& from_;
  const TerrainSurface& ground_;
  Footings footings_;
  Scene out_;
  std::vector<Laid> laid_;
  // Of what stands and is worth sharing: how often, and the prototype of it alone.
  std::map<Kind, uint32_t> counts_, alone_;
};

}  // namespace

Scene draped(const Scene& scene, const TerrainSurface& ground,
             const std::function<bool(const std::string&)>& lies) {
  return SceneDrape(scene, ground).drape(lies);
}

}  // namespace gable
