// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Surface simplification with quadric error metrics (Garland and Heckbert 1997), with subset
// placement: a vertex moves onto a neighbour, so that texture coordinates are those of a corner
// that was there. Quadrics are weighted by area; borders and seams add planes square to their
// faces. A collapse is not done where it changes the topology (the link condition of Dey et al.
// 1999), or where a triangle would turn by more than 78 degrees.
#include "geom/mesh/simplify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <queue>
#include <tuple>
#include <utility>

#include "base/work.h"
#include "geom/mesh/face_triangles.h"

namespace gable {

namespace {

// How much more a metre of border weighs than a square metre of surface.
constexpr double kBorderWeight = 100;
constexpr double kLeastCosine = 0.2;
// Of two collapses of equal cost the shorter goes first: flat parts thin out evenly.
constexpr double kLengthWeight = 1e-9;

/// The sum of squared distances to planes, each with a weight, as a function of the point.
struct Quadric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0, x = 0, y = 0, z = 0, one = 0;

  void addPlane(const Vec3& n, const Vec3& at, double weight) {
    const double d = -dot(n, at);
    xx += weight * n.x * n.x;
    xy += weight * n.x * n.y;
    xz += weight * n.x * n.z;
    yy += weight * n.y * n.y;
    yz += weight * n.y * n.z;
    zz += weight * n.z * n.z;
    x += weight * n.x * d;
    y += weight * n.y * d;
    z += weight * n.z * d;
    one += weight * d * d;
  }
  void add(const Quadric& q) {
    xx += q.xx;
    xy += q.xy;
    xz += q.xz;
    yy += q.yy;
    yz += q.yz;
    zz += q.zz;
    x += q.x;
    y += q.y;
    z += q.z;
    one += q.one;
  }
  double at(const Vec3& p) const {
    return std::max(0.0, p.x * p.x * xx + p.y * p.y * yy + p.z * p.z * zz +
                             2 * (p.x * p.y * xy + p.x * p.z * xz + p.y * p.z * yz) +
                             2 * (p.x * x + p.y * y + p.z * z) + one);
  }
};

struct Tri {
  /// Positions, and the corners of the mesh whose attributes the corners have.
  std::array<uint32_t, 3> vertex, corner;
  uint32_t face = 0;
  bool alive = true;
};

/// What a corner of a removed vertex becomes, in faces of one material.
struct Move {
  uint32_t from = 0, to = 0;
  uint16_t slot = 0;
};

/// Moves `from` onto `to`. Outdated when a stamp has changed.
struct Collapse {
  double cost = 0;
  uint32_t from = 0, to = 0;
  uint32_t fromStamp = 0, toStamp = 0;
  bool operator<(const Collapse& o) const {
    return std::tie(cost, from, to) > std::tie(o.cost, o.from, o.to);
  }
};

/// By the ends of an edge: the triangles that have it, and the number of their corner before it.
using EdgeUses =
    std::map<std::pair<uint32_t, uint32_t>, std::vector<std::pair<uint32_t, uint32_t>>>;

class Simplifier {
 public:
  explicit Simplifier(const Mesh& m);
  Mesh run(double share);

 private:
  bool sameAttributes(uint32_t a, uint32_t b) const;
  uint32_t jumps(const Tri& a, uint32_t ka, const Tri& b, uint32_t from, uint32_t to) const;
  std::vector<char> findPoles(const EdgeUses& uses) const;
  void findEdges();
  void markEdge(uint32_t tri, uint32_t k);
  void push(uint32_t from, uint32_t to);
  void pushAround(uint32_t v);
  std::vector<uint32_t> neighbours(uint32_t v) const;
  uint32_t cornerOf(const Tri& t, uint32_t vertex) const;
  const Move* moveOf(const Tri& t, uint32_t vertex, const std::vector<Move>& moves) const;
  bool findMoves(const Collapse& c, std::vector<Move>& moves) const;
  bool keepsTopology(const Collapse& c) const;
  bool keepsNormals(const Collapse& c) const;
  bool collapse(const Collapse& c);
  Mesh result() const;
  void addTriangle(const Tri& t, MeshBuilder& b, std::vector<uint32_t>& map) const;
  size_t used() const;

