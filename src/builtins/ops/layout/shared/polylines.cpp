// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/layout/shared/polylines.h"

namespace gable {

namespace {

Vec2 fromAbove(const Vec3& p) { return {p.x, -p.z}; }

void close(Polyline2& line) {
  if (line.line.size() < 4 || !(line.line.front() == line.line.back())) return;
  line.line.pop_back();
  line.closed = true;
}

}  // namespace

Frame groundAt(double height) {
  Frame f = axisFrame(1, 1);
  f.origin.y = height;
  return f;
}

std::vector<Polyline2> polylinesOf(const Mesh& mesh, const TagTable& tags) {
  std::vector<Polyline2> out;
  uint32_t last = MeshBuilder::kNoPosition, lastTags = 0;
  for (size_t f = 0; f < mesh.faceCount(); ++f) {
    const auto loops = mesh.loopsOf(f);
    if (loops.size() != 1 || loops[0].cornerCount != 2) continue;
    const auto ends = mesh.cornersOf(loops[0]);
    const uint32_t faceTags = mesh.faces[f].tags;
    if (ends[0] != last || faceTags != lastTags) {
      if (!out.empty()) close(out.back());
      const Vec3& from = mesh.positions[ends[0]];
      out.push_back({{fromAbove(from)}, false, from.y, tags.streetWidth(faceTags)});
    }
    out.back().line.push_back(fromAbove(mesh.positions[ends[1]]));
    last = ends[1];
    lastTags = faceTags;
  }
  if (!out.empty()) close(out.back());
  return out;
}

void addPolyline(MeshBuilder& b, const Line& line, bool closed, double height, uint32_t tags) {
  if (line.size() < 2) return;
  const auto add = [&](Vec2 p) { return b.addPosition({p.x, height, -p.y}); };
  const uint32_t first = add(line[0]);
  uint32_t from = first;
  for (size_t i = 1; i < line.size() + (closed ? 1 : 0); ++i) {
    const uint32_t to = i < line.size() ? add(line[i]) : first;
    const uint32_t ends[2] = {from, to};
    b.addPolygon(ends, 0, tags);
    from = to;
  }
}

}  // namespace gable
