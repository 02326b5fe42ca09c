// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Selections of edges: sets of parts of edges, and the words that mean them.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/number.h"
#include "base/random.h"
#include "builtins/ops/region/shared/region_text.h"
#include "geom/region/autoindex.h"
#include "geom/region/places.h"
#include "math/trig.h"

namespace gable {

namespace {

std::string near(std::string_view text, size_t place) {
  return place < text.size() ? "at '" + std::string(text.substr(place, 12)) + "'" : "at its end";
}

// A set of parts of edges: by edge the intervals, ascending and apart.
class EdgeSet {
 public:
  using Interval = std::pair<double, double>;
  explicit EdgeSet(size_t edges) : of_(edges) {}

  static EdgeSet all(size_t edges) {
    EdgeSet s(edges);
    for (auto& e : s.of_) e = {{0.0, 1.0}};
    return s;
  }
  void add(size_t edge, double from, double to) {
    if (to - from > 1e-12) of_[edge].emplace_back(std::max(0.0, from), std::min(1.0, to));
  }
  void add(size_t edge) { of_[edge] = {{0.0, 1.0}}; }

  EdgeSet complement() const {
    EdgeSet out(of_.size());
    for (size_t e = 0; e < of_.size(); ++e) {
      double from = 0;
      for (const Interval& i : merged(of_[e])) {
        out.add(e, from, i.first);
        from = i.second;
      }
      out.add(e, from, 1);
    }
    return out;
  }
  EdgeSet united(const EdgeSet& o) const {
    EdgeSet out(of_.size());
    for (size_t e = 0; e < of_.size(); ++e) {
      std::vector<Interval> both = of_[e];
      both.insert(both.end(), o.of_[e].begin(), o.of_[e].end());
      out.of_[e] = merged(std::move(both));
    }
    return out;
  }
  EdgeSet common(const EdgeSet& o) const {
    return complement().united(o.complement()).complement();
  }
  std::vector<EdgePart> parts() const {
    std::vector<EdgePart> out;
    for (uint32_t e = 0; e < of_.size(); ++e) {
      for (const Interval& i : merged(of_[e])) out.push_back({e, i.first, i.second});
    }
    return out;
  }

 private:
  static std::vector<Interval> merged(std::vector<Interval> v) {
    std::sort(v.begin(), v.end());
    std::vector<Interval> out;
    for (const Interval& i : v) {
      if (!out.empty() && i.first <= out.back().second + 1e-12) {
        out.back().second = std::max(out.back().second, i.second);
      } else {
        out.push_back(i);
      }
    }
    return out;
  }
  std::vector<std::vector<Interval>> of_;
};

class SelectionReader {
 public:
  SelectionReader(std::string_view text, const SelectionInput& in)
      : text_(text), r_(text), in_(in), view_(in.view), n_(in.view.marks().size()) {
    for (const Ring& r : ringsOf(view_.polygon())) {
      for (size_t i = 0; i < r.size(); ++i) {
        from_.push_back(r[i]);
        to_.push_back(r[(i + 1) % r.size()]);
      }
    }
    outer_ = view_.polygon().outer.size();
  }

  bool run(std::vector<EdgePart>& out, std::string& problem) {
    EdgeSet s = either();
    if (problem_.empty() && !r_.atEnd()) fail("this was not expected");
    problem = problem_;
    out = s.parts();
    return problem_.empty();
  }

 private:
  void fail(std::string what) {
    if (problem_.empty()) problem_ = std::move(what) + " " + near(text_, r_.place());
  }

  EdgeSet either() {
    EdgeSet s = minus();
    while (r_.accept("||") || r_.accept('|')) s = s.united(minus());
    return s;
  }
  EdgeSet minus() {
    EdgeSet s = both();
    while (r_.accept('-')) s = s.common(both().complement());
    return s;
  }
  EdgeSet both() {
    EdgeSet s = unary();
    while (r_.accept("&&") || r_.accept('&')) s = s.common(unary());
    return s;
  }
  EdgeSet unary() {
    if (++depth_ > 200) {
      fail("too many brackets");
      return EdgeSet(n_);
    }
    EdgeSet s(n_);
    if (r_.accept('!')) {
      s = unary().complement();
    } else if (r_.accept('(')) {
      s = either();
      if (!r_.accept(')')) fail("')' is missing");
    } else {
      s = atom();
    }
    --depth_;
    return s;
  }

