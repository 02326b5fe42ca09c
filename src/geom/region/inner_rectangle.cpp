// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The polygon is cut into trapezoids by vertical lines through all vertices. A rectangle reaches
// from a place x1 in one trapezoid to a place x2 in the same or another one to the right, through
// gates: the openings between the trapezoids on its way. Given both trapezoids and the narrowest
// gates, its height is a minimum of linear functions minus a maximum of such, so its area has a
// single peak over (x1, x2), which nested golden sections find. All chains of trapezoids are walked
// twice: once for a good rectangle of each, whose area then cuts off chains that cannot win, and
// once for their bounds; the search goes through what is left in the order of the bounds.
#include "geom/region/inner_rectangle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/work.h"
#include "geom/region/segment_grid.h"

namespace gable {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// A bound must beat the best area by this share to be looked at.
constexpr double kGain = 1e-7;
// Steps of a golden section: 0.618^40 is 4e-9.
constexpr int kSteps = 40;

struct Line {
  double y = 0, slope = 0;  // y at the left of its trapezoid.
};

struct Trapezoid {
  double x0, x1;
  Line bottom, top;
  uint32_t firstGate = 0, gateCount = 0;
  double reach = 0;  // The rightmost x that any chain from here gets to.

  double bottomAt(double x) const { return bottom.y + bottom.slope * (x - x0); }
  double topAt(double x) const { return top.y + top.slope * (x - x0); }
  double lowest() const { return std::min(bottom.y, bottomAt(x1)); }
  double highest() const { return std::max(top.y, topAt(x1)); }
};

struct Gate {
  uint32_t to;
  double low, high;
};

struct Span {
  double x1 = 0, x2 = 0, y1 = 0, y2 = 0;
  double area() const { return (x2 - x1) * (y2 - y1); }
};

// A pair of end trapezoids with the opening between them.
struct Chain {
  uint32_t from, to;
  double low, high;
  double bound;
};

class Search {
 public:
  Search(const Polygon& p, double atLeast) : atLeast_(atLeast) { decompose(p); }

  Span run() {
    walk([&](const Chain& c) { tryCheaply(c); });
    std::vector<Chain> left;
    walk([&](const Chain& c) {
      if (c.bound > needed()) left.push_back(c);
    });
    std::stable_sort(left.begin(), left.end(),
                     [](const Chain& a, const Chain& b) { return a.bound > b.bound; });
    for (const Chain& c : left) {
      if (c.bound <= needed()) break;
      refine(c);
    }
    return best_;
  }

 private:
  double needed() const { return std::max(best_.area(), atLeast_) * (1 + kGain); }

  void decompose(const Polygon& p) {
    const std::vector<Segment> edges = edgesOf(p);
    std::vector<double> xs;
    for (const Segment& s : edges) xs.push_back(s.a.x);
    std::sort(xs.begin(), xs.end());
    if (xs.empty()) return;
    // Lines nearer to each other than rounding are one.
    const double least = 1e-12 * std::max(xs.back() - xs.front(), 1e-3 * std::fabs(xs.back()));
    std::vector<double> lines{xs.front()};
    for (const double x : xs) {
      if (x - lines.back() > least) lines.push_back(x);
    }
    std::vector<Segment> rising;
    for (const Segment& s : edges) {
      if (s.a.x != s.b.x) rising.push_back(s.a.x < s.b.x ? s : Segment{s.b, s.a});
    }
    std::stable_sort(rising.begin(), rising.end(),
                     [](const Segment& s, const Segment& t) { return s.a.x < t.a.x; });
    std::vector<Segment> active;
    size_t next = 0;
    slabStarts_.push_back(0);
    for (size_t k = 0; k + 1 < lines.size(); ++k) {
      work(active.size());
      const double middle = (lines[k] + lines[k + 1]) / 2;
      while (next < rising.size() && rising[next].a.x < middle) active.push_back(rising[next++]);
      std::erase_if(active, [&](const Segment& s) { return s.b.x <= middle; });
      addSlab(active, lines[k], lines[k + 1]);
      slabStarts_.push_back(static_cast<uint32_t>(trapezoids_.size()));
    }
    openGates();
  }

