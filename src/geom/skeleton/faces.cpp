// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Steps: nodes that a short arc joins become one vertex; the arcs of each plane's faces are linked
// to loops; spikes without width, which the wavefront of nearly equal planes leaves, are zipped up;
// and loops that several collinear edges share are cut at right angles where their wavefronts met.
#include "geom/skeleton/faces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/disjoint_sets.h"
#include "base/work.h"

namespace gable::skeleton {

namespace {

// Arcs shorter than this part of the extent are one point: well over the rounding of the
// coordinates, and under anything one builds.
constexpr double kMergeDistance = 1e-9;

using Loop = std::vector<uint32_t>;

class Assembly {
 public:
  Assembly(const FaceInput& in, const Trace& trace, Skeleton& out)
      : in_(in), trace_(trace), out_(out), groups_(in.edges.size()), points_(trace.nodes.size()) {}

  bool run();

 private:
  struct Half {
    uint32_t from = 0, to = 0;
  };
  struct FaceView {
    SkeletonVertex origin;
    Vec2 along, up;
    double rise = 0;
    Vec2 operator()(const SkeletonVertex& v) const {
      const Vec2 d = v.xy - origin.xy;
      return {dot(d, along), dot(d, up) + (v.height - origin.height) * rise};
    }
  };
  struct Above {
    size_t index = 0;
    bool isVertex = false;
    double share = 0;
    double distance = std::numeric_limits<double>::infinity();
  };

  Vec2 at(uint32_t v) const { return vertices_[v].xy; }
  void placeVertices();
  void contractShortArcs();
  bool linkGroup(uint32_t group, std::vector<Half>& list);
  bool protectVanished();
  bool linkLoops();
  bool cutLoops();
  bool cutAt(const Trace::Merge& merge);
  void insertAcross(uint32_t a, uint32_t b, uint32_t fresh);
  void replaceVertex(uint32_t from, uint32_t to, Loop& also);
  FaceView viewOf(uint32_t edge, uint32_t origin) const;
  size_t cornerFacingUp(const Loop& loop, uint32_t v, const FaceView& view) const;
  Above findAbove(const Loop& loop, size_t s, const FaceView& view, double slack) const;
  void replaceLoop(uint32_t which, Loop one, Loop two, uint32_t group);
  void simplify(Loop& loop) const;
  bool encloses(const Loop& loop, Vec2 p) const;
  uint32_t numberOf(uint32_t v);
  void emit();
  bool checkAreas() const;

