// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Whether a small part lies on a large one is asked of their boxes, which fit them, as rules make
// parts along the axes of scopes: the eight corners of the one within the tolerance of the other.
// A box is convex, so all between the corners is as near. Where the large part does not fill its
// box, the corners are held against its triangles.
//
// Joining corners is vertex clustering (Rossignac, Borrel: Multi-resolution 3D approximations for
// rendering complex scenes, 1993), with the mean of the corners for each cell: a corner that stands
// alone stays where it is. Pieces of the ground share their corners, and share them still.
#include "tiles/coarse.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <unordered_map>

#include "base/hash.h"
#include "base/work.h"
#include "scene/flatten.h"
#include "tiles/closing.h"
#include "tiles/panels.h"
#include "tiles/plates.h"
#include "tiles/sheets.h"

namespace gable {
namespace {

// So many of the largest parts of a feature are asked whether they bear a small one.
constexpr size_t kMostBearers = 256;
// Longer ones are not gathered: a box of several would be far from them.
constexpr double kLongestGathered = 2;
// What is narrower covers less than two pixels, as a share of the tolerance.
constexpr double kThin = 1.0 / 8;
// A thing that is thinner, as a share of its width, is one sheet.
constexpr double kFlat = 0.25;
// Of the normals of what lies along each other, the least cosine.
constexpr double kAlong = 0.7;
// The same for faces that would be seen if they did not go.
constexpr double kFlush = 0.97;
// A box stands for things whose faces have together at least such a share of its own.
constexpr double kDense = 0.5;
// A part with so many triangles cannot be simpler.
constexpr uint32_t kSimple = 2;
// Anchors of a cell that are looked at.
constexpr size_t kMostAnchors = 16;
// A part with more triangles is known by its box alone.
constexpr uint32_t kMostMeasured = 64;

using Cell = std::array<int64_t, 3>;

Cell cellOf(const Vec3& p, double side) {
  // Places can be as far away as rules say.
  static constexpr double kMost = 9e18;
  const auto at = [side](double v) {
    return static_cast<int64_t>(std::clamp(std::floor(v / side), -kMost, kMost));
  };
  return {at(p.x), at(p.y), at(p.z)};
}

struct CellHash {
  size_t operator()(const Cell& c) const {
    uint64_t h = 0;
    for (const int64_t v : c) h = hashCombine(h, static_cast<uint64_t>(v));
    return h;
  }
};

// How far the farthest corner is from the box; at once where that is more than `most`.
double distanceTo(const CoarsePart& large, const std::array<Vec3, 8>& corners, double most) {
  double farthest = 0;
  for (const Vec3& c : corners) {
    const Vec3 p = large.frame.toLocal(c);
    const auto beyond = [](double v, double low, double high) {
      return std::max({low - v, v - high, 0.0});
    };
    const Vec3 d{beyond(p.x, large.box.min.x, large.box.max.x),
                 beyond(p.y, large.box.min.y, large.box.max.y),
                 beyond(p.z, large.box.min.z, large.box.max.z)};
    farthest = std::max(farthest, dot(d, d));
    if (farthest > most * most) break;
  }
  return std::sqrt(farthest);
}

double longestOf(const Box3& box) {
  const Vec3 s = box.size();
  return std::max({s.x, s.y, s.z});
}

// Squared, of a point from a triangle: from its plane where the foot lies inside, else from a side.
double distance2(const Vec3& p, const std::array<Vec3, 3>& t) {
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  double best = std::numeric_limits<double>::infinity();
  bool inside = true;
  for (size_t i = 0; i < 3; ++i) {
    const Vec3 &a = t[i], &b = t[(i + 1) % 3];
    const Vec3 along = b - a;
    inside = inside && dot(cross(along, p - a), n) >= 0;
    const double length2 = dot(along, along);
    const double at = length2 > 0 ? std::clamp(dot(p - a, along) / length2, 0.0, 1.0) : 0;
    const Vec3 d = p - (a + along * at);
    best = std::min(best, dot(d, d));
  }
  const double n2 = dot(n, n);
  if (!inside || !(n2 > 0)) return best;
  const double h = dot(p - t[0], n);
  return h * h / n2;
}

class Coarsener {
 public:
  /// `missed`: how far parts of `from` are from what they stand for already.
  Coarsener(const CoarseModel& from, double tolerance, double missed, const CoarseModel* seen)
      : from_(from), tolerance_(tolerance), side_(tolerance / 2), missed_(missed), seen_(seen) {}

