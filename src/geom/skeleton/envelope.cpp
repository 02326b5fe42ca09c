// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The envelope is built in layers between the heights at which walls end. In a layer each edge
// moves at one speed or stands still, so a layer is a weighted straight skeleton that is cut off;
// what remains of the polygon above is the ground of the next. The remainder is the outline less
// the outlines of all faces of the skeleton, edge by edge. Pieces of one face join in the same way.
#include "geom/skeleton/envelope.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "base/work.h"
#include "geom/skeleton/roof_pieces.h"
#include "geom/skeleton/skeleton.h"
#include "math/trig.h"

namespace gable {

namespace {

// Heights nearer to the top of a layer than this share of it are the top.
constexpr double kTop = 1 - 1e-9;
// Straight is told at this part of the extent.
constexpr double kStraight = 1e-9;

/// The edge of the polygon that an edge higher up comes from. A step is an upright edge that
/// appears between neighbours in line which move at different speeds; it stands still.
struct Owner {
  uint32_t ring = 0, edge = 0;
  bool step = false;
};

struct Link {
  uint32_t from = 0, to = 0;
  Owner owner;
};

/// Edges of which those that run back cancel those that run forth.
class Links {
 public:
  void add(uint32_t from, uint32_t to, Owner owner) {
    work(4);
    const auto back = byEnds_.find({to, from});
    if (back == byEnds_.end()) {
      byEnds_.emplace(std::pair{from, to}, owner);
    } else {
      byEnds_.erase(back);
    }
  }

  /// What is left, as loops. Where loops touch `choose` says how to go on: it gets the link that
  /// arrives and those that leave, and gives the number of one.
  template <class Choose>
  std::vector<std::vector<Link>> loops(const Choose& choose) {
    std::vector<std::vector<Link>> out;
    while (!byEnds_.empty()) {
      std::vector<Link> loop;
      auto at = byEnds_.begin();
      const uint32_t first = at->first.first;
      for (;;) {
        work();
        loop.push_back({at->first.first, at->first.second, at->second});
        byEnds_.erase(at);
        const uint32_t v = loop.back().to;
        if (v == first) break;
        std::vector<Link> leaving;
        const auto begin = byEnds_.lower_bound({v, 0});
        for (auto i = begin; i != byEnds_.end() && i->first.first == v; ++i) {
          leaving.push_back({v, i->first.second, i->second});
        }
        if (leaving.empty()) break;
        at = std::next(begin, static_cast<std::ptrdiff_t>(
                                  leaving.size() == 1 ? 0 : choose(loop.back(), leaving)));
      }
      if (loop.size() > 2 && loop.back().to == first) out.push_back(std::move(loop));
    }
    return out;
  }

 private:
  std::multimap<std::pair<uint32_t, uint32_t>, Owner> byEnds_;
};

/// Grows with the angle of a direction from -x, from -2 to 2.
double turnOf(Vec2 d) {
  const double x = 1 - d.x / (std::abs(d.x) + std::abs(d.y));
  return d.y < 0 ? -x : x;
}

class Builder {
 public:
  Builder(const Polygon& polygon, std::span<const std::vector<EnvelopeSide>> sides,
          double maxHeight)
      : polygon_(polygon), sides_(sides), maxHeight_(maxHeight) {}

  Status build(std::span<const std::vector<double>> floor);
  Envelope take() { return std::move(out_); }

 private:
  struct Corner {
    uint32_t vertex = 0;
    Owner owner;
  };
  using Part = std::vector<std::vector<Corner>>;
  using Loops = std::vector<std::vector<uint32_t>>;

