// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A ring is simplified to a dozen vertices by the least triangles (Visvalingam and Whyatt 1993),
// then all fours of them are tried as corners.
#include "geom/region/autoindex.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "math/trig.h"

namespace gable {
namespace {

constexpr size_t kMostCandidates = 14;
constexpr double kAngleWeight = 0.15;

double triangleArea(Vec2 a, Vec2 b, Vec2 c) { return std::fabs(cross(b - a, c - a)) / 2; }

std::vector<uint32_t> simplified(const Ring& r) {
  std::vector<uint32_t> left(r.size());
  for (uint32_t i = 0; i < r.size(); ++i) left[i] = i;
  while (left.size() > kMostCandidates) {
    work(left.size());
    const size_t n = left.size();
    size_t least = 0;
    double leastArea = 1e300;
    for (size_t i = 0; i < n; ++i) {
      const double a = triangleArea(r[left[(i + n - 1) % n]], r[left[i]], r[left[(i + 1) % n]]);
      if (a < leastArea) {
        leastArea = a;
        least = i;
      }
    }
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(least));
  }
  return left;
}

double turnAngle(Vec2 in, Vec2 out) { return toRadians(atan2Deg(cross(in, out), dot(in, out))); }

// How much four corners make of a region of that area: the share that they cover, less for corners
// that are not right angles. kWorse where it cannot be more than `least`.
constexpr double kWorse = -1e9;
double scoreOf(const Vec2 (&q)[4], double whole, double least) {
  const double a = signedArea({q[0], q[1], q[2], q[3]});
  if (!(a > 0)) return kWorse;
  const double share = std::min(a, whole) / std::max(a, whole);
  double bent = 0, score = share;
  for (size_t i = 0; i < 4; ++i) {
    // Each corner only takes away, and angles are dear.
    if (!(score > least)) return kWorse;
    const Vec2 in = q[i] - q[(i + 3) % 4], out = q[(i + 1) % 4] - q[i];
    if (cross(in, out) < 0) return kWorse;
    const double turn = turnAngle(in, out);
    if (!(turn > 0)) return kWorse;
    bent += (turn - kPi / 2) * (turn - kPi / 2);
    score = share - kAngleWeight * bent;
  }
  return score;
}

// Turns four places so that the first side looks south in the frame.
void southFirst(const Ring& r, std::array<uint32_t, 4>& corner, Vec2 east) {
  const Vec2 north = perpendicular(east);
  const Vec2 out[4] = {-north, east, north, -east};
  size_t best = 0;
  double most = -1e300;
  for (size_t turn = 0; turn < 4; ++turn) {
    work();
    double sum = 0;
    for (size_t i = 0; i < 4; ++i) {
      const Vec2 side = r[corner[(i + turn + 1) % 4]] - r[corner[(i + turn) % 4]];
      sum += dot(-perpendicular(normalized(side)), out[i]);
    }
    if (sum > most + 1e-9) {
      most = sum;
      best = turn;
    }
  }
  std::rotate(corner.begin(), corner.begin() + static_cast<std::ptrdiff_t>(best), corner.end());
}

// Logical edges between corners in the order of the ring; corner k begins the edge `first - k`.
LogicalEdges between(const Ring& r, const std::array<uint32_t, 4>& corner) {
  LogicalEdges out;
  out.count = 4;
  out.of.assign(r.size(), 0);
  // Counter-clockwise from the south-west: south 3, east 2, north 1, west 0.
  for (uint32_t k = 0; k < 4; ++k) {
    const uint32_t end = corner[(k + 1) % 4];
    for (uint32_t i = corner[k]; i != end; i = (i + 1) % static_cast<uint32_t>(r.size())) {
      work();
      out.of[i] = 3 - k;
    }
  }
  return out;
}

std::array<uint32_t, 4> boxCorners(const Ring& r, const OrientedRect& box) {
  std::array<uint32_t, 4> corner{};
  const Vec2 at[4] = {box.at(0, 0), box.at(box.width, 0), box.at(box.width, box.height),
                      box.at(0, box.height)};
  for (size_t k = 0; k < 4; ++k) {
    double least = 1e300;
    for (uint32_t i = 0; i < r.size(); ++i) {
      work();
      const double d = length(r[i] - at[k]);
      if (d < least) {
        least = d;
        corner[k] = i;
      }
    }
  }
  return corner;
}

// In cyclic order, though some may be equal.
bool ordered(const std::array<uint32_t, 4>& c, size_t n) {
  size_t round = 0;
  for (size_t k = 0; k < 4; ++k) round += (c[(k + 1) % 4] + n - c[k]) % n;
  return round == n;
}

LogicalEdges byFacing(const Ring& r, Vec2 east) {
  LogicalEdges out;
  out.count = 4;
  for (size_t i = 0; i < r.size(); ++i) {
    work();
    const Vec2 n = -perpendicular(r[(i + 1) % r.size()] - r[i]);
    const double x = dot(n, east), y = dot(n, perpendicular(east));
    out.of.push_back(std::fabs(x) >= std::fabs(y) ? (x < 0 ? 0u : 2u) : (y > 0 ? 1u : 3u));
  }
  return out;
}

// The logical edges between bends, given as ascending vertices.
LogicalEdges betweenBends(const Ring& outer, const std::vector<size_t>& bends) {
  const size_t n = outer.size();
  // The first logical edge is the one that ends, clockwise, farthest to the north-west: it begins
  // at the bend nearest to the south-west corner of the box.
  const OrientedRect box = orientedFrame(outer);
  size_t first = 0;
  for (size_t k = 1; k < bends.size(); ++k) {
    if (length(outer[bends[k]] - box.origin) < length(outer[bends[first]] - box.origin)) first = k;
  }
  LogicalEdges out;
  out.count = static_cast<uint32_t>(bends.size());
  out.of.assign(n, 0);
  for (size_t k = 0; k < bends.size(); ++k) {
    const size_t begin = bends[(first + k) % bends.size()];
    const size_t end = bends[(first + k + 1) % bends.size()];
    for (size_t i = begin; i != end; i = (i + 1) % n) {
      work();
      out.of[i] = static_cast<uint32_t>(bends.size() - 1 - k);
    }
  }
  return out;
}

}  // namespace