  CoarseModel run() {
    out_.features = from_.features;
    for (size_t i = 0; i < from_.parts.size();) {
      const size_t end = endOfFeature(from_.parts, i);
      addFeature(i, end);
      i = end;
    }
    join();
    dropFlat();
    if (seen_) missed_ = std::max(missed_, closeHoles(*seen_, tolerance_, out_));
    dropFeatures();
    out_.error = from_.error + std::max(tolerance_ * kThin, missed_) + shift_;
    return std::move(out_);
  }

 private:
  bool isLarge(const CoarsePart& p) const {
    return p.triangleCount > 0 && (p.isPanel || widthOf(p.box) >= tolerance_);
  }

  // Faces that are half as wide are kept where they lie on nothing, such as those of a dormer: it
  // costs no more to show them than what stands for them.
  bool isFace(const CoarsePart& p) const {
    return p.triangleCount > 0 && p.triangleCount <= kSimple && widthOf(p.box) >= side_;
  }

  // A part that smaller ones lie on, and the colour that they give it.
  struct Bearer {
    const CoarsePart* part;
    Tint tint;
  };

  void addFeature(size_t begin, size_t end) {
    std::vector<size_t> large, narrow;
    for (size_t i = begin; i < end; ++i) (isLarge(from_.parts[i]) ? large : narrow).push_back(i);
    std::vector<Bearer> bearers = bearersOf(large);
    narrow = bear(bearers, narrow, true);
    Plates plates = platesOf(from_, narrow, large, tolerance_);
    std::vector<size_t> rest;
    for (size_t i = 0; i < narrow.size(); ++i) {
      if (!plates.taken[i]) rest.push_back(narrow[i]);
    }
    for (const Plate& p : plates.plates) {
      if (bearers.size() < kMostBearers) bearers.push_back({&p.part, {}});
    }
    const auto firstFace = std::stable_partition(rest.begin(), rest.end(),
                                                 [&](size_t i) { return !isFace(from_.parts[i]); });
    const std::vector<size_t> faces(firstFace, rest.end());
    rest.erase(firstFace, rest.end());
    rest = bear(bearers, rest, false);
    const Tints tints = tintsOf(bearers);
    for (size_t i = 0; i < large.size(); ++i) {
      const CoarsePart& p = from_.parts[large[i]];
      copy(p, tintOf(tints, p.finish), plates.moves[i]);
    }
    for (Plate& p : plates.plates) addPlate(p, tintOf(tints, p.part.finish));
    for (const size_t i : faces) copy(from_.parts[i], tintOf(tints, from_.parts[i].finish), {});
    addLoose(rest);
  }

  // The largest parts, largest first; no narrow panels, which would bear the wall around them.
  std::vector<Bearer> bearersOf(std::vector<size_t> large) const {
    large.erase(std::remove_if(large.begin(), large.end(),
                               [&](size_t i) { return widthOf(from_.parts[i].box) < tolerance_; }),
                large.end());
    std::stable_sort(large.begin(), large.end(), [&](size_t a, size_t b) {
      return faceArea(from_.parts[a].box) > faceArea(from_.parts[b].box);
    });
    if (large.size() > kMostBearers) large.resize(kMostBearers);
    std::vector<Bearer> out;
    for (const size_t i : large) out.push_back({&from_.parts[i], {}});
    return out;
  }

