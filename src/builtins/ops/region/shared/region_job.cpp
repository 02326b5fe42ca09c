// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
#include "builtins/ops/region/shared/region_job.h"

#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "builtins/ops/subdivide/shared/parts.h"
#include "geom/region/peel.h"
#include "geom/region/places.h"

namespace gable {

RegionJob::RegionJob(OpCall& call) : call_(call), mesh_(meshInScope(call.shape())) {
  for (const size_t f : regionFaces(*mesh_)) {
    faces_.push_back(std::make_unique<RegionView>(call.services(), *mesh_, f));
  }
}

void RegionJob::keep(size_t face, std::string_view word, RegionPiece piece,
                     std::vector<EdgeMark> marks, std::optional<CellMark> cell) {
  kept_.push_back({face, std::string(word), std::move(piece), std::move(marks), cell});
}

void RegionJob::emit() {
  const ValuePool& pool = call_.services().pool();
  const Shape parent = call_.shape();
  uint32_t piece = 0;
  for (const SelectorItem& item : call_.selectors()) {
    std::vector<const Kept*> mine;
    for (const Kept& k : kept_) {
      if (selectsWord(item, k.word, pool)) mine.push_back(&k);
    }
    if (item.op == SelectOperator::Each) {
      for (const Kept* k : mine) {
        call_.emit(faces_[k->face]->shapeOf(parent, k->piece, k->marks, k->cell), item.slot,
                   piece++);
      }
      continue;
    }
    // One shape for each face of the parent, of all its pieces.
    for (size_t f = 0; f < faces_.size(); ++f) {
      std::vector<RegionPiece> pieces;
      std::vector<std::vector<EdgeMark>> marks;
      for (const Kept* k : mine) {
        if (k->face != f) continue;
        pieces.push_back(k->piece);
        pieces.back().axis = {1, 0};
        marks.push_back(k->marks);
      }
      if (pieces.empty()) continue;
      call_.emit(faces_[f]->shapeOf(parent, pieces, marks, std::nullopt), item.slot, piece++);
    }
  }
}

void RegionJob::emitCells(const char* remedy) {
  const bool any =
      std::any_of(kept_.begin(), kept_.end(), [](const Kept& k) { return k.word == "region"; });
  if (!kept_.empty() && !any) {
    std::string what;
    for (const char* word : {"path", "junction", "centre", "remainder"}) {
      const bool made =
          std::any_of(kept_.begin(), kept_.end(), [&](const Kept& k) { return k.word == word; });
      if (made) what += (what.empty() ? "" : " and ") + std::string(word);
    }
    call_.services().warn(
        "no-cells",
        "'" + std::string(call_.spec().name) + "': no cell is left; all of the region is " + what,
        "make the region larger, or " + std::string(remedy));
  }
  emit();
}

bool RegionJob::flat() const {
  constexpr double kOnPlane = 1e-6;
  const Frame& first = faces_[0]->plane().frame();
  return std::all_of(faces_.begin(), faces_.end(), [&](const auto& view) {
    const Frame& f = view->plane().frame();
    return dot(f.z, first.z) > 1 - kOnPlane &&
           std::fabs(dot(f.origin - first.origin, first.z)) < kOnPlane;
  });
}

size_t RegionJob::largest() const {
  size_t best = 0;
  for (size_t f = 1; f < faces_.size(); ++f) {
    if (area(faces_[f]->polygon()) > area(faces_[best]->polygon())) best = f;
  }
  return best;
}

void RegionJob::replace(Shape& shape, std::span<const std::vector<RegionPiece>> byFace,
                        bool reindex) {
  Mesh mesh;
  bool any = false;
  for (size_t f = 0; f < faces_.size(); ++f) {
    if (byFace[f].empty()) continue;
    Mesh part = faces_[f]->replaced(byFace[f], reindex);
    if (any) {
      append(mesh, part);
    } else {
      mesh = std::move(part);
    }
    any = true;
  }
  if (!any) {
    shape.geometry = Geometry{};
    return;
  }
  const Shape parent = shape;
  setPartMesh(shape, parent, std::move(mesh), true);
}

std::function<Frame()> RegionJob::worldIn(size_t face) const {
  return [this, face] {
    const Frame& plane = faces_[face]->plane().frame();
    const Shape& s = call_.shape();
    const auto local = [&](const Vec3& d) {
      return plane.toLocalDirection(
          s.scope.toLocalDirection(call_.services().world().toLocalDirection(d)));
    };
    return Frame::of({}, local({1, 0, 0}), local({0, 1, 0}), local({0, 0, 1}));
  };
}

Status noOneRegion(OpCall& call) {
  return call.orElse(call.fail("no-geometry", "the faces of the shape do not lie in one plane",
                               "take it apart first: comp(f) { all : ... }"));
}

Status noRegion(OpCall& call) {
  // What went to an otherwise before is at its end.
  if (call.shape().geometry.kind == GeometryKind::None &&
      call.spec().block == BlockKind::Operations) {
    return {};
  }
  return call.orElse(call.fail("no-geometry", "the shape has no face that could be divided",
                               "begin with a lot or a face"));
}

std::vector<EdgePart> selected(const OpCall& call, const Selection& selection, const RegionJob& job,
                               size_t face, std::vector<OwnWidth>* widths) {
  constexpr uint64_t kArguments = 900;
  const std::vector<Term> terms =
      termsOf(selection, call.services(), call.randomAddress(kArguments));
  const SelectionInput input{*job.faces()[face], call.randomAddress(1000 + face), job.worldIn(face),
                             call.services().pool()};
  return selectEdges(terms, input, widths);
}

namespace {

// Places with || between: all terms are places.
bool placesOnly(std::span<const Term> terms) {
  return !terms.empty() && std::all_of(terms.begin(), terms.end(), [](const Term& t) {
    return t.is("point") || t.kind == ArgumentTerm::Kind::Or;
  });
}

}  // namespace

Status discsOf(OpCall& call, std::span<const Term> sites, const DrawnNumber& radius,
               const RegionView& view, uint64_t seed, std::vector<Disc>& out) {
  if (placesOnly(sites)) {
    const Vec2 corner = bounds(view.polygon()).min;
    for (const Term& t : sites) {
      if (t.is("point")) {
        out.push_back({Vec2{t.number(0), t.number(1)} + corner, std::max(0.0, t.number(2))});
      }
    }
    return {};
  }
  if (sites.size() != 1 || sites[0].kind != ArgumentTerm::Kind::Value) {
    return call.fail("bad-argument", "these are no sites",
                     "write a number, or places: point(3, 4) || point(10, 4)");
  }
  const Value& v = sites[0].values[0];
  if (v.type == ValueType::FloatArray) {
    const Vec3 origin = view.plane().frame().toLocal({});
    const Array& a = call.services().pool().array(v);
    for (size_t i = 0; i + 1 < a.numbers.size(); i += 2) {
      out.push_back({Vec2{a.numbers[i], a.numbers[i + 1]} + Vec2{origin.x, origin.y}, 0});
    }
    return {};
  }
  if (!(v.number >= 0 && v.number <= kMostDiscs) || !(radius.low() >= 0) ||
      !std::isfinite(radius.high())) {
    return call.fail("bad-argument", "there can be 0 to 5000 discs of radii above zero",
                     "scatter fewer");
  }
  ScatterOptions options;
  options.seed = seed;
  options.count = static_cast<uint32_t>(v.number);
  options.least = std::min(radius.low(), radius.high());
  options.most = std::max(radius.low(), radius.high());
  out = scatterDiscs(view.polygon(), options);
  return {};
}

std::optional<uint32_t> slotOf(const OpCall& call, std::string_view word) {
  for (const SelectorItem& item : call.selectors()) {
    if (selectsWord(item, word, call.services().pool())) return item.slot;
  }
  return std::nullopt;
}

bool planFigureOf(const DrawnFigure& figure, PlanFigure& out) {
  out = {};
  if (!figure.spec) return true;
  struct Known {
    std::string_view name;
    PlanShape shape;
  };
  static constexpr Known kKnown[] = {{"circle", PlanShape::Circle},
                                     {"rect", PlanShape::Rect},
                                     {"regularPolygon", PlanShape::Polygon},
                                     {"rhombus", PlanShape::Rhombus},
                                     {"square", PlanShape::Square}};
  for (const Known& k : kKnown) {
    if (k.name == figure.spec->name) out.shape = k.shape;
  }
  const auto number = [&](size_t i) {
    return i < figure.values.size() ? figure.values[i].number : 0;
  };
  const auto sides = [](double n) { return static_cast<uint32_t>(std::clamp(n, 3.0, 1000.0)); };
  out.a = out.b = number(0);
  if (out.shape == PlanShape::Rect) out.b = number(1);
  if (out.shape == PlanShape::Circle) out.segments = sides(number(1));
  if (out.shape == PlanShape::Polygon) {
    out.segments = sides(number(0));
    out.a = out.b = number(1);
  }
  return out.a > 0 && out.b > 0 && std::isfinite(out.a + out.b);
}

Status badFigure(const OpCall& call) {
  return call.fail("bad-argument", "a figure needs lengths above zero", "write 1 or more");
}

Smoothing smoothingOf(std::span<const Term> terms) {
  Smoothing s;
  if (terms.size() != 1) return s;
  const Term& t = terms[0];
  const auto times = [](double n) { return static_cast<uint32_t>(std::clamp(n, 0.0, 6.0)); };
  if (t.kind == ArgumentTerm::Kind::Value || t.is("average")) {
    s.kind = Smoothing::Kind::Average;
    s.times = times(t.number(0));
    if (t.is("average")) s.weight = std::clamp(t.number(1), 0.0, 1.0);
  } else if (t.is("chaikin")) {
    s.kind = Smoothing::Kind::Chaikin;
    s.times = times(t.number(0));
  } else if (t.is("bezier")) {
    s.kind = Smoothing::Kind::Bezier;
  } else if (t.is("round")) {
    s.kind = Smoothing::Kind::Round;
    s.radius = std::isfinite(t.number(0)) ? std::max(0.0, t.number(0)) : 1;
  }
  return s;
}

namespace {

// The lines of ranges along logical edges.
void linesOfRanges(OpCall& call, std::vector<LogicalRange> ranges, double inset,
                   const RegionView& view, std::vector<Polyline>& out) {
  // Of a mirrored cell the numbers run the other way.
  const std::optional<CellMark>& cell = view.cell();
  const bool four = view.logicalCount() == 4 && cell;
  const bool mx = four && cell->mirroredX(), my = four && cell->mirroredY();
  uint32_t beyond = 0;
  for (LogicalRange& r : ranges) {
    if (r.logical >= view.logicalCount()) ++beyond;
    if (four && r.logical < 4) r.logical = cell->side(r.logical);
  }
  if (beyond > 0) {
    call.services().warn(
        "range-beyond", "there are more ranges than the region has logical edges",
        "leave out those behind edge " + std::to_string(std::max(1u, view.logicalCount()) - 1));
  }
  const std::vector<uint32_t> logical = view.logicals();
  if (!(inset > 0)) {
    for (Polyline& line : parametrise(view.polygon().outer, logical, ranges, mx == my)) {
      out.push_back(std::move(line));
    }
    return;
  }
  for (const RegionPiece& p : contract(view.polygon(), inset)) {
    std::vector<uint32_t> moved;
    for (size_t i = 0; i < p.polygon.outer.size(); ++i) {
      const uint32_t source = p.edges[i].source;
      moved.push_back(source < logical.size() ? logical[source] : EdgeMark::kNoLogical);
    }
    for (Polyline& line : parametrise(p.polygon.outer, moved, ranges, mx == my)) {
      out.push_back(std::move(line));
    }
  }
}

}  // namespace

namespace {

// Takes the parts of logical edges out of what is joined by ||; the other selections stay.
void divideTerms(std::span<const Term> terms, std::vector<LogicalRange>& ranges,
                 std::vector<Term>& others) {
  using Kind = ArgumentTerm::Kind;
  // Where the expression that ends at each term begins.
  std::vector<size_t> begins;
  for (size_t i = 0; i < terms.size(); ++i) {
    size_t operands = terms[i].kind == Kind::Not    ? 1
                      : terms[i].kind == Kind::Term ? terms[i].operands
                      : terms[i].kind >= Kind::And  ? 2
                                                    : 0;
    size_t begin = i;
    for (; operands > 0; --operands) begin = begins[begin - 1];
    begins.push_back(begin);
  }
  std::vector<size_t> open;
  if (!terms.empty()) open.push_back(terms.size() - 1);
  while (!open.empty()) {
    const size_t end = open.back();
    open.pop_back();
    const Term& t = terms[end];
    if (t.kind == Kind::Or) {
      open.push_back(end - 1);
      open.push_back(begins[end - 1] - 1);
    } else if (t.is("edge")) {
      const double k = std::clamp(std::trunc(t.number(0)), 0.0, 1e6);
      ranges.push_back({static_cast<uint32_t>(k), t.number(1), t.number(2, 1)});
    } else if (t.is("range")) {
      const double a = t.number(0), b = t.number(1);
      for (double k = std::floor(a); k < b && k >= 0 && k < a + 1000; ++k) {
        ranges.push_back({static_cast<uint32_t>(k), std::max(a - k, 0.0), std::min(b - k, 1.0)});
      }
    } else {
      others.insert(others.end(), terms.begin() + static_cast<std::ptrdiff_t>(begins[end]),
                    terms.begin() + static_cast<std::ptrdiff_t>(end) + 1);
      if (others.size() > end - begins[end] + 1) {
        Term join;
        join.kind = Kind::Or;
        others.push_back(join);
      }
    }
  }
}

}  // namespace

Status linesOf(OpCall& call, const Selection& selection, double inset, const RegionJob& job,
               size_t face, std::vector<Polyline>& out) {
  constexpr uint64_t kArguments = 900;
  const RegionView& view = *job.faces()[face];
  const std::vector<Term> terms =
      termsOf(selection, call.services(), call.randomAddress(kArguments));
  std::vector<LogicalRange> ranges;
  std::vector<Term> others;
  divideTerms(terms, ranges, others);
  if (!ranges.empty()) linesOfRanges(call, std::move(ranges), inset, view, out);
  if (others.empty() && !terms.empty()) return {};
  const SelectionInput input{view, call.randomAddress(1000 + face), job.worldIn(face),
                             call.services().pool()};
  for (const Polyline& line : runsOf(view.polygon(), selectEdges(others, input), {})) {
    for (Polyline& moved : insetLines(line, inset)) out.push_back(std::move(moved));
  }
  return {};
}

}  // namespace gable
