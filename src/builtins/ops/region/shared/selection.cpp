// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Selections of edges: sets of parts of edges, and what each term means.
#include "builtins/ops/region/shared/selection.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/random.h"
#include "geom/region/autoindex.h"
#include "geom/region/places.h"
#include "math/trig.h"

namespace gable {

namespace {

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

// What stands on the stack: a set, and the terms that it was made of where they are joined by || or
// stand alone.
struct Operand {
  EdgeSet set;
  std::vector<Term> leaves;
};

int sideOf(std::string_view w) {
  if (w == "W" || w == "west") return 0;
  if (w == "N" || w == "north") return 1;
  if (w == "E" || w == "east") return 2;
  if (w == "S" || w == "south") return 3;
  return -1;
}

// CGA's words for the sides of a scope, whose front is the south of a plan.
int sideOfScope(std::string_view w) {
  if (w == "left") return sideOf("west");
  if (w == "back") return sideOf("north");
  if (w == "right") return sideOf("east");
  if (w == "front") return sideOf("south");
  return -1;
}

class EdgeSelector {
 public:
  explicit EdgeSelector(const SelectionInput& in)
      : in_(in), view_(in.view), n_(in.view.marks().size()) {
    for (const Ring& r : ringsOf(view_.polygon())) {
      for (size_t i = 0; i < r.size(); ++i) {
        from_.push_back(r[i]);
        to_.push_back(r[(i + 1) % r.size()]);
      }
    }
    outer_ = view_.polygon().outer.size();
  }

  EdgeSet run(std::span<const Term> terms, std::vector<OwnWidth>* widths) {
    using Kind = ArgumentTerm::Kind;
    widths_ = widths;
    std::vector<Operand> stack;
    const auto pop = [&] {
      Operand o = std::move(stack.back());
      stack.pop_back();
      return o;
    };
    for (const Term& t : terms) {
      const size_t needed = t.kind == Kind::Not    ? 1
                            : t.kind == Kind::Term ? t.operands
                            : t.kind >= Kind::And  ? 2
                                                   : 0;
      if (stack.size() < needed) return EdgeSet(n_);
      switch (t.kind) {
        case Kind::Value: stack.push_back({logical(t.number(0)), {t}}); break;
        case Kind::Term: {
          std::vector<Operand> operands(t.operands, Operand{EdgeSet(n_), {}});
          for (size_t k = t.operands; k-- > 0;) operands[k] = pop();
          stack.push_back({meaning(t, operands), {t}});
          break;
        }
        case Kind::Not: {
          const Operand a = pop();
          stack.push_back({a.set.complement(), {}});
          break;
        }
        default: {
          Operand b = pop(), a = pop();
          if (t.kind == Kind::Or) {
            a.leaves.insert(a.leaves.end(), b.leaves.begin(), b.leaves.end());
            stack.push_back({a.set.united(b.set), std::move(a.leaves)});
          } else {
            stack.push_back({a.set.common(t.kind == Kind::And ? b.set : b.set.complement()), {}});
          }
        }
      }
    }
    return stack.empty() ? EdgeSet::all(n_) : stack.back().set;
  }

