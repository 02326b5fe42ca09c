// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "json/tiles_json.h"

namespace gable {

void writeTileCounts(JsonWriter& w, const TileResult& result) {
  w.field("tiles", result.tiles).field("levels", result.levels).field("shapes", result.shapes);
  w.field("triangles", result.triangles).field("coarseTriangles", result.coarseTriangles);
  w.field("bytes", result.bytes);
  if (result.shapesBefore > 0) w.field("shapesBefore", result.shapesBefore);
}

std::string tilesJson(const TileResult& result, const RunFigures& figures) {
  std::string out;
  JsonWriter w(out, 2);
  w.beginObject();
  writeTileCounts(w, result);
  w.key("seconds").beginObject();
  if (figures.parseSeconds) w.field("parse", *figures.parseSeconds);
  w.field("derive", result.deriveSeconds).field("write", result.writeSeconds);
  if (figures.totalSeconds) w.field("total", *figures.totalSeconds);
  w.endObject();
  if (figures.peakBytes) w.field("peakBytes", *figures.peakBytes);
  w.endObject();
  out += '\n';
  return out;
}

}  // namespace gable