  // Gives narrow parts to what bears them, and those back that nothing does. `within`: not what
  // lies beside a part in its plane.
  std::vector<size_t> bear(std::vector<Bearer>& bearers, const std::vector<size_t>& narrow,
                           bool within) {
    std::vector<size_t> rest;
    size_t last = 0;
    for (const size_t i : narrow) {
      const CoarsePart& p = from_.parts[i];
      const std::array<Vec3, 8> corners = cornersOf(p);
      const Vec3 center = p.frame.point(p.box.center());
      // Neighbours in the list are neighbours on a wall.
      size_t at = last;
      size_t tries = 0;
      for (; tries < bearers.size(); ++tries, at = at + 1 < bearers.size() ? at + 1 : 0) {
        work();
        const CoarsePart& bearer = *bearers[at].part;
        // Most are far, which the first corner tells.
        if (distanceTo(bearer, corners, tolerance_) > tolerance_) continue;
        if (!within || (isBefore(bearer, p, corners) && isAlong(bearer, p, center))) break;
      }
      if (tries == bearers.size()) {
        rest.push_back(i);
        continue;
      }
      last = at;
      bearers[at].tint.add(p.finish, faceArea(p.box));
      miss(p, distanceToSurface(*bearers[at].part, corners));
    }
    return rest;
  }

  // Whether a part lies in another, or across one of its faces: not beside a thin one in its plane,
  // and not as a wall below a roof.
  bool isBefore(const CoarsePart& bearer, const CoarsePart& part,
                const std::array<Vec3, 8>& corners) const {
    Box3 reach;
    for (const Vec3& c : corners) reach.include(bearer.frame.toLocal(c));
    const Vec3 size = bearer.box.size();
    const double slack = tolerance_ / 64;
    const bool hasThin = std::min({size.x, size.y, size.z}) < tolerance_;
    const Vec3 facing = axisOf(part.frame, thinnestOf(part.box.size()));
    size_t beyond = 0;
    for (size_t i = 0; i < 3; ++i) {
      const bool isWithin =
          reach.min[i] >= bearer.box.min[i] - slack && reach.max[i] <= bearer.box.max[i] + slack;
      if (isWithin) continue;
      if (hasThin && size[i] < tolerance_) continue;
      const bool isAcross =
          !isSheet(part) || std::abs(dot(axisOf(bearer.frame, i), facing)) > kAlong;
      if (hasThin || !isAcross || ++beyond > 1) return false;
    }
    return true;
  }

  static bool isSheet(const CoarsePart& part) {
    const Vec3 size = part.box.size();
    return std::min({size.x, size.y, size.z}) <= kFlat * widthOf(part.box);
  }

  // A sheet does not lie on a surface that it stands on edge to: the walls at a corner, those under
  // a roof.
  bool isAlong(const CoarsePart& bearer, const CoarsePart& part, const Vec3& center) const {
    if (!isSheet(part)) return true;
    const size_t across = thinnestOf(part.box.size());
    const std::optional<Vec3> normal = normalNear(bearer, center);
    const double least = isFace(part) ? kFlush : kAlong;
    return normal && std::abs(dot(*normal, axisOf(part.frame, across))) > least;
  }

  // Of what a part shows nearest to a point; none where that is too much to look through.
  std::optional<Vec3> normalNear(const CoarsePart& part, const Vec3& point) const {
    const size_t across = thinnestOf(part.box.size());
    if (part.box.size()[across] < tolerance_) return axisOf(part.frame, across);
    if (part.triangleCount > kMostMeasured) return std::nullopt;
    std::optional<Vec3> normal;
    double nearest = std::numeric_limits<double>::infinity();
    for (uint32_t t = 0; t < part.triangleCount; ++t) {
      const auto corners = triangleOf(part, t);
      const double d = distance2(point, corners);
      const Vec3 n = cross(corners[1] - corners[0], corners[2] - corners[0]);
      if (!(d < nearest) || !(length(n) > 0)) continue;
      nearest = d;
      normal = n * (1 / length(n));
    }
    return normal;
  }

  std::array<Vec3, 3> triangleOf(const CoarsePart& part, uint32_t number) const {
    const auto& tri = from_.triangles[part.firstTriangle + number];
    const auto at = [&](size_t k) { return from_.vertices[part.firstVertex + tri[k]]; };
    return {at(0), at(1), at(2)};
  }

  // By the colour that parts had: walls of one stone stay of one colour.
  using Tints = std::map<std::array<int64_t, 3>, Tint>;

  static Tints tintsOf(const std::vector<Bearer>& bearers) {
    Tints out;
    for (const Bearer& b : bearers) {
      Tint& tint = out[tintKey(b.part->finish)];
      tint.add(b.part->finish, b.part->area);
      tint.add(b.tint);
    }
    return out;
  }

