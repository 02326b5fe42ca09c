// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The edges that an item selects are joined to lines, which end where the outline turns sharply,
// and each line is measured out. The middle between two sides of a street is found from the longer
// one: every place of it is paired with the nearest place of another. Lines that are the shape's
// own geometry are measured out as they are.
#include <cmath>
#include <limits>
#include <vector>

#include "base/work.h"
#include "builtins/lists.h"
#include "builtins/ops/layout/shared/polylines.h"
#include "builtins/ops/shared/face_plan.h"
#include "builtins/ops/shared/refit.h"
#include "builtins/ops/subdivide/shared/components.h"
#include "geom/curve/curve.h"
#include "geom/mesh/face_plane.h"
#include "geom/region/segment_grid.h"
#include "math/trig.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// Lines end where the outline turns by more degrees than this: rounded corners belong to them.
constexpr double kSharpTurn = 50;
constexpr double kMostPlaces = 100000;
constexpr const char* kStreetTag = "street";
constexpr uint32_t kNoItem = 0xffffffff;

// Edges one after the other in the plane of their face, the face to their left.
struct Chain {
  Line line;
  bool closed = false;
};

struct Layout {
  Spacing spacing;
  double offset = 0;
  /// From a place beside a line to all other lines.
  double clear = 0;
  enum class Facing : uint8_t { Outward, Inward, Along } facing = Facing::Outward;
};

bool isWord(const OpCall& call, const SelectorItem& item, std::string_view word) {
  return item.terms.size() == 1 && item.terms[0].kind == SelectorTerm::Kind::Word &&
         call.services().pool().text(item.terms[0].word) == word;
}

// By corner: the edge that begins there is one of a street. Without tags every edge is.
std::vector<bool> streetEdges(const OpCall& call, const Mesh& m) {
  std::vector<bool> out(m.corners.size(), false);
  bool any = false;
  for (size_t c = 0; c < m.edgeTags.size(); ++c) {
    work();
    out[c] = call.services().tags().has(m.edgeTags[c], kStreetTag);
    any = any || out[c];
  }
  if (!any) out.assign(out.size(), true);
  return out;
}

// By corner: the item that takes the edge; the first of several.
std::vector<uint32_t> itemsOfEdges(OpCall& call, const Mesh& m, const std::vector<bool>& street) {
  std::vector<uint32_t> out(m.corners.size(), kNoItem);
  const Components edges(m, ComponentKind::FaceEdges);
  const Directions directions(call.services(), call.shape());
  const auto count = static_cast<uint32_t>(edges.list().size());
  for (uint32_t i = 0; i < call.selectors().size(); ++i) {
    const SelectorItem& item = call.selectors()[i];
    if (isWord(call, item, "middle")) continue;
    const bool streets = isWord(call, item, "street");
    const Selector selector(item, call.services().pool(), directions);
    for (const Component& c : edges.list()) {
      work();
      if (out[c.corner] != kNoItem) continue;
      const bool taken = streets ? street[c.corner]
                                 : selector.matches(c.what, edges, call.services().tags(), count);
      if (taken) out[c.corner] = i;
    }
  }
  return out;
}

bool turnsSharply(Vec2 before, Vec2 at, Vec2 after) {
  const Vec2 a = normalized(at - before), b = normalized(after - at);
  return dot(a, b) < cosDeg(kSharpTurn);
}

// The chosen edges of a ring as lines, from the first sharp corner or gap on.
void addChains(const Ring& ring, const std::vector<bool>& chosen, std::vector<Chain>& out) {
  const size_t n = ring.size();
  const auto goesOn = [&](size_t i) {
    const size_t before = (i + n - 1) % n;
    return chosen[before] && chosen[i] && !turnsSharply(ring[before], ring[i], ring[(i + 1) % n]);
  };
  size_t first = 0;
  while (first < n && goesOn(first)) ++first;
  if (first == n) {
    out.push_back({ring, true});
    return;
  }
  for (size_t k = 0; k < n; ++k) {
    work();
    const size_t i = (first + k) % n;
    if (!chosen[i]) continue;
    if (!goesOn(i)) out.push_back({{ring[i]}, false});
    out.back().line.push_back(ring[(i + 1) % n]);
  }
}