  void addSlab(std::vector<Segment>& active, double x0, double x1) {
    const double middle = (x0 + x1) / 2;
    const auto at = [](const Segment& s, double x) {
      return s.a.y + (s.b.y - s.a.y) * ((x - s.a.x) / (s.b.x - s.a.x));
    };
    std::stable_sort(active.begin(), active.end(), [&](const Segment& s, const Segment& t) {
      return at(s, middle) < at(t, middle);
    });
    const auto line = [&](const Segment& s) {
      const double y0 = at(s, x0), y1 = at(s, x1);
      return Line{y0, (y1 - y0) / (x1 - x0)};
    };
    for (size_t i = 0; i + 1 < active.size(); i += 2) {
      trapezoids_.push_back({x0, x1, line(active[i]), line(active[i + 1]), 0, 0, x1});
    }
  }

  void openGates() {
    for (size_t k = 0; k + 2 < slabStarts_.size(); ++k) {
      for (uint32_t a = slabStarts_[k]; a < slabStarts_[k + 1]; ++a) {
        Trapezoid& t = trapezoids_[a];
        t.firstGate = static_cast<uint32_t>(gates_.size());
        for (uint32_t b = slabStarts_[k + 1]; b < slabStarts_[k + 2]; ++b) {
          work();
          const Trapezoid& u = trapezoids_[b];
          const double low = std::max(t.bottomAt(t.x1), u.bottom.y);
          const double high = std::min(t.topAt(t.x1), u.top.y);
          if (high > low) gates_.push_back({b, low, high});
        }
        t.gateCount = static_cast<uint32_t>(gates_.size()) - t.firstGate;
      }
    }
    for (size_t a = trapezoids_.size(); a-- > 0;) {
      Trapezoid& t = trapezoids_[a];
      for (uint32_t g = t.firstGate; g < t.firstGate + t.gateCount; ++g) {
        work();
        t.reach = std::max(t.reach, trapezoids_[gates_[g].to].reach);
      }
    }
  }

  template <class Visit>
  void walk(const Visit& visit) {
    std::vector<Chain> stack;
    for (uint32_t a = 0; a < trapezoids_.size(); ++a) {
      stack.push_back({a, a, -kInfinity, kInfinity, 0});
      while (!stack.empty()) {
        work();
        Chain c = stack.back();
        stack.pop_back();
        const Trapezoid& from = trapezoids_[c.from];
        const Trapezoid& to = trapezoids_[c.to];
        const double high = std::min(c.high, std::min(from.highest(), to.highest()));
        const double low = std::max(c.low, std::max(from.lowest(), to.lowest()));
        c.bound = (to.x1 - from.x0) * (high - low);
        if (c.bound > needed()) visit(c);
        for (uint32_t g = to.firstGate; g < to.firstGate + to.gateCount; ++g) {
          work();
          const double top = std::min(std::min(c.high, gates_[g].high), from.highest());
          const double bottom = std::max(std::max(c.low, gates_[g].low), from.lowest());
          // Narrower than this, no chain onward can win.
          const double reach = trapezoids_[gates_[g].to].reach - from.x0;
          if ((top - bottom) * reach <= needed()) continue;
          stack.push_back({c.from, gates_[g].to, bottom, top, 0});
        }
      }
    }
  }

  Span spanOf(const Chain& c, double x1, double x2) const {
    const Trapezoid& a = trapezoids_[c.from];
    const Trapezoid& b = trapezoids_[c.to];
    return {x1, x2, std::max(c.low, std::max(a.bottomAt(x1), b.bottomAt(x2))),
            std::min(c.high, std::min(a.topAt(x1), b.topAt(x2)))};
  }

  // Area where there is one, else how far the height is from it: a single peak everywhere.
  double worth(const Chain& c, double x1, double x2) const {
    const Span s = spanOf(c, x1, x2);
    const double width = x2 - x1, height = s.y2 - s.y1;
    return height > 0 && width > 0 ? width * height : std::min(width, height);
  }

  void keep(const Chain& c, double x1, double x2) {
    const Span s = spanOf(c, x1, x2);
    if (s.x2 > s.x1 && s.y2 > s.y1 && s.area() > needed()) best_ = s;
  }

  void tryCheaply(const Chain& c) {
    const Trapezoid& a = trapezoids_[c.from];
    const Trapezoid& b = trapezoids_[c.to];
    for (const double x1 : {a.x0, (a.x0 + a.x1) / 2}) {
      for (const double x2 : {b.x1, (b.x0 + b.x1) / 2}) keep(c, x1, x2);
    }
  }