 private:
  template <class Test>
  EdgeSet where(Test&& test) const {
    EdgeSet s(n_);
    for (size_t i = 0; i < n_; ++i) {
      if (test(i)) s.add(i);
    }
    return s;
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

  // A direction of the plane: a word, of the world perhaps, or an angle.
  bool direction(const Term& t, Vec2& d) const {
    if (t.kind == ArgumentTerm::Kind::Value) {
      d = {cosDeg(t.number(0)), sinDeg(t.number(0))};
      return true;
    }
    constexpr std::string_view kWorld = "world.";
    const bool world = t.name.starts_with(kWorld);
    const int k = sideOf(world ? t.name.substr(kWorld.size()) : t.name);
    if (k >= 0) d = directionOf(k, world);
    return k >= 0;
  }
  std::vector<Vec2> directions(const Operand& o) const {
    std::vector<Vec2> out;
    for (const Term& t : o.leaves) {
      if (Vec2 d; direction(t, d)) out.push_back(d);
    }
    return out;
  }

  EdgeSet ofRole(EdgeRole wanted) const {
    return where([&](size_t i) { return view_.marks()[i].role == wanted; });
  }

  EdgeSet meaning(const Term& t, const std::vector<Operand>& operands) {
    const std::string_view w = t.name;
    const double a = t.number(0), b = t.number(1);
    if (w == "all") return EdgeSet::all(n_);
    if (w == "outer") return outerOf(t.values.empty() ? -1 : wholeOf(a));
    if (w == "strictOuter") return strictOuter();
    if (w == "inner") return outerOf(-1).complement();
    if (w == "border") return outerOf(0);
    if (const int k = sideOfScope(w); k >= 0) return facing(directionOf(k, false));
    if (w == "pathSide") return ofRole(EdgeRole::Path);
    if (w == "centreSide") return ofRole(EdgeRole::Centre);
    if (w == "holeSide") return ofRole(EdgeRole::Hole);
    if (w == "cut") return ofRole(EdgeRole::Cut);
    if (w == "peeledBase") return peeled(EdgeRole::Base, false, wholeOf(a));
    if (w == "peeledInner") return peeled(EdgeRole::Inner, false, wholeOf(a));
    if (w == "peeledSegment") return peeled(EdgeRole::Inner, true, wholeOf(a));
    if (w == "corners") return atCorners();
    if (w == "touches") return touching(operands[0].set);
    if (w == "longest") return byLength(true);
    if (w == "shortest") return byLength(false);
    if (w == "longer") return where([&](size_t i) { return length(to_[i] - from_[i]) > a; });
    if (w == "shorter") return where([&](size_t i) { return length(to_[i] - from_[i]) < a; });
    if (w == "side") return side(std::max(0, sideOf(t.word(0, in_.pool))));
    if (w == "edge") return edgeWord(t);
    if (w == "range") return parameters(a, b);
    if (w == "angle") return angle(a, b);
    if (w == "sector") return sector(a, b, t.word(2, in_.pool) == "whole");
    return function(t, operands);
  }

  EdgeSet edgeWord(const Term& t) const {
    const double from = t.number(1), to = t.number(2, 1);
    if (from == 0 && to == 1) return logical(t.number(0));
    const double k = std::trunc(t.number(0));
    return parametersOf(k, std::min(from, to), std::max(from, to));
  }

  EdgeSet function(const Term& t, const std::vector<Operand>& operands) {
    const std::string_view w = t.name;
    const double a = t.number(0), b = t.number(1);
    if (w == "facing") {
      const std::vector<Vec2> d = directions(operands[0]);
      return d.empty() ? EdgeSet(n_) : facing(d[0]);
    }
    if (w == "grow") {
      std::vector<Vec2> d = directions(operands[0]);
      if (d.empty()) return EdgeSet(n_);
      if (d.size() == 1) addCardinals(d);
      return grow(d, a);
    }
    if (w == "wide") {
      if (widths_) widths_->push_back({operands[0].set.parts(), a});
      return operands[0].set;
    }
    const auto i = static_cast<size_t>(std::clamp(a, 0.0, 1e9));
    const auto o = static_cast<size_t>(std::clamp(b, 0.0, 1e9));
    if (w == "index") return where([&](size_t k) { return k == i % std::max<size_t>(1, n_); });
    if (w == "nth") {
      return where([&](size_t k) { return i > 0 && k >= o && (k - o) % i == 0; });
    }
    if (w == "random") {
      return where([&](size_t k) { return randomUnit(hashCombine(in_.seed, k)) < a; });
    }
    return EdgeSet(n_);
  }

  static int wholeOf(double v) { return static_cast<int>(std::clamp(v, -1e6, 1e6)); }

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
    for (double k = std::floor(a); k < b && k < a + 1000; ++k) {
      s = s.united(parametersOf(k, std::max(a - k, 0.0), std::min(b - k, 1.0)));
    }
    return s;
  }
  EdgeSet parametersOf(double k, double from, double to) const {
    EdgeSet s(n_);
    const bool turned = view_.cell() && view_.cell()->mirroredX() != view_.cell()->mirroredY() &&
                        view_.logicalCount() == 4;
    const double count = std::max(1u, view_.logicalCount());
    const uint32_t wanted =
        seen(static_cast<uint32_t>(std::fmod(std::fmod(k, count) + count, count)));
    addAlong(wanted, turned ? from : 1 - to, turned ? to : 1 - from, s);
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

  EdgeSet byLength(bool longest) const {
    double best = longest ? -1 : 1e300;
    for (size_t i = 0; i < n_; ++i) {
      const double l = length(to_[i] - from_[i]);
      if (longest ? l > best : l < best) best = l;
    }
    return where(
        [&](size_t i) { return std::fabs(length(to_[i] - from_[i]) - best) <= 1e-9 * best; });
  }

  static void addCardinals(std::vector<Vec2>& directions) {
    for (const Vec2 d : {Vec2{-1, 0}, Vec2{0, 1}, Vec2{1, 0}, Vec2{0, -1}}) {
      if (dot(d, directions[0]) < 1 - 1e-9) directions.push_back(d);
    }
  }

  const SelectionInput& in_;
  const RegionView& view_;
  size_t n_, outer_ = 0;
  std::vector<Vec2> from_, to_;
  std::vector<OwnWidth>* widths_ = nullptr;
};

}  // namespace

std::vector<EdgePart> selectEdges(std::span<const Term> terms, const SelectionInput& input,
                                  std::vector<OwnWidth>* widths) {
  return EdgeSelector(input).run(terms, widths).parts();
}

}  // namespace gable