// A line, ended where it turns sharply.
void addChains(const Polyline2& line, std::vector<Chain>& out) {
  if (line.closed) {
    addChains(line.line, std::vector<bool>(line.line.size(), true), out);
    return;
  }
  out.push_back({{line.line[0]}, false});
  for (size_t i = 1; i < line.line.size(); ++i) {
    if (i > 1 && turnsSharply(line.line[i - 2], line.line[i - 1], line.line[i])) {
      out.push_back({{line.line[i - 1]}, false});
    }
    out.back().line.push_back(line.line[i]);
  }
}

// All rings of a face; `chosen` tells by corner of the mesh.
template <class Chosen>
std::vector<Chain> chainsOf(const Mesh& m, size_t face, const Frame& frame, Chosen&& chosen) {
  std::vector<Chain> out;
  for (const MeshLoop& loop : m.loopsOf(face)) {
    if (loop.cornerCount < 3) continue;
    Ring ring;
    std::vector<bool> mine;
    for (uint32_t i = 0; i < loop.cornerCount; ++i) {
      work();
      const uint32_t corner = loop.firstCorner + i;
      const Vec3 p = frame.toLocal(m.positions[m.corners[corner]]);
      ring.push_back({p.x, p.y});
      mine.push_back(chosen(corner));
    }
    addChains(ring, mine, out);
  }
  return out;
}

std::vector<double> stationsOf(const Path& path, const Spacing& spacing) {
  if (!path.closed()) return stations(path.length(), spacing);
  std::vector<double> out;
  const double count = std::max(1.0, std::nearbyint(path.length() / spacing.step));
  if (!std::isfinite(count) || count > kMostPlaces) return out;
  for (double i = 0; i < count; ++i) out.push_back(path.length() * i / count);
  return out;
}

// Places halfway between the longest line and the nearest of the others.
std::vector<Path::Place> middlePlaces(const std::vector<Chain>& chains, const Spacing& spacing) {
  std::vector<Path> paths;
  for (const Chain& c : chains) paths.emplace_back(c.line, c.closed);
  std::vector<Path::Place> out;
  if (paths.size() < 2) return out;
  size_t longest = 0;
  for (size_t i = 1; i < paths.size(); ++i) {
    if (paths[i].length() > paths[longest].length()) longest = i;
  }
  for (const double s : stationsOf(paths[longest], spacing)) {
    Path::Place place = paths[longest].at(s);
    double best = std::numeric_limits<double>::infinity();
    Vec2 facing = place.point;
    for (size_t i = 0; i < paths.size(); ++i) {
      work(4);
      if (i == longest) continue;
      const Vec2 p = paths[i].at(paths[i].nearest(place.point)).point;
      if (length(p - place.point) >= best) continue;
      best = length(p - place.point);
      facing = p;
    }
    place.point = (place.point + facing) * 0.5;
    out.push_back(place);
  }
  return out;
}

Ref<Mesh> pointMesh() {
  MeshBuilder b;
  const uint32_t p = b.addPosition({});
  b.addPolygon({&p, 1});
  return makeRef<Mesh>(b.take());
}

Vec2 besideOf(const Path::Place& place, double offset) {
  return place.point + Vec2{place.tangent.y, -place.tangent.x} * offset;
}

// Tells which places lie in a junction: too near to a line that is not their own.
class Junctions {
 public:
  Junctions(const std::vector<Polyline2>& lines, const Layout& layout)
      : layout_(layout), segments_(segmentsOf(lines)), grid_(segments_) {}

  bool hold(const Path::Place& place, uint32_t line) {
    if (!(layout_.clear > 0)) return false;
    const Vec2 p = besideOf(place, layout_.offset), around{layout_.clear, layout_.clear};
    Box2 box;
    box.include(p - around);
    box.include(p + around);
    bool near = false;
    grid_.query(box, [&](uint32_t i) {
      near = near || (lineOf_[i] != line && distanceTo(segments_[i], p) < layout_.clear);
    });
    return near;
  }

