// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/subdivide/shared/components.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/disjoint_sets.h"
#include "builtins/ops/subdivide/shared/roof_edges.h"

namespace gable {

namespace {

constexpr uint32_t kNone = MeshEdge::kNone;

// Any direction square to z, for components that prefer none.
Vec3 someX(const Vec3& z) { return frameFromZ({}, z, {1, 0, 0}).x; }

}  // namespace

Components::Components(const Mesh& m, ComponentKind kind, std::vector<uint16_t> firstSlots,
                       std::span<const Vec3> ups)
    : mesh_(m),
      kind_(kind),
      edges_(std::make_unique<MeshEdges>(m)),
      firstSlots_(std::move(firstSlots)) {
  for (size_t f = 0; f < m.faceCount(); ++f) normals_.push_back(m.normal(f));
  switch (kind) {
    case ComponentKind::Faces: addFaces(); break;
    case ComponentKind::Edges: addEdges(ups); break;
    case ComponentKind::FaceEdges: addFaceEdges(); break;
    case ComponentKind::Vertices: addVertices(); break;
    case ComponentKind::FaceVertices: addFaceVertices(); break;
    case ComponentKind::Slots: addSlots(); break;
    case ComponentKind::Holes: addHoles(); break;
  }
  for (uint32_t i = 0; i < list_.size(); ++i) list_[i].what.index = i;
}

bool Components::facesBorder(uint32_t face) const {
  for (const MeshLoop& loop : mesh_.loopsOf(face)) {
    for (uint32_t i = 0; i < loop.cornerCount; ++i) {
      if (edges_->edges()[edges_->edgeOf(loop.firstCorner + i)].uses == 1) return true;
    }
  }
  return false;
}

void Components::addFaces() {
  for (uint32_t f = 0; f < mesh_.faceCount(); ++f) {
    Component c;
    c.face = f;
    c.corner = mesh_.loopsOf(f)[0].firstCorner;
    c.what.normal = c.z = normals_[f];
    c.what.border = facesBorder(f);
    c.origin = mesh_.at(c.corner);
    c.x = mesh_.at(edges_->next(c.corner)) - c.origin;
    list_.push_back(c);
  }
}

Vec3 Components::meanNormalOfEdge(uint32_t edge) const {
  const MeshEdge& e = edges_->edges()[edge];
  Vec3 sum = normals_[edges_->faceOf(e.corner)];
  if (e.other != kNone) sum += normals_[edges_->faceOf(e.other)];
  // Faces folded back on each other, or an edge of no face, leave no mean.
  if (length(sum) > 1e-9) return normalized(sum);
  if (!mesh_.normals.empty() && length(mesh_.normals[e.corner]) > 0) {
    return mesh_.normals[e.corner];
  }
  return normals_[edges_->faceOf(e.corner)];
}

void Components::addEdges(std::span<const Vec3> ups) {
  for (uint32_t i = 0; i < edges_->edges().size(); ++i) {
    const MeshEdge& e = edges_->edges()[i];
    // The edge face of two corners has its one edge twice.
    if (mesh_.corners[e.corner] == mesh_.corners[edges_->next(e.corner)]) continue;
    Component c;
    c.face = edges_->faceOf(e.corner);
    c.corner = e.corner;
    c.from = mesh_.corners[e.corner];
    c.to = mesh_.corners[edges_->next(e.corner)];
    const bool ownFace = e.other != kNone && edges_->faceOf(e.other) == c.face && e.uses == 2 &&
                         mesh_.loopsOf(c.face)[0].cornerCount == 2;
    c.what.border = e.uses == 1 || ownFace;
    c.what.normal = c.z = meanNormalOfEdge(i);
    list_.push_back(c);
  }
  placeRoofEdges(ups);
  for (Component& c : list_) {
    c.origin = mesh_.positions[c.from];
    c.x = mesh_.positions[c.to] - c.origin;
    if (c.z == Vec3{}) c.what.normal = c.z = frameFromZ({}, c.x, {0, 1, 0}).x;
  }
}

void Components::placeRoofEdges(std::span<const Vec3> ups) {
  const std::vector<PlacedEdge> placed = roofEdges(mesh_, *edges_, normals_, ups);
  for (Component& c : list_) {
    const PlacedEdge& e = placed[edges_->edgeOf(c.corner)];
    c.what.roof = e.what;
    c.from = e.from;
    c.to = e.to;
  }
}

void Components::addFaceEdges() {
  for (uint32_t f = 0; f < mesh_.faceCount(); ++f) {
    for (const MeshLoop& loop : mesh_.loopsOf(f)) {
      // An edge is a face edge of its own, once.
      const uint32_t count = loop.cornerCount == 2  ? 1
                             : loop.cornerCount < 2 ? 0
                                                    : loop.cornerCount;
      for (uint32_t i = 0; i < count; ++i) {
        Component c;
        c.face = f;
        c.corner = loop.firstCorner + i;
        c.from = mesh_.corners[c.corner];
        c.to = mesh_.corners[edges_->next(c.corner)];
        c.origin = mesh_.positions[c.from];
        c.x = mesh_.positions[c.to] - c.origin;
        c.what.border = edges_->edges()[edges_->edgeOf(c.corner)].uses == 1;
        c.z = normalized(cross(c.x, normals_[f]));
        if (c.z == Vec3{} && !mesh_.normals.empty()) c.z = mesh_.normals[c.corner];
        if (c.z == Vec3{}) c.z = someX(c.x);
        c.what.normal = c.z;
        list_.push_back(c);
      }
    }
  }
}

void Components::addVertices() {
  std::vector<bool> met(mesh_.positions.size(), false);
  for (uint32_t corner = 0; corner < mesh_.corners.size(); ++corner) {
    const uint32_t position = mesh_.corners[corner];
    if (met[position]) continue;
    met[position] = true;
    Component c;
    c.corner = corner;
    c.face = edges_->faceOf(corner);
    c.from = position;
    c.origin = mesh_.positions[position];
    Vec3 sum;
    for (const uint32_t at : edges_->cornersAt(position)) {
      sum += normals_[edges_->faceOf(at)];
      c.what.border |= edges_->edges()[edges_->edgeOf(at)].uses == 1 ||
                       edges_->edges()[edges_->edgeOf(edges_->previous(at))].uses == 1;
    }
    c.what.normal = c.z = length(sum) > 1e-9 ? normalized(sum) : Vec3{0, 1, 0};
    c.x = someX(c.z);
    list_.push_back(c);
  }
}

void Components::addFaceVertices() {
  for (uint32_t f = 0; f < mesh_.faceCount(); ++f) {
    for (const MeshLoop& loop : mesh_.loopsOf(f)) {
      for (uint32_t i = 0; i < loop.cornerCount; ++i) {
        Component c;
        c.face = f;
        c.corner = loop.firstCorner + i;
        c.from = mesh_.corners[c.corner];
        c.origin = mesh_.at(c.corner);
        const Vec3 before = normalized(c.origin - mesh_.at(edges_->previous(c.corner)));
        const Vec3 after = normalized(mesh_.at(edges_->next(c.corner)) - c.origin);
        // At a turn right round the tangent is that of the edge that follows.
        const Vec3 tangent = before + after;
        c.x = loop.cornerCount == 2 || length(tangent) < 1e-9 ? after : tangent;
        const Vec3 normal = normals_[f] == Vec3{} ? someX(c.x) : normals_[f];
        c.what.normal = c.z = normalized(cross(c.x, normal));
        c.what.border = edges_->edges()[edges_->edgeOf(c.corner)].uses == 1 ||
                        edges_->edges()[edges_->edgeOf(edges_->previous(c.corner))].uses == 1;
        list_.push_back(c);
      }
    }
  }
}

uint32_t Components::slotOf(uint32_t face) const {
  const uint16_t slot = mesh_.faces[face].materialSlot;
  return slot < firstSlots_.size() ? firstSlots_[slot] : slot;
}

std::span<const uint32_t> Components::facesOfSlot(uint32_t slot) const {
  const auto first = std::partition_point(bySlot_.begin(), bySlot_.end(),
                                          [&](uint32_t f) { return slotOf(f) < slot; });
  const auto end =
      std::partition_point(first, bySlot_.end(), [&](uint32_t f) { return slotOf(f) == slot; });
  const auto begin = static_cast<size_t>(first - bySlot_.begin());
  return std::span(bySlot_).subspan(begin, static_cast<size_t>(end - first));
}

void Components::addSlots() {
  bySlot_.resize(mesh_.faceCount());
  std::iota(bySlot_.begin(), bySlot_.end(), 0);
  std::stable_sort(bySlot_.begin(), bySlot_.end(),
                   [&](uint32_t a, uint32_t b) { return slotOf(a) < slotOf(b); });
  for (size_t i = 0; i < bySlot_.size(); ++i) {
    const uint32_t f = bySlot_[i];
    const uint32_t slot = slotOf(f);
    if (i > 0 && slotOf(bySlot_[i - 1]) == slot) continue;
    Component c;
    c.face = slot;
    c.corner = mesh_.loopsOf(f)[0].firstCorner;
    c.origin = mesh_.at(c.corner);
    c.x = mesh_.at(edges_->next(c.corner)) - c.origin;
    c.what.normal = c.z = normals_[f];
    list_.push_back(c);
  }
}

void Components::addHoles() {
  for (uint32_t f = 0; f < mesh_.faceCount(); ++f) {
    const auto loops = mesh_.loopsOf(f);
    for (size_t l = 1; l < loops.size(); ++l) {
      Component c;
      c.face = f;
      c.corner = loops[l].firstCorner;
      c.origin = mesh_.at(c.corner);
      // The hole is turned round, so its first edge is the loop's last.
      c.x = mesh_.at(edges_->previous(c.corner)) - c.origin;
      c.what.normal = c.z = normals_[f];
      c.what.borderless = true;
      list_.push_back(c);
    }
  }
}

namespace {

// Copies parts of a mesh with all that belongs to them.
class Extractor {
 public:
  // `map` has no position, and has none again when the mesh was taken: a map of its own for each
  // component of a large mesh would take quadratic time.
  Extractor(const Mesh& from, std::vector<uint32_t>& map) : from_(from), map_(map) {
    map_.resize(from_.positions.size(), MeshBuilder::kNoPosition);
  }

