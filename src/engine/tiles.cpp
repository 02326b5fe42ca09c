// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// From rules and shapes in memory to a folder of tiles, a unit after the other.

#include "gable/tiles.h"

#include "engine/city_rules.h"
#include "engine/guard.h"
#include "engine/tile_plan.h"
#include "engine/tile_source.h"
#include "tiles/placement.h"

namespace gable {

namespace {

void tile(const Rules& rules, const Shapes& shapes, const std::string& path,
          const TileSettings& settings, Task& task, TileResult& result) {
  const double begin = now();
  if (auto e = formMistake(settings)) return fail(result, *e);
  TileFolder folder(path);
  if (!settings.replacePlan) {
    if (auto e = planInUse(folder)) return fail(result, *e);
  }
  if (auto e = folder.open()) return fail(result, *e);
  result.diagnostics = cityRuleNotes(shapes.impl(), rules.impl());
  Told told;
  ShapeSource source(rules, shapes, settings.derive, told, result);
  if (settings.derive.progress) {
    source.showProgress([&](size_t done) { settings.derive.progress(done, shapes.size()); });
  }
  TileTreeOptions options = tileOptions(rules, settings, folder.path());
  options.meter = &task.allowance();
  if (options.together) warnTogether(result.diagnostics);
  std::vector<Vec2> middles;
  middles.reserve(shapes.size());
  for (size_t i = 0; i < shapes.size(); ++i) middles.push_back(source.middle(i));
  const TileDivision division = divided(middles, unitShapes(rules));
  const Result<TilePart> all = writeTileTop(
      division,
      [&](size_t i) {
        const TileUnit& unit = division.units[i];
        return writeTileUnit(source, division.squareOf(unit.name), unit, options);
      },
      options);
  if (!all.ok()) return fail(result, all.error());
  takeCounts(all.value(), result);
  if (!all.value().root) {
    return fail(result, {"tiles-empty", "nothing is built on the shapes, so there are no tiles",
                         "see that the shapes are where you look, and what the rules begin with"});
  }
  const Result<uint64_t> bytes = folder.close(all.value(), placementOf(shapes.impl().geo.get()));
  if (!bytes.ok()) return fail(result, bytes.error());
  result.ok = true;
  result.shapes = shapes.size();
  result.bytes += bytes.value();
  result.writeSeconds = now() - begin - result.deriveSeconds;
}

}  // namespace

TileResult writeTiles(const Rules& rules, const Shapes& shapes, const std::string& folder,
                      const TileSettings& settings) {
  FileLimits limits = settings.limits;
  if (!limits.cancel) limits.cancel = settings.derive.cancel;
  return guardedResult<TileResult>(Task("writing", folder, limits), [&](Task& task) {
    TileResult result;
    if (rules.ok()) tile(rules, shapes, folder, settings, task, result);
    return result;
  });
}

}  // namespace gable