OrientedRect orientedFrame(const Ring& outer) {
  OrientedRect box = smallestRect(outer);
  const auto turn = [&] {
    box.origin = box.at(box.width, 0);
    box.x = perpendicular(box.x);
    std::swap(box.width, box.height);
  };
  constexpr double kAligned = 1e-9;
  const bool aligned = std::min(std::fabs(box.x.x), std::fabs(box.x.y)) < kAligned;
  for (int i = 0; i < 4; ++i) {
    if (aligned && box.x.x > 0.5) break;
    const bool longSide = box.width > box.height * (1 + 1e-9) ||
                          (box.width > box.height * (1 - 1e-9) && box.x.x > 0.7);
    if (!aligned && longSide && (box.x.x > 0 || (box.x.x == 0 && box.x.y > 0))) break;
    turn();
  }
  return box;
}

BestQuad bestQuad(const Ring& outer) {
  BestQuad best;
  if (outer.size() < 4) return best;
  const std::vector<uint32_t> v = simplified(outer);
  const double whole = signedArea(outer);
  const size_t n = v.size();
  for (size_t a = 0; a < n; ++a) {
    for (size_t b = a + 1; b < n; ++b) {
      for (size_t c = b + 1; c < n; ++c) {
        work(n);
        for (size_t d = c + 1; d < n; ++d) {
          const Vec2 q[4] = {outer[v[a]], outer[v[b]], outer[v[c]], outer[v[d]]};
          const double least = best.score + 1e-12;
          const double s = scoreOf(q, whole, least);
          if (s > least) best = {{v[a], v[b], v[c], v[d]}, s};
        }
      }
    }
  }
  if (best.found()) southFirst(outer, best.corner, orientedFrame(outer).x);
  return best;
}