  static Finish tintOf(const Tints& tints, const Finish& finish) {
    const auto found = tints.find(tintKey(finish));
    return found == tints.end() ? finish : found->second.mean(finish);
  }

  // What lies on nothing.
  void addLoose(const std::vector<size_t>& narrow) {
    std::map<Cell, std::vector<size_t>> cells;
    std::vector<size_t> rods;
    for (const size_t i : narrow) {
      const CoarsePart& p = from_.parts[i];
      if (longestOf(p.box) <= kLongestGathered * tolerance_) {
        cells[cellOf(p.frame.point(p.box.center()), tolerance_)].push_back(i);
      } else if (widthOf(p.box) >= kThin * tolerance_) {
        rods.push_back(i);
      }
    }
    for (const auto& [cell, members] : cells) gather(members);
    for (const size_t i : rods) addRod(from_.parts[i]);
  }

  // Something is not shown that is so far from what is; no farther than it is long.
  void miss(const CoarsePart& p, double distance) {
    if (widthOf(p.box) < kThin * tolerance_) return;
    missed_ = std::max(missed_, std::min(distance, longestOf(p.box)));
  }

  // How far the farthest corner is from what a large part shows.
  double distanceToSurface(const CoarsePart& large, const std::array<Vec3, 8>& corners) const {
    const double toBox = distanceTo(large, corners, std::numeric_limits<double>::infinity());
    const Vec3 s = large.box.size();
    const double thickness = std::min({s.x, s.y, s.z});
    // A plate is its box.
    if (large.triangleCount == 0) return toBox;
    if (large.triangleCount > kMostMeasured) return toBox + thickness;
    double farthest = 0;
    for (const Vec3& c : corners) {
      double nearest = std::numeric_limits<double>::infinity();
      for (uint32_t t = 0; t < large.triangleCount; ++t) {
        nearest = std::min(nearest, distance2(c, triangleOf(large, t)));
      }
      farthest = std::max(farthest, nearest);
    }
    return std::sqrt(farthest);
  }

  void copy(const CoarsePart& p, const Finish& finish, const Vec3& move) {
    CoarsePart part = p;
    part.finish = finish;
    part.firstVertex = static_cast<uint32_t>(out_.vertices.size());
    part.firstTriangle = static_cast<uint32_t>(out_.triangles.size());
    const auto vertices = from_.vertices.begin() + p.firstVertex;
    const auto triangles = from_.triangles.begin() + p.firstTriangle;
    for (auto v = vertices; v != vertices + p.vertexCount; ++v) out_.vertices.push_back(*v + move);
    out_.triangles.insert(out_.triangles.end(), triangles, triangles + p.triangleCount);
    part.frame.origin += move;
    out_.parts.push_back(part);
    missed_ = std::max(missed_, length(move));
  }

  // One box for what stands in a cell.
  void gather(const std::vector<size_t>& members) {
    Box3 box;
    Tint tint;
    for (const size_t i : members) {
      const CoarsePart& p = from_.parts[i];
      for (const Vec3& c : cornersOf(p)) box.include(c);
      tint.add(p.finish, faceArea(p.box));
    }
    CoarsePart part;
    part.feature = from_.parts[members[0]].feature;
    part.finish = tint.mean(from_.parts[members[0]].finish);
    part.area = faceArea(box);
    part.box = box;
    const Vec3 size = box.size();
    const double sides = size.x * size.y + size.y * size.z + size.z * size.x;
    // A railing is no block: its bars go.
    if (tint.weight < kDense * sides) {
      for (const size_t i : members) {
        const Box3& gone = from_.parts[i].box;
        missed_ = std::max(missed_, std::min(longestOf(gone), widthOf(gone) / kThin));
      }
      return;
    }
    if (widthOf(box) < side_) return miss(part, longestOf(box));
    addBox(part);
    missed_ = std::max(missed_, length(box.size()));
  }

