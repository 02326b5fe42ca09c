// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "engine/terrain_record.h"

#include <algorithm>
#include <utility>

#include "base/bytes.h"
#include "base/work.h"

namespace gable {
namespace {

using Facet = TerrainSurface::Facet;
using Piece = TerrainSurface::Piece;

// A piece has room in memory that may hold anything, so its fields go one by one.
void write(ByteWriter& w, const Piece& p) {
  for (const uint32_t v : {p.firstFacet, p.facetCount, p.firstPoint, p.pointCount}) w.value(v);
  w.value(static_cast<uint8_t>(p.level));
}

Piece readPiece(ByteReader& r) {
  Piece p;
  for (uint32_t* v : {&p.firstFacet, &p.facetCount, &p.firstPoint, &p.pointCount}) {
    *v = r.value<uint32_t>();
  }
  p.level = r.value<uint8_t>() != 0;
  return p;
}

// Whether all numbers name what is there.
bool fits(const std::vector<Vec3>& points, const std::vector<Facet>& facets,
          const std::vector<Piece>& pieces) {
  const auto within = [](uint64_t first, uint64_t count, size_t size) {
    return first + count <= size;
  };
  return std::all_of(points.begin(), points.end(), [](const Vec3& p) { return isFinite(p); }) &&
         std::all_of(facets.begin(), facets.end(),
                     [&](const Facet& f) {
                       work();
                       const auto isPoint = [&](uint32_t i) { return i < points.size(); };
                       return f.piece < pieces.size() &&
                              std::all_of(f.points.begin(), f.points.end(), isPoint);
                     }) &&
         std::all_of(pieces.begin(), pieces.end(), [&](const Piece& p) {
           return within(p.firstFacet, p.facetCount, facets.size()) &&
                  within(p.firstPoint, p.pointCount, points.size());
         });
}

}  // namespace

std::string terrainBytes(const TerrainSurface& terrain) {
  std::string out;
  ByteWriter w(out);
  w.list(terrain.points());
  w.list(terrain.facets());
  w.value(uint64_t{terrain.pieces().size()});
  for (const Piece& p : terrain.pieces()) write(w, p);
  return out;
}

std::shared_ptr<const TerrainSurface> terrainOf(std::string_view bytes) {
  ByteReader r(bytes);
  auto points = r.list<Vec3>();
  auto facets = r.list<Facet>();
  std::vector<Piece> pieces(r.count(4 * sizeof(uint32_t) + 1));
  for (Piece& p : pieces) p = readPiece(r);
  if (!r.ok() || !r.atEnd() || !fits(points, facets, pieces)) return nullptr;
  return std::make_shared<TerrainSurface>(std::move(points), std::move(facets), std::move(pieces));
}

}  // namespace gable
