// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// New axes for the scope, from the world, from a face and an edge, or from the smallest rectangle
// around the geometry. In each case the scope becomes the bounding box along them and the pivot
// goes to its origin; the geometry stays where it is.
//
// The smallest rectangle has a side along an edge of the convex hull (Freeman, Shapira 1975), so
// each hull edge is tried.

#include <algorithm>
#include <string>

#include "builtins/lists.h"
#include "builtins/ops/shared/frames.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// Heights and lengths that differ by less than this are equal; the first component then wins.
constexpr double kSameHeight = 1e-6;

void align(Shape& s, const Frame& axes) {
  realignScope(s, axes);
  s.pivot = s.scope;
}

Frame axesOf(const Vec3& x, const Vec3& y, const Vec3& z) { return Frame::of({}, x, y, z); }

// The part of `v` across the unit vector `axis`, as a unit vector; `otherwise` when v is along it.
Vec3 across(const Vec3& v, const Vec3& axis, const Vec3& otherwise) {
  const Vec3 part = v - axis * dot(v, axis);
  return length(part) > 1e-9 ? normalized(part) : otherwise;
}

struct AlignToAxes {
  Word axes;
};

Status applyToAxes(OpCall& call, const AlignToAxes& args) {
  Shape& s = call.shape();
  std::string_view word = args.axes.text;
  Frame to = worldFrame(call.services());
  if (word.starts_with("object")) to = objectFrame(call.services());
  if (const size_t dot = word.find('.'); dot != std::string_view::npos) word.remove_prefix(dot + 1);
  if (word == "x") {
    const Vec3 z = across(s.scope.z, to.x, to.z);
    align(s, axesOf(to.x, cross(z, to.x), z));
  } else if (word == "y") {
    const Vec3 x = across(s.scope.x, to.y, to.x);
    align(s, axesOf(x, to.y, cross(x, to.y)));
  } else if (word == "z") {
    const Vec3 x = across(s.scope.x, to.z, to.x);
    align(s, axesOf(x, cross(to.z, x), to.z));
  } else {
    align(s, to);
  }
  return {};
}

// A face and one of its edges (counted over all loops of the face).
struct Pick {
  size_t face = 0;
  size_t edge = 0;
};

struct EdgeEnds {
  Vec3 a, b;
};

size_t edgeCount(const Mesh& m, size_t face) {
  size_t n = 0;
  for (const MeshLoop& loop : m.loopsOf(face)) n += loop.cornerCount;
  return n;
}

EdgeEnds edgeOf(const Mesh& m, size_t face, size_t edge) {
  for (const MeshLoop& loop : m.loopsOf(face)) {
    if (edge < loop.cornerCount) {
      const auto next = static_cast<uint32_t>((edge + 1) % loop.cornerCount);
      return {m.at(loop.firstCorner + static_cast<uint32_t>(edge)), m.at(loop.firstCorner + next)};
    }
    edge -= loop.cornerCount;
  }
  return {};
}

// An index from any number: counted from the end when negative.
size_t wrapped(double index, size_t count) {
  const double n = static_cast<double>(count);
  double i = std::fmod(std::trunc(index), n);
  if (!(i > -n && i < n)) i = 0;
  return static_cast<size_t>(i < 0 ? i + n : i);
}

double meanHeight(const Mesh& m, size_t face, const Vec3& up) {
  double sum = 0;
  const auto ring = m.cornersOf(m.loopsOf(face)[0]);
  for (const uint32_t p : ring) sum += dot(m.positions[p], up);
  return sum / static_cast<double>(ring.size());
}

class Picker {
 public:
  Picker(const Mesh& mesh, const Vec3& up) : m_(mesh), up_(up) {}

  size_t lowestFace() const {
    return best([&](size_t f) { return -meanHeight(m_, f, up_); });
  }
  size_t largestFace() const {
    return best([&](size_t f) { return m_.area(f); });
  }
  // The first face whose normal points most along `d`.
  size_t faceTowards(const Vec3& d) const {
    return best([&](size_t f) { return dot(m_.normal(f), d); });
  }
  // The greatest of an edge measure on one face, or on all.
  Pick lowestEdge(bool anyFace, size_t face) const {
    return bestEdge(anyFace, face, [&](const EdgeEnds& e) { return -dot(e.a + e.b, up_) * 0.5; });
  }
  Pick longestEdge(bool anyFace, size_t face) const {
    return bestEdge(anyFace, face, [&](const EdgeEnds& e) { return length(e.b - e.a); });
  }
  bool levelEdges() const {
    double lo = 0, hi = 0;
    bool first = true;
    for (size_t f = 0; f < m_.faceCount(); ++f) {
      for (size_t e = 0; e < edgeCount(m_, f); ++e) {
        const EdgeEnds ends = edgeOf(m_, f, e);
        const double h = dot(ends.a + ends.b, up_) * 0.5;
        lo = first ? h : std::min(lo, h);
        hi = first ? h : std::max(hi, h);
        first = false;
      }
    }
    return hi - lo <= kSameHeight;
  }

