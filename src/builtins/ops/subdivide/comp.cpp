// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A box gives its faces, and a rectangle itself, without a mesh; so do the leaves of most facades.
// All other geometry goes through Components, which counts and selects; what it gives out is put
// into axes of its own, where a rectangle becomes a primitive again.
#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "builtins/lists.h"
#include "builtins/ops/shared/material_slots.h"
#include "builtins/ops/subdivide/shared/components.h"
#include "builtins/ops/subdivide/shared/parts.h"
#include "builtins/selection.h"
#include "builtins/shared/materials.h"
#include "geom/mesh/recompose.h"
#include "program/tag_effects.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// Trim planes of edges flatter than 40 degrees are horizontal; this is the sine.
constexpr double kSinHorizontal = 0.64278760968653933;
// Equal faces come out with equal sizes: coordinates in a face's own axes lie on this grid.
constexpr double kGrid = 0x1.0p-30;

double onGrid(double v) { return std::fabs(v) < 0x1.0p20 ? std::nearbyint(v / kGrid) * kGrid : v; }
Vec3 onGrid(const Vec3& v) { return {onGrid(v.x), onGrid(v.y), onGrid(v.z)}; }

// The plane through an edge of a face that halves the angle to the face beyond it. All in scope
// coordinates; `along` runs as the face does.
struct SharedEdge {
  Vec3 point, along, normal, otherNormal;
};

void addTrimPlane(ShapeExtra& extra, const Shape& parent, const SharedEdge& e) {
  const Vec3 along = normalized(e.along);
  // From the edge into the other face, less from the edge into this one.
  const Vec3 out = cross(along, e.normal + e.otherNormal);
  if (length(out) < 1e-6) return;
  TrimPlane plane;
  plane.normal = parent.scope.direction(normalized(out));
  plane.distance = dot(plane.normal, parent.scope.point(e.point));
  const Vec3 direction = parent.scope.direction(along);
  plane.horizontal = std::fabs(dot(direction, parent.pivot.y)) < kSinHorizontal;
  extra.trim.push_back(plane);
}

// What all children of a call have in common.
struct Context {
  OpCall& call;
  bool align;
  /// The parts shall be glued back.
  bool tracked = false;

  Shape child(StringId name, size_t index, size_t total) const {
    Shape s = call.shape();
    s.comp = {static_cast<uint32_t>(index), static_cast<uint32_t>(total)};
    s.compSelector = name;
    return s;
  }
  StringId nameOf(const SelectorItem& item, const Selector& selector) const {
    const bool word = item.terms.size() == 1 && item.terms[0].kind == SelectorTerm::Kind::Word;
    return word ? item.terms[0].word : call.services().pool().intern(selector.text());
  }
};

// A face of a primitive in scope coordinates: a rectangle from its ring.
struct FlatFace {
  std::array<Vec3, 4> ring;
  Vec3 normal;
  uint32_t tags = 0;
  BoxSide side = kSideFront;
  /// Of rectangles only: box edges have none.
  std::array<uint32_t, 4> edgeTags{};
};