  const Ring& ring(size_t r) const { return r == 0 ? polygon_.outer : polygon_.holes[r - 1]; }
  size_t ringCount() const { return polygon_.holes.size() + 1; }
  EnvelopeSide sideOf(size_t r, size_t k) const {
    return r < sides_.size() && k < sides_[r].size() ? sides_[r][k] : EnvelopeSide{};
  }
  Vec2 planOf(uint32_t v) const { return {out_.vertices[v].x, out_.vertices[v].y}; }
  uint32_t addVertex(Vec2 xy, double height) {
    out_.vertices.push_back({xy.x, xy.y, height});
    return static_cast<uint32_t>(out_.vertices.size() - 1);
  }
  double weightOf(const Owner& o, double height) const;
  std::vector<double> heights() const;
  Part ground(std::span<const std::vector<double>> floor, std::vector<Loops>& bottom);
  void addPiece(const Owner& o, bool leans, const std::vector<uint32_t>& loop);
  void raise(const Part& part, double top, std::vector<Part>& above);
  Status grow(const Part& part, double low, double top, std::vector<Part>& above);
  std::vector<Part> partsOf(const std::vector<std::vector<Link>>& loops);
  double areaOf(const std::vector<Link>& loop) const;
  void joinPieces();
  void dropStraightVertices();