 private:
  template <class F>
  size_t best(F measure) const {
    size_t at = 0;
    double value = measure(0);
    for (size_t f = 1; f < m_.faceCount(); ++f) {
      const double v = measure(f);
      if (v > value + kSameHeight) {
        value = v;
        at = f;
      }
    }
    return at;
  }
  template <class F>
  Pick bestEdge(bool anyFace, size_t face, F measure) const {
    Pick pick{face, 0};
    double value = 0;
    bool none = true;
    for (size_t f = anyFace ? 0 : face; f < (anyFace ? m_.faceCount() : face + 1); ++f) {
      for (size_t e = 0; e < edgeCount(m_, f); ++e) {
        const double v = measure(edgeOf(m_, f, e));
        if (none || v > value + kSameHeight) {
          value = v;
          pick = {f, e};
          none = false;
        }
      }
    }
    return pick;
  }

  const Mesh& m_;
  const Vec3& up_;
};

// The direction that an orientation word names, in the local frame; zero for other words.
Vec3 directionNamed(std::string_view word, const Frame& scope) {
  if (word == "front") return scope.z;
  if (word == "back") return -scope.z;
  if (word == "right") return scope.x;
  if (word == "left") return -scope.x;
  if (word == "top") return scope.y;
  if (word == "bottom") return -scope.y;
  return {};
}

// The first face that stands more upright than it lies.
size_t sideFace(const Mesh& m, const Vec3& up) {
  for (size_t f = 0; f < m.faceCount(); ++f) {
    if (std::fabs(dot(m.normal(f), up)) < 0.5) return f;
  }
  return 0;
}

enum class UpAxis : uint8_t { Y, Z };
enum class FaceWord : uint8_t { Lowest, Largest, Any };
enum class EdgeWord : uint8_t { Lowest, Longest };

}  // namespace

template <>
struct WordsOf<UpAxis> {
  static constexpr const char* text = "yUp zUp";
};
template <>
struct WordsOf<FaceWord> {
  static constexpr const char* text = "world.lowest largest any";
};
template <>
struct WordsOf<EdgeWord> {
  static constexpr const char* text = "world.lowest longest";
};