  const Mesh& mesh_;
  Vec3 centre_;
  std::vector<Vec3> at_;
  std::vector<Tri> tris_;
  std::vector<std::vector<uint32_t>> around_;
  std::vector<Quadric> quadrics_;
  /// Vertices on borders and seams move along these alone; see findEdges.
  std::vector<char> onSeam_, fixed_;
  std::map<std::pair<uint32_t, uint32_t>, char> seams_;
  std::vector<uint32_t> stamp_;
  std::vector<char> changed_;
  std::priority_queue<Collapse> queue_;
};

Simplifier::Simplifier(const Mesh& m)
    : mesh_(m),
      at_(m.positions),
      around_(m.positions.size()),
      quadrics_(m.positions.size()),
      onSeam_(m.positions.size(), 0),
      fixed_(m.positions.size(), 0),
      stamp_(m.positions.size(), 0),
      changed_(m.faceCount(), 0) {
  // Around the middle the sums lose no digits.
  const Box3 box = m.bounds();
  for (Vec3& p : at_) p = p - (box.min + box.max) * 0.5;
  FaceTriangulator triangulator;
  std::vector<std::array<uint32_t, 3>> corners;
  for (uint32_t f = 0; f < m.faceCount(); ++f) {
    corners.clear();
    triangulator.add(m, f, corners);
    for (const auto& c : corners) {
      work();
      const Tri t{{m.corners[c[0]], m.corners[c[1]], m.corners[c[2]]}, c, f, true};
      const Vec3 n =
          cross(at_[t.vertex[1]] - at_[t.vertex[0]], at_[t.vertex[2]] - at_[t.vertex[0]]);
      const double area = length(n) / 2;
      for (const uint32_t v : t.vertex) {
        around_[v].push_back(static_cast<uint32_t>(tris_.size()));
        if (area > 0) quadrics_[v].addPlane(normalized(n), at_[v], area);
      }
      tris_.push_back(t);
    }
  }
  findEdges();
}

bool Simplifier::sameAttributes(uint32_t a, uint32_t b) const {
  return std::all_of(mesh_.uvs.begin(), mesh_.uvs.end(),
                     [&](const auto& set) { return set.empty() || set[a] == set[b]; });
}

/// At which ends of an edge (1: from, 2: to) attributes jump from one triangle to the other.
uint32_t Simplifier::jumps(const Tri& a, uint32_t ka, const Tri& b, uint32_t from,
                           uint32_t to) const {
  uint32_t out = 0;
  for (uint32_t k = 0; k < 3; ++k) {
    if (b.vertex[k] == from && !sameAttributes(b.corner[k], a.corner[ka])) out |= 1;
    if (b.vertex[k] == to && !sameAttributes(b.corner[k], a.corner[(ka + 1) % 3])) out |= 2;
  }
  return out;
}

/// Vertices like the pole of a sphere, with attributes of their own in each triangle.
std::vector<char> Simplifier::findPoles(const EdgeUses& uses) const {
  std::vector<char> poles(at_.size(), 1);
  for (const auto& [ends, at] : uses) {
    const auto [t, k] = at[0];
    const uint32_t from = tris_[t].vertex[k], to = tris_[t].vertex[(k + 1) % 3];
    const uint32_t j = at.size() == 2 ? jumps(tris_[t], k, tris_[at[1].first], from, to) : 0;
    if ((j & 1) == 0) poles[from] = 0;
    if ((j & 2) == 0) poles[to] = 0;
  }
  return poles;
}

/// An edge of one triangle is a border; one of three and more fixes its ends.
void Simplifier::findEdges() {
  EdgeUses uses;
  for (uint32_t t = 0; t < tris_.size(); ++t) {
    for (uint32_t k = 0; k < 3; ++k) {
      work(4);
      uses[std::minmax(tris_[t].vertex[k], tris_[t].vertex[(k + 1) % 3])].push_back({t, k});
    }
  }
  const std::vector<char> poles = findPoles(uses);
  for (const auto& [ends, at] : uses) {
    const auto [t, k] = at[0];
    const uint32_t from = tris_[t].vertex[k], to = tris_[t].vertex[(k + 1) % 3];
    if (at.size() > 2) fixed_[ends.first] = fixed_[ends.second] = 1;
    if (at.size() == 2) {
      const Tri& other = tris_[at[1].first];
      const uint32_t j = jumps(tris_[t], k, other, from, to);
      const bool spoke = (j == 1 && poles[from]) || (j == 2 && poles[to]);
      const bool sameMaterial =
          mesh_.faces[tris_[t].face].materialSlot == mesh_.faces[other.face].materialSlot;
      if (sameMaterial && (j == 0 || spoke)) continue;
    }
    seams_[ends] = 1;
    for (const auto& [tri, corner] : at) markEdge(tri, corner);
  }
  std::vector<uint32_t> count(at_.size(), 0);
  for (const auto& [ends, one] : seams_) {
    ++count[ends.first];
    ++count[ends.second];
  }
  for (size_t v = 0; v < count.size(); ++v) {
    onSeam_[v] = count[v] > 0 ? 1 : 0;
    // Where seams end or meet.
    if (count[v] != 0 && count[v] != 2) fixed_[v] = 1;
  }
  for (const auto& [ends, at] : uses) {
    push(ends.first, ends.second);
    push(ends.second, ends.first);
  }
}

void Simplifier::markEdge(uint32_t tri, uint32_t k) {
  const Tri& t = tris_[tri];
  const Vec3 a = at_[t.vertex[k]], b = at_[t.vertex[(k + 1) % 3]], c = at_[t.vertex[(k + 2) % 3]];
  const Vec3 n = normalized(cross(b - a, cross(b - a, c - a)));
  const double weight = kBorderWeight * dot(b - a, b - a);
  quadrics_[t.vertex[k]].addPlane(n, a, weight);
  quadrics_[t.vertex[(k + 1) % 3]].addPlane(n, a, weight);
}

void Simplifier::push(uint32_t from, uint32_t to) {
  if (fixed_[from]) return;
  if (onSeam_[from] && seams_.count(std::minmax(from, to)) == 0) return;
  Quadric q = quadrics_[from];
  q.add(quadrics_[to]);
  const Vec3 way = at_[to] - at_[from];
  queue_.push({q.at(at_[to]) + kLengthWeight * dot(way, way), from, to, stamp_[from], stamp_[to]});
}

std::vector<uint32_t> Simplifier::neighbours(uint32_t v) const {
  std::vector<uint32_t> out;
  for (const uint32_t t : around_[v]) {
    work();
    for (const uint32_t u : tris_[t].vertex) {
      if (u != v) out.push_back(u);
    }
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

void Simplifier::pushAround(uint32_t v) {
  for (const uint32_t u : neighbours(v)) {
    push(u, v);
    push(v, u);
  }
}

uint32_t Simplifier::cornerOf(const Tri& t, uint32_t vertex) const {
  for (size_t k = 0; k < 3; ++k) {
    if (t.vertex[k] == vertex) return t.corner[k];
  }
  return MeshBuilder::kNoPosition;
}

const Move* Simplifier::moveOf(const Tri& t, uint32_t vertex,
                               const std::vector<Move>& moves) const {
  const uint32_t corner = cornerOf(t, vertex);
  for (const Move& m : moves) {
    if (m.slot == mesh_.faces[t.face].materialSlot && sameAttributes(m.from, corner)) return &m;
  }
  return nullptr;
}

/// Corners at `from` become those at `to` on the same side of all seams. False where one has none,
/// or two that differ.
bool Simplifier::findMoves(const Collapse& c, std::vector<Move>& moves) const {
  for (const uint32_t t : around_[c.from]) {
    const uint32_t to = cornerOf(tris_[t], c.to);
    if (to == MeshBuilder::kNoPosition) continue;
    const Move* other = moveOf(tris_[t], c.from, moves);
    if (other && !sameAttributes(other->to, to)) return false;
    moves.push_back({cornerOf(tris_[t], c.from), to, mesh_.faces[tris_[t].face].materialSlot});
  }
  return !moves.empty() &&
         std::all_of(around_[c.from].begin(), around_[c.from].end(),
                     [&](uint32_t t) { return moveOf(tris_[t], c.from, moves) != nullptr; });
}

/// The ends of an edge share no neighbours but those across from it in its triangles.
bool Simplifier::keepsTopology(const Collapse& c) const {
  const std::vector<uint32_t> a = neighbours(c.from), b = neighbours(c.to);
  std::vector<uint32_t> both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  std::vector<uint32_t> across;
  for (const uint32_t t : around_[c.from]) {
    if (cornerOf(tris_[t], c.to) == MeshBuilder::kNoPosition) continue;
    for (const uint32_t v : tris_[t].vertex) {
      if (v != c.from && v != c.to) across.push_back(v);
    }
  }
  // An edge between two borders joins them to a point, and a tetrahedron would become flat.
  const bool isSeam = seams_.count(std::minmax(c.from, c.to)) != 0;
  if (onSeam_[c.from] && onSeam_[c.to] && !isSeam) return false;
  // Something has to be left.
  if (around_[c.from].size() + around_[c.to].size() <= 2 * across.size()) return false;
  return both.size() == across.size() && (a.size() > 3 || onSeam_[c.from]) &&
         (b.size() > 3 || onSeam_[c.to]);
}

bool Simplifier::keepsNormals(const Collapse& c) const {
  for (const uint32_t i : around_[c.from]) {
    const Tri& t = tris_[i];
    if (cornerOf(t, c.to) != MeshBuilder::kNoPosition) continue;
    std::array<Vec3, 3> before, after;
    for (size_t k = 0; k < 3; ++k) {
      before[k] = at_[t.vertex[k]];
      after[k] = t.vertex[k] == c.from ? at_[c.to] : before[k];
    }
    const Vec3 n = cross(before[1] - before[0], before[2] - before[0]);
    const Vec3 m = cross(after[1] - after[0], after[2] - after[0]);
    if (!(dot(n, m) > kLeastCosine * length(n) * length(m))) return false;
  }
  return true;
}

bool Simplifier::collapse(const Collapse& c) {
  std::vector<Move> moves;
  if (!findMoves(c, moves) || !keepsTopology(c) || !keepsNormals(c)) return false;
  // A border goes on from the removed vertex to its other neighbour.
  for (const uint32_t u : onSeam_[c.from] ? neighbours(c.from) : std::vector<uint32_t>{}) {
    if (seams_.erase(std::minmax(c.from, u)) != 0 && u != c.to) seams_[std::minmax(c.to, u)] = 1;
  }
  for (const uint32_t i : around_[c.from]) {
    Tri& t = tris_[i];
    changed_[t.face] = 1;
    if (cornerOf(t, c.to) != MeshBuilder::kNoPosition) {
      t.alive = false;
      for (const uint32_t v : t.vertex) {
        if (v != c.from) std::erase(around_[v], i);
      }
      continue;
    }
    const Move move = *moveOf(t, c.from, moves);
    for (size_t k = 0; k < 3; ++k) {
      if (t.vertex[k] != c.from) continue;
      t.vertex[k] = c.to;
      t.corner[k] = move.to;
    }
    around_[c.to].push_back(i);
  }
  around_[c.from].clear();
  quadrics_[c.to].add(quadrics_[c.from]);
  ++stamp_[c.from];
  ++stamp_[c.to];
  pushAround(c.to);
  return true;
}

size_t Simplifier::used() const {
  return static_cast<size_t>(std::count_if(around_.begin(), around_.end(),
                                           [](const auto& tris) { return !tris.empty(); }));
}

Mesh Simplifier::run(double share) {
  const size_t before = used();
  const auto goal = static_cast<size_t>(std::ceil(static_cast<double>(before) * (1 - share)));
  for (size_t left = before; left > goal && !queue_.empty();) {
    work(16);
    const Collapse c = queue_.top();
    queue_.pop();
    if (stamp_[c.from] != c.fromStamp || stamp_[c.to] != c.toStamp) continue;
    if (around_[c.from].empty() || around_[c.to].empty()) continue;
    if (collapse(c)) --left;
  }
  return result();
}

void Simplifier::addTriangle(const Tri& t, MeshBuilder& b, std::vector<uint32_t>& map) const {
  const MeshFace& face = mesh_.faces[t.face];
  b.beginFace(face.materialSlot, 0, face.smooth);
  b.beginLoop();
  for (size_t k = 0; k < 3; ++k) {
    uint32_t& position = map[t.vertex[k]];
    if (position == MeshBuilder::kNoPosition) {
      position = b.addPosition(mesh_.positions[t.vertex[k]]);
    }
    const uint32_t corner = b.addCorner(position);
    for (int set = 0; set < mesh_.setCount(); ++set) {
      if (mesh_.hasUv(set)) b.setUv(corner, set, mesh_.set(set)[t.corner[k]]);
    }
  }
}

Mesh Simplifier::result() const {
  MeshBuilder b;
  std::vector<uint32_t> map(mesh_.positions.size(), MeshBuilder::kNoPosition);
  size_t next = 0;
  for (uint32_t f = 0; f < mesh_.faceCount(); ++f) {
    const size_t first = next;
    while (next < tris_.size() && tris_[next].face == f) ++next;
    if (!changed_[f] && next > first) {
      b.copyFace(mesh_, f, map);
      continue;
    }
    for (size_t t = first; t < next; ++t) {
      if (tris_[t].alive) addTriangle(tris_[t], b, map);
    }
  }
  Mesh out = b.take();
  out.normals.clear();
  out.edgeTags.clear();
  out.vertexTags.clear();
  for (MeshFace& f : out.faces) f.tags = 0;
  return out;
}

}  // namespace

Mesh simplified(const Mesh& m, double share) { return Simplifier(m).run(share); }

}  // namespace gable
