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

std::string textOf(const OpCall& call, size_t argument, std::string_view otherwise) {
  if (!call.has(argument)) return std::string(otherwise);
  const Value& v = call.arg(argument);
  if (v.type == ValueType::Float) return shortestText(v.number);
  if (v.type == ValueType::String || v.type == ValueType::Selector) {
    return std::string(call.text(argument));
  }
  return std::string(otherwise);
}

Status optionsAre(const OpCall& call, size_t argument, std::string_view known) {
  std::string problem;
  if (checkOptions(textOf(call, argument, ""), known, problem)) return {};
  std::string hint;
  for (const char c : known) hint += c == ' ' ? std::string(", ") : std::string(1, c);
  return call.fail("bad-argument", problem, "options are " + hint);
}

Status noOneRegion(OpCall& call) {
  return failOrElse(call, "no-geometry", "the faces of the shape do not lie in one plane",
                    "take it apart first: comp(f) { all : ... }");
}

Status noRegion(OpCall& call) {
  // What went to an otherwise before is at its end.
  if (call.shape().geometry.kind == GeometryKind::None &&
      call.spec().block == BlockKind::Operations) {
    return {};
  }
  return failOrElse(call, "no-geometry", "the shape has no face that could be divided",
                    "begin with a lot or a face");
}

Status selected(OpCall& call, size_t argument, std::string_view otherwise, const RegionJob& job,
                size_t face, const RegionView& view, std::vector<EdgePart>& out) {
  return selectedBy(call, textOf(call, argument, otherwise), job, face, view, out);
}

Status selectedBy(OpCall& call, std::string_view selection, const RegionJob& job, size_t face,
                  const RegionView& view, std::vector<EdgePart>& out) {
  std::string problem;
  const SelectionInput input{view, call.randomAddress(1000 + face), job.worldIn(face)};
  if (selectEdges(selection, input, out, problem)) return {};
  return call.fail("bad-selection", "the selection cannot be read: " + problem,
                   "write words like outer, inner, side(W), longest, with & | - !");
}

Status discsOf(OpCall& call, size_t argument, const RegionView& view, uint64_t seed,
               std::vector<Disc>& out) {
  const Value& v = call.arg(argument);
  const Vec3 origin = view.plane().frame().toLocal({});
  const Vec2 o{origin.x, origin.y};
  if (v.type == ValueType::FloatArray) {
    const Array& a = call.services().pool().array(v);
    for (size_t i = 0; i + 1 < a.numbers.size(); i += 2) {
      out.push_back({Vec2{a.numbers[i], a.numbers[i + 1]} + o, 0});
    }
    return {};
  }
  if (v.type == ValueType::String && readPoints(call.text(argument), out)) {
    for (Disc& d : out) d.centre = d.centre + bounds(view.polygon()).min;
    return {};
  }
  out.clear();
  ScatterOptions options;
  options.seed = seed;
  TextReader r(call.services().pool().text(v.id));
  double n = v.number;
  DrawnRange radius;
  if (v.type == ValueType::String) {
    bool ok = r.number(n);
    if (ok && r.accept('{')) ok = r.range(radius) && r.accept('}');
    if (!ok || !r.atEnd()) {
      return call.fail(
          "bad-argument", "these are no discs to scatter",
          "write a number and a radius, \"5 {[5,10]}\", or places, \"(3, 4) (10, 4)\"");
    }
  }
  constexpr double kMostDiscs = 5000;
  if (!(n >= 0 && n <= kMostDiscs) || !(radius.low >= 0) || !std::isfinite(radius.high)) {
    return call.fail("bad-argument", "there can be 0 to 5000 discs of radii above zero",
                     "scatter fewer");
  }
  options.count = static_cast<uint32_t>(n);
  options.least = std::min(radius.low, radius.high);
  options.most = std::max(radius.low, radius.high);
  out = scatterDiscs(view.polygon(), options);
  return {};
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

Status linesOf(OpCall& call, size_t argument, double inset, const RegionJob& job, size_t face,
               const RegionView& view, std::vector<Polyline>& out) {
  const std::string text = textOf(call, argument, "");
  for (size_t begin = 0; begin <= text.size();) {
    size_t end = begin;
    for (int depth = 0; end < text.size() && (depth > 0 || text[end] != ';'); ++end) {
      depth += text[end] == '(' ? 1 : text[end] == ')' ? -1 : 0;
    }
    const std::string part = text.substr(begin, end - begin);
    begin = end + 1;
    std::vector<LogicalRange> ranges;
    if (readRanges(part, ranges)) {
      linesOfRanges(call, std::move(ranges), inset, view, out);
      continue;
    }
    std::vector<EdgePart> parts;
    const Status status = selectedBy(call, part.empty() ? "all" : part, job, face, view, parts);
    if (!status.ok()) return status;
    for (const Polyline& line : runsOf(view.polygon(), parts, {})) {
      for (Polyline& moved : insetLines(line, inset)) out.push_back(std::move(moved));
    }
  }
  return {};
}

}  // namespace gable