 private:
  std::vector<Segment> segmentsOf(const std::vector<Polyline2>& lines) {
    std::vector<Segment> out;
    for (uint32_t k = 0; layout_.clear > 0 && k < lines.size(); ++k) {
      const Line& line = lines[k].line;
      for (size_t i = 0; i + (lines[k].closed ? 0 : 1) < line.size(); ++i) {
        work();
        out.push_back({line[i], line[(i + 1) % line.size()]});
        lineOf_.push_back(k);
      }
    }
    return out;
  }

  const Layout& layout_;
  std::vector<uint32_t> lineOf_;
  std::vector<Segment> segments_;
  SegmentGrid grid_;
};

// Gives out one child after the other.
class Emitter {
 public:
  Emitter(OpCall& call, const Layout& layout) : call_(call), layout_(layout) {}

  // Outward is to the right of an edge, and away from a line. `index` is the place's number on its
  // line.
  void emit(const Frame& plane, const Path::Place& place, uint32_t slot, size_t index, size_t total,
            bool ofLine = false) {
    const Vec2 right{place.tangent.y, -place.tangent.x};
    const Vec2 at = besideOf(place, layout_.offset);
    const Vec2 out = ofLine && layout_.offset < 0 ? right * -1.0 : right;
    const Vec2 z = layout_.facing == Layout::Facing::Along    ? place.tangent
                   : layout_.facing == Layout::Facing::Inward ? out * -1.0
                                                              : out;
    const Vec3 facing = plane.direction({z.x, z.y, 0});
    Shape child = call_.shape();
    child.scope = call_.shape().scope *
                  Frame::of(fromPlanFrame(plane, at), cross(plane.z, facing), plane.z, facing);
    child.size = {};
    child.split = {static_cast<uint32_t>(index), static_cast<uint32_t>(total)};
    setMesh(child, point_, ScopeFit::Keep);
    forgetFarTrimPlanes(child);
    call_.emit(std::move(child), slot, piece_++);
  }

  void emit(const Frame& plane, const std::vector<Path::Place>& places, uint32_t slot) {
    for (size_t i = 0; i < places.size(); ++i) emit(plane, places[i], slot, i, places.size());
  }

 private:
  OpCall& call_;
  const Layout& layout_;
  Ref<Mesh> point_ = pointMesh();
  uint32_t piece_ = 0;
};

enum class Fit : uint8_t { Centred, Stretch };

}  // namespace

template <>
struct WordsOf<Fit> {
  static constexpr const char* text = "centred stretch";
};
template <>
struct WordsOf<Layout::Facing> {
  static constexpr const char* text = "outward inward along";
};