  const Polygon& polygon_;
  std::span<const std::vector<EnvelopeSide>> sides_;
  double maxHeight_;
  Envelope out_;
  std::vector<Part> tops_;
  /// By ring, edge and whether it leans.
  std::map<std::tuple<uint32_t, uint32_t, bool>, Links> pieces_;
};

/// How far the edge moves a metre up from `height`.
double Builder::weightOf(const Owner& o, double height) const {
  const EnvelopeSide s = sideOf(o.ring, o.edge);
  return o.step || s.angle >= 90 || s.baseHeight > height ? 0 : 1 / tanDeg(s.angle);
}

/// The heights between the layers, ascending, from 0 to the top.
std::vector<double> Builder::heights() const {
  std::vector<double> h{0, maxHeight_};
  for (size_t r = 0; r < ringCount(); ++r) {
    for (size_t k = 0; k < ring(r).size(); ++k) {
      const EnvelopeSide s = sideOf(r, k);
      if (s.angle < 90 && s.baseHeight < maxHeight_) h.push_back(s.baseHeight);
    }
  }
  std::sort(h.begin(), h.end());
  h.erase(std::unique(h.begin(), h.end()), h.end());
  return h;
}

/// The polygon at height 0, with walls down to the floor.
Builder::Part Builder::ground(std::span<const std::vector<double>> floor,
                              std::vector<Loops>& bottom) {
  Part part;
  Loops below;
  for (uint32_t r = 0; r < ringCount(); ++r) {
    auto& loop = part.emplace_back();
    auto& low = below.emplace_back();
    for (uint32_t k = 0; k < ring(r).size(); ++k) {
      loop.push_back({addVertex(ring(r)[k], 0), {r, k, false}});
      const double depth = r < floor.size() && k < floor[r].size() ? floor[r][k] : 0;
      low.push_back(depth < 0 ? addVertex(ring(r)[k], depth) : loop.back().vertex);
    }
    const size_t n = loop.size();
    for (size_t k = 0; k < n; ++k) {
      const size_t next = (k + 1) % n;
      addPiece(loop[k].owner, false, {low[k], low[next], loop[next].vertex, loop[k].vertex});
    }
    std::reverse(low.begin() + 1, low.end());
  }
  bottom.push_back(std::move(below));
  return part;
}

void Builder::addPiece(const Owner& o, bool leans, const std::vector<uint32_t>& loop) {
  Links& links = pieces_[{o.ring, o.edge, leans || o.step}];
  for (size_t i = 0; i < loop.size(); ++i) {
    const uint32_t next = loop[(i + 1) % loop.size()];
    if (loop[i] != next) links.add(loop[i], next, o);
  }
}

/// A layer in which nothing moves.
void Builder::raise(const Part& part, double top, std::vector<Part>& above) {
  Part& to = above.emplace_back();
  for (const auto& loop : part) {
    auto& upper = to.emplace_back();
    for (const Corner& c : loop) upper.push_back({addVertex(planOf(c.vertex), top), c.owner});
    for (size_t k = 0; k < loop.size(); ++k) {
      const size_t next = (k + 1) % loop.size();
      addPiece(loop[k].owner, false,
               {loop[k].vertex, loop[next].vertex, upper[next].vertex, upper[k].vertex});
    }
  }
}

Status Builder::grow(const Part& part, double low, double top, std::vector<Part>& above) {
  Polygon polygon;
  std::vector<std::vector<double>> weights;
  std::vector<uint32_t> number;
  bool moves = false;
  for (const auto& loop : part) {
    Ring& r = weights.empty() ? polygon.outer : polygon.holes.emplace_back();
    auto& w = weights.emplace_back();
    for (const Corner& c : loop) {
      r.push_back(planOf(c.vertex));
      w.push_back(weightOf(c.owner, low));
      number.push_back(c.vertex);
      moves |= w.back() > 0;
    }
  }
  if (!moves) {
    raise(part, top, above);
    return {};
  }
  const Skeleton s = buildSkeleton(polygon, weights, top - low);
  if (!s.status.ok()) return s.status;
  for (size_t v = s.inputCount; v < s.vertices.size(); ++v) {
    const bool atTop = s.vertices[v].height >= (top - low) * kTop;
    number.push_back(addVertex(s.vertices[v].xy, atTop ? top : low + s.vertices[v].height));
  }
  Links rest;
  for (const auto& loop : part) {
    for (size_t k = 0; k < loop.size(); ++k) {
      rest.add(loop[k].vertex, loop[(k + 1) % loop.size()].vertex, loop[k].owner);
    }
  }
  for (const SkeletonFace& f : s.faces) {
    if (f.loop.size() < 3) continue;
    Owner owner = part[f.ring][f.edge].owner;
    owner.step |= f.step;
    const bool leans = weights[f.ring][f.edge] > 0;
    for (size_t l = 0; l <= f.holes.size(); ++l) {
      std::vector<uint32_t> loop;
      for (const uint32_t v : l == 0 ? f.loop : f.holes[l - 1]) loop.push_back(number[v]);
      addPiece(owner, leans, loop);
      for (size_t i = 0; i < loop.size(); ++i) {
        rest.add(loop[(i + 1) % loop.size()], loop[i], owner);
      }
    }
  }
  const auto sharpestLeft = [&](const Link& in, const std::vector<Link>& leaving) {
    const double back = turnOf(planOf(in.from) - planOf(in.to));
    size_t best = 0;
    double least = 5;
    for (size_t i = 0; i < leaving.size(); ++i) {
      double turn = back - turnOf(planOf(leaving[i].to) - planOf(leaving[i].from));
      if (turn <= 0) turn += 4;
      if (turn >= least) continue;
      least = turn;
      best = i;
    }
    return best;
  };
  for (Part& p : partsOf(rest.loops(sharpestLeft))) above.push_back(std::move(p));
  return {};
}

double Builder::areaOf(const std::vector<Link>& loop) const {
  double sum = 0;
  const Vec2 o = planOf(loop[0].from);
  for (const Link& l : loop) sum += cross(planOf(l.from) - o, planOf(l.to) - o);
  return sum / 2;
}

/// Loops as polygons with holes. One without area ends here: a face that closes the sides.
std::vector<Builder::Part> Builder::partsOf(const std::vector<std::vector<Link>>& loops) {
  std::vector<Part> parts;
  const auto cornersOf = [](const std::vector<Link>& loop) {
    std::vector<Corner> corners;
    for (const Link& l : loop) corners.push_back({l.from, l.owner});
    return corners;
  };
  for (const auto& loop : loops) {
    const double area = areaOf(loop);
    if (area > 0) parts.push_back({cornersOf(loop)});
    if (area == 0) tops_.push_back({cornersOf(loop)});
  }
  const auto inside = [&](const std::vector<Corner>& outer, Vec2 p) {
    bool in = false;
    for (size_t i = 0; i < outer.size(); ++i) {
      work();
      const Vec2 a = planOf(outer[i].vertex), b = planOf(outer[(i + 1) % outer.size()].vertex);
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) {
        in = !in;
      }
    }
    return in;
  };
  for (const auto& loop : loops) {
    if (areaOf(loop) >= 0) continue;
    const Vec2 p = (planOf(loop[0].from) + planOf(loop[0].to)) * 0.5;
    for (Part& part : parts) {
      if (!inside(part[0], p)) continue;
      part.push_back(cornersOf(loop));
      break;
    }
  }
  return parts;
}

void Builder::joinPieces() {
  const auto first = [](const Link&, const std::vector<Link>&) { return size_t{0}; };
  for (auto& [key, links] : pieces_) {
    const auto [ring, edge, leans] = key;
    std::vector<EnvelopeFace> faces;
    std::vector<std::vector<uint32_t>> holes;
    const Vec2 a = this->ring(ring)[edge],
               b = this->ring(ring)[(edge + 1) % this->ring(ring).size()];
    const Vec2 outwards = -perpendicular(b - a);
    for (const auto& loop : links.loops(first)) {
      std::vector<uint32_t> vertices;
      for (const Link& l : loop) vertices.push_back(l.from);
      Vec3 normal;
      for (size_t i = 1; i + 1 < vertices.size(); ++i) {
        const Vec3 o = out_.vertices[vertices[0]];
        normal += cross(out_.vertices[vertices[i]] - o, out_.vertices[vertices[i + 1]] - o);
      }
      const double facing = normal.x * outwards.x + normal.y * outwards.y;
      // A step stands across its edge and is no hole.
      if (facing >= 0 ||
          std::any_of(loop.begin(), loop.end(), [](const Link& l) { return l.owner.step; })) {
        faces.push_back({leans ? EnvelopeRole::Slope : EnvelopeRole::Base, ring, edge, {vertices}});
      } else {
        holes.push_back(std::move(vertices));
      }
    }
    // Rounding may turn a sliver over.
    for (auto& h : holes) {
      if (faces.empty())
        faces.push_back({leans ? EnvelopeRole::Slope : EnvelopeRole::Base, ring, edge, {}});
      faces[0].loops.push_back(std::move(h));
    }
    for (EnvelopeFace& f : faces) out_.faces.push_back(std::move(f));
  }
}

/// Takes out vertices at which the borders of all their faces go straight on.
void Builder::dropStraightVertices() {
  Box3 box;
  for (const Vec3& v : out_.vertices) box.include(v);
  const double tolerance = kStraight * length(box.size());
  std::vector<char> bent(out_.vertices.size(), 0);
  for (const EnvelopeFace& f : out_.faces) {
    for (const auto& loop : f.loops) {
      const size_t n = loop.size();
      for (size_t i = 0; i < n; ++i) {
        work();
        const Vec3 p = out_.vertices[loop[(i + n - 1) % n]], q = out_.vertices[loop[i]];
        const Vec3 r = out_.vertices[loop[(i + 1) % n]];
        const bool straight =
            dot(q - p, r - q) > 0 && length(cross(q - p, r - p)) <= tolerance * length(r - p);
        // The bottom keeps the corners that its polygon has.
        if (!straight || f.role == EnvelopeRole::Bottom) bent[loop[i]] = 1;
      }
    }
  }
  // A sliver that would lose its shape keeps all of its vertices, and so do its neighbours theirs.
  for (bool changed = true; changed;) {
    changed = false;
    for (const EnvelopeFace& f : out_.faces) {
      for (const auto& loop : f.loops) {
        const auto kept =
            std::count_if(loop.begin(), loop.end(), [&](uint32_t v) { return bent[v] != 0; });
        if (kept >= 3 || kept == static_cast<std::ptrdiff_t>(loop.size())) continue;
        for (const uint32_t v : loop) bent[v] = 1;
        changed = true;
      }
    }
  }
  const auto isStraight = [&](uint32_t v) { return bent[v] == 0; };
  for (EnvelopeFace& f : out_.faces) {
    for (auto& loop : f.loops) std::erase_if(loop, isStraight);
    std::erase_if(f.loops, [](const auto& loop) { return loop.size() < 3; });
  }
  std::erase_if(out_.faces, [](const EnvelopeFace& f) { return f.loops.empty(); });
}

Status Builder::build(std::span<const std::vector<double>> floor) {
  std::vector<Loops> bottom;
  std::vector<Part> parts{ground(floor, bottom)};
  const std::vector<double> levels = heights();
  for (size_t i = 0; i + 1 < levels.size(); ++i) {
    std::vector<Part> above;
    for (const Part& p : parts) {
      const Status status = grow(p, levels[i], levels[i + 1], above);
      if (!status.ok()) return status;
    }
    parts = std::move(above);
  }
  joinPieces();
  tops_.insert(tops_.end(), parts.begin(), parts.end());
  for (const Part& p : tops_) {
    EnvelopeFace& f = out_.faces.emplace_back(EnvelopeFace{EnvelopeRole::Top, 0, 0, {}});
    for (const auto& loop : p) {
      auto& to = f.loops.emplace_back();
      for (const Corner& c : loop) to.push_back(c.vertex);
    }
  }
  for (Loops& loops : bottom) {
    out_.faces.push_back({EnvelopeRole::Bottom, 0, 0, std::move(loops)});
  }
  dropStraightVertices();
  return {};
}

bool isGood(const EnvelopeSide& s) {
  return s.baseHeight >= 0 && std::isfinite(s.baseHeight) && s.angle > 0 && s.angle <= 90;
}

}  // namespace

