// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A box gives its faces, and a rectangle itself, without a mesh; so do the leaves of most facades.
// All other geometry goes through splitMesh.
#include <array>
#include <utility>

#include "base/work.h"
#include "builtins/lists.h"
#include "builtins/ops/subdivide/shared/component_split.h"
#include "builtins/ops/subdivide/shared/parts.h"
#include "builtins/selection.h"
#include "program/tag_effects.h"
#include "shape/op_call.h"

namespace gable {

namespace {

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

Shape flatChild(const ComponentCall& context, Shape s, const FlatFace& face, size_t faceCount) {
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

void splitFlatFaces(const ComponentCall& context) {
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

Status applyComp(OpCall& call, const Comp& args) {
  const ComponentKind kind = kindOf(args);
  const ComponentCall context{call, args.alignment == Alignment::ZUp};
  if (kind == ComponentKind::Faces && context.align && hasFlatFaces(call, call.shape())) {
    splitFlatFaces(context);
  } else {
    const MeshRef mesh = meshInScope(call.shape());
    Components all = componentsOf(call, args, *mesh);
    splitMesh(context, all, *mesh, kind);
  }
  return {};
}

constexpr OpSpec kSpecs[] = {
    {"comp", "subdivide", "Divides the shape into faces, edges, vertices or other components.",
     kCompSignatures, typed<applyComp>, BlockKind::Selectors,
     kReadsWorld | kReadsWorldByWord | kReadsPivotAxes | kLeavesOccluder | kIgnoresTags},
};

}  // namespace

extern const OpList kOps_comp;
const OpList kOps_comp = kSpecs;

}  // namespace gable