  template <class Test>
  EdgeSet where(Test&& test) const {
    EdgeSet s(n_);
    for (size_t i = 0; i < n_; ++i) {
      if (test(i)) s.add(i);
    }
    return s;
  }

  bool argument(double& v) {
    if (!r_.number(v)) {
      fail("a number is missing");
      return false;
    }
    return true;
  }
  void open() {
    if (!r_.accept('(')) fail("'(' is missing");
  }
  void close() {
    if (!r_.accept(')')) fail("')' is missing");
  }
  int optionalArgument(int otherwise) {
    double v = otherwise;
    if (r_.accept('(')) {
      argument(v);
      close();
    }
    return static_cast<int>(std::clamp(v, -1e6, 1e6));
  }

  static int sideOf(std::string_view w) {
    if (w == "w" || w == "west") return 0;
    if (w == "n" || w == "north") return 1;
    if (w == "e" || w == "east") return 2;
    if (w == "s" || w == "south") return 3;
    return -1;
  }

  // Sides are mirrored with the cell.
  uint32_t seen(uint32_t logical) const {
    if (view_.logicalCount() > 4 || !view_.cell() || logical > 3) return logical;
    return view_.cell()->side(logical);
  }
  // Counted from the end where it is negative: -1 is the last.
  EdgeSet logical(double k) const {
    const double count = std::max(1u, view_.logicalCount());
    const double turn =
        std::fmod(std::fmod(std::trunc(std::clamp(k, -1e9, 1e9)), count) + count, count);
    const uint32_t wanted = seen(static_cast<uint32_t>(turn));
    return where([&](size_t i) { return view_.marks()[i].logical == wanted; });
  }

  EdgeSet side(int k) const {
    if (view_.logicalCount() == 4) return logical(k);
    const LogicalEdges l = sidesOf(view_.polygon().outer);
    return where([&](size_t i) { return i < outer_ && l.of[i] == static_cast<uint32_t>(k); });
  }

  Vec2 outward(size_t i) const { return -perpendicular(normalized(to_[i] - from_[i])); }

  Vec2 directionOf(int k, bool world) const {
    static constexpr Vec2 kPlan[] = {{-1, 0}, {0, 1}, {1, 0}, {0, -1}};
    const Vec2 d = kPlan[k];
    if (!world) return d;
    // North of the world is -z.
    const Vec3 local = in_.world().direction({d.x, 0, -d.y});
    return {local.x, local.y};
  }

  bool direction(Vec2& d) {
    std::string w = r_.word();
    const bool world = w == "world";
    if (world && r_.accept('.')) w = r_.word();
    const int k = sideOf(w);
    if (k < 0) {
      double angle = 0;
      if (w.empty() && r_.number(angle)) {
        d = {cosDeg(angle), sinDeg(angle)};
        return true;
      }
      fail("a direction is missing: W, N, E or S");
      return false;
    }
    d = directionOf(k, world);
    return true;
  }

  EdgeSet facing(Vec2 d) const {
    return where([&](size_t i) {
      const Vec2 n = outward(i);
      // Half-open at 45 degrees, so that four directions share all edges.
      const double along = dot(n, d), across = cross(d, n);
      return along > 0 &&
             (std::fabs(across) < along * (1 - 1e-9) || std::fabs(across - along) <= along * 1e-9);
    });
  }

  EdgeSet angle(double a, double b) const {
    return where([&](size_t i) {
      const Vec2 d = to_[i] - from_[i];
      double v = std::fmod(atan2Deg(d.y, d.x) + 360, 180);
      if (v > 180 - 1e-9) v = 0;
      return a <= b ? v >= a && v < b : v >= a || v < b;
    });
  }

