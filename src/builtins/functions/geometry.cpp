// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Measures of the shape's geometry at its present size. Boxes and rectangles are answered without
// making a mesh where rules ask most: areas and counts.

#include <algorithm>
#include <cmath>
#include <optional>

#include "builtins/lists.h"
#include "builtins/ops/shared/edit_mesh.h"
#include "builtins/ops/shared/frames.h"
#include "builtins/ops/subdivide/shared/uv_extent.h"
#include "builtins/selection.h"
#include "builtins/shared/arrays.h"
#include "builtins/shared/materials.h"
#include "geom/mesh/topology.h"
#include "math/trig.h"
#include "program/tag_effects.h"
#include "shape/op_call.h"

namespace gable {

namespace {

Value number(size_t v) { return Value::of(static_cast<double>(v)); }

// The way that faces look; empty where all of them are meant.
struct Orientation {
  Word word;
};

// A measure that differs by rounding alone from a number of few decimals, such as an author thinks
// of, is that number: 300, where the sum over the faces is 299.9999999999999.
Value measure(double v) {
  constexpr double kDecimals = 1e6, kRounding = 1e-14;
  const double near = std::nearbyint(v * kDecimals) / kDecimals;
  return Value::of(std::fabs(near - v) <= kRounding * std::fabs(v) ? near : v);
}

// The sides of a shape; where a selector asks, those of the shape whose component this one is.
class Sides {
 public:
  explicit Sides(const FunctionCall& call)
      : shape_(call.shape()),
        asked_(call.services().divided() ? *call.services().divided() : call.shape()),
        mesh_(meshInScope(shape_)),
        directions_(call.services(), asked_) {}

  const Mesh& mesh() const { return *mesh_; }
  bool has(std::string_view word, size_t face) const {
    if (word == "all" || word == "surface") return true;
    std::vector<Vec3> outline;
    for (const uint32_t p : mesh_->cornersOf(mesh_->loopsOf(face)[0])) {
      outline.push_back(inAsked(mesh_->positions[p]));
    }
    const Vec3 normal = inAskedDirection(normalOf(face));
    return selectsDirection(word, normal, outline, mesh_->faces[face].tags, directions_);
  }

 private:
  // Edges and vertices look where their normals point.
  Vec3 normalOf(size_t face) const {
    const Vec3 normal = mesh_->areaNormal(face);
    const MeshLoop& loop = mesh_->loopsOf(face)[0];
    const bool flat = normal != Vec3{} || loop.cornerCount > 2 || mesh_->normals.empty();
    return flat ? normal : mesh_->normals[loop.firstCorner];
  }
  bool isAsked() const { return &asked_ == &shape_; }
  Vec3 inAsked(const Vec3& p) const {
    return isAsked() ? p : asked_.scope.toLocal(shape_.scope.point(p));
  }
  Vec3 inAskedDirection(const Vec3& d) const {
    return isAsked() ? d : asked_.scope.toLocalDirection(shape_.scope.direction(d));
  }