namespace {

// A face and an edge, each by a number or by a word. The old form has a word of its own, or the
// number of a face without an edge.
struct AlignToGeometry {
  UpAxis up;
  std::optional<double> faceIndex, edgeIndex;
  FaceWord face;
  std::optional<EdgeWord> edge;
  std::optional<Word> oldFace;
};

Pick pickOldFace(std::string_view word, const Picker& picker, const Mesh& m, const Frame& scope) {
  if (word == "auto") {
    return picker.levelEdges() ? picker.longestEdge(true, 0) : picker.lowestEdge(true, 0);
  }
  size_t face = 0;
  if (word == "largest")
    face = picker.largestFace();
  else if (word == "world.lowest")
    face = picker.lowestFace();
  else if (word == "side")
    face = sideFace(m, scope.y);
  else if (const Vec3 d = directionNamed(word, scope); d != Vec3{})
    face = picker.faceTowards(d);
  return {face, 0};
}

Pick pick(const AlignToGeometry& args, const Picker& picker, const Mesh& m, const Frame& scope) {
  if (args.oldFace) return pickOldFace(args.oldFace->text, picker, m, scope);
  const bool any = !args.faceIndex && args.face == FaceWord::Any;
  size_t face = 0;
  if (args.faceIndex)
    face = wrapped(*args.faceIndex, m.faceCount());
  else if (args.face == FaceWord::Largest)
    face = picker.largestFace();
  else if (!any)
    face = picker.lowestFace();
  if (args.edgeIndex) return {face, wrapped(*args.edgeIndex, edgeCount(m, face))};
  if (!args.edge) return {face, 0};
  return args.edge == EdgeWord::Longest ? picker.longestEdge(any, face)
                                        : picker.lowestEdge(any, face);
}

// Only the lowest face and the lowest edge ask which way is up.
bool asksForUp(const AlignToGeometry& args) {
  if (args.oldFace) return *args.oldFace == "auto" || *args.oldFace == "world.lowest";
  const bool lowestFace = !args.faceIndex && args.face == FaceWord::Lowest;
  return lowestFace || args.edge == EdgeWord::Lowest;
}

Status applyToGeometry(OpCall& call, const AlignToGeometry& args) {
  Shape& s = call.shape();
  if (s.geometry.kind == GeometryKind::None) {
    s.pivot = s.scope;
    return {};
  }
  const Mesh mesh = meshInLocal(s);
  const Vec3 up = asksForUp(args) ? worldFrame(call.services()).y : Vec3{};
  const Picker picker(mesh, up);
  const Pick at = pick(args, picker, mesh, s.scope);
  const EdgeEnds ends = edgeOf(mesh, at.face, at.edge);

  // Points and edges have no normal of their own; their scope has one, which is z.
  Vec3 normal = mesh.normal(at.face);
  const bool flat = normal == Vec3{};
  if (flat) normal = across(s.scope.z, normalized(ends.b - ends.a), s.scope.y);
  const Vec3 x = across(ends.b - ends.a, normal, across(s.scope.x, normal, s.scope.y));
  const bool zUp = args.up == UpAxis::Z;
  align(s, zUp ? axesOf(x, cross(normal, x), normal) : axesOf(x, normal, cross(x, normal)));
  return {};
}

// The convex hull of plane points, counter-clockwise (Andrew's monotone chain).
std::vector<Vec2> hullOf(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vec2> hull;
  const auto add = [&](Vec2 p, size_t floor) {
    while (hull.size() > floor &&
           cross(hull[hull.size() - 1] - hull[hull.size() - 2], p - hull[hull.size() - 1]) <= 0) {
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const Vec2 p : points) add(p, 1);
  const size_t floor = hull.size();
  for (size_t i = points.size() - 1; i-- > 0;) add(points[i], floor);
  hull.pop_back();
  return hull;
}

// The direction of the longer side of the smallest rectangle around the points, as near to +x as
// it can be chosen.
Vec2 longSideOf(const std::vector<Vec2>& points) {
  const std::vector<Vec2> hull = hullOf(points);
  Vec2 direction{1, 0};
  double area = -1;
  for (size_t i = 0; i < hull.size(); ++i) {
    const Vec2 d = normalized(hull[(i + 1) % hull.size()] - hull[i]);
    if (d == Vec2{}) continue;
    Box2 box;
    for (const Vec2 p : hull) box.include({dot(p, d), dot(p, perpendicular(d))});
    const Vec2 size = box.size();
    Vec2 along = size.x >= size.y ? d : perpendicular(d);
    if (std::fabs(size.x - size.y) <= 1e-9 * (size.x + size.y) && std::fabs(d.x) < std::fabs(d.y)) {
      along = perpendicular(d);
    }
    if (along.x < 0 || (along.x == 0 && along.y < 0)) along = -along;
    const double a = size.x * size.y;
    const bool smaller = area < 0 || a < area * (1 - 1e-9);
    const bool same = !smaller && a <= area * (1 + 1e-9);
    if (smaller || (same && along.x > direction.x + 1e-9)) {
      if (smaller) area = a;
      direction = along;
    }
  }
  return direction;
}

struct AlignToBox {
  Word axes;
};

Status applyToBBox(OpCall& call, const AlignToBox& args) {
  Shape& s = call.shape();
  if (s.geometry.kind == GeometryKind::None) {
    s.pivot = s.scope;
    return {};
  }
  const std::string_view word = args.axes.text;
  const Vec3* const axes[3] = {&s.scope.x, &s.scope.y, &s.scope.z};
  const size_t first = word.empty() ? 0 : static_cast<size_t>(word[0] - 'x');
  const size_t second = word.size() < 2 ? 2 : static_cast<size_t>(word[1] - 'x');
  if (first > 2 || second > 2 || first == second) {
    return call.fail("unknown-selector",
                     "alignScopeToGeometryBBox knows no axes '" + std::string(word) + "'",
                     "use xy, yx, xz, zx, yz or zy");
  }
  const size_t fixed = 3 - first - second;
  const Mesh mesh = meshInLocal(s);
  std::vector<Vec2> points;
  points.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions) {
    const Vec3 d = p - s.scope.origin;
    points.push_back({dot(d, *axes[first]), dot(d, *axes[second])});
  }
  const Vec2 along = longSideOf(points);
  Vec3 made[3];
  made[fixed] = *axes[fixed];
  made[first] = *axes[first] * along.x + *axes[second] * along.y;
  // The remaining axis closes the right-handed cycle x, y, z.
  made[second] =
      (first + 1) % 3 == second ? cross(made[fixed], made[first]) : cross(made[first], made[fixed]);
  align(s, axesOf(made[0], made[1], made[2]));
  return {};
}

constexpr ParamSpec kAxesParams[] = {
    param<&AlignToAxes::axes>(
        "alignAxes",
        "The axis of the world or the object that the scope takes over; xyz takes all three. A "
        "word "
        "without a system means the world's.",
        "world.xyz",
        "x y z xyz world.x world.y world.z world.xyz object.x object.y object.z object.xyz"),
};
constexpr Signature kAxesSignatures[] = {{kAxesParams}};

constexpr ParamSpec kUpAxis = param<&AlignToGeometry::up>(
    "upAxis", "The axis of the scope that becomes the normal of the face.");
constexpr ParamSpec kFaceIndex = param<&AlignToGeometry::faceIndex>(
    "faceIndex", "The face, counted from 0; negative counts from the last.");
constexpr ParamSpec kFaceWord = param<&AlignToGeometry::face>(
    "faceSelector",
    "The lowest or the largest face, or any: the one of the edge that the next argument finds.");
constexpr ParamSpec kEdgeIndex = param<&AlignToGeometry::edgeIndex>(
    "edgeIndex",
    "The edge of the face that the x axis follows, from 0; negative "
    "counts from the last.");
constexpr ParamSpec kEdgeWord =
    param<&AlignToGeometry::edge>("edgeSelector", "The lowest or the longest edge.");
constexpr ParamSpec kLegacyWord = param<&AlignToGeometry::oldFace>(
    "face",
    "Old form: auto takes the lowest edge of all, any other word the first edge of such a face.",
    nullptr, "auto side front back left right top bottom world.lowest largest");
constexpr ParamSpec kIndexIndex[] = {kUpAxis, kFaceIndex, kEdgeIndex};
constexpr ParamSpec kWordIndex[] = {kUpAxis, kFaceWord, kEdgeIndex};
constexpr ParamSpec kIndexWord[] = {kUpAxis, kFaceIndex, kEdgeWord};
constexpr ParamSpec kWordWord[] = {kUpAxis, kFaceWord, kEdgeWord};
constexpr ParamSpec kLegacyIndexParams[] = {kUpAxis, kFaceIndex};
constexpr ParamSpec kLegacyWordParams[] = {kUpAxis, kLegacyWord};
constexpr Signature kGeometrySignatures[] = {{kIndexIndex},        {kWordIndex},
                                             {kIndexWord},         {kWordWord},
                                             {kLegacyIndexParams}, {kLegacyWordParams}};

constexpr ParamSpec kBBoxParams[] = {
    param<&AlignToBox::axes>(
        "alignAxes", "The two axes that turn; the first follows the longer side of the rectangle.",
        nullptr, "xy yx xz zx yz zy"),
};
constexpr Signature kBBoxSignatures[] = {{kBBoxParams}};

constexpr OpSpec kSpecs[] = {
    {"alignScopeToAxes", "scope",
     "Gives the scope the directions of the world or the object and fits it around the geometry.",
     kAxesSignatures, typed<applyToAxes>, BlockKind::None, kReadsWorld},
    {"alignScopeToGeometry", "scope",
     "Gives the scope axes from the normal of a face and one of its edges, and fits it around the "
     "geometry.",
     kGeometrySignatures, typed<applyToGeometry>, BlockKind::None, kReadsWorld | kReadsWorldByWord},
    {"alignScopeToGeometryBBox", "scope",
     "Turns two axes of the scope so that they span the smallest rectangle around the geometry.",
     kBBoxSignatures, typed<applyToBBox>},
};

}  // namespace

extern const OpList kOps_align_scope;
const OpList kOps_align_scope = kSpecs;

}  // namespace gable