  // A long thin thing becomes what shows it from all sides with few triangles: two crossed sheets
  // through its middle, or one where it is flat. Their corners are not joined: it would be gone.
  void addRod(const CoarsePart& p) {
    const Vec3 s = p.box.size();
    const size_t along = s.x >= s.y && s.x >= s.z ? 0 : s.y >= s.z ? 1 : 2;
    size_t wide = (along + 1) % 3, thin = (along + 2) % 3;
    if (s[wide] < s[thin]) std::swap(wide, thin);
    CoarsePart part = p;
    part.firstVertex = static_cast<uint32_t>(out_.vertices.size());
    part.firstTriangle = static_cast<uint32_t>(out_.triangles.size());
    part.vertexCount = part.triangleCount = 0;
    corners_.resize(out_.vertices.size(), Corner::Joined);
    addSheet(part, along, wide, thin);
    if (s[thin] > kFlat * s[wide]) addSheet(part, along, thin, wide);
    corners_.resize(out_.vertices.size(), Corner::Free);
    out_.parts.push_back(part);
    missed_ = std::max(missed_, std::sqrt(s[wide] * s[wide] + s[thin] * s[thin]) / 2);
  }

  void addPlate(const Plate& plate, const Finish& finish) {
    CoarsePart part = plate.part;
    part.finish = finish;
    part.firstVertex = static_cast<uint32_t>(out_.vertices.size());
    part.firstTriangle = static_cast<uint32_t>(out_.triangles.size());
    addSheet(part, 0, 1, 2);
    out_.parts.push_back(part);
    missed_ = std::max(missed_, plate.offset);
  }

  // A rectangle through the middle of the box of a part, along two axes.
  void addSheet(CoarsePart& part, size_t along, size_t across, size_t normal) {
    const uint32_t first = part.vertexCount;
    for (size_t i = 0; i < 4; ++i) {
      Vec3 at = part.box.center();
      at[along] = i == 1 || i == 2 ? part.box.max[along] : part.box.min[along];
      at[across] = i >= 2 ? part.box.max[across] : part.box.min[across];
      at[normal] = part.box.center()[normal];
      out_.vertices.push_back(part.frame.point(at));
    }
    out_.triangles.push_back({first, first + 1, first + 2});
    out_.triangles.push_back({first, first + 2, first + 3});
    part.vertexCount += 4;
    part.triangleCount += 2;
  }

  // The box of a part in the place of its triangles; its underside is never seen.
  void addBox(CoarsePart part) {
    part.firstVertex = static_cast<uint32_t>(out_.vertices.size());
    part.firstTriangle = static_cast<uint32_t>(out_.triangles.size());
    part.vertexCount = 8;
    part.triangleCount = 10;
    for (const Vec3& c : cornersOf(part)) out_.vertices.push_back(c);
    static constexpr std::array<std::array<uint32_t, 3>, 10> kSides = {{{2, 6, 7},
                                                                        {2, 7, 3},
                                                                        {4, 5, 7},
                                                                        {4, 7, 6},
                                                                        {1, 0, 2},
                                                                        {1, 2, 3},
                                                                        {5, 1, 3},
                                                                        {5, 3, 7},
                                                                        {0, 4, 6},
                                                                        {0, 6, 2}}};
    out_.triangles.insert(out_.triangles.end(), kSides.begin(), kSides.end());
    out_.parts.push_back(part);
  }

  // Rectangles and triangles keep their corners: joining would make nothing simpler, and equal
  // windows unequal.
  void markAnchors() {
    for (const CoarsePart& p : out_.parts) {
      if (p.triangleCount > kSimple) continue;
      for (uint32_t v = p.firstVertex; v < p.firstVertex + p.vertexCount; ++v) {
        if (corners_[v] == Corner::Joined) corners_[v] = Corner::Anchor;
      }
    }
  }

