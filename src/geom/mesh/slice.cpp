// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Each face is cut on its own. A cut divides its loops into runs: chains of edges on one side that
// begin and end on the cut. On that side, the end of a run continues along the cut to the start of
// the next run; since the face lies to the left of its edges, ends and starts alternate along the
// cut, and sorting them pairs them (the step that Sutherland and Hodgman's clipping leaves out for
// concave polygons). A vertex on the cut ends a run and starts another, so touching, collinear and
// pinched outlines need no special case: where several ends and starts meet in a point, the
// alternation says which comes first.
//
// Caps: after the cut, half-edges in the plane without a partner bound an opening; turned round and
// chained they are the outlines of the faces that close it.
#include "geom/mesh/slice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "geom/mesh/loops.h"

namespace gable {

namespace {

constexpr uint32_t kNone = 0xffffffff;

// A face on its way through the cuts: loops of corners of the slicer.
struct Part {
  LoopFace loops;
  uint32_t source = 0;
};

class Slicer {
 public:
  Slicer(const Mesh& m, std::vector<double> values, std::span<const double> cuts)
      : mesh_(m), value_(std::move(values)), cuts_(cuts), parts_(cuts.size() + 1) {
    double extent = 0;
    for (const double v : value_) extent = std::max(extent, std::fabs(v));
    tolerance_ = 1e-9 * (1 + extent);
    const Vec3 size = m.bounds().size();
    reach_ = std::max({size.x, size.y, size.z});
    leastArea_ = 1e-10 * reach_ * std::min(reach_, 1.0);
    sourceCorners_ = static_cast<uint32_t>(m.corners.size());
  }

  // For planes: where a cut is, a face's own gradient of the value is this direction in its plane.
  void setPlane(const Vec3& normal) {
    planar_ = true;
    normal_ = normal;
    for (size_t a = 0; a < 3; ++a) {
      if (std::fabs(normal[a]) == 1) axis_ = a;
    }
  }

  void run();
  std::vector<Mesh> assemble(bool cap);

 private:
  // What becomes of a loop on one side of a cut.
  struct Run {
    std::vector<uint32_t> corners;
    // Where the loop goes on along the cut, if it does: the corners after the end up to the start
    // of the loop's next run.
    std::vector<uint32_t> along;
    uint32_t nextInLoop = kNone;
    bool used = false;
  };
  struct Event {
    double at = 0;
    uint32_t run = 0;
    bool isStart = false;
  };

  const Vec3& point(uint32_t corner) const { return mesh_.positions[mesh_.corners[corner]]; }
  int side(uint32_t corner, double cut) const {
    const double d = value_[corner] - cut;
    return d < -tolerance_ ? -1 : d > tolerance_ ? 1 : 0;
  }

  void cutFace(uint32_t face);
  void cutEdge(uint32_t face);
  void place(Part part, size_t slab);
  size_t slabOf(const Part& part, const Vec3& normal) const;
  std::pair<double, double> rangeOf(const LoopFace& loops) const;
  Vec3 gradientOf(const LoopFace& loops, const Vec3& normal) const;
  std::vector<Part> partsOnSide(const Part& part, size_t cut, int wanted, const Vec3& normal,
                                const Vec3& gradient);
  void runsOf(const IndexLoop& loop, size_t cut, int wanted, std::vector<Run>& out);
  std::vector<uint32_t> matched(const std::vector<Run>& runs, const Vec3& direction) const;
  uint32_t crossing(uint32_t from, uint32_t to, size_t cut, uint32_t edgeTags);
  uint32_t crossingPosition(uint32_t from, uint32_t to, size_t cut);
  uint32_t copyCorner(uint32_t corner, uint32_t edgeTags);
  void snap(uint32_t corner, size_t cut);
  void addCap(Mesh& slab, double cut, double direction) const;

