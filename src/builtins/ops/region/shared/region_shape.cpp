// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
#include "builtins/ops/region/shared/region_shape.h"

#include <algorithm>
#include <cmath>

#include "builtins/ops/shared/refit.h"
#include "builtins/ops/subdivide/shared/parts.h"
#include "geom/region/autoindex.h"

namespace gable {

namespace {

// Rings begin at their vertex nearest to the south-west, as rectangles do.
size_t southWest(const Ring& r, Vec2 x) {
  const Vec2 diagonal = x + perpendicular(x);
  size_t best = 0;
  for (size_t i = 1; i < r.size(); ++i) {
    if (dot(r[i], diagonal) < dot(r[best], diagonal) - 1e-9) best = i;
  }
  return best;
}

}  // namespace

RegionView::RegionView(const Services& services, const Mesh& mesh, size_t face)
    : services_(services), mesh_(mesh), plane_(mesh, face) {
  const TagSetId own = mesh.faces[face].tags;
  const RegionProvenance* const known = services.regionAt(own);
  faceTags_ = services.tags().plain(own);
  if (known) {
    depth_ = known->depth;
    cell_ = known->cell;
  }
  const std::vector<Ring> rings = ringsOf(polygon());
  for (size_t r = 0; r < rings.size(); ++r) {
    for (size_t i = 0; i < rings[r].size(); ++i) {
      const uint32_t corner = plane_.cornerOf(r, i);
      const TagSetId set = mesh.edgeTags.empty() ? 0 : mesh.edgeTags[corner];
      const EdgeProvenance* const edge = services.edgeAt(set);
      marks_.push_back({edge ? *edge : EdgeProvenance(), services.tags().plain(set)});
    }
  }
  if (!known) {
    const LogicalEdges l = autoindex(polygon().outer);
    for (size_t i = 0; i < l.of.size(); ++i) marks_[i].logical = l.of[i];
  }
  for (size_t i = 0; i < rings[0].size(); ++i) {
    if (marks_[i].logical != EdgeMark::kNoLogical) {
      logicalCount_ = std::max(logicalCount_, marks_[i].logical + 1);
    }
  }
}

std::vector<uint32_t> RegionView::logicals() const {
  std::vector<uint32_t> out;
  for (size_t i = 0; i < polygon().outer.size(); ++i) out.push_back(marks_[i].logical);
  return out;
}

namespace {

LogicalEdges logicalsOf(const RegionPiece& piece, EdgeIndex index) {
  const Ring& outer = piece.polygon.outer;
  if (index == EdgeIndex::Chains) {
    std::vector<uint32_t> kind;
    for (size_t i = 0; i < outer.size(); ++i) {
      // Made edges of one role are one kind; of the input each edge is.
      const EdgeOrigin& e = piece.edges[i];
      kind.push_back(e.role == EdgeRole::Kept ? e.source
                                              : 0x80000000u + static_cast<uint32_t>(e.role));
    }
    return chainsOf(outer, kind);
  }
  if (index == EdgeIndex::Sector) {
    std::vector<SectorSide> side;
    for (size_t i = 0; i < outer.size(); ++i) {
      const EdgeRole role = piece.edges[i].role;
      side.push_back(role == EdgeRole::Kept     ? SectorSide::Outer
                     : role == EdgeRole::Centre ? SectorSide::Centre
                                                : SectorSide::Ray);
    }
    return sectorOf(outer, side);
  }
  return autoindex(outer);
}

}  // namespace

std::vector<EdgeMark> RegionView::marksOf(const RegionPiece& piece, EdgeIndex index) const {
  const bool grid =
      index == EdgeIndex::Grid || index == EdgeIndex::GridByY || index == EdgeIndex::GridSplit;
  std::vector<EdgeMark> out;
  const std::vector<Ring> rings = ringsOf(piece.polygon);
  size_t i = 0;
  for (const Ring& r : rings) {
    for (size_t k = 0; k < r.size(); ++k, ++i) {
      const EdgeOrigin& o = piece.edges[i];
      EdgeMark m;
      const bool inherits = o.source < marks_.size();
      if (inherits) m = marks_[o.source];
      if (o.role != EdgeRole::Kept && o.role != EdgeRole::Base) {
        m.level = depth_ + 1;
        m.role = o.role;
        if (o.role != EdgeRole::Inner) m.tags = 0;
        // A moved edge is no longer what earlier peels made.
        m.peels.clear();
      }
      if (o.role == EdgeRole::Base || o.role == EdgeRole::Inner || o.role == EdgeRole::Cap) {
        m.role = o.role;
        m.peels.push_back({depth_ + 1, o.role});
      }
      if (grid && &r == &rings[0]) {
        uint32_t side = o.side;
        const Vec2 n = -perpendicular(r[(k + 1) % r.size()] - r[k]);
        const double u = dot(n, piece.axis), v = dot(n, perpendicular(piece.axis));
        const bool tie = isDiagonal(u, v) && index != EdgeIndex::GridSplit;
        if (side > 3 || tie) {
          // The 45 degree edge belongs to one side, and to its image in mirrored cells.
          const bool across = tie ? index == EdgeIndex::Grid : std::fabs(u) >= std::fabs(v);
          side = across ? (u < 0 ? 0 : 2) : (v > 0 ? 1 : 3);
        }
        m.logical = side;
      } else if (o.role == EdgeRole::Cap || !inherits) {
        m.logical = EdgeMark::kNoLogical;
      }
      out.push_back(std::move(m));
    }
  }
  if (grid || index == EdgeIndex::Inherited) return out;
  const LogicalEdges l = logicalsOf(piece, index);
  for (size_t k = 0; k < l.of.size(); ++k) out[k].logical = l.of[k];
  return out;
}

TagSetId RegionView::tagsOf(const EdgeMark& m) const { return services_.tags().marked(m.tags, m); }

TagSetId RegionView::faceTags(uint32_t depth, const std::optional<CellMark>& cell) const {
  return services_.tags().marked(faceTags_, RegionProvenance{depth, cell});
}

Mesh RegionView::meshOf(std::span<const RegionPiece> pieces,
                        std::span<const std::vector<EdgeMark>> marks, uint32_t tags) {
  std::vector<PatchFace> faces;
  for (size_t p = 0; p < pieces.size(); ++p) {
    PatchFace face;
    face.plane = &plane_;
    face.tags = tags;
    size_t first = 0;
    for (const Ring& r : ringsOf(pieces[p].polygon)) {
      const auto at = static_cast<uint32_t>(plane_.points.size());
      const auto n = static_cast<uint32_t>(r.size());
      plane_.points.insert(plane_.points.end(), r.begin(), r.end());
      const auto start = static_cast<uint32_t>(southWest(r, pieces[p].axis));
      PatchLoop loop;
      for (uint32_t k = 0; k < n; ++k) {
        const uint32_t i = (start + k) % n;
        loop.push_back({at + i, at + (i + 1) % n, tagsOf(marks[p][first + i]), 0});
      }
      face.patch.loops.push_back(std::move(loop));
      first += n;
    }
    faces.push_back(std::move(face));
  }
  return meshOfPatches(mesh_, faces);
}

Frame RegionView::axesAlong(const Shape& parent, Vec2 along) const {
  const Frame& plane = plane_.frame();
  const Vec3 x = normalized(plane.x * along.x + plane.y * along.y);
  const Vec3 n = plane.z;
  // The axis of the scope that is the normal stays so.
  const bool upright = std::fabs(n.y) >= std::fabs(n.z);
  const Vec3 up = n.y < 0 && upright ? -n : n;
  Frame f = upright ? Frame::of({}, x, up, cross(x, up)) : Frame::of({}, x, cross(n, x), n);
  return Frame::of(parent.scope.origin, parent.scope.direction(f.x), parent.scope.direction(f.y),
                   parent.scope.direction(f.z));
}

Shape RegionView::shapeOf(const Shape& parent, std::span<const RegionPiece> pieces,
                          std::span<const std::vector<EdgeMark>> marks,
                          const std::optional<CellMark>& cell) {
  Shape child = parent;
  setPartMesh(child, parent, meshOf(pieces, marks, faceTags(depth_ + 1, cell)), true);
  const Vec2 axis = pieces[0].axis;
  if (std::fabs(axis.y) > 1e-9 || axis.x < 0) alignScope(child, axesAlong(parent, axis));
  forgetFarTrimPlanes(child);
  return child;
}

Shape RegionView::markedAs(const Shape& parent, const CellMark& cell) const {
  Shape s = parent;
  s.geometry = primitive(GeometryKind::QuadXz, faceTags(depth_ + 1, cell));
  return s;
}

Mesh RegionView::replaced(std::span<const RegionPiece> pieces, bool reindex) {
  std::vector<std::vector<EdgeMark>> marks;
  for (const RegionPiece& p : pieces) {
    marks.emplace_back();
    for (const EdgeOrigin& o : p.edges) {
      EdgeMark m;
      if (o.source < marks_.size()) m = marks_[o.source];
      if (o.role != EdgeRole::Kept && o.role != EdgeRole::Inner) {
        m.role = o.role;
        m.level = depth_ + 1;
      }
      // What moved off the border is no border.
      if (o.role == EdgeRole::Inner) m.level = depth_ + 1;
      marks.back().push_back(std::move(m));
    }
    if (!reindex) continue;
    const LogicalEdges l = autoindex(p.polygon.outer);
    for (size_t k = 0; k < l.of.size(); ++k) marks.back()[k].logical = l.of[k];
  }
  return meshOf(pieces, marks, faceTags(depth_, cell_));
}

void RegionView::replace(Shape& shape, std::span<const RegionPiece> pieces, bool reindex) {
  const Shape parent = shape;
  setPartMesh(shape, parent, replaced(pieces, reindex), true);
}

Shape RegionView::pointAt(const Shape& parent, Vec2 at, Vec2 along) const {
  Shape child = parent;
  Frame f = axesAlong(parent, along);
  f.origin = parent.scope.point(plane_.frame().point({at.x, at.y, 0}));
  child.scope = f;
  child.size = {};
  MeshBuilder b;
  const uint32_t p = b.addPosition({});
  b.addPolygon({&p, 1});
  setMesh(child, b.take(), ScopeFit::Keep);
  forgetFarTrimPlanes(child);
  return child;
}

Shape RegionView::segmentAt(const Shape& parent, Vec2 a, Vec2 b) const {
  Shape child = pointAt(parent, a, b - a);
  const double l = length(b - a);
  child.size = {l, 0, 0};
  MeshBuilder builder;
  const uint32_t p[2] = {builder.addPosition({}), builder.addPosition({l, 0, 0})};
  builder.addPolygon(p);
  setMesh(child, builder.take(), ScopeFit::Keep);
  return child;
}

Shape RegionView::solidOf(const Shape& parent, Mesh mesh, Vec2 along) const {
  Shape child = parent;
  for (Vec3& p : mesh.positions) p = plane_.frame().point(p);
  setPartMesh(child, parent, std::move(mesh), true);
  alignScope(child, axesAlong(parent, along));
  forgetFarTrimPlanes(child);
  return child;
}

Shape RegionView::lineOf(const Shape& parent, std::span<const Vec2> points, bool closed) const {
  MeshBuilder b;
  std::vector<uint32_t> at;
  for (const Vec2 p : points) at.push_back(b.addPosition({p.x, p.y, 0}));
  for (size_t i = 0; i + (closed ? 0 : 1) < at.size(); ++i) {
    const uint32_t ends[2] = {at[i], at[(i + 1) % at.size()]};
    b.addPolygon(ends);
  }
  return solidOf(parent, b.take(), points[1] - points[0]);
}

RegionProvenance provenanceOf(const Services& services, const Shape& shape) {
  TagSetId tags = 0;
  switch (shape.geometry.kind) {
    case GeometryKind::None:
    case GeometryKind::Box: return {};
    case GeometryKind::QuadXy: tags = shape.geometry.tags[kSideFront]; break;
    case GeometryKind::QuadXz: tags = shape.geometry.tags[kSideTop]; break;
    case GeometryKind::Mesh: tags = shape.geometry.mesh->faces[0].tags; break;
  }
  const RegionProvenance* const known = services.regionAt(tags);
  return known ? *known : RegionProvenance();
}

std::optional<uint32_t> thingSlot(OpCall& call) {
  if (call.selectors().empty()) return 0;
  for (const SelectorItem& item : call.selectors()) {
    if (item.terms.empty()) return item.slot;
  }
  return std::nullopt;
}

std::vector<size_t> regionFaces(const Mesh& mesh) {
  std::vector<size_t> out;
  for (size_t f = 0; f < mesh.faceCount(); ++f) {
    if (mesh.normal(f) != Vec3{}) out.push_back(f);
  }
  return out;
}

}  // namespace gable