constexpr std::array<Vec3, 6> kSideNormals{
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

FlatFace quadFace(const Shape& s) {
  const Vec3 z = s.size;
  FlatFace f;
  if (s.geometry.kind == GeometryKind::QuadXy) {
    f.ring = {{{0, 0, 0}, {z.x, 0, 0}, {z.x, z.y, 0}, {0, z.y, 0}}};
    f.normal = {0, 0, 1};
  } else {
    f.ring = {{{0, 0, z.z}, {z.x, 0, z.z}, {z.x, 0, 0}, {0, 0, 0}}};
    f.normal = {0, 1, 0};
    f.side = kSideTop;
  }
  f.tags = s.geometry.tags[f.side];
  const auto& edges = quadEdges(s.geometry.kind);
  for (size_t i = 0; i < 4; ++i) f.edgeTags[i] = s.geometry.tags[edges[i]];
  return f;
}

size_t facesOf(const Shape& s, std::array<FlatFace, 6>& out) {
  const Vec3 z = s.size;
  if (s.geometry.kind != GeometryKind::Box) {
    out[0] = quadFace(s);
    return 1;
  }
  const auto& faces = boxFaces(s.geometry.order);
  for (size_t f = 0; f < 6; ++f) {
    for (size_t i = 0; i < 4; ++i) {
      const uint32_t p = faces[f].ring[i], around = p % 4;
      out[f].ring[i] = {around == 1 || around == 2 ? z.x : 0, p >= 4 ? z.y : 0,
                        around >= 2 ? z.z : 0};
    }
    out[f].side = faces[f].side;
    out[f].normal = kSideNormals[faces[f].side];
    out[f].tags = s.geometry.tags[faces[f].side];
  }
  return 6;
}

// The side of a box that lies beyond the edge `i` of a face.
Vec3 beyondEdge(const FlatFace& f, size_t i) {
  return cross(f.ring[(i + 1) % 4] - f.ring[i], f.normal);
}

class FlatFaces : public ComponentSource {
 public:
  FlatFaces(const std::array<FlatFace, 6>& faces, size_t count) : faces_(faces), count_(count) {}
  void tagsOf(const Selectable& c, Of of, std::vector<uint32_t>& out) const override {
    out.push_back(faces_[c.index].tags);
    if (of == Of::Component || of == Of::Itself) return;
    if (count_ == 1) {
      out.insert(out.end(), faces_[0].edgeTags.begin(), faces_[0].edgeTags.end());
      return;
    }
    // All faces of a box but the one opposite are beyond an edge, and beyond a vertex.
    const auto opposite = static_cast<BoxSide>(faces_[c.index].side ^ 1);
    for (size_t f = 0; f < count_; ++f) {
      work();
      if (faces_[f].side != opposite) out.push_back(faces_[f].tags);
    }
  }
  void pointsOf(const Selectable& c, std::vector<Vec3>& out) const override {
    out.assign(faces_[c.index].ring.begin(), faces_[c.index].ring.end());
  }

 private:
  const std::array<FlatFace, 6>& faces_;
  size_t count_;
};

Shape flatChild(const Context& context, Shape s, const FlatFace& face, size_t faceCount) {
  const Shape& parent = context.call.shape();
  const Vec3 along = face.ring[1] - face.ring[0], up = face.ring[3] - face.ring[0];
  const double width = length(along), height = length(up);
  const Frame own = Frame::of(face.ring[0], along * (1 / width), up * (1 / height), face.normal);
  s.scope = parent.scope * own;
  s.pivot = s.scope;
  s.size = {onGrid(width), onGrid(height), 0};
  const bool uv = parent.geometry.uv;
  s.geometry = primitive(GeometryKind::QuadXy, face.tags);
  s.geometry.uv = uv;
  const auto& edges = quadEdges(GeometryKind::QuadXy);
  for (size_t i = 0; i < 4; ++i) s.geometry.tags[edges[i]] = face.edgeTags[i];
  if (faceCount > 1) {
    ShapeExtra extra = extraOf(parent);
    for (size_t i = 0; i < 4; ++i) {
      const Vec3 beyond = normalized(beyondEdge(face, i));
      addTrimPlane(extra, parent,
                   {face.ring[i], face.ring[(i + 1) % 4] - face.ring[i], face.normal, beyond});
    }
    s.extra = makeRef<ShapeExtra>(std::move(extra));
    forgetFarTrimPlanes(s);
  }
  return s;
}

// True when the primitive's faces can be given out one by one as rectangles.
bool hasFlatFaces(const OpCall& call, const Shape& s) {
  const bool kind = s.geometry.kind == GeometryKind::Box ||
                    s.geometry.kind == GeometryKind::QuadXy ||
                    s.geometry.kind == GeometryKind::QuadXz;
  if (!kind || s.size.x <= 0) return false;
  if (s.geometry.kind != GeometryKind::QuadXz && s.size.y <= 0) return false;
  if (s.geometry.kind != GeometryKind::QuadXy && s.size.z <= 0) return false;
  if (s.geometry.kind == GeometryKind::QuadXz && s.size.y < 0) return false;
  if (s.geometry.kind == GeometryKind::QuadXy && s.size.z < 0) return false;
  for (const SelectorItem& item : call.selectors()) {
    if (item.op != SelectOperator::Each) return false;
  }
  return true;
}

void splitFlatFaces(const Context& context) {
  OpCall& call = context.call;
  const Shape& s = call.shape();
  std::array<FlatFace, 6> faces;
  const size_t count = facesOf(s, faces);
  const FlatFaces source(faces, count);
  const Directions directions(call.services(), s);
  std::array<bool, 6> taken{};
  call.countComponents(count);
  for (const SelectorItem& item : call.selectors()) {
    const Selector selector(item, call.services().pool(), directions);
    std::array<uint32_t, 6> chosen{};
    size_t total = 0;
    for (uint32_t f = 0; f < count; ++f) {
      work();
      Selectable what;
      what.normal = faces[f].normal;
      what.index = f;
      what.border = count == 1;
      if (taken[f] || !selector.matches(what, source, call.services().tags())) continue;
      taken[f] = true;
      chosen[total++] = f;
    }
    const StringId name = context.nameOf(item, selector);
    for (size_t i = 0; i < total; ++i) {
      work();
      Shape child = context.child(name, i, total);
      call.emit(flatChild(context, std::move(child), faces[chosen[i]], count), item.slot,
                chosen[i]);
      call.placeComponent(chosen[i]);
    }
  }
}

Frame axesOf(const Component& c, ComponentKind kind) {
  const bool alongEdge = kind == ComponentKind::Edges || kind == ComponentKind::FaceEdges ||
                         kind == ComponentKind::FaceVertices;
  if (!alongEdge) return frameFromZ(c.origin, c.z, c.x);
  // The edge is exactly x; z leans on it.
  const Frame f = frameFromZ(c.origin, c.x, c.z);
  return Frame::of(c.origin, f.z, cross(f.x, f.z), f.x);
}

// The planes at the edges that a face shares. One that cuts the face itself, as those beside a
// reflex corner do, would cut what is put into it at the wrong place, and is left out.
void addFaceTrimPlanes(Shape& s, const Shape& parent, const Mesh& mesh, const Components& all,
                       const Component& c) {
  ShapeExtra extra = extraOf(parent);
  const MeshEdges& edges = all.edges();
  double extent = 0;
  for (size_t i = 0; i < 3; ++i) extent = std::max(extent, std::fabs(s.size[i]));
  const MeshLoop& outer = mesh.loopsOf(c.face)[0];
  for (uint32_t i = 0; i < outer.cornerCount; ++i) {
    work();
    const uint32_t corner = outer.firstCorner + i;
    const MeshEdge& e = edges.edges()[edges.edgeOf(corner)];
    if (e.uses != 2) continue;
    const uint32_t other = e.corner == corner ? e.other : e.corner;
    if (edges.faceOf(other) == c.face) continue;
    const size_t before = extra.trim.size();
    addTrimPlane(extra, parent,
                 {mesh.at(corner), mesh.at(edges.next(corner)) - mesh.at(corner),
                  mesh.normal(c.face), mesh.normal(edges.faceOf(other))});
    if (extra.trim.size() == before) continue;
    const TrimPlane& plane = extra.trim.back();
    for (uint32_t k = 0; k < outer.cornerCount; ++k) {
      work();
      const Vec3 p = parent.scope.point(mesh.at(outer.firstCorner + k));
      if (dot(plane.normal, p) <= plane.distance + 1e-6 * (1 + extent)) continue;
      extra.trim.pop_back();
      break;
    }
  }
  s.extra = makeRef<ShapeExtra>(std::move(extra));
  forgetFarTrimPlanes(s);
}

void emitComponents(const Context& context, const Mesh& mesh, Components& all, ComponentKind kind,
                    const std::vector<uint32_t>& which, Shape child, uint32_t slot, bool each) {
  OpCall& call = context.call;
  const Shape& parent = call.shape();
  const Component& first = all.list()[which[0]];
  Mesh part = all.meshOf(which);
  if (context.tracked) setOrigins(part, which[0]);
  child.geometry = {};
  if (context.align) {
    const Frame own = axesOf(first, kind);
    child.scope = parent.scope * own;
    child.pivot = child.scope;
    part = transformed(part, {1, 1, 1}, inverse(own));
    for (Vec3& p : part.positions) p = onGrid(p);
  } else {
    child.scope = parent.scope;
  }
  child.size = {};
  setMesh(child, std::move(part), ScopeFit::Refit);
  if (kind == ComponentKind::Faces && each) {
    addFaceTrimPlanes(child, parent, mesh, all, first);
  } else {
    forgetFarTrimPlanes(child);
  }
  call.emit(std::move(child), slot, which[0]);
  for (const uint32_t component : which) call.placeComponent(component);
}

// A face without area has no axes; it cannot be a shape.
bool isDegenerate(const Component& c, ComponentKind kind) {
  return kind != ComponentKind::Vertices && (c.z == Vec3{} || c.x == Vec3{});
}

// Says of each component whether an item took it.
std::vector<bool> splitMesh(const Context& context, Components& all, const Mesh& mesh,
                            ComponentKind kind) {
  OpCall& call = context.call;
  const Directions directions(call.services(), call.shape());
  std::vector<bool> taken(all.list().size(), false);
  call.countComponents(all.list().size());
  for (const SelectorItem& item : call.selectors()) {
    const Selector selector(item, call.services().pool(), directions);
    std::vector<uint32_t> chosen;
    for (uint32_t i = 0; i < all.list().size(); ++i) {
      work();
      const Component& c = all.list()[i];
      if (taken[i] || isDegenerate(c, kind)) continue;
      if (!selector.matches(c.what, all, call.services().tags())) continue;
      taken[i] = true;
      chosen.push_back(i);
    }
    if (chosen.empty()) continue;
    std::vector<std::vector<uint32_t>> sets;
    if (item.op == SelectOperator::All) sets.push_back(chosen);
    if (item.op == SelectOperator::Connected) sets = all.connected(chosen);
    if (item.op == SelectOperator::Each) {
      for (const uint32_t i : chosen) sets.push_back({i});
    }
    const StringId name = context.nameOf(item, selector);
    for (size_t i = 0; i < sets.size(); ++i) {
      work();
      emitComponents(context, mesh, all, kind, sets[i], context.child(name, i, sets.size()),
                     item.slot, item.op == SelectOperator::Each);
    }
  }
  return taken;
}

using SlotTable = std::vector<uint16_t> (*)(const Shape&, const Services&);

// The words for components, in the order of kKinds.
enum class KindWord : uint8_t {};
struct Kind {
  ComponentKind kind;
  SlotTable slots = nullptr;
};
constexpr Kind kKinds[] = {
    {ComponentKind::Faces},
    {ComponentKind::Faces},
    {ComponentKind::Edges},
    {ComponentKind::Edges},
    {ComponentKind::FaceEdges},
    {ComponentKind::Vertices},
    {ComponentKind::Vertices},
    {ComponentKind::FaceVertices},
    {ComponentKind::Slots, slotsByGroup},
    {ComponentKind::Slots, slotsByGroup},
    {ComponentKind::Slots, slotsByMaterial},
    {ComponentKind::Slots, slotsByMaterial},
    {ComponentKind::Holes},
    {ComponentKind::Holes},
};
enum class Alignment : uint8_t { ZUp, NoAlign };

}  // namespace