  // Edges between the rays at two angles from the middle, cut there unless whole.
  EdgeSet sector(double a, double b, bool whole) const {
    const Vec2 c = middleOf(view_.polygon());
    const double width = std::fmod(std::fmod(b - a, 360) + 360, 360);
    const auto inside = [&](Vec2 p) {
      const double v = std::fmod(atan2Deg(p.y - c.y, p.x - c.x) - a + 720, 360);
      return width == 0 || v < width;
    };
    EdgeSet s(n_);
    for (size_t i = 0; i < n_; ++i) {
      std::vector<double> cuts{0, 1};
      for (const double angle : {a, b}) {
        const Vec2 d{cosDeg(angle), sinDeg(angle)};
        const double p = cross(d, from_[i] - c), q = cross(d, to_[i] - c);
        if ((p < 0) != (q < 0) && p != q) {
          const double t = p / (p - q);
          const Vec2 at = from_[i] + (to_[i] - from_[i]) * t;
          if (dot(at - c, d) > 0) cuts.push_back(t);
        }
      }
      std::sort(cuts.begin(), cuts.end());
      bool any = false;
      EdgeSet parts(n_);
      for (size_t k = 0; k + 1 < cuts.size(); ++k) {
        const double mid = (cuts[k] + cuts[k + 1]) / 2;
        if (!inside(from_[i] + (to_[i] - from_[i]) * mid)) continue;
        any = true;
        parts.add(i, cuts[k], cuts[k + 1]);
      }
      if (whole && any) {
        s.add(i);
      } else if (any) {
        s = s.united(parts);
      }
    }
    return s;
  }

  // The group of the first direction when all directions grow from where their rays meet the
  // outline: always the part that turns least from a group's mean normal is attached to it. An edge
  // that two rays meet is divided where the bisector of both meets it.
  EdgeSet grow(const std::vector<Vec2>& directions, double threshold) const {
    const Vec2 c = middleOf(view_.polygon());
    constexpr int kNone = -1;
    struct Part {
      size_t edge;
      double from, to;
      int group;
    };
    std::vector<Part> parts;
    for (size_t i = 0; i < outer_; ++i) parts.push_back({i, 0, 1, kNone});
    std::vector<Vec2> normals(directions.size());
    const auto join = [&](Part& p, int g) {
      p.group = g;
      const double l = length(to_[p.edge] - from_[p.edge]) * (p.to - p.from);
      normals[static_cast<size_t>(g)] = normals[static_cast<size_t>(g)] + outward(p.edge) * l;
    };
    for (size_t g = 0; g < directions.size(); ++g) {
      double at = 0;
      const size_t edge = hitFrom(c, directions[g], at);
      if (edge == outer_) continue;
      const auto part = std::find_if(parts.begin(), parts.end(), [&](const Part& p) {
        return p.edge == edge && at >= p.from && at <= p.to;
      });
      if (part == parts.end()) continue;
      if (part->group == kNone) {
        join(*part, static_cast<int>(g));
        continue;
      }
      const Vec2 middle =
          normalized(directions[static_cast<size_t>(part->group)]) + normalized(directions[g]);
      double cut = 0, own = 0;
      if (!(length(middle) > 0) || hitFrom(c, middle, cut) != edge) continue;
      const Vec2 first = directions[static_cast<size_t>(part->group)];
      if (hitFrom(c, first, own) != edge || !(cut > part->from && cut < part->to)) continue;
      Part rest = *part;
      (at > own ? part->to : part->from) = cut;
      (at > own ? rest.from : rest.to) = cut;
      rest.group = kNone;
      join(rest, static_cast<int>(g));
      parts.insert(at > own ? part + 1 : part, rest);
    }
    attach(parts, normals, threshold);
    EdgeSet out(n_);
    for (const Part& p : parts) {
      if (p.group == 0) out.add(p.edge, p.from, p.to);
    }
    return out;
  }