namespace {

struct Along {
  double spacing, offset, inset;
  Fit fit;
  Layout::Facing facing;
  double clear;
};

Layout layoutOf(const Along& args) {
  Layout out;
  out.spacing.step = args.spacing;
  out.offset = args.offset;
  out.spacing.startInset = out.spacing.endInset = args.inset;
  out.spacing.stretch = args.fit == Fit::Stretch;
  out.facing = args.facing;
  out.clear = args.clear;
  return out;
}

// What would be made at most; a little more where lines begin and end.
bool tooMany(const Mesh& m, const Spacing& spacing, size_t items) {
  double whole = 0;
  for (size_t f = 0; f < m.faceCount(); ++f) {
    for (const MeshLoop& loop : m.loopsOf(f)) {
      for (uint32_t i = 0; i < loop.cornerCount; ++i) {
        work();
        const uint32_t next = loop.firstCorner + (i + 1) % loop.cornerCount;
        whole +=
            length(m.positions[m.corners[next]] - m.positions[m.corners[loop.firstCorner + i]]);
      }
    }
  }
  return !(whole / spacing.step * static_cast<double>(items) <= kMostPlaces);
}

std::vector<Path::Place> placesOn(const Chain& chain, const Spacing& spacing) {
  const Path path(chain.line, chain.closed);
  std::vector<Path::Place> out;
  for (const double s : stationsOf(path, spacing)) out.push_back(path.at(s));
  return out;
}

// Along lines every item gets its places; `sides` gets those to the right, then those to the left,
// where the line is seen from its other end.
void emitAlongLines(OpCall& call, const Mesh& mesh, const Layout& layout, Emitter& emitter) {
  const auto lines = polylinesOf(mesh, call.services().tags());
  Junctions junctions(lines, layout);
  for (uint32_t k = 0; k < lines.size(); ++k) {
    const Polyline2& line = lines[k];
    const Frame plane = groundAt(line.height);
    std::vector<Chain> chains;
    addChains(line, chains);
    for (const SelectorItem& item : call.selectors()) {
      const bool sides = isWord(call, item, "sides");
      for (const Chain& chain : chains) {
        const std::vector<Path::Place> places = placesOn(chain, layout.spacing);
        for (size_t i = 0; i < places.size(); ++i) {
          work(8);
          if (junctions.hold(places[i], k)) continue;
          emitter.emit(plane, places[i], item.slot, i, places.size(), true);
        }
        for (size_t i = 0; sides && i < places.size(); ++i) {
          work(8);
          const Path::Place back{places[i].point, places[i].tangent * -1.0};
          if (junctions.hold(back, k)) continue;
          emitter.emit(plane, back, item.slot, i, places.size(), true);
        }
      }
    }
  }
}

Status applyAlong(OpCall& call, const Along& args) {
  const Layout layout = layoutOf(args);
  const MeshRef mesh = meshInScope(call.shape());
  if (mesh->faceCount() == 0) {
    return call.fail("no-geometry", "the shape has no edges to place things along",
                     "start from a footprint, or insert a primitive first");
  }
  if (tooMany(*mesh, layout.spacing, call.selectors().size())) {
    return call.fail("along-too-many", "along would make more than 100000 shapes",
                     "give a larger spacing, or divide the shape first");
  }
  const std::vector<bool> street = streetEdges(call, *mesh);
  const std::vector<uint32_t> items = itemsOfEdges(call, *mesh, street);
  Emitter emitter(call, layout);
  for (size_t f = 0; f < mesh->faceCount(); ++f) {
    if (mesh->normal(f) == Vec3{}) continue;
    const Frame plane = planFrame(*mesh, f);
    for (uint32_t i = 0; i < call.selectors().size(); ++i) {
      const SelectorItem& item = call.selectors()[i];
      if (isWord(call, item, "middle")) {
        const auto sides =
            chainsOf(*mesh, f, plane, [&](uint32_t corner) -> bool { return street[corner]; });
        emitter.emit(plane, middlePlaces(sides, layout.spacing), item.slot);
        continue;
      }
      const auto mine = [&](uint32_t corner) { return items[corner] == i; };
      for (const Chain& c : chainsOf(*mesh, f, plane, mine)) {
        emitter.emit(plane, placesOn(c, layout.spacing), item.slot);
      }
    }
  }
  emitAlongLines(call, *mesh, layout, emitter);
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&Along::spacing>("spacing", "From one place to the next along the edges, in metres.")
        .above(0),
    param<&Along::offset>("offset",
                          "How far beside the edge: outwards, inwards where negative. Of a line: "
                          "to its right, to its "
                          "left where negative.",
                          "0"),
    param<&Along::inset>("inset", "Kept free at both ends of each line of edges.", "0").atLeast(0),
    param<&Along::fit>(
        "fit",
        "centred shares what is left over between both ends; stretch makes the spacing a little "
        "longer "
        "or shorter, so that both ends are met.",
        "centred"),
    param<&Along::facing>("facing", "Where z points: outward across the edge, inward, or along it.",
                          "outward"),
    param<&Along::clear>("clear",
                         "Beside lines: places that are nearer than so many metres to another "
                         "line of the shape, as in junctions, are left out.",
                         "0")
        .atLeast(0),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr PartSpec kParts[] = {
    {"street", "Edges along a street."},
    {"middle", "Half-way between two edges along streets: the middle of a roadway."},
    {"sides", "Both sides of a line."}};
constexpr OpSpec kSpecs[] = {
    withFaces({"along", "layout",
               "Gives out places along the edges of the faces, at equal spacing.", kSignatures,
               typed<applyAlong>, BlockKind::Selectors, kReadsWorld | kReadsWorldByWord, kParts,
               false, true}),
};

}  // namespace

extern const OpList kOps_along;
const OpList kOps_along = kSpecs;

}  // namespace gable