template <>
struct WordsOf<KindWord> {
  static constexpr const char* text =
      "f faces e edges fe v vertices fv g groups m materials h holes";
};
template <>
struct WordsOf<Alignment> {
  static constexpr const char* text = "zUp noAlign";
};

namespace {

struct Comp {
  KindWord component;
  Alignment alignment;
};

std::vector<uint16_t> slotsOf(const Kind& kind, const OpCall& call, const Shape& s) {
  return kind.slots ? kind.slots(s, call.services()) : std::vector<uint16_t>();
}

Status applyComp(OpCall& call, const Comp& args) {
  const Kind& chosen = kKinds[static_cast<size_t>(args.component)];
  const ComponentKind kind = chosen.kind;
  const Context context{call, args.alignment == Alignment::ZUp};
  if (kind == ComponentKind::Faces && context.align && hasFlatFaces(call, call.shape())) {
    splitFlatFaces(context);
  } else {
    const MeshRef mesh = meshInScope(call.shape());
    Components all(*mesh, kind, slotsOf(chosen, call, call.shape()));
    splitMesh(context, all, *mesh, kind);
  }
  return {};
}

// The faces that no component took: all of them where components are edges or vertices.
Mesh untouched(const Mesh& m, const Components& all, const std::vector<bool>& taken,
               ComponentKind kind, const std::vector<uint16_t>& firstSlots) {
  std::vector<bool> gone(m.faceCount(), false);
  std::vector<bool> slotGone(size_t{1} << 16, false);
  for (size_t i = 0; i < taken.size(); ++i) {
    if (!taken[i]) continue;
    if (kind == ComponentKind::Faces) gone[all.list()[i].face] = true;
    if (kind == ComponentKind::Slots) slotGone[all.list()[i].face] = true;
  }
  MeshBuilder builder;
  std::vector<uint32_t> map;
  for (size_t f = 0; f < m.faceCount(); ++f) {
    work();
    const uint16_t own = m.faces[f].materialSlot;
    const uint16_t slot = own < firstSlots.size() ? firstSlots[own] : own;
    if (!gone[f] && !slotGone[slot]) builder.copyFace(m, f, map);
  }
  return builder.take();
}

// The shape keeps what is not edited until the parts come back.
Status beginModify(OpCall& call, const Comp& args) {
  const Kind& chosen = kKinds[static_cast<size_t>(args.component)];
  const ComponentKind kind = chosen.kind;
  const Context context{call, args.alignment == Alignment::ZUp, true};
  MeshRef mesh = meshInScope(call.shape());
  // Within another modify the notes are those of the outer one, which takes what comes as new.
  if (hasOrigins(*mesh)) {
    Mesh without = *mesh;
    dropOrigins(without);
    mesh = makeRef<Mesh>(std::move(without));
  }
  if (!hasRoomForOrigins(*mesh)) {
    return call.fail("uv-sets-in-use",
                     "'modify' keeps its own notes in the uv sets 8 and 9, which the shape uses",
                     "copy them to other sets, or modify the shape before they are made");
  }
  const std::vector<uint16_t> slots = slotsOf(chosen, call, call.shape());
  Components all(*mesh, kind, slots);
  const std::vector<bool> taken = splitMesh(context, all, *mesh, kind);
  if (std::find(taken.begin(), taken.end(), true) == taken.end()) return {};
  setMesh(call.shape(), untouched(*mesh, all, taken, kind, slots), ScopeFit::Keep);
  call.gather();
  return {};
}

Status finishModify(OpCall& call, std::span<Gathered> leaves) {
  Shape& s = call.shape();
  std::vector<const Shape*> shapes;
  if (s.geometry.kind != GeometryKind::None) shapes.push_back(&s);
  for (Gathered& leaf : leaves) {
    leaf.taken = true;
    if (leaf.shape.geometry.kind != GeometryKind::None) shapes.push_back(&leaf.shape);
  }
  const bool oneMaterial = haveOneMaterial(shapes);
  MaterialSlots slots(call.services());
  Mesh whole;
  std::vector<Mesh> parts;
  const Frame home = inverse(s.scope);
  for (const Shape* shape : shapes) {
    Mesh mesh = shape == &s ? *meshInScope(s)
                            : transformed(*meshInScope(*shape), {1, 1, 1}, home * shape->scope);
    work(static_cast<uint32_t>(mesh.corners.size()));
    if (!oneMaterial) slots.put(mesh, *shape);
    if (shape == &s) {
      whole = std::move(mesh);
    } else {
      parts.push_back(std::move(mesh));
    }
  }
  if (!shapes.empty()) {
    s.material = oneMaterial ? shapes[0]->material : s.material;
    s.assetMaterials = oneMaterial ? shapes[0]->assetMaterials : slots.interned();
  }
  s.geometry = {};
  setMesh(s, recomposed(whole, parts), ScopeFit::Refit);
  return {};
}

constexpr ParamSpec kParams[] = {
    param<&Comp::component>("component",
                            "What to divide into: faces, edges, face edges, vertices, face "
                            "vertices, groups, materials or "
                            "holes."),
    param<&Comp::alignment>(
        "scopeAlignment",
        "zUp gives each component axes of its own, with z along its normal; noAlign keeps the axes "
        "and the pivot.",
        "zUp"),
};
constexpr Signature kSignatures[] = {{kParams}};

constexpr OpSpec kSpecs[] = {
    {"comp", "subdivide", "Divides the shape into faces, edges, vertices or other components.",
     kSignatures, typed<applyComp>, BlockKind::Selectors,
     kReadsWorld | kReadsWorldByWord | kReadsPivotAxes | kLeavesOccluder | kIgnoresTags},
    heavy({"modify",
           "subdivide",
           "Edits components of the shape and glues what comes of them back into it.",
           kSignatures,
           typed<beginModify>,
           BlockKind::Selectors,
           kReadsWorld | kReadsWorldByWord | kReadsPivotAxes | kReadsTags,
           kNoParts,
           false,
           false,
           {},
           1,
           finishModify}),
};

}  // namespace

extern const OpList kOps_comp;
const OpList kOps_comp = kSpecs;

}  // namespace gable