  // The edge of the outer ring that a ray meets first, and the share of it; outer_ when none.
  size_t hitFrom(Vec2 c, Vec2 d, double& share) const {
    size_t best = outer_;
    double reach = 1e300;
    for (size_t i = 0; i < outer_; ++i) {
      const Vec2 e = to_[i] - from_[i];
      const double det = cross(d, e);
      if (det == 0) continue;
      const double t = cross(from_[i] - c, e) / det, u = cross(from_[i] - c, d) / det;
      if (t > 0 && u >= 0 && u <= 1 && t < reach) {
        reach = t;
        best = i;
        share = u;
      }
    }
    return best;
  }

  template <class Parts>
  void attach(Parts& parts, std::vector<Vec2>& normals, double threshold) const {
    const size_t n = parts.size();
    for (;;) {
      double least = 1e300;
      size_t part = n;
      int to = -1;
      for (size_t i = 0; i < n; ++i) {
        if (parts[i].group >= 0) continue;
        for (const size_t k : {(i + 1) % n, (i + n - 1) % n}) {
          if (parts[k].group < 0) continue;
          const Vec2 d = normals[static_cast<size_t>(parts[k].group)], o = outward(parts[i].edge);
          const double turn = std::fabs(atan2Deg(cross(d, o), dot(d, o)));
          if (turn < least) {
            least = turn;
            part = i;
            to = parts[k].group;
          }
        }
      }
      if (part == n || least > threshold) return;
      auto& p = parts[part];
      p.group = to;
      const double l = length(to_[p.edge] - from_[p.edge]) * (p.to - p.from);
      normals[static_cast<size_t>(to)] = normals[static_cast<size_t>(to)] + outward(p.edge) * l;
    }
  }

  EdgeSet peeled(EdgeRole role, bool both, int last) const {
    std::vector<uint32_t> depths;
    for (const EdgeMark& m : view_.marks()) {
      for (const PeelMark& p : m.peels) depths.push_back(p.depth);
    }
    std::sort(depths.begin(), depths.end(), std::greater<>());
    depths.erase(std::unique(depths.begin(), depths.end()), depths.end());
    if (last < 0 || static_cast<size_t>(last) >= depths.size()) return EdgeSet(n_);
    const uint32_t depth = depths[static_cast<size_t>(last)];
    return where([&](size_t i) {
      return std::any_of(
          view_.marks()[i].peels.begin(), view_.marks()[i].peels.end(), [&](const PeelMark& p) {
            return p.depth == depth && (p.role == role || (both && p.role == EdgeRole::Cap));
          });
    });
  }

  // Edges made no later than the ancestor k: 0 is the parent, -1 the initial region.
  EdgeSet outerOf(int k) const {
    const int depth = static_cast<int>(view_.depth());
    const int ancestor = k >= 0 ? depth - 1 - k : -1 - k;
    return where([&](size_t i) { return static_cast<int>(view_.marks()[i].level) <= ancestor; });
  }

  // An edge whose two ends lie on the initial boundary, whatever made it.
  EdgeSet strictOuter() const {
    std::vector<bool> on(n_, false);
    forEachCorner([&](size_t before, size_t i) {
      on[i] = view_.marks()[i].level == 0 || view_.marks()[before].level == 0;
    });
    EdgeSet s(n_);
    forEachCorner([&](size_t before, size_t i) {
      if (on[before] && on[i]) s.add(before);
    });
    return s;
  }

  // Calls visit(edge that ends, edge that begins) for each vertex of all rings.
  template <class Visit>
  void forEachCorner(Visit&& visit) const {
    size_t first = 0;
    for (const Ring& r : ringsOf(view_.polygon())) {
      for (size_t i = 0; i < r.size(); ++i) {
        visit(first + (i + r.size() - 1) % r.size(), first + i);
      }
      first += r.size();
    }
  }

  // Edges that share a vertex with what is selected; what is selected itself is not among them.
  EdgeSet touching(const EdgeSet& set) const {
    std::vector<bool> begins(n_, false), ends(n_, false), any(n_, false);
    for (const EdgePart& p : set.parts()) {
      any[p.edge] = true;
      begins[p.edge] = begins[p.edge] || p.from <= 0;
      ends[p.edge] = ends[p.edge] || p.to >= 1;
    }
    EdgeSet s(n_);
    forEachCorner([&](size_t before, size_t i) {
      if (ends[before] && !any[i]) s.add(i);
      if (begins[i] && !any[before]) s.add(before);
    });
    return s;
  }