Envelope buildEnvelope(const Polygon& given, std::span<const std::vector<EnvelopeSide>> sides,
                       double maxHeight, std::span<const std::vector<double>> floor) {
  Envelope failed;
  bool good = maxHeight > 0 && std::isfinite(maxHeight) && given.outer.size() >= 3;
  for (const auto& ring : sides) good &= std::all_of(ring.begin(), ring.end(), isGood);
  if (!good) {
    failed.status = Status::failure(
        "envelope-sides", "a height of the envelope or an angle of its sides makes no solid",
        "Give a positive greatest height, base heights of 0 and more, and angles up to 90 "
        "degrees.");
    return failed;
  }
  std::vector<bool> reversed;
  const Polygon polygon = skeleton::orientedCopy(given, reversed);
  std::vector<std::vector<EnvelopeSide>> turned(sides.begin(), sides.end());
  turned.resize(reversed.size());
  std::vector<std::vector<double>> turnedFloor(floor.begin(), floor.end());
  turnedFloor.resize(reversed.size());
  for (size_t r = 0; r < reversed.size(); ++r) {
    const size_t n = r == 0 ? polygon.outer.size() : polygon.holes[r - 1].size();
    turned[r].resize(n);
    turnedFloor[r].resize(n, 0);
    if (!reversed[r]) continue;
    std::reverse(turned[r].begin(), turned[r].end());
    std::reverse(turnedFloor[r].begin() + 1, turnedFloor[r].end());
  }
  Builder builder(polygon, turned, maxHeight);
  failed.status = builder.build(turnedFloor);
  if (!failed.status.ok()) return failed;
  Envelope made = builder.take();
  for (EnvelopeFace& f : made.faces) {
    if (f.role != EnvelopeRole::Base && f.role != EnvelopeRole::Slope) continue;
    if (!reversed[f.ring]) continue;
    const size_t n = f.ring == 0 ? polygon.outer.size() : polygon.holes[f.ring - 1].size();
    f.edge = static_cast<uint32_t>(n) - 1 - f.edge;
  }
  return made;
}

}  // namespace gable