  void face(size_t f) {
    builder_.copyFace(from_, f, map_);
    faces_.push_back(f);
  }
  void hole(const MeshLoop& loop) {
    builder_.beginFace();
    builder_.beginLoop();
    for (uint32_t i = 0; i < loop.cornerCount; ++i) {
      const uint32_t c = loop.firstCorner + (loop.cornerCount - i) % loop.cornerCount;
      const uint32_t edge = loop.firstCorner + (loop.cornerCount - 1 - i);
      corner(c, from_.corners[c], from_.edgeTagsAt(edge));
    }
  }
  // `next` is the corner behind the edge's.
  void edge(const Component& c, uint32_t next, uint32_t tags) {
    builder_.beginFace(from_.faces[c.face].materialSlot);
    builder_.beginLoop();
    for (const uint32_t position : {c.from, c.to}) {
      const uint32_t like = from_.corners[next] == position ? next : c.corner;
      builder_.setNormal(corner(like, position, tags), c.z);
    }
  }
  void vertex(const Component& c) {
    builder_.beginFace(from_.faces[c.face].materialSlot);
    builder_.beginLoop();
    builder_.setNormal(corner(c.corner, c.from, 0), c.z);
  }
  Mesh take() {
    for (const size_t f : faces_) {
      for (const MeshLoop& loop : from_.loopsOf(f)) {
        for (uint32_t i = 0; i < loop.cornerCount; ++i) forget(from_.corners[loop.firstCorner + i]);
      }
    }
    for (const uint32_t position : positions_) forget(position);
    return builder_.take();
  }

