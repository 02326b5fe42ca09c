// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/subdivide/shared/component_split.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/work.h"
#include "builtins/ops/subdivide/shared/parts.h"
#include "builtins/ops/subdivide/shared/roof_edges.h"
#include "builtins/shared/materials.h"
#include "geom/mesh/origins.h"

namespace gable {

namespace {

// Trim planes of edges flatter than 40 degrees are horizontal; this is the sine.
constexpr double kSinHorizontal = 0.64278760968653933;
// Of the grid a metre: what a rule wrote as a decimal number comes out as the same number.
constexpr double kGridLines = 1e9;

Vec3 onGrid(const Vec3& v) { return {gable::onGrid(v.x), gable::onGrid(v.y), gable::onGrid(v.z)}; }

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

void emitComponents(const ComponentCall& context, const Mesh& mesh, Components& all,
                    ComponentKind kind, const std::vector<uint32_t>& which, Shape child,
                    uint32_t slot, bool each) {
  OpCall& call = context.call;
  const Shape& parent = call.shape();
  const Component& first = all.list()[which[0]];
  Mesh part = all.meshOf(which);
  if (context.tracked) noteOrigins(part, which[0] + 1.0);
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

using SlotTable = std::vector<uint16_t> (*)(const Shape&, const Services&);

struct Kind {
  ComponentKind kind;
  SlotTable slots = nullptr;
};
// In the order of KindWord.
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

}  // namespace

double onGrid(double v) {
  return std::fabs(v) < 0x1.0p20 ? std::nearbyint(v * kGridLines) / kGridLines : v;
}

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

Shape ComponentCall::child(StringId name, size_t index, size_t total) const {
  Shape s = call.shape();
  s.comp = {static_cast<uint32_t>(index), static_cast<uint32_t>(total)};
  s.compSelector = name;
  return s;
}

StringId ComponentCall::nameOf(const SelectorItem& item, const Selector& selector) const {
  const bool word = item.terms.size() == 1 && item.terms[0].kind == SelectorTerm::Kind::Word;
  return word ? item.terms[0].word : call.services().pool().intern(selector.text());
}

ComponentKind kindOf(const Comp& args) { return kKinds[static_cast<size_t>(args.component)].kind; }

std::vector<uint16_t> componentSlots(const Comp& args, const Shape& s, const Services& services) {
  const SlotTable slots = kKinds[static_cast<size_t>(args.component)].slots;
  return slots ? slots(s, services) : std::vector<uint16_t>();
}

Components componentsOf(OpCall& call, const Comp& args, const Mesh& mesh) {
  const ComponentKind kind = kindOf(args);
  bool asksForRoof = false;
  for (const SelectorItem& item : call.selectors()) {
    for (const SelectorTerm& t : item.terms) {
      work();
      asksForRoof = asksForRoof || (t.kind == SelectorTerm::Kind::Word &&
                                    namesRoofEdge(call.services().pool().text(t.word)));
    }
  }
  std::vector<Vec3> ups(std::begin(kUp), std::end(kUp));
  if (asksForRoof && kind == ComponentKind::Edges) ups = waysUp(call, mesh);
  return Components(mesh, kind, componentSlots(args, call.shape(), call.services()), ups);
}

std::vector<bool> splitMesh(const ComponentCall& context, Components& all, const Mesh& mesh,
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

}  // namespace gable