  // Edges with a corner at an end: where one logical edge ends and another begins.
  EdgeSet atCorners() const {
    EdgeSet s(n_);
    forEachCorner([&](size_t before, size_t i) {
      if (view_.marks()[before].logical == view_.marks()[i].logical) return;
      s.add(before);
      s.add(i);
    });
    return s;
  }

  // The ranges of parameters along logical edges: [0.4, 2.9].
  EdgeSet parameters(double a, double b) const {
    EdgeSet s(n_);
    const bool turned = view_.cell() && view_.cell()->mirroredX() != view_.cell()->mirroredY() &&
                        view_.logicalCount() == 4;
    for (double k = std::floor(a); k < b && k < a + 1000; ++k) {
      const double from = std::max(a - k, 0.0), to = std::min(b - k, 1.0);
      const double count = std::max(1u, view_.logicalCount());
      const uint32_t wanted =
          seen(static_cast<uint32_t>(std::fmod(std::fmod(k, count) + count, count)));
      addAlong(wanted, turned ? from : 1 - to, turned ? to : 1 - from, s);
    }
    return s;
  }
  // A part of a logical edge, counter-clockwise.
  void addAlong(uint32_t logical, double from, double to, EdgeSet& s) const {
    double whole = 0;
    size_t begin = outer_;
    for (size_t i = 0; i < outer_; ++i) {
      if (view_.marks()[i].logical != logical) continue;
      whole += length(to_[i] - from_[i]);
      if (view_.marks()[(i + outer_ - 1) % outer_].logical != logical) begin = i;
    }
    if (begin == outer_) begin = 0;
    double run = 0;
    for (size_t k = 0; k < outer_; ++k) {
      const size_t i = (begin + k) % outer_;
      if (view_.marks()[i].logical != logical) continue;
      const double l = length(to_[i] - from_[i]);
      if (l > 0)
        s.add(i, std::clamp((from * whole - run) / l, 0.0, 1.0),
              std::clamp((to * whole - run) / l, 0.0, 1.0));
      run += l;
    }
  }

  EdgeSet bracket() {
    EdgeSet s(n_);
    do {
      double a = 0, b = 0;
      if (!argument(a)) return s;
      if (r_.accept(',')) {
        if (!argument(b)) return s;
        s = s.united(parameters(a, b));
      } else {
        s = s.united(logical(a));
      }
      if (!r_.accept(']')) fail("']' is missing");
    } while (problem_.empty() && r_.accept('['));
    return s;
  }

  EdgeSet byLength(bool longest) const {
    double best = longest ? -1 : 1e300;
    for (size_t i = 0; i < n_; ++i) {
      const double l = length(to_[i] - from_[i]);
      if (longest ? l > best : l < best) best = l;
    }
    return where(
        [&](size_t i) { return std::fabs(length(to_[i] - from_[i]) - best) <= 1e-9 * best; });
  }

