// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A face is cut by one value after the other from low to high, each time with what is left above.
// A new point is found by the two points of its edge and its place between them, counted from the
// lower point number, so that every face around the edge gets the same one. The field's gradient in
// a face comes from Green's theorem, which is exact for linear fields on any polygon with holes.
#include "geom/mesh/slicer.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"
#include "base/work.h"

namespace gable::slicing {
namespace {

// Nearer than this share of the extent, a point lies on a cut.
constexpr double kOnCut = 1e-9;

template <class T>
T mix(const T& a, const T& b, double t) {
  return a + (b - a) * t;
}

}  // namespace

Slicer::Slicer(const Mesh& m, std::vector<double> cornerValues, int axis, const Vec3& direction,
               double tolerance)
    : mesh_(m),
      axis_(axis),
      direction_(direction),
      points_(m.positions),
      values_(std::move(cornerValues)),
      normals_(m.normals) {
  for (int s = 0; s < m.setCount(); ++s) sets_.push_back(m.set(s));
  measureTolerance(tolerance);
  collapseShortEdges();
}

void Slicer::measureTolerance(double least) {
  if (values_.empty()) return;
  const auto [low, high] = std::minmax_element(values_.begin(), values_.end());
  const double reach = std::max(std::fabs(*low), std::fabs(*high));
  tolerance_ = std::max({kOnCut * (*high - *low), 4e-16 * reach, least});
}

// An edge so short that both its ends may lie on one cut has no direction that a cut could use, so
// its ends become one point.
void Slicer::collapseShortEdges() {
  standIn_.resize(points_.size());
  for (uint32_t i = 0; i < standIn_.size(); ++i) standIn_[i] = i;
  if (direction_ == Vec3{}) return;
  const double least = 3 * tolerance_ / length(direction_);
  const auto rootOf = [&](uint32_t i) {
    while (standIn_[i] != i) i = standIn_[i] = standIn_[standIn_[i]];
    return i;
  };
  bool any = false;
  for (const MeshLoop& loop : mesh_.loops) {
    work(loop.cornerCount);
    for (uint32_t i = 0; i < loop.cornerCount && loop.cornerCount > 2; ++i) {
      const uint32_t a = mesh_.corners[loop.firstCorner + i];
      const uint32_t b = mesh_.corners[loop.firstCorner + (i + 1) % loop.cornerCount];
      if (length(points_[a] - points_[b]) > least) continue;
      const uint32_t ra = rootOf(a), rb = rootOf(b);
      standIn_[std::max(ra, rb)] = std::min(ra, rb);
      any = true;
    }
  }
  if (!any) return;
  for (uint32_t i = 0; i < standIn_.size(); ++i) standIn_[i] = rootOf(i);
  for (size_t c = 0; c < mesh_.corners.size(); ++c) {
    const uint32_t p = mesh_.corners[c];
    if (standIn_[p] != p) values_[c] = dot(direction_, points_[standIn_[p]]);
  }
}

bool Slicer::onCut(uint32_t attributes) const {
  return std::fabs(values_[attributes] - cut_) <= tolerance_;
}

int Slicer::side(const cut::Corner& c) const {
  if (onCut(c.attributes)) return 0;
  return values_[c.attributes] < cut_ ? -1 : 1;
}

Vec2 Slicer::place(const cut::Corner& c) const {
  const Vec3 p = points_[c.point] - origin_;
  return {dot(p, along_), dot(p, up_)};
}

cut::Corner Slicer::split(const cut::Corner& a, const cut::Corner& b) {
  const double va = values_[a.attributes], vb = values_[b.attributes];
  const double t = (cut_ - va) / (vb - va);
  return {pointOn(a, b), interpolate(a.attributes, b.attributes, t), a.edge};
}

uint32_t Slicer::pointOn(const cut::Corner& a, const cut::Corner& b) {
  const cut::Corner& low = a.point < b.point ? a : b;
  const cut::Corner& high = a.point < b.point ? b : a;
  const double vl = values_[low.attributes], vh = values_[high.attributes];
  const double t = (cut_ - vl) / (vh - vl);
  const uint64_t key = hashCombine(hashCombine(low.point, high.point), hashDouble(cut_));
  const auto [begin, end] = edgePoints_.equal_range(key);
  for (auto it = begin; it != end; ++it) {
    work();
    const NewPoint& n = it->second;
    if (n.low == low.point && n.high == high.point && std::fabs(n.t - t) < 1e-12) return n.point;
  }
  Vec3 p = mix(points_[low.point], points_[high.point], t);
  if (axis_ >= 0) p[static_cast<size_t>(axis_)] = cut_;
  const auto point = static_cast<uint32_t>(points_.size());
  points_.push_back(p);
  edgePoints_.insert({key, {low.point, high.point, t, point}});
  return point;
}

uint32_t Slicer::interpolate(uint32_t a, uint32_t b, double t) {
  const auto attributes = static_cast<uint32_t>(values_.size());
  values_.push_back(cut_);
  for (auto& set : sets_) {
    if (!set.empty()) set.push_back(mix(set[a], set[b], t));
  }
  if (!normals_.empty()) normals_.push_back(normalized(mix(normals_[a], normals_[b], t)));
  return attributes;
}

Vec3 Slicer::gradientOf(uint32_t face, const Vec3& normal) const {
  if (!(direction_ == Vec3{})) return direction_ - normal * dot(normal, direction_);
  Vec3 sum;
  for (const MeshLoop& loop : mesh_.loopsOf(face)) {
    work(loop.cornerCount);
    for (uint32_t i = 0; i < loop.cornerCount; ++i) {
      const uint32_t a = loop.firstCorner + i, b = loop.firstCorner + (i + 1) % loop.cornerCount;
      const double middle = (values_[a] + values_[b]) / 2 - values_[loop.firstCorner];
      sum += cross(mesh_.at(b) - mesh_.at(a), normal) * middle;
    }
  }
  return sum;
}

void Slicer::setPlane(uint32_t face) {
  const Vec3 normal = mesh_.normal(face);
  origin_ = mesh_.at(mesh_.loopsOf(face)[0].firstCorner);
  up_ = normalized(gradientOf(face, normal));
  along_ = cross(up_, normal);
}

// Points and edges have no holes.
std::span<const MeshLoop> Slicer::loopsThatCount(uint32_t face) const {
  const auto loops = mesh_.loopsOf(face);
  return loops[0].cornerCount < 3 ? loops.first(1) : loops;
}

cut::Face Slicer::faceOf(uint32_t face) const {
  cut::Face out;
  for (const MeshLoop& loop : loopsThatCount(face)) {
    work(loop.cornerCount);
    cut::Loop l;
    for (uint32_t i = 0; i < loop.cornerCount; ++i) {
      const uint32_t c = loop.firstCorner + i;
      const uint32_t point = standIn_[mesh_.corners[c]];
      if (!l.empty() && l.back().point == point)
        l.back().edge = c;
      else
        l.push_back({point, c, c});
    }
    // A run of one point over the seam ends with the edge that leads on, which the first has.
    while (l.size() > 1 && l.back().point == l[0].point) l.pop_back();
    const bool kept = l.size() >= std::min(loop.cornerCount, 3u);
    if (!kept && out.empty()) return {};
    if (kept) out.push_back(std::move(l));
  }
  return out;
}

std::vector<std::vector<Piece>> Slicer::slice(std::span<const double> cuts) {
  std::vector<std::vector<Piece>> slabs(cuts.size() + 1);
  for (uint32_t f = 0; f < mesh_.faces.size(); ++f) {
    work(4);
    sliceFace(f, cuts, slabs);
  }
  return slabs;
}

void Slicer::sliceFace(uint32_t face, std::span<const double> cuts,
                       std::vector<std::vector<Piece>>& slabs) {
  double low = values_[mesh_.loopsOf(face)[0].firstCorner], high = low;
  for (const MeshLoop& loop : loopsThatCount(face)) {
    for (uint32_t i = 0; i < loop.cornerCount; ++i) {
      low = std::min(low, values_[loop.firstCorner + i]);
      high = std::max(high, values_[loop.firstCorner + i]);
    }
  }
  const auto put = [&](size_t slab, cut::Face f) {
    if (!f.empty()) slabs[slab].push_back({std::move(f), face});
  };
  const auto countUpTo = [&](double v) {
    return static_cast<size_t>(std::upper_bound(cuts.begin(), cuts.end(), v) - cuts.begin());
  };
  const size_t slabBelow = countUpTo(low - tolerance_), firstCut = countUpTo(low + tolerance_);
  if (high - low <= 2 * tolerance_) {
    // A flat face on a cut stays below when it looks up.
    const bool looksUp = direction_ == Vec3{} || dot(mesh_.areaNormal(face), direction_) > 0;
    put(looksUp ? slabBelow : firstCut, faceOf(face));
    return;
  }
  const size_t lastCut = std::max(
      firstCut, static_cast<size_t>(std::lower_bound(cuts.begin(), cuts.end(), high - tolerance_) -
                                    cuts.begin()));
  if (firstCut == lastCut) {
    put(firstCut, faceOf(face));
    return;
  }
  if (mesh_.loopsOf(face)[0].cornerCount == 2)
    return sliceEdge(face, cuts, firstCut, lastCut, slabs);
  setPlane(face);
  std::vector<cut::Face> rest{faceOf(face)};
  for (size_t k = firstCut; k < lastCut; ++k) {
    work(4);
    cut_ = cuts[k];
    std::vector<cut::Face> below, above;
    for (const cut::Face& f : rest) cut::cutFace(f, *this, MeshPart::kNone, below, above);
    for (cut::Face& f : below) put(k, std::move(f));
    rest = std::move(above);
  }
  for (cut::Face& f : rest) put(lastCut, std::move(f));
}

// A face of two corners stands for an edge.
void Slicer::sliceEdge(uint32_t face, std::span<const double> cuts, size_t firstCut, size_t lastCut,
                       std::vector<std::vector<Piece>>& slabs) {
  const cut::Face whole = faceOf(face);
  if (whole.empty()) return;
  const bool rising = values_[whole[0][0].attributes] < values_[whole[0][1].attributes];
  cut::Corner from = whole[0][rising ? 0 : 1];
  const cut::Corner to = whole[0][rising ? 1 : 0];
  const auto put = [&](size_t slab, const cut::Corner& a, const cut::Corner& b) {
    slabs[slab].push_back({{rising ? cut::Loop{a, b} : cut::Loop{b, a}}, face});
  };
  for (size_t k = firstCut; k < lastCut; ++k) {
    work(2);
    cut_ = cuts[k];
    const cut::Corner at = split(from, to);
    put(k, from, at);
    from = at;
  }
  put(lastCut, from, to);
}

MeshPart Slicer::build(const std::vector<Piece>& pieces, const CutOptions& options) const {
  MeshPart part;
  MeshBuilder b;
  std::vector<uint32_t> local(points_.size(), MeshBuilder::kNoPosition);
  for (const Piece& piece : pieces) {
    const bool isCap = piece.source == MeshPart::kNone;
    if (isCap) {
      b.beginFace(options.capSlot, options.capTags);
    } else {
      const MeshFace& f = mesh_.faces[piece.source];
      b.beginFace(f.materialSlot, f.tags, f.smooth);
    }
    part.faceSource.push_back(piece.source);
    for (const cut::Loop& loop : piece.face) {
      work(loop.size());
      b.beginLoop();
      for (const cut::Corner& c : loop) {
        uint32_t& position = local[c.point];
        if (position == MeshBuilder::kNoPosition) {
          // The mesh's own positions come first among the points.
          position = b.addPosition(points_[c.point], mesh_.vertexTagsAt(c.point));
        }
        uint32_t tags = isCap ? 0 : options.cutEdgeTags;
        if (c.edge != MeshPart::kNone) tags = mesh_.edgeTagsAt(c.edge);
        const uint32_t corner = b.addCorner(position, tags);
        part.edgeSource.push_back(c.edge);
        for (size_t s = 0; s < sets_.size(); ++s) {
          if (!sets_[s].empty()) b.setUv(corner, static_cast<int>(s), sets_[s][c.attributes]);
        }
        if (!normals_.empty()) b.setNormal(corner, normals_[c.attributes]);
      }
    }
  }
  part.mesh = b.take();
  return part;
}

}  // namespace gable::slicing