LogicalEdges sidesOf(const Ring& outer) {
  const BestQuad quad = bestQuad(outer);
  if (quad.found()) return between(outer, quad.corner);
  const OrientedRect box = orientedFrame(outer);
  const std::array<uint32_t, 4> corner = boxCorners(outer, box);
  if (ordered(corner, outer.size())) return between(outer, corner);
  return byFacing(outer, box.x);
}

LogicalEdges autoindex(const Ring& outer) {
  const BestQuad quad = bestQuad(outer);
  if (quad.found() && quad.score >= kRoughlyQuad) return between(outer, quad.corner);
  const size_t n = outer.size();
  const double mean = perimeter(outer) / static_cast<double>(n);
  std::vector<size_t> bends;
  for (size_t i = 0; i < n; ++i) {
    // The turn over a window of one metre.
    Vec2 in, out;
    double before = 0, after = 0;
    for (size_t k = i; before < 0.5 && k + n > i; --k) {
      work();
      const Vec2 e = outer[k % n] - outer[(k + n - 1) % n];
      in = in + e;
      before += length(e);
      if (k == 0) break;
    }
    for (size_t k = i; after < 0.5 && k < i + n; ++k) {
      work();
      const Vec2 e = outer[(k + 1) % n] - outer[k % n];
      out = out + e;
      after += length(e);
    }
    const double turn = std::fabs(turnAngle(in, out)) * 180 / kPi;
    const double shorter =
        std::min(length(outer[i] - outer[(i + n - 1) % n]), length(outer[(i + 1) % n] - outer[i]));
    if (turn > 30 || (turn > 15 && shorter > mean)) bends.push_back(i);
  }
  if (bends.size() < 3) return sidesOf(outer);
  return betweenBends(outer, bends);
}

LogicalEdges chainsOf(const Ring& outer, const std::vector<uint32_t>& kind) {
  const size_t n = outer.size();
  std::vector<size_t> bends;
  for (size_t i = 0; i < n; ++i) {
    const Vec2 in = outer[i] - outer[(i + n - 1) % n], out = outer[(i + 1) % n] - outer[i];
    const bool changes = kind[i] != kind[(i + n - 1) % n];
    if (changes && std::fabs(turnAngle(in, out)) * 180 / kPi > 30) bends.push_back(i);
  }
  return bends.size() >= 3 ? betweenBends(outer, bends) : autoindex(outer);
}

LogicalEdges sectorOf(const Ring& outer, const std::vector<SectorSide>& side) {
  const size_t n = outer.size();
  // Where, clockwise, the first ray begins: behind the border of the centre, or at the centre.
  std::vector<size_t> starts;
  for (size_t i = 0; i < n; ++i) {
    const SectorSide own = side[i], next = side[(i + 1) % n];
    if (own == SectorSide::Ray && next == SectorSide::Centre) starts.push_back(i);
  }
  if (starts.empty()) {
    for (size_t i = 0; i < n; ++i) {
      work();
      const size_t k = (i + 1) % n;
      const Vec2 in = outer[k] - outer[i], out = outer[(k + 1) % n] - outer[k];
      const bool turns = std::fabs(turnAngle(in, out)) * 180 / kPi > 1;
      if (side[i] == SectorSide::Ray && side[k] == SectorSide::Ray && turns) starts.push_back(i);
    }
  }
  if (starts.size() != 1) return autoindex(outer);
  LogicalEdges out;
  out.of.assign(n, 0);
  uint32_t number = 1;
  SectorSide before = SectorSide::Ray;
  for (size_t k = 0; k < n; ++k) {
    const size_t i = (starts[0] + n - k) % n;
    if (side[i] == SectorSide::Centre) continue;
    const Vec2 own = outer[(i + 1) % n] - outer[i];
    const Vec2 last = outer[(i + 2) % n] - outer[(i + 1) % n];
    const bool bend = std::fabs(turnAngle(own, last)) * 180 / kPi > 30;
    if (k > 0 && (side[i] != before || (side[i] == SectorSide::Outer && bend))) ++number;
    out.of[i] = number;
    before = side[i];
  }
  out.count = number + 1;
  return out;
}

}  // namespace gable