  EdgeSet atom() {
    if (r_.accept('[')) return bracket();
    const size_t start = r_.place();
    double number = 0;
    if (r_.number(number)) return logical(number);
    const std::string w = r_.word();
    const auto role = [&](EdgeRole wanted) {
      return where([&](size_t i) { return view_.marks()[i].role == wanted; });
    };
    if (const int k = sideOf(w); k >= 0) return side(k);
    if (w == "all") return EdgeSet::all(n_);
    if (w == "outer" || w == "outer_edge" || w == "outeredgesselection") {
      const size_t before = r_.place();
      if (r_.accept('(') && r_.word() == "strict") {
        close();
        return strictOuter();
      }
      r_.goTo(before);
      return r_.peek() == '(' ? outerOf(optionalArgument(0)) : outerOf(-1);
    }
    if (w == "inner") return outerOf(-1).complement();
    if (w == "border") return outerOf(0);
    if (w == "pathside") return role(EdgeRole::Path);
    if (w == "centreside" || w == "centerside") return role(EdgeRole::Centre);
    if (w == "holeside") return role(EdgeRole::Hole);
    if (w == "cut") return role(EdgeRole::Cut);
    if (w == "peeled_base" || w == "pb") return peeled(EdgeRole::Base, false, optionalArgument(0));
    if (w == "peeled_inner" || w == "pi")
      return peeled(EdgeRole::Inner, false, optionalArgument(0));
    if (w == "peeled_segment" || w == "ps") {
      return peeled(EdgeRole::Inner, true, optionalArgument(0));
    }
    if (w == "corners") return atCorners();
    if (w == "touches") {
      open();
      const EdgeSet inside = either();
      close();
      return touching(inside);
    }
    if (w == "longest") return byLength(true);
    if (w == "shortest") return byLength(false);
    if (w == "len") return lengthTest();
    if (w == "side") {
      open();
      const int k = sideOf(r_.word());
      if (k < 0) fail("side takes W, N, E or S");
      close();
      return k < 0 ? EdgeSet(n_) : side(k);
    }
    return function(w, start);
  }

  EdgeSet lengthTest() {
    const bool more = r_.accept('>');
    if (!more && !r_.accept('<')) fail("write len > 2 or len < 2");
    double v = 0;
    argument(v);
    return where([&](size_t i) {
      const double l = length(to_[i] - from_[i]);
      return more ? l > v : l < v;
    });
  }

  EdgeSet function(const std::string& w, size_t start) {
    EdgeSet none(n_);
    double a = 0, b = 0;
    if (w == "facing") {
      open();
      Vec2 d;
      if (!direction(d)) return none;
      close();
      return facing(d);
    }
    if (w == "angle" || w == "sector") {
      open();
      if (!argument(a) || !r_.accept(',') || !argument(b)) {
        fail("two angles are missing");
        return none;
      }
      const bool whole = w == "sector" && r_.accept(',') && r_.word() == "whole";
      close();
      return w == "angle" ? angle(a, b) : sector(a, b, whole);
    }
    if (w == "grow") {
      open();
      std::vector<Vec2> directions;
      do {
        Vec2 d;
        if (!direction(d)) return none;
        directions.push_back(d);
      } while (r_.accept(','));
      double threshold = 1e9;
      if (r_.accept(';')) argument(threshold);
      close();
      if (directions.size() == 1) addCardinals(directions);
      return grow(directions, threshold);
    }
    if (w == "index" || w == "nth") {
      open();
      if (!argument(a)) return none;
      if (w == "nth" && r_.accept(',')) argument(b);
      close();
      const auto i = static_cast<size_t>(std::clamp(a, 0.0, 1e9));
      const auto o = static_cast<size_t>(std::clamp(b, 0.0, 1e9));
      if (w == "index") return where([&](size_t k) { return k == i % std::max<size_t>(1, n_); });
      return where([&](size_t k) { return i > 0 && k >= o && (k - o) % i == 0; });
    }
    if (w == "random") {
      open();
      if (!argument(a)) return none;
      close();
      return where([&](size_t k) { return randomUnit(hashCombine(in_.seed, k)) < a; });
    }
    r_.goTo(start);
    fail("no edges are called so");
    return none;
  }

  static void addCardinals(std::vector<Vec2>& directions) {
    for (const Vec2 d : {Vec2{-1, 0}, Vec2{0, 1}, Vec2{1, 0}, Vec2{0, -1}}) {
      if (dot(d, directions[0]) < 1 - 1e-9) directions.push_back(d);
    }
  }

  std::string_view text_;
  TextReader r_;
  const SelectionInput& in_;
  const RegionView& view_;
  size_t n_, outer_ = 0;
  std::vector<Vec2> from_, to_;
  std::string problem_;
  int depth_ = 0;
};

}  // namespace

bool selectEdges(std::string_view text, const SelectionInput& input, std::vector<EdgePart>& out,
                 std::string& problem) {
  return SelectionReader(text, input).run(out, problem);
}

}  // namespace gable