 private:
  void forget(uint32_t position) { map_[position] = MeshBuilder::kNoPosition; }

  uint32_t corner(uint32_t like, uint32_t position, uint32_t tags) {
    uint32_t& to = map_[position];
    if (to == MeshBuilder::kNoPosition) {
      to = builder_.copyPosition(from_, position);
      positions_.push_back(position);
    }
    const uint32_t made = builder_.addCorner(to, tags);
    for (int set = 0; set < from_.setCount(); ++set) {
      if (from_.hasUv(set)) builder_.setUv(made, set, from_.set(set)[like]);
    }
    return made;
  }

  const Mesh& from_;
  MeshBuilder builder_;
  std::vector<uint32_t>& map_;
  std::vector<size_t> faces_;
  std::vector<uint32_t> positions_;
};

}  // namespace

Mesh Components::meshOf(const std::vector<uint32_t>& which) {
  Extractor out(mesh_, positionMap_);
  for (const uint32_t i : which) {
    const Component& c = list_[i];
    switch (kind_) {
      case ComponentKind::Faces: out.face(c.face); break;
      case ComponentKind::Edges:
      case ComponentKind::FaceEdges:
        out.edge(c, edges_->next(c.corner), mesh_.edgeTagsAt(c.corner));
        break;
      case ComponentKind::Vertices:
      case ComponentKind::FaceVertices: out.vertex(c); break;
      case ComponentKind::Slots:
        for (const uint32_t f : facesOfSlot(c.face)) out.face(f);
        break;
      case ComponentKind::Holes:
        for (const MeshLoop& loop : mesh_.loopsOf(c.face)) {
          if (loop.firstCorner == c.corner) out.hole(loop);
        }
        break;
    }
  }
  return out.take();
}

std::vector<std::vector<uint32_t>> Components::connected(const std::vector<uint32_t>& which) const {
  DisjointSets sets(which.size());
  // Faces meet at edges, other components at positions.
  const bool byEdge = kind_ == ComponentKind::Faces;
  std::vector<uint32_t> owner(byEdge ? edges_->edges().size() : mesh_.positions.size(), kNone);
  const auto meet = [&](uint32_t at, uint32_t member) {
    if (owner[at] == kNone) {
      owner[at] = member;
    } else {
      sets.join(owner[at], member);
    }
  };
  for (uint32_t i = 0; i < which.size(); ++i) {
    const Component& c = list_[which[i]];
    if (byEdge) {
      for (const MeshLoop& loop : mesh_.loopsOf(c.face)) {
        for (uint32_t k = 0; k < loop.cornerCount; ++k) {
          meet(edges_->edgeOf(loop.firstCorner + k), i);
        }
      }
    } else if (kind_ == ComponentKind::Edges || kind_ == ComponentKind::FaceEdges) {
      meet(c.from, i);
      meet(c.to, i);
    } else if (kind_ == ComponentKind::Vertices || kind_ == ComponentKind::FaceVertices) {
      meet(c.from, i);
    }
  }
  std::vector<std::vector<uint32_t>> out;
  std::vector<uint32_t> place(which.size(), kNone);
  for (uint32_t i = 0; i < which.size(); ++i) {
    const uint32_t root = sets.find(i);
    if (place[root] == kNone) {
      place[root] = static_cast<uint32_t>(out.size());
      out.emplace_back();
    }
    out[place[root]].push_back(which[i]);
  }
  return out;
}

void Components::edgeTags(uint32_t edge, std::vector<uint32_t>& out) const {
  const MeshEdge& e = edges_->edges()[edge];
  for (const uint32_t corner : {e.corner, e.other}) {
    if (corner == kNone) continue;
    out.push_back(mesh_.edgeTagsAt(corner));
    out.push_back(mesh_.faces[edges_->faceOf(corner)].tags);
  }
}

void Components::vertexTags(uint32_t position, std::vector<uint32_t>& out) const {
  out.push_back(mesh_.vertexTagsAt(position));
  for (const uint32_t corner : edges_->cornersAt(position)) {
    edgeTags(edges_->edgeOf(corner), out);
    edgeTags(edges_->edgeOf(edges_->previous(corner)), out);
  }
}

void Components::faceTags(uint32_t face, Of of, std::vector<uint32_t>& out) const {
  out.push_back(mesh_.faces[face].tags);
  if (of == Of::Component) return;
  for (const MeshLoop& loop : mesh_.loopsOf(face)) {
    for (uint32_t i = 0; i < loop.cornerCount; ++i) {
      const uint32_t c = loop.firstCorner + i;
      if (of == Of::Edges) {
        edgeTags(edges_->edgeOf(c), out);
      } else {
        vertexTags(mesh_.corners[c], out);
      }
    }
  }
}

// Vertices have no sides and holes no tags of their own.
void Components::ownTags(const Component& c, std::vector<uint32_t>& out) const {
  switch (kind_) {
    case ComponentKind::Faces: out.push_back(mesh_.faces[c.face].tags); return;
    case ComponentKind::Slots:
      for (const uint32_t f : facesOfSlot(c.face)) out.push_back(mesh_.faces[f].tags);
      return;
    case ComponentKind::FaceEdges: out.push_back(mesh_.edgeTagsAt(c.corner)); return;
    case ComponentKind::Edges: {
      const MeshEdge& e = edges_->edges()[edges_->edgeOf(c.corner)];
      out.push_back(mesh_.edgeTagsAt(e.corner));
      if (e.other != kNone) out.push_back(mesh_.edgeTagsAt(e.other));
      return;
    }
    case ComponentKind::Vertices:
    case ComponentKind::FaceVertices: out.push_back(mesh_.vertexTagsAt(c.from)); return;
    case ComponentKind::Holes: return;
  }
}

void Components::tagsOf(const Selectable& what, Of of, std::vector<uint32_t>& out) const {
  const Component& c = list_[what.index];
  if (of == Of::Itself) return ownTags(c, out);
  switch (kind_) {
    case ComponentKind::Faces:
    case ComponentKind::Holes: return faceTags(c.face, of, out);
    case ComponentKind::Slots:
      for (const uint32_t f : facesOfSlot(c.face)) faceTags(f, of, out);
      return;
    case ComponentKind::Edges:
    case ComponentKind::FaceEdges:
      if (of == Of::Vertices) {
        vertexTags(c.from, out);
        vertexTags(c.to, out);
      } else {
        edgeTags(edges_->edgeOf(c.corner), out);
      }
      return;
    case ComponentKind::Vertices:
    case ComponentKind::FaceVertices: return vertexTags(c.from, out);
  }
}

void Components::pointsOf(const Selectable& what, std::vector<Vec3>& out) const {
  const Component& c = list_[what.index];
  const auto addLoop = [&](const MeshLoop& loop) {
    for (const uint32_t p : mesh_.cornersOf(loop)) out.push_back(mesh_.positions[p]);
  };
  switch (kind_) {
    case ComponentKind::Faces: return addLoop(mesh_.loopsOf(c.face)[0]);
    case ComponentKind::Slots:
      for (const uint32_t f : facesOfSlot(c.face)) addLoop(mesh_.loopsOf(f)[0]);
      return;
    case ComponentKind::Holes:
      for (const MeshLoop& loop : mesh_.loopsOf(c.face)) {
        if (loop.firstCorner == c.corner) addLoop(loop);
      }
      return;
    case ComponentKind::Edges:
    case ComponentKind::FaceEdges: out.push_back(mesh_.positions[c.to]); [[fallthrough]];
    case ComponentKind::Vertices:
    case ComponentKind::FaceVertices: out.push_back(mesh_.positions[c.from]);
  }
}

}  // namespace gable