  const Shape& shape_;
  const Shape& asked_;
  MeshRef mesh_;
  Directions directions_;
};

double plainArea(const Shape& s) {
  const double x = std::fabs(s.size.x), y = std::fabs(s.size.y), z = std::fabs(s.size.z);
  switch (s.geometry.kind) {
    case GeometryKind::None: return 0;
    case GeometryKind::QuadXy: return x * y;
    case GeometryKind::QuadXz: return x * z;
    case GeometryKind::Box: return 2 * (x * y + y * z + z * x);
    case GeometryKind::Mesh: break;
  }
  return meshInScope(s)->area();
}

Value area(FunctionCall& call, const Orientation& args) {
  const Shape& s = call.shape();
  if (args.word.text.empty()) return measure(plainArea(s));
  const Sides sides(call);
  double sum = 0;
  for (size_t f = 0; f < sides.mesh().faceCount(); ++f) {
    if (sides.has(args.word.text, f)) sum += sides.mesh().area(f);
  }
  return measure(sum);
}

Value isOriented(FunctionCall& call, const Orientation& args) {
  const Sides sides(call);
  for (size_t f = 0; f < sides.mesh().faceCount(); ++f) {
    if (sides.has(args.word.text, f)) return Value::of(true);
  }
  return Value::of(false);
}

// The mean normal in the world; that of the first face where faces cancel each other out, and the
// z axis of the scope where there is none (points, edges).
Vec3 worldNormal(FunctionCall& call) {
  const Shape& s = call.shape();
  const MeshRef m = meshInScope(s);
  Vec3 sum;
  double total = 0;
  for (size_t f = 0; f < m->faceCount(); ++f) {
    sum += m->areaNormal(f);
    total += length(m->areaNormal(f));
  }
  if (length(sum) <= 1e-9 * total) sum = m->empty() ? Vec3{} : m->areaNormal(0);
  if (sum == Vec3{}) sum = {0, 0, 1};
  return normalized(call.services().world().direction(s.scope.direction(sum)));
}

struct Angle {
  Word type;
};

Value angle(FunctionCall& call, const Angle& args) {
  const Vec3 n = worldNormal(call);
  const double across = std::sqrt(n.x * n.x + n.z * n.z);
  const double slope = atan2Deg(across, std::fabs(n.y));
  if (args.type == "maxSlope") return Value::of(slope);
  if (args.type == "zenith") return Value::of(90 - slope);
  // Downhill is where the upper side of the surface leans to; north is -z.
  if (across <= 1e-12) return Value::of(0.0);
  const double side = n.y < 0 ? -1 : 1;
  const double azimuth = atan2Deg(side * n.x, -side * n.z);
  return Value::of(azimuth < 0 ? azimuth + 360 : azimuth + 0.0);
}

Value height(FunctionCall& call) {
  const Shape& s = call.shape();
  if (s.geometry.kind == GeometryKind::None) return Value::of(0.0);
  const Vec3 up = s.scope.toLocalDirection(worldFrame(call.services()).y);
  const MeshRef m = meshInScope(s);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& p : m->positions) {
    low = std::min(low, dot(p, up));
    high = std::max(high, dot(p, up));
  }
  return Value::of(std::max(high - low, 0.0));
}

// How high the lowest of the edges that stand reaches: of a wall under a slope, its lower side. The
// whole height where no edge stands.
Value lowerHeight(FunctionCall& call) {
  constexpr double kStanding = 0.7071;  // Steeper than 45 degrees.
  const Shape& s = call.shape();
  if (s.geometry.kind == GeometryKind::None) return Value::of(0.0);
  const Vec3 up = s.scope.toLocalDirection(worldFrame(call.services()).y);
  const MeshRef m = meshInScope(s);
  double bottom = std::numeric_limits<double>::infinity(), lowest = bottom;
  for (const Vec3& p : m->positions) bottom = std::min(bottom, dot(p, up));
  for (const MeshLoop& loop : m->loops) {
    for (uint32_t c = 0; c < loop.cornerCount; ++c) {
      const Vec3& a = m->positions[m->corners[loop.firstCorner + c]];
      const Vec3& b = m->positions[m->corners[loop.firstCorner + (c + 1) % loop.cornerCount]];
      if (std::fabs(dot(b - a, up)) < kStanding * length(b - a)) continue;
      lowest = std::min(lowest, std::max(dot(a, up), dot(b, up)));
    }
  }
  return std::isfinite(lowest) ? Value::of(lowest - bottom) : height(call);
}

Value nVertices(FunctionCall& call) { return number(countsOf(call.shape().geometry).vertices); }
Value nEdges(FunctionCall& call) { return number(countsOf(call.shape().geometry).edges); }
Value nFaces(FunctionCall& call) { return number(countsOf(call.shape().geometry).faces); }
Value nHoles(FunctionCall& call) { return number(countsOf(call.shape().geometry).holes); }

Value volumeOf(FunctionCall& call) {
  const Shape& s = call.shape();
  if (s.geometry.kind == GeometryKind::Box) {
    return measure(std::fabs(s.size.x * s.size.y * s.size.z));
  }
  if (s.geometry.kind != GeometryKind::Mesh) return Value::of(0.0);
  return measure(std::fabs(volume(*meshInScope(s))));
}

Value boundary(FunctionCall& call) { return measure(boundaryLength(*meshInScope(call.shape()))); }

Value isClosed(FunctionCall& call) {
  const GeometryKind kind = call.shape().geometry.kind;
  if (kind != GeometryKind::Mesh) return Value::of(kind == GeometryKind::Box);
  return Value::of(Topology(*call.shape().geometry.mesh).closed());
}

Value isConcaveOf(FunctionCall& call) {
  if (call.shape().geometry.kind != GeometryKind::Mesh) return Value::of(false);
  return Value::of(isConcave(*meshInScope(call.shape())));
}

struct Tolerance {
  double degrees = 0;
};

Value isPlanarOf(FunctionCall& call, const Tolerance& args) {
  const GeometryKind kind = call.shape().geometry.kind;
  if (kind != GeometryKind::Mesh) return Value::of(kind != GeometryKind::None);
  return Value::of(isPlanar(*meshInScope(call.shape()), args.degrees));
}

Value isRectangularOf(FunctionCall& call, const Tolerance& args) {
  const GeometryKind kind = call.shape().geometry.kind;
  if (kind != GeometryKind::Mesh) return Value::of(kind != GeometryKind::None);
  return Value::of(isRectangular(*meshInScope(call.shape()), args.degrees));
}

Value isInstanced(FunctionCall& call) { return Value::of(call.shape().geometry.instanced); }

struct UvSet {
  std::optional<double> number;
  Word units;
};

// The uv set of an argument, 0 without one; false when the shape has no such coordinates.
bool uvSet(const Shape& shape, const UvSet& args, int& set) {
  const double v = args.number.value_or(0);
  set = v >= 0 && v < kUvSets ? static_cast<int>(v) : -1;
  return set >= 0 && hasUvSet(shape, set);
}

template <int coordinate>
Value uvRange(FunctionCall& call, const UvSet& args) {
  int set = 0;
  if (!uvSet(call.shape(), args, set)) return Value::of(0.0);
  const UvExtent e = uvExtent(*meshInScope(call.shape()), set, coordinate);
  return Value::of(args.units == "unitSpace" ? e.metres : e.max - e.min);
}

template <int coordinate, bool upper>
Value uvBound(FunctionCall& call, const UvSet& args) {
  int set = 0;
  if (!uvSet(call.shape(), args, set)) return Value::of(0.0);
  const UvExtent e = uvExtent(*meshInScope(call.shape()), set, coordinate);
  return Value::of(upper ? e.max : e.min);
}

Value hasUvs(FunctionCall& call, const UvSet& args) {
  int set = 0;
  if (args.number) return Value::of(uvSet(call.shape(), args, set));
  for (set = 0; set < kUvSets; ++set) {
    if (hasUvSet(call.shape(), set)) return Value::of(true);
  }
  return Value::of(false);
}

// The slots that faces have, each of those that count as one once: the components of a split.
std::vector<uint16_t> slotsOf(const Shape& s, const std::vector<uint16_t>& firstSlots) {
  std::vector<uint16_t> slots;
  if (s.geometry.kind == GeometryKind::Mesh) {
    for (const MeshFace& f : s.geometry.mesh->faces) slots.push_back(firstSlots[f.materialSlot]);
  } else if (s.geometry.kind != GeometryKind::None) {
    slots.push_back(0);
  }
  std::sort(slots.begin(), slots.end());
  slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
  return slots;
}

Value materials(FunctionCall& call) {
  const Shape& s = call.shape();
  const Services& services = call.services();
  const auto& list = services.attributes().materials(s.assetMaterials);
  std::vector<std::string> names;
  for (const uint16_t slot : slotsOf(s, slotsByMaterial(s, services))) {
    const bool own = slot == 0 || slot > list.size() / 2;
    names.push_back(services.materials().get(own ? s.material : list[slot - 1u]).name);
  }
  return stringArray(names, services.pool());
}

// Without a group that has a name, what comes of the initial shape has its name. What is inserted
// then has none.
Value groups(FunctionCall& call) {
  const Shape& s = call.shape();
  const Services& services = call.services();
  const auto& all = services.attributes().groups(s.assetMaterials);
  std::vector<std::string> names;
  for (const uint16_t slot : slotsOf(s, slotsByGroup(s, services))) {
    const bool none = slot == 0 || slot > all.size();
    names.emplace_back(none ? std::string_view() : services.pool().text(all[slot - 1u]));
  }
  const bool any = std::any_of(names.begin(), names.end(),
                               [](const std::string& name) { return !name.empty(); });
  if (!any) names.clear();
  if (!any && s.geometry.kind != GeometryKind::None && !s.geometry.instanced) {
    names.push_back(services.initialShape().name);
  }
  return stringArray(names, services.pool());
}

struct TagQuery {
  std::string_view query;
  Word of{"all"};
  Word subcomponent;
};

// All tags of the faces, edges or vertices that a query means, sorted, each once.
std::vector<std::string> tagNames(FunctionCall& call, const TagQuery& args) {
  const Services& services = call.services();
  const std::string_view query = args.query;
  const MeshRef m = meshInScope(call.shape());
  std::vector<TagSetId> sets;
  if (args.of == "all" || args.of == "faces") {
    for (const MeshFace& f : m->faces) sets.push_back(f.tags);
  }
  if (args.of == "all" || args.of == "edges") {
    sets.insert(sets.end(), m->edgeTags.begin(), m->edgeTags.end());
  }
  if (args.of == "all" || args.of == "vertices") {
    sets.insert(sets.end(), m->vertexTags.begin(), m->vertexTags.end());
  }
  std::sort(sets.begin(), sets.end());
  sets.erase(std::unique(sets.begin(), sets.end()), sets.end());
  std::vector<std::string> names;
  for (const TagSetId set : sets) {
    for (const StringId name : services.tags().names(set)) {
      const std::string_view tag = services.pool().text(name);
      if (query.empty() || tagMatches(query, tag)) names.emplace_back(tag);
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

Value tags(FunctionCall& call, const TagQuery& args) {
  return stringArray(tagNames(call, args), call.services().pool());
}
// isTagged() within a selector is not asked here: the component split itself asks the components;
// see selection.h.
Value hasTags(FunctionCall& call, const TagQuery& args) {
  return Value::of(!tagNames(call, args).empty());
}

constexpr ValueType kFloat = ValueType::Float, kBool = ValueType::Bool;
constexpr const char* kOrientations =
    "all surface front back left right top bottom side object.front object.back object.left "
    "object.right object.top object.bottom object.side world.north world.south world.west "
    "world.east world.up world.down world.side street.front street.back street.left street.right "
    "street.side";

constexpr Signature kNumber[] = {{{}, kFloat}};
constexpr Signature kTruth[] = {{{}, kBool}};
constexpr Signature kNames[] = {{{}, ValueType::StringArray}};
constexpr ParamSpec kAreaParams[] = {param<&Orientation::word>(
    "faceOrientation", "Which faces count, by the way they look.", nullptr, kOrientations)};
constexpr Signature kArea[] = {{{}, kFloat}, {kAreaParams, kFloat}};
constexpr ParamSpec kOrientedParams[] = {param<&Orientation::word>(
    "orientation", "The way that a face has to look.", nullptr, kOrientations)};
constexpr Signature kOriented[] = {{kOrientedParams, kBool}};
constexpr ParamSpec kAngleParams[] = {param<&Angle::type>(
    "angleType",
    "The slope against the ground, the direction of downhill clockwise from north, or what the "
    "slope lacks to 90.",
    nullptr, "maxSlope azimuth zenith")};
constexpr Signature kAngle[] = {{kAngleParams, kFloat}};
constexpr ParamSpec kToleranceParams[] = {
    param<&Tolerance::degrees>("tolerance", "How far angles may be off, in degrees.", "0.25")};
constexpr Signature kTolerance[] = {{kToleranceParams, kBool}};
constexpr ParamSpec kUvSet = param<&UvSet::number>("uvSet", "The uv set, 0 to 9.");
constexpr ParamSpec kUvParams[] = {kUvSet};
constexpr Signature kUvBound[] = {{{}, kFloat}, {kUvParams, kFloat}};
constexpr Signature kHasUv[] = {{{}, kBool}, {kUvParams, kBool}};
constexpr ParamSpec kRangeParams[] = {
    kUvSet, param<&UvSet::units>("surfaceParameterization",
                                 "In the units of the coordinates, or in metres along the surface.",
                                 nullptr, "uvSpace unitSpace")};
constexpr Signature kRange[] = {{kRangeParams, kFloat}};
constexpr ParamSpec kQuery = param<&TagQuery::query>(
    "tagQuery",
    "Tags to count: a name or its beginning by dots; ? stands for one part, * for some.");
constexpr ParamSpec kOf =
    param<&TagQuery::of>("components", "Whose tags count.", nullptr, "all faces edges vertices");
constexpr ParamSpec kQueryParams[] = {kQuery};
constexpr ParamSpec kQueryOfParams[] = {kQuery, kOf};
constexpr Signature kTags[] = {{{}, ValueType::StringArray},
                               {kQueryParams, ValueType::StringArray},
                               {kQueryOfParams, ValueType::StringArray}};
constexpr ParamSpec kSubcomponent = param<&TagQuery::subcomponent>(
    "subcomponent", "Puts the query to the edges or the vertices of a component.", nullptr, "e v");
constexpr ParamSpec kTaggedParams[] = {kQuery, kSubcomponent};
constexpr Signature kIsTagged[] = {{kQueryParams, kBool}, {kTaggedParams, kBool}};
constexpr Signature kHasTags[] = {{{}, kBool}, {kQueryParams, kBool}, {kQueryOfParams, kBool}};

constexpr const char* kFamily = "geometry";
constexpr uint32_t kByWord = kReadsWorld | kReadsWorldByWord;
constexpr FunctionSpec kFunctions[] = {
    {"geometry.area", kFamily, "The area of all faces, or of those that look a certain way.", kArea,
     typed<area>, kByWord, true},
    {"geometry.angle", kFamily, "How steep the surface is, and where it slopes to, in degrees.",
     kAngle, typed<angle>, kReadsWorld},
    {"geometry.boundaryLength", kFamily, "The length of all edges with only one face.", kNumber,
     boundary, kPure, true},
    {"geometry.du", kFamily, "The range of u of a uv set.", kRange, typed<uvRange<0>>},
    {"geometry.dv", kFamily, "The range of v of a uv set.", kRange, typed<uvRange<1>>},
    {"geometry.groups", kFamily, "The names of the groups of the geometry.", kNames, groups,
     kReadsInitialShape | kReadsPath, true},
    {"geometry.hasTags", kFamily, "Whether any component has a tag, or a certain tag.", kHasTags,
     typed<hasTags>, kReadsTags, true},
    {"geometry.hasUVs", kFamily, "Whether there are texture coordinates, in any or a certain set.",
     kHasUv, typed<hasUvs>, kPure, true},
    {"geometry.height", kFamily, "The height of the geometry in the world.", kNumber, height,
     kReadsWorld, true},
    {"geometry.isClosedSurface", kFamily, "Whether every edge belongs to exactly two faces.",
     kTruth, isClosed, kPure, true},
    {"geometry.isConcave", kFamily, "Whether any face is concave or has a hole.", kTruth,
     isConcaveOf, kPure, true},
    {"geometry.isInstanced", kFamily,
     "Whether the geometry is an asset or primitive as it was inserted.", kTruth, isInstanced,
     kReadsPath, true},
    {"geometry.isOriented", kFamily, "Whether any face looks a certain way.", kOriented,
     typed<isOriented>, kByWord},
    {"geometry.isPlanar", kFamily, "Whether every face is flat.", kTolerance, typed<isPlanarOf>,
     kPure, true},
    {"geometry.isRectangular", kFamily, "Whether every face is a rectangle.", kTolerance,
     typed<isRectangularOf>, kPure, true},
    {"geometry.lowerheight", kFamily,
     "Old: the height of a wall at its lower side, where the lowest standing edge ends.", kNumber,
     lowerHeight, kReadsWorld, true},
    {"geometry.materials", kFamily, "The names of the materials in the order of their first faces.",
     kNames, materials, kPure, true},
    {"geometry.nEdges", kFamily, "The number of edges.", kNumber, nEdges, kPure, true},
    {"geometry.nFaces", kFamily, "The number of faces.", kNumber, nFaces, kPure, true},
    {"geometry.nHoles", kFamily, "The number of holes in faces.", kNumber, nHoles, kPure, true},
    {"geometry.nVertices", kFamily, "The number of vertices.", kNumber, nVertices, kPure, true},
    {"isTagged", kFamily, "Selects components by their tags; elsewhere, whether any has the tag.",
     kIsTagged, typed<hasTags>, kReadsTags},
    {"geometry.tags", kFamily, "The tags of the components, sorted.", kTags, typed<tags>,
     kReadsTags, true},
    {"geometry.uMin", kFamily, "The least u of a uv set, of set 0 without argument.", kUvBound,
     typed<uvBound<0, false>>, kPure, true},
    {"geometry.uMax", kFamily, "The greatest u of a uv set.", kUvBound, typed<uvBound<0, true>>,
     kPure, true},
    {"geometry.vMin", kFamily, "The least v of a uv set.", kUvBound, typed<uvBound<1, false>>,
     kPure, true},
    {"geometry.vMax", kFamily, "The greatest v of a uv set.", kUvBound, typed<uvBound<1, true>>,
     kPure, true},
    {"geometry.volume", kFamily, "The volume that the faces enclose.", kNumber, volumeOf, kPure,
     true},
};

}  // namespace

extern const FunctionList kFunctions_geometry;
const FunctionList kFunctions_geometry = {kFunctions, {}};

}  // namespace gable