  // Corners of one cell become the nearest anchor of it, or else their mean.
  void join() {
    struct Sum {
      Vec3 first, sum;
      double count = 0;
      std::vector<Vec3> anchors;
      Vec3 target(const Vec3& from) const {
        if (anchors.empty()) return first + sum * (1 / count);
        return *std::min_element(anchors.begin(), anchors.end(), [&](const Vec3& a, const Vec3& b) {
          return length(a - from) < length(b - from);
        });
      }
    };
    std::unordered_map<Cell, Sum, CellHash> cells;
    std::vector<Sum*> cellOfVertex(out_.vertices.size(), nullptr);
    corners_.resize(out_.vertices.size(), Corner::Joined);
    markAnchors();
    for (size_t v = 0; v < out_.vertices.size(); ++v) {
      work();
      if (corners_[v] == Corner::Free) continue;
      const Vec3& p = out_.vertices[v];
      Sum& s = cells[cellOf(p, side_)];
      if (corners_[v] == Corner::Anchor) {
        if (s.anchors.size() < kMostAnchors) s.anchors.push_back(p);
        continue;
      }
      if (s.count == 0) s.first = p;
      // Differences to the first, so that equal corners stay what they are.
      s.sum += p - s.first;
      s.count += 1;
      cellOfVertex[v] = &s;
    }
    for (size_t v = 0; v < out_.vertices.size(); ++v) {
      if (!cellOfVertex[v]) continue;
      const Vec3 target = cellOfVertex[v]->target(out_.vertices[v]);
      shift_ = std::max(shift_, length(target - out_.vertices[v]));
      out_.vertices[v] = target;
    }
  }

  // Leaves out triangles without area, corners that none has, and parts without triangles.
  void dropFlat() {
    std::vector<CoarsePart> parts;
    std::vector<Vec3> vertices;
    std::vector<std::array<uint32_t, 3>> triangles;
    std::vector<uint32_t> index;
    for (const CoarsePart& old : out_.parts) {
      CoarsePart p = old;
      p.firstVertex = static_cast<uint32_t>(vertices.size());
      p.firstTriangle = static_cast<uint32_t>(triangles.size());
      p.box = {};
      index.assign(old.vertexCount, 0xffffffff);
      for (uint32_t t = 0; t < old.triangleCount; ++t) {
        std::array<uint32_t, 3> tri = out_.triangles[old.firstTriangle + t];
        const Vec3& a = out_.vertices[old.firstVertex + tri[0]];
        const Vec3& b = out_.vertices[old.firstVertex + tri[1]];
        const Vec3& c = out_.vertices[old.firstVertex + tri[2]];
        if (!(length(cross(b - a, c - a)) > 1e-6)) continue;
        for (uint32_t& v : tri) {
          uint32_t& at = index[v];
          if (at == 0xffffffff) {
            at = static_cast<uint32_t>(vertices.size()) - p.firstVertex;
            vertices.push_back(out_.vertices[old.firstVertex + v]);
            p.box.include(p.frame.toLocal(vertices.back()));
          }
          v = at;
        }
        triangles.push_back(tri);
      }
      p.vertexCount = static_cast<uint32_t>(vertices.size()) - p.firstVertex;
      p.triangleCount = static_cast<uint32_t>(triangles.size()) - p.firstTriangle;
      if (p.triangleCount > 0)
        parts.push_back(p);
      else
        miss(old, longestOf(old.box));
    }
    out_.parts.swap(parts);
    out_.vertices.swap(vertices);
    out_.triangles.swap(triangles);
  }

  // Those of which nothing is left to see, and to pick.
  void dropFeatures() {
    std::vector<TileFeature> features;
    uint32_t last = 0xffffffff;
    for (CoarsePart& p : out_.parts) {
      if (p.feature != last) features.push_back(std::move(out_.features[p.feature]));
      last = p.feature;
      p.feature = static_cast<uint32_t>(features.size()) - 1;
    }
    out_.features.swap(features);
  }

  const CoarseModel& from_;
  double tolerance_, side_;
  /// The farthest of what is not shown from what is, and of a corner from where it was.
  double missed_;
  const CoarseModel* seen_;
  double shift_ = 0;
  CoarseModel out_;
  /// Of a vertex: it is joined with others, stays where it is, or stays and draws others to it.
  enum class Corner : uint8_t { Joined, Free, Anchor };
  std::vector<Corner> corners_;
};

// One leaf: a part for each of its material slots.
class PartMaker {
 public:
  PartMaker(const TileContent& content, double tolerance, const FinishOf& finishOf)
      : content_(content), tolerance_(tolerance), finishOf_(finishOf) {}

  CoarseModel run() {
    out_.features = content_.features;
    for (const TileLeaf& l : content_.leaves) add(l);
    return std::move(out_);
  }