  const FaceInput& in_;
  const Trace& trace_;
  Skeleton& out_;
  DisjointSets groups_;
  DisjointSets points_;
  std::vector<SkeletonVertex> vertices_;
  uint32_t inputCount_ = 0;
  double tolerance_ = 0;
  std::vector<Loop> loops_;
  std::vector<uint32_t> number_;
  std::vector<char> protected_;
  std::vector<double> slack_;
  /// Per input edge the loop that it is on, and per group all of its loops.
  std::vector<uint32_t> loopOf_;
  std::vector<std::vector<uint32_t>> loopsOfGroup_, holesOfGroup_;
};

void Assembly::placeVertices() {
  double extent = 0, far = 0;
  for (const Ring& r : in_.inputPoints) {
    for (const Vec2 p : r) {
      vertices_.push_back({p, 0});
      extent = std::max({extent, std::abs(p.x - in_.center.x), std::abs(p.y - in_.center.y)});
      far = std::max({far, std::abs(p.x), std::abs(p.y)});
    }
  }
  inputCount_ = static_cast<uint32_t>(vertices_.size());
  tolerance_ = 2 * extent * kMergeDistance + far * 0x1p-45;
  for (size_t i = inputCount_; i < trace_.nodes.size(); ++i) {
    const Planes::Point& p = trace_.nodes[i].at;
    vertices_.push_back(
        {{in_.center.x + p.x * in_.step, in_.center.y + p.y * in_.step}, p.time * in_.timeStep});
  }
}

void Assembly::contractShortArcs() {
  points_ = DisjointSets(trace_.nodes.size());
  for (const Trace::Arc& a : trace_.arcs) {
    const uint32_t p = points_.find(a.from), q = points_.find(a.to);
    if (p == q || (p < inputCount_ && q < inputCount_)) continue;
    if (protected_[a.left] || protected_[a.right]) continue;
    const SkeletonVertex &u = vertices_[a.from], &v = vertices_[a.to];
    if (length(u.xy - v.xy) > tolerance_) continue;
    if (std::abs(u.height - v.height) * in_.step > tolerance_ * in_.timeStep) continue;
    points_.join(p, q);
  }
}

/// Drops repeated vertices and out-and-back pairs.
void Assembly::simplify(Loop& loop) const {
  bool changed = true;
  while (changed && loop.size() > 2) {
    work(loop.size());
    changed = false;
    Loop kept;
    for (const uint32_t v : loop) {
      if (!kept.empty() && kept.back() == v) continue;
      if (kept.size() >= 2 && kept[kept.size() - 2] == v) {
        kept.pop_back();
        changed = true;
        continue;
      }
      kept.push_back(v);
    }
    while (kept.size() > 1 && kept.front() == kept.back()) kept.pop_back();
    if (kept.size() > 2 && kept[1] == kept.back()) {
      kept.erase(kept.begin());
      changed = true;
    }
    loop = std::move(kept);
  }
}

/// Links the halves of a group's faces to one outer loop and, where a fast edge has run round an
/// island of slower ones, loops of holes.
bool Assembly::linkGroup(uint32_t group, std::vector<Half>& list) {
  const uint32_t first = list.front().from;
  std::sort(list.begin(), list.end(), [](const Half& a, const Half& b) {
    return a.from != b.from ? a.from < b.from : a.to < b.to;
  });
  std::vector<char> used(list.size(), 0);
  size_t usedCount = 0, seek = 0;
  uint32_t begin = first;
  while (usedCount < list.size()) {
    work();
    Loop loop;
    uint32_t v = begin;
    do {
      auto i = static_cast<size_t>(
          std::lower_bound(list.begin(), list.end(), v,
                           [](const Half& h, uint32_t from) { return h.from < from; }) -
          list.begin());
      while (i < list.size() && list[i].from == v && used[i]) ++i;
      if (i == list.size() || list[i].from != v) return false;
      used[i] = 1;
      ++usedCount;
      loop.push_back(points_.find(v));
      v = list[i].to;
    } while (v != begin);
    simplify(loop);
    const auto id = static_cast<uint32_t>(loops_.size());
    if (begin == first && loopOf_[group] == kNone) {
      loopOf_[group] = id;
      loopsOfGroup_[group].push_back(id);
    } else if (loop.size() > 2) {
      holesOfGroup_[group].push_back(id);
    } else {
      loop.clear();
    }
    if (!loop.empty()) loops_.push_back(std::move(loop));
    while (seek < list.size() && used[seek]) ++seek;
    if (seek < list.size()) begin = list[seek].from;
  }
  return true;
}

/// Marks the faces that contracting has emptied; true if there are new ones.
bool Assembly::protectVanished() {
  bool found = false;
  for (uint32_t e = 0; e < in_.edges.size(); ++e) {
    if (loops_[loopOf_[e]].size() >= 3 || protected_[e]) continue;
    protected_[e] = 1;
    found = true;
  }
  return found;
}

bool Assembly::linkLoops() {
  loops_.clear();
  std::vector<std::vector<Half>> halves(in_.edges.size());
  for (uint32_t e = 0; e < in_.edges.size(); ++e) {
    if (in_.edges[e].from == in_.edges[e].to) continue;
    halves[groups_.find(e)].push_back({in_.edges[e].from, in_.edges[e].to});
  }
  for (const Trace::Arc& a : trace_.arcs) {
    halves[groups_.find(a.left)].push_back({a.from, a.to});
    halves[groups_.find(a.right)].push_back({a.to, a.from});
  }
  for (const Trace::Top& t : trace_.tops) halves[groups_.find(t.face)].push_back({t.to, t.from});

  loopOf_.assign(in_.edges.size(), kNone);
  loopsOfGroup_.assign(in_.edges.size(), {});
  holesOfGroup_.assign(in_.edges.size(), {});
  for (uint32_t g = 0; g < halves.size(); ++g) {
    auto& list = halves[g];
    if (list.empty()) continue;
    if (!linkGroup(g, list)) return false;
  }
  for (uint32_t e = 0; e < loopOf_.size(); ++e) loopOf_[e] = loopOf_[groups_.find(e)];
  return true;
}

/// A face seen square on: x along its edge, y up the face. Upright faces go by their height.
Assembly::FaceView Assembly::viewOf(uint32_t edge, uint32_t origin) const {
  const FaceInput::Edge& e = in_.edges[edge];
  const Vec2 along = normalized(at(e.to) - at(e.from));
  const double rise = e.upright ? in_.step / in_.timeStep : 0;
  return {vertices_[origin], along, e.upright ? Vec2{} : perpendicular(along), rise};
}

/// The place of v in the loop where "up" points inside, or the loop's size.
size_t Assembly::cornerFacingUp(const Loop& loop, uint32_t v, const FaceView& view) const {
  const size_t n = loop.size();
  const Vec2 up{0, 1};
  for (size_t i = 0; i < n; ++i) {
    work();
    if (loop[i] != v) continue;
    const Vec2 out = view(vertices_[loop[(i + 1) % n]]),
               in = view(vertices_[loop[(i + n - 1) % n]]);
    const bool leftOfOut = cross(out, up) > 0, rightOfIn = cross(up, in) > 0;
    const bool convex = cross(out, in) > 0;
    if (convex ? leftOfOut && rightOfIn : leftOfOut || rightOfIn) return i;
  }
  return n;
}

/// The nearest place of the loop straight above its corner s: a vertex, or a point of an edge.
Assembly::Above Assembly::findAbove(const Loop& loop, size_t s, const FaceView& view,
                                    double slack) const {
  Above above;
  const size_t n = loop.size();
  for (size_t i = 0; i < n; ++i) {
    work();
    const Vec2 p = view(vertices_[loop[i]]), q = view(vertices_[loop[(i + 1) % n]]);
    if (i != s && std::abs(p.x) <= slack) {
      const bool beside = i == (s + 1) % n || (i + 1) % n == s;
      if (p.y >= (beside ? slack : -slack) && p.y < above.distance) above = {i, true, 0, p.y};
      continue;
    }
    const bool reaches = (p.x < 0) != (q.x < 0) && std::abs(q.x) > slack;
    if (i == s || (i + 1) % n == s || !reaches) continue;
    const double share = p.x / (p.x - q.x);
    const double y = p.y + share * (q.y - p.y);
    if (y >= -slack && y < above.distance) above = {i, false, share, y};
  }
  return above;
}

/// Puts a vertex into the edge a b of the face that runs it as b a.
void Assembly::insertAcross(uint32_t a, uint32_t b, uint32_t fresh) {
  for (Loop& l : loops_) {
    for (size_t i = 0; i < l.size(); ++i) {
      work();
      if (l[i] != b || l[(i + 1) % l.size()] != a) continue;
      l.insert(l.begin() + static_cast<std::ptrdiff_t>(i + 1), fresh);
      return;
    }
  }
}

/// Makes two vertices in one place one.
void Assembly::replaceVertex(uint32_t from, uint32_t to, Loop& also) {
  const auto replaceIn = [&](Loop& l) {
    std::replace(l.begin(), l.end(), from, to);
    simplify(l);
  };
  for (Loop& l : loops_) replaceIn(l);
  replaceIn(also);
  points_.join(from, to);
}

/// Cuts the loop of a merge from its node straight up to the loop's other side.
bool Assembly::cutAt(const Trace::Merge& merge) {
  const uint32_t start = points_.find(merge.node);
  const uint32_t group = groups_.find(merge.left);
  const double slack = slack_[group];
  const FaceView view = viewOf(merge.left, start);
  uint32_t which = kNone;
  size_t s = 0;
  for (const uint32_t piece : loopsOfGroup_[group]) {
    work();
    s = cornerFacingUp(loops_[piece], start, view);
    if (s == loops_[piece].size()) continue;
    which = piece;
    break;
  }
  if (which == kNone) return false;
  Loop loop = loops_[which];
  const Above above = findAbove(loop, s, view, slack);
  if (std::isinf(above.distance)) return false;

  const bool parts = above.distance > slack;
  size_t e = above.index;
  if (!above.isVertex) {
    const uint32_t a = loop[e], b = loop[(e + 1) % loop.size()];
    uint32_t fresh = start;
    if (parts) {
      fresh = static_cast<uint32_t>(vertices_.size());
      points_.addOne();
      const double rise = vertices_[b].height - vertices_[a].height;
      vertices_.push_back(
          {at(a) + (at(b) - at(a)) * above.share, vertices_[a].height + above.share * rise});
    }
    ++e;
    loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(e), fresh);
    if (s >= e) ++s;
    insertAcross(a, b, fresh);
  }
  Loop one, two;
  for (size_t i = s; i != e; i = (i + 1) % loop.size()) one.push_back(loop[i]);
  for (size_t i = e; i != s; i = (i + 1) % loop.size()) two.push_back(loop[i]);
  // A cut without length parts the loop at a point; otherwise both parts have the cut as an edge.
  if (parts) {
    one.push_back(loop[e]);
    two.push_back(start);
  } else if (loop[e] != start) {
    const uint32_t keep = std::min(loop[e], start), gone = std::max(loop[e], start);
    if (gone < inputCount_) return false;
    replaceVertex(gone, keep, one);
    replaceVertex(gone, keep, two);
  }
  replaceLoop(which, std::move(one), std::move(two), group);
  return true;
}

/// Two loops for one; each edge goes with the loop that it is on.
void Assembly::replaceLoop(uint32_t which, Loop one, Loop two, uint32_t group) {
  loops_[which] = std::move(one);
  const auto added = static_cast<uint32_t>(loops_.size());
  loops_.push_back(std::move(two));
  loopsOfGroup_[group].push_back(added);
  const Loop& l = loops_[added];
  for (uint32_t k = 0; k < loopOf_.size(); ++k) {
    if (loopOf_[k] != which) continue;
    for (size_t i = 0; i < l.size(); ++i) {
      work();
      if (l[i] == in_.edges[k].from && l[(i + 1) % l.size()] == in_.edges[k].to) loopOf_[k] = added;
    }
  }
}

bool Assembly::cutLoops() {
  // What is straight above a point is told finer than the shortest of the edges in line.
  slack_.assign(in_.edges.size(), tolerance_);
  for (uint32_t e = 0; e < in_.edges.size(); ++e) {
    double& slack = slack_[groups_.find(e)];
    const double own = length(at(in_.edges[e].to) - at(in_.edges[e].from));
    if (own > 0) slack = std::min(slack, own / 8);
  }
  DisjointSets joined(in_.edges.size());
  for (const Trace::Merge& m : trace_.merges) {
    // An edge that met itself again behind an island stays whole.
    if (joined.find(m.left) == joined.find(m.right)) continue;
    joined.join(m.left, m.right);
    if (!cutAt(m)) return false;
  }
  return true;
}

bool Assembly::checkAreas() const {
  for (const SkeletonVertex& v : vertices_) {
    if (!isFinite({v.xy.x, v.xy.y, v.height})) return false;
  }
  double total = 0, polygon = 0;
  const auto areaOf = [&](const auto& points, const auto& at) {
    double sum = 0;
    const Vec2 origin = at(points[0]);
    for (size_t i = 1; i + 1 < points.size(); ++i) {
      sum += cross(at(points[i]) - origin, at(points[i + 1]) - origin);
    }
    return sum / 2;
  };
  for (const Ring& r : in_.inputPoints) polygon += areaOf(r, [](Vec2 p) { return p; });
  for (const Loop& l : loops_) {
    if (l.size() > 2) total += areaOf(l, [this](uint32_t v) { return at(v); });
  }
  const double cut = in_.top > 0 ? polygon : 0;
  return total <= polygon * (1 + 1e-9) && total + cut >= polygon * (1 - 1e-9);
}

uint32_t Assembly::numberOf(uint32_t v) {
  if (number_[v] == kNone) {
    number_[v] = static_cast<uint32_t>(out_.vertices.size());
    out_.vertices.push_back(vertices_[v]);
  }
  return number_[v];
}

bool Assembly::encloses(const Loop& loop, Vec2 p) const {
  bool inside = false;
  for (size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
    const Vec2 a = at(loop[i]), b = at(loop[j]);
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) {
      inside = !inside;
    }
  }
  return inside;
}