  template <class F>
  static double peak(double low, double high, const F& f) {
    constexpr double kGolden = 0.6180339887498949;
    double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
    double fa = f(a), fb = f(b);
    for (int i = 0; i < kSteps; ++i) {
      work();
      if (fa >= fb) {
        high = b;
        b = a;
        fb = fa;
        a = high - kGolden * (high - low);
        fa = f(a);
      } else {
        low = a;
        a = b;
        fa = fb;
        b = low + kGolden * (high - low);
        fb = f(b);
      }
    }
    return (low + high) / 2;
  }

  void refine(const Chain& c) {
    const Trapezoid& a = trapezoids_[c.from];
    const Trapezoid& b = trapezoids_[c.to];
    const auto bestX2 = [&](double x1) {
      return peak(b.x0, b.x1, [&](double x2) { return worth(c, x1, x2); });
    };
    double x1 = peak(a.x0, a.x1, [&](double x) { return worth(c, x, bestX2(x)); });
    double x2 = bestX2(x1);
    // Sides on the lines of vertices are exact.
    const auto settle = [&](double& x, double line) {
      const double old = x, before = worth(c, x1, x2);
      x = line;
      if (worth(c, x1, x2) < before * (1 - 1e-9)) x = old;
    };
    if (x1 - a.x0 < a.x1 - x1) settle(x1, a.x0);
    if (b.x1 - x2 < x2 - b.x0) settle(x2, b.x1);
    keep(c, x1, x2);
  }

  double atLeast_;
  std::vector<Trapezoid> trapezoids_;
  std::vector<uint32_t> slabStarts_;
  std::vector<Gate> gates_;
  Span best_;
};

// Coordinates along a direction and across it, relative to the first vertex.
Polygon turned(const Polygon& p, Vec2 x) {
  Polygon out = p;
  const Vec2 origin = p.outer[0];
  const auto turn = [&](Ring& r) {
    for (Vec2& v : r) v = {dot(v - origin, x), cross(x, v - origin)};
  };
  turn(out.outer);
  for (Ring& h : out.holes) turn(h);
  return out;
}

OrientedRect searchAlong(const Polygon& p, Vec2 x, double atLeast) {
  const Span s = Search(turned(p, x), atLeast).run();
  return {p.outer[0] + x * s.x1 + perpendicular(x) * s.y1, x, s.x2 - s.x1, s.y2 - s.y1};
}

// A search takes milliseconds for hundreds of vertices; more directions than these would add up.
constexpr size_t kMaxDirections = 64;

struct EdgeDirection {
  Vec2 direction;
  double length;
};

// Directions of the long edges, turned by quarters into (-45, 45] degrees, without repetitions.
std::vector<EdgeDirection> edgeDirections(const Polygon& p) {
  std::vector<Ring> rings{p.outer};
  rings.insert(rings.end(), p.holes.begin(), p.holes.end());
  std::vector<EdgeDirection> out;
  for (const Ring& r : rings) {
    const std::vector<Segment> edges = edgesOf(std::vector<Ring>{r});
    double longest = 0;
    for (const Segment& s : edges) longest = std::max(longest, length(s.b - s.a));
    for (const Segment& s : edges) {
      work();
      const double l = length(s.b - s.a);
      if (!(l > longest / 4)) continue;
      Vec2 d = normalized(s.b - s.a);
      while (!(d.x > 0 && d.y <= d.x && d.y > -d.x)) d = perpendicular(d);
      const auto same = std::find_if(out.begin(), out.end(), [&](const EdgeDirection& e) {
        return std::fabs(cross(d, e.direction)) < 1e-7 && dot(d, e.direction) > 0;
      });
      if (same == out.end())
        out.push_back({d, l});
      else
        same->length = std::max(same->length, l);
    }
  }
  if (out.size() > kMaxDirections) {
    std::stable_sort(out.begin(), out.end(), [](const EdgeDirection& a, const EdgeDirection& b) {
      return a.length > b.length;
    });
    out.resize(kMaxDirections);
  }
  return out;
}

}  // namespace

OrientedRect largestInnerRect(const Polygon& p, Vec2 direction) {
  const Vec2 x = normalized(direction);
  if (p.outer.size() < 3 || x == Vec2{}) return {};
  return searchAlong(p, x, 0);
}

OrientedRect largestInnerRectByEdge(const Polygon& p) {
  OrientedRect best;
  if (p.outer.size() < 3) return best;
  for (const EdgeDirection& e : edgeDirections(p)) {
    const OrientedRect r = searchAlong(p, e.direction, best.area());
    if (r.area() > best.area()) best = r;
  }
  return best;
}

}  // namespace gable