  // The mesh's own corners, then those that cuts make. Loops and faces stay those of the input.
  Mesh mesh_;
  std::vector<double> value_;
  std::span<const double> cuts_;
  std::vector<std::vector<Part>> parts_;
  std::map<std::tuple<uint32_t, uint32_t, size_t>, uint32_t> crossings_;
  double tolerance_ = 0, reach_ = 0, leastArea_ = 0;
  uint32_t sourceCorners_ = 0;
  bool planar_ = false;
  Vec3 normal_;
  size_t axis_ = 3;
};

std::pair<double, double> Slicer::rangeOf(const LoopFace& loops) const {
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
  for (const IndexLoop& loop : loops) {
    for (const uint32_t c : loop) {
      lo = std::min(lo, value_[c]);
      hi = std::max(hi, value_[c]);
    }
  }
  return {lo, hi};
}

// The part that a face belongs to which no cut passes through.
size_t Slicer::slabOf(const Part& part, const Vec3& normal) const {
  const auto [lo, hi] = rangeOf(part.loops);
  const auto first = std::lower_bound(cuts_.begin(), cuts_.end(), hi - tolerance_);
  const auto slab = static_cast<size_t>(first - cuts_.begin());
  const bool inCut = slab < cuts_.size() && lo >= cuts_[slab] - tolerance_;
  return inCut && planar_ && dot(normal, normal_) < 0 ? slab + 1 : slab;
}

void Slicer::place(Part part, size_t slab) { parts_[slab].push_back(std::move(part)); }

// The direction in which the value grows, in the face's plane: the plane normal's share for planes,
// a least-squares fit over the corners otherwise.
Vec3 Slicer::gradientOf(const LoopFace& loops, const Vec3& normal) const {
  if (planar_) return normal_ - normal * dot(normal, normal_);
  const Frame f = frameFromZ({}, normal, point(loops[0][1]) - point(loops[0][0]));
  Vec2 mean;
  double meanValue = 0, n = 0;
  const auto each = [&](auto&& visit) {
    for (const IndexLoop& loop : loops) {
      for (const uint32_t c : loop) {
        visit(Vec2{dot(point(c), f.x), dot(point(c), f.y)}, value_[c]);
      }
    }
  };
  each([&](Vec2 p, double v) {
    mean = mean + p;
    meanValue += v;
    ++n;
  });
  mean = mean * (1 / n);
  meanValue /= n;
  double xx = 0, xy = 0, yy = 0, xv = 0, yv = 0;
  each([&](Vec2 p, double v) {
    const Vec2 d = p - mean;
    xx += d.x * d.x;
    xy += d.x * d.y;
    yy += d.y * d.y;
    xv += d.x * (v - meanValue);
    yv += d.y * (v - meanValue);
  });
  const double det = xx * yy - xy * xy;
  if (!(det > 0)) return f.x;
  return f.x * ((xv * yy - yv * xy) / det) + f.y * ((yv * xx - xv * xy) / det);
}

uint32_t Slicer::copyCorner(uint32_t corner, uint32_t edgeTags) {
  const auto made = static_cast<uint32_t>(mesh_.corners.size());
  mesh_.corners.push_back(mesh_.corners[corner]);
  value_.push_back(value_[corner]);
  for (auto& set : mesh_.uvs) {
    if (!set.empty()) set.push_back(set[corner]);
  }
  if (!mesh_.normals.empty()) mesh_.normals.push_back(mesh_.normals[corner]);
  if (!mesh_.edgeTags.empty()) mesh_.edgeTags.push_back(edgeTags);
  return made;
}

// The shared position of a cut edge. The point is computed from the lower position to the higher,
// so that both faces at the edge find the same.
uint32_t Slicer::crossingPosition(uint32_t from, uint32_t to, size_t cut) {
  uint32_t a = from, b = to;
  if (mesh_.corners[a] > mesh_.corners[b]) std::swap(a, b);
  const double t = (cuts_[cut] - value_[a]) / (value_[b] - value_[a]);
  Vec3 p = point(a) + (point(b) - point(a)) * t;
  if (axis_ < 3) p[axis_] = cuts_[cut] * normal_[axis_];
  const auto [at, isNew] = crossings_.try_emplace({mesh_.corners[a], mesh_.corners[b], cut}, kNone);
  // Along uv lines the two faces of an edge need not agree.
  if (!isNew && length(mesh_.positions[at->second] - p) <= 1e-9 * (1 + reach_)) return at->second;
  at->second = static_cast<uint32_t>(mesh_.positions.size());
  mesh_.positions.push_back(p);
  return at->second;
}

uint32_t Slicer::crossing(uint32_t from, uint32_t to, size_t cut, uint32_t edgeTags) {
  const uint32_t position = crossingPosition(from, to, cut);
  const double t = (cuts_[cut] - value_[from]) / (value_[to] - value_[from]);
  const uint32_t made = copyCorner(from, edgeTags);
  mesh_.corners[made] = position;
  value_[made] = cuts_[cut];
  for (auto& set : mesh_.uvs) {
    if (!set.empty()) set[made] = set[from] + (set[to] - set[from]) * t;
  }
  if (!mesh_.normals.empty()) {
    const Vec3 n = mesh_.normals[from] + (mesh_.normals[to] - mesh_.normals[from]) * t;
    mesh_.normals[made] = normalized(n);
  }
  return made;
}

// A vertex that counts as on the cut is put there, so that parts are exactly as long as asked.
void Slicer::snap(uint32_t corner, size_t cut) {
  if (axis_ < 3) mesh_.positions[mesh_.corners[corner]][axis_] = cuts_[cut] * normal_[axis_];
}

void Slicer::runsOf(const IndexLoop& loop, size_t cut, int wanted, std::vector<Run>& out) {
  // The loop with the points where it crosses the cut. `on` marks those and vertices on it.
  struct Entry {
    uint32_t corner;
    int side;
  };
  std::vector<Entry> ring;
  for (size_t i = 0; i < loop.size(); ++i) {
    const uint32_t c = loop[i], next = loop[(i + 1) % loop.size()];
    const int here = side(c, cuts_[cut]), there = side(next, cuts_[cut]);
    if (here == 0) snap(c, cut);
    ring.push_back({c, here});
    if (here * there < 0) {
      const uint32_t tags = mesh_.edgeTags.empty() ? 0 : mesh_.edgeTags[c];
      ring.push_back({crossing(c, next, cut, tags), 0});
    }
  }
  const size_t n = ring.size();
  const auto at = [&](size_t i) -> const Entry& { return ring[i % n]; };
  const size_t firstRun = out.size();
  for (size_t i = 0; i < n; ++i) {
    if (ring[i].side != 0 || at(i + 1).side != wanted) continue;
    Run run;
    run.corners.push_back(ring[i].corner);
    size_t j = i + 1;
    while (at(j).side == wanted) run.corners.push_back(at(j++).corner);
    run.corners.push_back(at(j).corner);
    // On along the cut, as far as the loop itself runs there.
    while (at(j).side == 0 && at(j + 1).side == 0) run.along.push_back(at(++j).corner);
    if (at(j).side == 0 && at(j + 1).side == wanted && !run.along.empty()) {
      run.along.pop_back();
      run.nextInLoop = kNone - 1;
    } else {
      run.along.clear();
    }
    out.push_back(std::move(run));
  }
  for (size_t r = firstRun; r < out.size(); ++r) {
    if (out[r].nextInLoop == kNone) continue;
    out[r].nextInLoop = static_cast<uint32_t>(r + 1 < out.size() ? r + 1 : firstRun);
  }
}

// For each run the one that follows its end along the cut.
std::vector<uint32_t> Slicer::matched(const std::vector<Run>& runs, const Vec3& direction) const {
  std::vector<Event> events;
  const Vec3 origin = point(runs[0].corners.front());
  for (uint32_t r = 0; r < runs.size(); ++r) {
    const auto& corners = runs[r].corners;
    events.push_back({dot(point(corners.front()) - origin, direction), r, true});
    events.push_back({dot(point(corners.back()) - origin, direction), r, false});
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return a.at < b.at; });
  const double same = 1e-9 * (1 + reach_);
  std::vector<uint32_t> next(runs.size(), kNone);
  std::vector<uint32_t> looseStarts, looseEnds;
  uint32_t open = kNone;
  for (size_t i = 0; i < events.size();) {
    // Events in one point are taken in the order that lets ends and starts alternate.
    size_t end = i + 1;
    while (end < events.size() && events[end].at - events[end - 1].at <= same) ++end;
    std::vector<uint32_t> starts, ends;
    for (; i < end; ++i) (events[i].isStart ? starts : ends).push_back(events[i].run);
    size_t s = 0, e = 0;
    while (s < starts.size() || e < ends.size()) {
      if (open != kNone && s < starts.size()) {
        next[open] = starts[s++];
        open = kNone;
      } else if (open == kNone && e < ends.size()) {
        open = ends[e++];
      } else if (s < starts.size()) {
        looseStarts.push_back(starts[s++]);
      } else {
        looseEnds.push_back(std::exchange(open, ends[e++]));
      }
    }
  }
  if (open != kNone) looseEnds.push_back(open);
  // Only outlines that cross themselves leave any.
  for (size_t k = 0; k < looseEnds.size(); ++k) next[looseEnds[k]] = looseStarts[k];
  return next;
}

std::vector<Part> Slicer::partsOnSide(const Part& part, size_t cut, int wanted, const Vec3& normal,
                                      const Vec3& gradient) {
  std::vector<Run> runs;
  std::vector<IndexLoop> loops;
  for (const IndexLoop& loop : part.loops) {
    bool crosses = false, strict = false;
    for (size_t i = 0; i < loop.size(); ++i) {
      const int here = side(loop[i], cuts_[cut]);
      const int there = side(loop[(i + 1) % loop.size()], cuts_[cut]);
      strict |= here == wanted;
      crosses |= here == -wanted || (here == 0 && there == 0);
    }
    if (!strict) continue;
    if (crosses) {
      runsOf(loop, cut, wanted, runs);
    } else {
      loops.push_back(loop);
    }
  }
  const std::vector<uint32_t> next =
      runs.empty() ? std::vector<uint32_t>{}
                   : matched(runs, wanted < 0 ? cross(normal, gradient) : cross(gradient, normal));
  for (uint32_t first = 0; first < runs.size(); ++first) {
    IndexLoop loop;
    for (uint32_t r = first; r != kNone && !runs[r].used; r = next[r]) {
      Run& run = runs[r];
      run.used = true;
      const bool followsLoop = run.nextInLoop == next[r];
      const bool closesUp =
          mesh_.corners[run.corners.back()] == mesh_.corners[runs[next[r]].corners.front()];
      for (size_t i = 0; i + 1 < run.corners.size(); ++i) loop.push_back(run.corners[i]);
      if (closesUp) continue;
      loop.push_back(followsLoop ? run.corners.back() : copyCorner(run.corners.back(), 0));
      if (followsLoop) loop.insert(loop.end(), run.along.begin(), run.along.end());
    }
    if (!loop.empty()) loops.push_back(std::move(loop));
  }
  std::vector<Part> parts;
  const auto at = [this](uint32_t c) { return point(c); };
  for (LoopFace& face : facesOfLoops(std::move(loops), normal, leastArea_, at)) {
    parts.push_back({std::move(face), part.source});
  }
  return parts;
}

// A face of two corners is an edge, one of one corner a point.
void Slicer::cutEdge(uint32_t face) {
  const MeshLoop& loop = mesh_.loopsOf(face)[0];
  uint32_t a = loop.firstCorner, b = loop.firstCorner + loop.cornerCount - 1;
  const bool reversed = value_[a] > value_[b];
  if (reversed) std::swap(a, b);
  const auto put = [&](uint32_t from, uint32_t to, size_t slab) {
    Part p;
    p.source = face;
    p.loops.push_back(loop.cornerCount == 1 ? IndexLoop{from}
                      : reversed            ? IndexLoop{to, from}
                                            : IndexLoop{from, to});
    place(std::move(p), slab);
  };
  const uint32_t tags = mesh_.edgeTags.empty() ? 0 : mesh_.edgeTags[loop.firstCorner];
  size_t slab = 0;
  for (; slab < cuts_.size() && value_[b] > cuts_[slab] + tolerance_; ++slab) {
    if (value_[a] >= cuts_[slab] - tolerance_) continue;
    const uint32_t x = crossing(a, b, slab, tags);
    put(a, x, slab);
    a = copyCorner(x, tags);
  }
  put(a, b, slab);
}

void Slicer::cutFace(uint32_t face) {
  const Vec3 normal = mesh_.normal(face);
  Part whole;
  whole.source = face;
  for (const MeshLoop& loop : mesh_.loopsOf(face)) {
    IndexLoop corners(loop.cornerCount);
    for (uint32_t i = 0; i < loop.cornerCount; ++i) corners[i] = loop.firstCorner + i;
    whole.loops.push_back(std::move(corners));
  }
  const auto [lo, hi] = rangeOf(whole.loops);
  size_t cut = static_cast<size_t>(std::upper_bound(cuts_.begin(), cuts_.end(), lo + tolerance_) -
                                   cuts_.begin());
  const bool untouched = cut == cuts_.size() || cuts_[cut] >= hi - tolerance_;
  if (untouched || normal == Vec3{}) {
    const size_t slab = slabOf(whole, normal);
    return place(std::move(whole), slab);
  }
  const Vec3 gradient = gradientOf(whole.loops, normal);
  std::vector<Part> rest{std::move(whole)};
  for (; cut < cuts_.size() && cuts_[cut] < hi - tolerance_ && !rest.empty(); ++cut) {
    std::vector<Part> above;
    for (const Part& part : rest) {
      for (Part& p : partsOnSide(part, cut, -1, normal, gradient)) place(std::move(p), cut);
      for (Part& p : partsOnSide(part, cut, 1, normal, gradient)) above.push_back(std::move(p));
    }
    rest = std::move(above);
  }
  for (Part& part : rest) place(std::move(part), cut);
}

void Slicer::run() {
  const auto faces = static_cast<uint32_t>(mesh_.faces.size());
  for (uint32_t f = 0; f < faces; ++f) {
    if (mesh_.loopsOf(f)[0].cornerCount < 3) {
      cutEdge(f);
    } else {
      cutFace(f);
    }
  }
}

std::vector<Mesh> Slicer::assemble(bool cap) {
  std::vector<Mesh> out;
  // Where a position went, and in which slab: no clearing between slabs.
  std::vector<uint32_t> stamp(mesh_.positions.size(), kNone), target(mesh_.positions.size());
  for (size_t slab = 0; slab < parts_.size(); ++slab) {
    MeshBuilder b;
    for (const Part& part : parts_[slab]) {
      const MeshFace& source = mesh_.faces[part.source];
      b.beginFace(source.materialSlot, source.tags, source.smooth);
      for (const IndexLoop& loop : part.loops) {
        b.beginLoop();
        for (const uint32_t c : loop) {
          const uint32_t p = mesh_.corners[c];
          if (stamp[p] != slab) {
            stamp[p] = static_cast<uint32_t>(slab);
            target[p] = b.addPosition(mesh_.positions[p]);
          }
          const uint32_t made =
              b.addCorner(target[p], mesh_.edgeTags.empty() ? 0 : mesh_.edgeTags[c]);
          for (int set = 0; set < kUvSets; ++set) {
            if (mesh_.hasUv(set)) b.setUv(made, set, mesh_.uvs[static_cast<size_t>(set)][c]);
          }
          if (!mesh_.normals.empty()) b.setNormal(made, mesh_.normals[c]);
        }
      }
    }
    Mesh m = b.take();
    if (cap && !m.empty()) {
      if (slab > 0) addCap(m, cuts_[slab - 1], -1);
      if (slab < cuts_.size()) addCap(m, cuts_[slab], 1);
    }
    out.push_back(std::move(m));
  }
  return out;
}

// Chains the unpaired half-edges in the plane of a cut, turned round. Where more than one goes on
// from a point, the leftmost does, which keeps outlines that touch apart. Chains that do not close
// belong to open surfaces and are left.
void Slicer::addCap(Mesh& slab, double cut, double direction) const {
  const Vec3 normal = normal_ * direction;
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  std::vector<uint16_t> slots;
  uint16_t slot = 0;
  for (const MeshFace& f : slab.faces) {
    for (uint32_t l = 0; l < f.loopCount; ++l) {
      const auto ring = slab.cornersOf(slab.loops[f.firstLoop + l]);
      if (ring.size() < 3) continue;
      for (size_t i = 0; i < ring.size(); ++i) {
        const uint32_t a = ring[i], b = ring[(i + 1) % ring.size()];
        if (std::fabs(dot(slab.positions[a], normal_) - cut) > tolerance_) continue;
        if (std::fabs(dot(slab.positions[b], normal_) - cut) > tolerance_) continue;
        if (edges.empty()) slot = f.materialSlot;
        edges.emplace_back(b, a);
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  // Partners cancel one for one.
  std::vector<bool> gone(edges.size(), false);
  for (size_t i = 0; i < edges.size(); ++i) {
    if (gone[i]) continue;
    const auto [a, b] = edges[i];
    auto twin = std::lower_bound(edges.begin(), edges.end(), std::pair{b, a});
    while (twin != edges.end() && *twin == std::pair{b, a} &&
           gone[static_cast<size_t>(twin - edges.begin())]) {
      ++twin;
    }
    if (twin == edges.end() || *twin != std::pair{b, a}) continue;
    gone[i] = true;
    gone[static_cast<size_t>(twin - edges.begin())] = true;
  }
  const auto pick = [&](uint32_t from, const Vec3& incoming) {
    size_t best = edges.size();
    double bestTurn = -10;
    auto at = std::lower_bound(edges.begin(), edges.end(), std::pair{from, 0u});
    for (; at != edges.end() && at->first == from; ++at) {
      const auto i = static_cast<size_t>(at - edges.begin());
      if (gone[i]) continue;
      const Vec3 d = normalized(slab.positions[at->second] - slab.positions[from]);
      const double sine = dot(cross(incoming, d), normal), cosine = dot(incoming, d);
      // Grows with the turn to the left, from -2 (back) through 0 (on) to 2.
      const double turn = sine >= 0 ? 1 - cosine : cosine - 1;
      if (turn > bestTurn) {
        bestTurn = turn;
        best = i;
      }
    }
    return best;
  };
  std::vector<IndexLoop> loops;
  for (size_t first = 0; first < edges.size(); ++first) {
    if (gone[first]) continue;
    IndexLoop loop;
    size_t at = first;
    while (at < edges.size() && !gone[at]) {
      gone[at] = true;
      loop.push_back(edges[at].first);
      const uint32_t reached = edges[at].second;
      if (reached == edges[first].first) break;
      const Vec3 incoming = normalized(slab.positions[reached] - slab.positions[edges[at].first]);
      const size_t following = pick(reached, incoming);
      if (following == edges.size()) loop.clear();
      at = following;
    }
    if (loop.size() >= 3) loops.push_back(std::move(loop));
  }
  MeshBuilder b;
  b.mesh() = std::move(slab);
  for (const LoopFace& face : facesOfLoops(std::move(loops), normal, leastArea_,
                                           [&](uint32_t p) { return b.mesh().positions[p]; })) {
    b.beginFace(slot);
    for (const IndexLoop& loop : face) {
      b.beginLoop();
      for (const uint32_t p : loop) b.addCorner(p);
    }
  }
  slab = b.take();
}

}  // namespace

std::vector<Mesh> sliceMesh(const Mesh& m, const Vec3& normal, std::span<const double> cuts,
                            bool cap) {
  std::vector<double> values;
  values.reserve(m.corners.size());
  for (uint32_t c = 0; c < m.corners.size(); ++c) values.push_back(dot(m.at(c), normal));
  Slicer slicer(m, std::move(values), cuts);
  slicer.setPlane(normal);
  slicer.run();
  return slicer.assemble(cap);
}

Mesh clippedBelow(const Mesh& m, const Vec3& normal, double distance, bool cap) {
  return std::move(sliceMesh(m, normal, {&distance, 1}, cap)[0]);
}

std::vector<Mesh> sliceMeshByUv(const Mesh& m, int set, int coordinate,
                                std::span<const double> cuts) {
  std::vector<double> values;
  values.reserve(m.corners.size());
  for (const Vec2 uv : m.uvs[static_cast<size_t>(set)]) {
    values.push_back(uv[static_cast<size_t>(coordinate)]);
  }
  values.resize(m.corners.size());
  Slicer slicer(m, std::move(values), cuts);
  slicer.run();
  return slicer.assemble(false);
}

}  // namespace gable