/// Renumbers the vertices that are still in use and writes the faces.
void Assembly::emit() {
  number_.assign(vertices_.size(), kNone);
  out_.vertices.assign(vertices_.begin(), vertices_.begin() + inputCount_);
  for (uint32_t i = 0; i < inputCount_; ++i) number_[i] = i;
  out_.inputCount = inputCount_;
  for (uint32_t ring = 0; ring < in_.inputPoints.size(); ++ring) {
    for (uint32_t edge = 0; edge < in_.inputPoints[ring].size(); ++edge) {
      out_.faces.push_back({ring, edge, false, {}, {}});
    }
  }
  for (const FaceInput::Step& s : in_.steps) out_.faces.push_back({s.ring, s.edge, true, {}, {}});
  for (uint32_t e = 0; e < in_.edges.size(); ++e) {
    Loop& loop = loops_[loopOf_[e]];
    const auto begin = std::find(loop.begin(), loop.end(), in_.edges[e].from);
    if (begin != loop.end()) std::rotate(loop.begin(), begin, loop.end());
    SkeletonFace& face = out_.faces[in_.edges[e].face];
    for (const uint32_t v : loop) face.loop.push_back(numberOf(v));
    const uint32_t group = groups_.find(e);
    for (const uint32_t h : holesOfGroup_[group]) {
      if (loopsOfGroup_[group].size() > 1 && !encloses(loop, at(loops_[h].front()))) continue;
      auto& hole = face.holes.emplace_back();
      for (const uint32_t v : loops_[h]) hole.push_back(numberOf(v));
    }
  }
}

bool Assembly::run() {
  for (const Trace::Merge& m : trace_.merges) groups_.join(m.left, m.right);
  protected_.assign(in_.edges.size(), 0);
  placeVertices();
  // Where contracting leaves nothing of a face, that face's arcs are kept as they are.
  bool vanished = true;
  for (int round = 0; vanished && round < 8; ++round) {
    contractShortArcs();
    if (!linkLoops()) return false;
    vanished = protectVanished();
  }
  if (!cutLoops() || !checkAreas()) return false;
  emit();
  return true;
}

}  // namespace

bool assembleFaces(const FaceInput& in, const Trace& trace, Skeleton& out) {
  return Assembly(in, trace, out).run();
}

}  // namespace gable::skeleton