 private:
  const Finish& finishOf(uint32_t scene, uint32_t material, const Material& m) {
    const auto [at, fresh] = finishes_.try_emplace({scene, material});
    if (fresh) at->second = finishOf_(m);
    return at->second;
  }

  void add(const TileLeaf& l) {
    const Scene& scene = *content_.scenes[l.scene];
    const Leaf& leaf = scene.leaves[l.leaf];
    const Mesh& mesh = *scene.meshes[leaf.mesh];
    CoarsePart part;
    part.feature = l.feature;
    part.frame = l.world;
    part.box = localBox(scene, leaf);
    if (part.box.empty()) return;
    part.area = faceArea(part.box);
    if (widthOf(part.box) < tolerance_) {
      const uint32_t slot = mesh.faces.empty() ? 0 : mesh.faces[0].materialSlot;
      part.finish =
          finishOf(l.scene, materialIndexOf(scene, leaf, slot), materialOf(scene, leaf, slot));
      out_.parts.push_back(part);
      return;
    }
    std::map<uint16_t, std::vector<std::array<uint32_t, 3>>> slots;
    for (size_t f = 0; f < mesh.faceCount(); ++f) {
      triangulator_.add(mesh, f, slots[mesh.faces[f].materialSlot]);
    }
    for (const auto& [slot, triangles] : slots) {
      part.finish =
          finishOf(l.scene, materialIndexOf(scene, leaf, slot), materialOf(scene, leaf, slot));
      addTriangles(part, l, leaf, mesh, triangles);
    }
  }

  void addTriangles(CoarsePart part, const TileLeaf& l, const Leaf& leaf, const Mesh& mesh,
                    const std::vector<std::array<uint32_t, 3>>& triangles) {
    const bool mirrored = leaf.scale.x * leaf.scale.y * leaf.scale.z < 0;
    part.firstVertex = static_cast<uint32_t>(out_.vertices.size());
    part.firstTriangle = static_cast<uint32_t>(out_.triangles.size());
    std::unordered_map<uint32_t, uint32_t> index;
    work(triangles.size());
    for (const auto& tri : triangles) {
      std::array<uint32_t, 3> out{};
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t position = mesh.corners[tri[mirrored ? 2 - k : k]];
        const auto [at, fresh] = index.try_emplace(position, static_cast<uint32_t>(index.size()));
        if (fresh) {
          out_.vertices.push_back(l.world.point(scaled(mesh.positions[position], leaf.scale)));
        }
        out[k] = at->second;
      }
      out_.triangles.push_back(out);
    }
    part.vertexCount = static_cast<uint32_t>(out_.vertices.size()) - part.firstVertex;
    part.triangleCount = static_cast<uint32_t>(out_.triangles.size()) - part.firstTriangle;
    out_.parts.push_back(part);
  }

  const TileContent& content_;
  double tolerance_;
  const FinishOf& finishOf_;
  FaceTriangulator triangulator_;
  std::map<std::pair<uint32_t, uint32_t>, Finish> finishes_;
  CoarseModel out_;
};

}  // namespace

void CoarseModel::append(CoarseModel&& other) {
  const auto firstFeature = static_cast<uint32_t>(features.size());
  const auto firstVertex = static_cast<uint32_t>(vertices.size());
  const auto firstTriangle = static_cast<uint32_t>(triangles.size());
  std::move(other.features.begin(), other.features.end(), std::back_inserter(features));
  vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
  triangles.insert(triangles.end(), other.triangles.begin(), other.triangles.end());
  for (CoarsePart p : other.parts) {
    p.feature += firstFeature;
    p.firstVertex += firstVertex;
    p.firstTriangle += firstTriangle;
    parts.push_back(p);
  }
  error = std::max(error, other.error);
}

CoarseModel partsOf(const TileContent& content, double tolerance, const FinishOf& finishOf) {
  return PartMaker(content, tolerance, finishOf).run();
}

CoarseModel coarsened(const CoarseModel& model, double tolerance, const CoarseModel* seen) {
  const Panelled panelled = withPanels(model, tolerance);
  return Coarsener(panelled.model, tolerance, panelled.offset, seen).run();
}

}  // namespace gable
