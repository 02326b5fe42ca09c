// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Which way faces look, and how light is smoothed across their edges. Angles are those of the shape
// at its present size, so the mesh is taken as scaled.

#include <cmath>
#include <vector>

#include "base/work.h"
#include "builtins/lists.h"
#include "builtins/ops/shared/edit_mesh.h"
#include "builtins/ops/shared/frames.h"
#include "geom/mesh/topology.h"
#include "shape/op_call.h"

namespace gable {

namespace {

// Turns a face round so that its first edge stays the first: rules address edges by number.
void turnFace(Mesh& m, size_t face) {
  for (const MeshLoop& loop : m.loopsOf(face)) {
    const uint32_t n = loop.cornerCount, first = loop.firstCorner;
    const auto reorder = [&](auto& v, uint32_t shift) {
      if (v.empty()) return;
      const auto old = std::vector(v.begin() + first, v.begin() + first + n);
      for (uint32_t i = 0; i < n; ++i) v[first + i] = old[(n + shift - i) % n];
    };
    // Corners begin with the end of the first edge, edges with the first edge itself.
    reorder(m.corners, 1);
    for (int set = 0; set < m.setCount(); ++set) reorder(m.set(set), 1);
    reorder(m.normals, 1);
    reorder(m.edgeTags, 0);
    if (m.normals.empty()) continue;
    for (uint32_t i = 0; i < n; ++i) m.normals[first + i] = -m.normals[first + i];
  }
}

Status applyReverse(OpCall& call) {
  editMesh(call.shape(), [](Mesh& m) {
    for (size_t f = 0; f < m.faceCount(); ++f) turnFace(m, f);
  });
  return {};
}

// Gives the shape a changed mesh at its present size.
template <class Edit>
void editScaled(Shape& s, Edit edit) {
  if (s.geometry.kind == GeometryKind::None) return;
  Mesh mesh = *meshInScope(s);
  edit(mesh);
  s.geometry = {GeometryKind::Mesh, false, s.size, makeRef<Mesh>(std::move(mesh))};
}

void harden(Mesh& m) {
  m.normals.clear();
  for (MeshFace& f : m.faces) f.smooth = false;
}

// Primitives and faces without corner normals are hard already.
void hardenShape(Shape& s) {
  if (s.geometry.kind == GeometryKind::Mesh) editMesh(s, harden);
}

// The direction in which a face runs along an edge, from the lower position to the higher or not.
bool ascending(const Mesh& m, const Topology& t, uint32_t corner) {
  return m.corners[corner] < m.corners[t.next(corner)];
}

// For each face whether it must turn, so that neighbours agree within each connected part; where
// more than two faces meet, nothing is asked.
std::vector<bool> turnsToAgree(const Mesh& m, const Topology& t, std::vector<uint32_t>& part) {
  std::vector<bool> turn(m.faceCount(), false);
  part.assign(m.faceCount(), Topology::kNone);
  uint32_t parts = 0;
  std::vector<uint32_t> open;
  for (uint32_t start = 0; start < m.faceCount(); ++start) {
    work();
    if (part[start] != Topology::kNone) continue;
    part[start] = parts++;
    open.assign(1, start);
    while (!open.empty()) {
      const uint32_t face = open.back();
      open.pop_back();
      for (const MeshLoop& loop : m.loopsOf(face)) {
        work(loop.cornerCount);
        for (uint32_t i = 0; i < loop.cornerCount; ++i) {
          const uint32_t corner = loop.firstCorner + i;
          const auto uses = t.usesOf(t.edgeOf(corner));
          if (uses.size() != 2) continue;
          const uint32_t other = uses[0] == corner ? uses[1] : uses[0];
          const uint32_t neighbour = t.faceOf(other);
          if (part[neighbour] != Topology::kNone) continue;
          part[neighbour] = part[face];
          const bool against = ascending(m, t, corner) == ascending(m, t, other);
          turn[neighbour] = turn[face] != against;
          open.push_back(neighbour);
        }
      }
    }
  }
  return turn;
}

// Makes neighbours agree; a closed part then looks outward, an open one up.
void conform(Mesh& m, const Vec3& up) {
  std::vector<bool> turn;
  std::vector<uint32_t> part;
  std::vector<double> volume, upward;
  std::vector<bool> closed;
  {
    const Topology t(m);
    turn = turnsToAgree(m, t, part);
    uint32_t parts = 0;
    for (const uint32_t p : part) parts = std::max(parts, p + 1);
    volume.resize(parts);
    upward.resize(parts);
    closed.assign(parts, true);
    const Vec3 origin = m.positions.empty() ? Vec3{} : m.positions[0];
    for (uint32_t f = 0; f < m.faceCount(); ++f) {
      const double sign = turn[f] ? -1 : 1;
      const Vec3 n = m.areaNormal(f);
      upward[part[f]] += sign * dot(n, up);
      volume[part[f]] += sign * dot(n, m.at(m.loopsOf(f)[0].firstCorner) - origin);
      for (const MeshLoop& loop : m.loopsOf(f)) {
        work(loop.cornerCount);
        for (uint32_t i = 0; i < loop.cornerCount; ++i) {
          if (t.usesOf(t.edgeOf(loop.firstCorner + i)).size() != 2) closed[part[f]] = false;
        }
      }
    }
  }
  for (uint32_t f = 0; f < m.faceCount(); ++f) {
    const bool inside = closed[part[f]] ? volume[part[f]] < 0 : upward[part[f]] < 0;
    if (turn[f] != inside) turnFace(m, f);
  }
  harden(m);
}

void soften(Shape& s, double angle) {
  if (angle <= 0)
    hardenShape(s);
  else
    editScaled(s, [&](Mesh& m) { softenNormals(m, angle); });
}

enum class NormalsMode : uint8_t { Hard, Conform, Soft, Auto };

}  // namespace

template <>
struct WordsOf<NormalsMode> {
  static constexpr const char* text = "hard conform soft auto";
};

namespace {

struct SetNormals {
  NormalsMode mode;
};

Status applySetNormals(OpCall& call, const SetNormals& args) {
  Shape& s = call.shape();
  if (args.mode == NormalsMode::Conform) {
    const Vec3 up = s.scope.toLocalDirection(worldFrame(call.services()).y);
    editScaled(s, [&](Mesh& m) { conform(m, up); });
  } else {
    soften(s, args.mode == NormalsMode::Soft ? 180 : args.mode == NormalsMode::Auto ? 30 : 0);
  }
  return {};
}

struct SoftenNormals {
  double angle;
};

Status applySoften(OpCall& call, const SoftenNormals& args) {
  const double angle = args.angle;
  if (std::isnan(angle)) {
    return call.fail("bad-argument", "softenNormals got no number", "give an angle in degrees");
  }
  soften(call.shape(), std::min(angle, 180.0));
  return {};
}

constexpr Signature kNoArguments[] = {{}};

constexpr ParamSpec kModeParams[] = {
    param<&SetNormals::mode>("normalsMode",
                             "Flat faces (hard), averages around vertices (soft), averages but for "
                             "edges of 30 degrees and "
                             "more (auto), or flat faces that agree which side is out (conform)."),
};
constexpr Signature kModeSignatures[] = {{kModeParams}};

constexpr ParamSpec kAngleParams[] = {
    param<&SoftenNormals::angle>(
        "angle",
        "Edges at which normals meet at this angle (degrees) or more stay hard: 0 for all, 180 for "
        "none."),
};
constexpr Signature kAngleSignatures[] = {{kAngleParams}};

constexpr OpSpec kSpecs[] = {
    {"reverseNormals", "normals", "Turns all faces round.", kNoArguments, applyReverse},
    {"setNormals", "normals", "Sets how the faces are lit, flat or smoothed.", kModeSignatures,
     typed<applySetNormals>, BlockKind::None, kReadsWorld | kReadsWorldByWord},
    {"softenNormals", "normals", "Smooths the light across edges that are not too sharp.",
     kAngleSignatures, typed<applySoften>},
};

}  // namespace

extern const OpList kOps_normals;
const OpList kOps_normals = kSpecs;

}  // namespace gable
