// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "json/city_json.h"

#include "json/reports_json.h"
#include "json/tiles_json.h"

namespace gable {

std::string cityJson(const CityStatistics& s, const RunFigures& figures, const TileResult* tiles,
                     const std::vector<ReportSummary>* reports) {
  std::string out;
  JsonWriter json(out, 2);
  json.beginObject().field("area", s.area).field("groundArea", s.groundArea);
  json.key("box").beginArray();
  for (const double v : s.box) json.value(v);
  json.endArray();
  if (s.lowest != 0 || s.highest != 0) {
    json.field("lowest", s.lowest).field("highest", s.highest);
  }
  json.key("surfaces").beginObject();
  for (const CityStatistics::Surface& surface : s.surfaces) {
    json.key(surface.name).beginObject().field("pieces", surface.pieces);
    json.field("area", surface.area).endObject();
  }
  json.endObject().key("shapes").beginObject();
  for (const auto& [rule, count] : s.shapes) json.field(rule, count);
  json.endObject().field("features", s.features).field("skipped", s.skipped);
  json.key("leftOut").beginArray();
  for (const CityStatistics::Skip& skip : s.skips) {
    json.beginObject().field("feature", skip.place).field("reason", skip.reason).endObject();
  }
  json.endArray();
  json.key("seconds").beginObject();
  const std::pair<const char*, std::optional<double>> parts[] = {{"plan", figures.parseSeconds},
                                                                 {"derive", figures.deriveSeconds},
                                                                 {"write", figures.writeSeconds},
                                                                 {"total", figures.totalSeconds}};
  for (const auto& [name, seconds] : parts) {
    if (seconds) json.field(name, *seconds);
  }
  json.endObject();
  if (tiles) {
    json.key("tiles").beginObject();
    writeTileCounts(json, *tiles);
    json.endObject();
  }
  if (reports) writeReports(json, *reports);
  if (figures.triangles) json.field("triangles", *figures.triangles);
  if (figures.peakBytes) json.field("peakBytes", *figures.peakBytes);
  if (figures.fileBytes) json.field("fileBytes", *figures.fileBytes);
  if (figures.savedBytes) json.field("savedBytes", *figures.savedBytes);
  json.endObject();
  out += '\n';
  return out;
}

}  // namespace gable
