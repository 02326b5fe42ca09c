// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// gable tiles: rules and shapes as a folder of 3D Tiles, at once or as a plan, its jobs and their
// merge.

#include "tiles.h"

#include <algorithm>
#include <filesystem>

#include "answer.h"
#include "derive_settings.h"
#include "gable/names.h"
#include "json/tiles_json.h"
#include "progress.h"
#include "tiles_viewer.h"

namespace {

int statusOfTiles(const gable::DiagnosticList& diagnostics) {
  for (const gable::Diagnostic& d : diagnostics) {
    if (d.code == "tiles-folder" || d.code == "tiles-plan" || d.code == "tiles-planned" ||
        d.code == "tiles-join" || d.code.starts_with("file-")) {
      return kExitFile;
    }
  }
  return statusOf(diagnostics, kExitWrong);
}

/// Prints what there is to say; the exit status.
int told(const gable::TileResult& result) {
  print(result.diagnostics);
  printLines(result.prints, stderr);
  if (result.end != gable::End::Done) return kExitLimit;
  return result.ok ? static_cast<int>(kExitDone) : statusOfTiles(result.diagnostics);
}

int told(const gable::TilePlan& plan) {
  print(plan.diagnostics());
  return plan.ok() ? static_cast<int>(kExitDone) : statusOfTiles(plan.diagnostics());
}

/// What a command may use for all that it runs, one thing after the other.
struct Means {
  std::optional<int> threads;
  LimitArguments limits;
  /// Of the command.
  double begin = 0;

  /// For the next one: with the time that is left.
  gable::TileRun run() const {
    gable::TileRun run;
    run.threads = threads;
    run.limits = fileLimits(limits);
    // Places take what time they take.
    run.limits.seconds.reset();
    if (limits.maxSeconds > 0.0) {
      run.limits.seconds = std::max(0.0, *limits.maxSeconds - (secondsNow() - begin));
    }
    run.cancel = cancelFlag();
    return run;
  }
};

int writeStats(const std::string& path, const gable::TileResult& result, double begin,
               double parseSeconds) {
  gable::RunFigures figures;
  figures.parseSeconds = parseSeconds;
  figures.totalSeconds = secondsNow() - begin;
  figures.peakBytes = peakBytes();
  const std::string text = gable::tilesJson(result, figures);
  answer().members(text);
  return writeCounts(path, text);
}

gable::TileSettings tileSettings(const TileArguments& arguments, const LimitArguments& limits) {
  gable::TileSettings tiles;
  tiles.triangles = arguments.triangles;
  tiles.compress = arguments.compress;
  tiles.instancing = gable::instancingNamed(arguments.instancing).value_or(tiles.instancing);
  tiles.vertices = gable::verticesNamed(arguments.vertices).value_or(tiles.vertices);
  tiles.replacePlan = arguments.replacePlan;
  tiles.limits = fileLimits(limits);
  // Places take what time they take.
  if (!limits.maxSeconds) tiles.limits.seconds.reset();
  return tiles;
}

gable::TilePlanSettings planSettings(const DeriveArguments& derive, const TileArguments& tiles,
                                     bool ofOneRun) {
  gable::TilePlanSettings settings;
  settings.rules = derive.rules;
  settings.load = {derive.project, derive.dialect, derive.style, derive.search};
  settings.jobShapes = tiles.jobShapes;
  settings.tiles = tileSettings(tiles, derive.limits);
  settings.ofOneRun = ofOneRun;
  return settings;
}

/// Maps are read a piece at a time; others are in memory first.
int planFolder(const DeriveArguments& derive, const TileArguments& tiles, bool ofOneRun,
               const std::string& folder, gable::TilePlan& plan) {
  gable::TilePlanSettings settings = planSettings(derive, tiles, ofOneRun);
  if (!derive.shapes.empty() && !derive.cutNested) {
    gable::Rules rules(nullptr);
    if (const int status = readRules(derive, rules)) return status;
    if (const int status = deriveSettings(derive, settings.tiles.derive)) return status;
    const gable::FeatureSelection selection = selectionOf(derive);
    plan = gable::planTiles(rules, derive.shapes, selection, folder, settings);
    return told(plan);
  }
  Inputs inputs;
  if (const int status = readInputs(derive, inputs)) return status;
  settings.tiles.derive = inputs.settings;
  plan = gable::planTiles(inputs.rules, inputs.shapes, folder, settings);
  return told(plan);
}

/// Runs jobs one after the other; `result` has their counts.
int runJobs(const gable::TilePlan& plan, const gable::Rules& rules,
            const std::vector<uint64_t>& jobs, const Means& means, gable::TileResult& result) {
  Progress progress("writing tiles");
  const std::function<void(size_t, size_t)> show = progress.callback();
  for (size_t i = 0; i < jobs.size(); ++i) {
    gable::TileRun run = means.run();
    if (show) {
      run.progress = [&, i](size_t done, size_t total) {
        constexpr size_t kSteps = 1000;
        show(i * kSteps + (total ? done * kSteps / total : 0), jobs.size() * kSteps);
      };
    }
    const gable::TileResult one = gable::runTileJob(plan, rules, jobs[i], run);
    if (const int status = told(one)) return status;
    result.ok = true;
    result.tiles += one.tiles;
    result.levels = std::max(result.levels, one.levels);
    result.shapes += one.shapes;
    result.shapesBefore += one.shapesBefore;
    result.triangles += one.triangles;
    result.coarseTriangles += one.coarseTriangles;
    result.bytes += one.bytes;
    result.deriveSeconds += one.deriveSeconds;
    result.writeSeconds += one.writeSeconds;
  }
  return kExitDone;
}

/// "3" or "3-17", both within the plan; false, with a message, for anything else.
bool parseJobs(const std::string& text, uint64_t count, std::vector<uint64_t>& jobs) {
  const size_t dash = text.find('-');
  double first = 0, last = 0;
  const NumberRange range{0, static_cast<double>(count) - 1, true};
  if (!parseNumber(text.substr(0, dash), range, first) ||
      !parseNumber(dash == std::string::npos ? text : text.substr(dash + 1), range, last) ||
      last < first) {
    fail(kExitUsage, "'" + text + "' names no jobs of the plan; it has 0 to " +
                         std::to_string(count - 1) + ", as 3 or 3-17");
    return false;
  }
  for (auto j = static_cast<uint64_t>(first); j <= static_cast<uint64_t>(last); ++j) {
    jobs.push_back(j);
  }
  return true;
}

int rulesOf(const gable::TilePlan& plan, const LimitArguments& limits, gable::Rules& rules) {
  rules = plan.rules(fileLimits(limits));
  print(rules.diagnostics());
  if (!rules.found()) return kExitFile;
  return rules.ok() ? static_cast<int>(kExitDone) : statusOf(rules.diagnostics(), kExitWrong);
}

/// Runs all jobs of a plan and merges, in this process.
int runPlan(const gable::TilePlan& plan, const gable::Rules& rules, const Means& means,
            gable::TileResult& result) {
  std::vector<uint64_t> jobs;
  for (uint64_t j = 0; j < plan.jobs(); ++j) jobs.push_back(j);
  gable::TileResult made;
  if (const int status = runJobs(plan, rules, jobs, means, made)) {
    result.end = made.end;
    return status;
  }
  result = gable::mergeTiles(plan, means.run());
  result.deriveSeconds = made.deriveSeconds;
  result.writeSeconds += made.writeSeconds;
  return told(result);
}

/// Many bytes are told, with what would make them fewer.
void tellTiles(const std::string& folder, const gable::TileResult& result, bool compressed) {
  constexpr uint64_t kMany = 20'000'000;
  answer().wrote(folder);
  if (compressed || result.bytes < kMany) return;
  note(std::to_string(result.bytes / 1'000'000) +
       " MB of tiles; --compress writes about a sixth of that");
}

/// Memory does not grow with the map, and what was begun before goes on.
int runInPieces(const TilesArguments& arguments, const std::string& folder, double begin) {
  ViewerPage page;
  if (arguments.tiles.viewer) {
    if (const int status = page.findOrTell(folder)) return status;
  }
  gable::TilePlan plan(nullptr);
  if (const int status = planFolder(arguments.derive, arguments.tiles, true, folder, plan)) {
    return status;
  }
  const double planned = secondsNow();
  const gable::Rules rules = plan.rules(fileLimits(arguments.derive.limits));
  const Means means{arguments.derive.jobs, arguments.derive.limits, begin};
  gable::TileResult result;
  if (const int status = runPlan(plan, rules, means, result)) return status;
  if (const int status = page.write()) return status;
  tellTiles(folder, result, arguments.tiles.compress);
  return writeStats(arguments.stats, result, begin, planned - begin);
}

/// Tiles of shapes that are in memory.
int writeTileFolder(const TilesArguments& arguments, const Inputs& inputs,
                    const std::string& folder, gable::TileResult& result) {
  ViewerPage page;
  if (arguments.tiles.viewer) {
    if (const int status = page.findOrTell(folder)) return status;
  }
  Progress progress("writing tiles", "shapes");
  gable::TileSettings tiles = tileSettings(arguments.tiles, arguments.derive.limits);
  tiles.derive = inputs.settings;
  tiles.derive.progress = progress.callback();
  result = gable::writeTiles(inputs.rules, inputs.shapes, folder, tiles);
  if (const int status = told(result)) return status;
  return page.write();
}

int tellPlan(const gable::TilePlan& plan, const std::string& folder) {
  const std::string jobs = std::to_string(plan.jobs()), shapes = std::to_string(plan.shapes());
  answer().wrote(folder);
  answer().member("jobs", jobs);
  answer().member("shapes", shapes);
  tell(jobs + " jobs for " + shapes + " shapes in " + folder + "\n");
  return kExitDone;
}

}  // namespace

std::string tileFolder(const std::string& output) {
  constexpr std::string_view kTileset = "tileset.json";
  if (output.ends_with('/')) return output;
  if (output == kTileset) return "./";
  if (output.ends_with("/" + std::string(kTileset))) {
    return output.substr(0, output.size() - kTileset.size());
  }
  std::error_code error;
  return std::filesystem::is_directory(output, error) ? output + "/" : std::string();
}

std::string asFolder(const std::string& output) {
  const std::string folder = tileFolder(output);
  return folder.empty() ? output + "/" : folder;
}

int makeTiles(const DeriveArguments& derive, const TileArguments& tiles, const PlacedShapes& placed,
              const std::string& folder, gable::TileResult& result) {
  const double begin = secondsNow();
  ViewerPage page;
  if (tiles.viewer) {
    if (const int status = page.findOrTell(folder)) return status;
  }
  gable::TilePlanSettings settings = planSettings(derive, tiles, !tiles.onlyPlan);
  settings.tiles.derive = placed.settings;
  const gable::TilePlan plan = gable::planTiles(placed.rules, placed.shapes, folder, settings);
  if (const int status = told(plan)) return status;
  if (tiles.onlyPlan) return tellPlan(plan, folder);
  const Means means{derive.jobs, derive.limits, begin};
  if (const int status = runPlan(plan, placed.rules, means, result)) return status;
  tellTiles(folder, result, tiles.compress);
  return page.write();
}

int runTiles(const TilesArguments& arguments) {
  const double begin = secondsNow();
  const std::string folder = asFolder(arguments.output);
  if (!arguments.derive.cutNested && gable::isReadInPieces(arguments.derive.shapes)) {
    return runInPieces(arguments, folder, begin);
  }
  Inputs inputs;
  if (const int status = readInputs(arguments.derive, inputs)) return status;
  gable::TileResult result;
  if (const int status = writeTileFolder(arguments, inputs, folder, result)) return status;
  tellTiles(folder, result, arguments.tiles.compress);
  return writeStats(arguments.stats, result, begin, inputs.rules.parseSeconds());
}

int runTilesPlan(const PlanArguments& arguments) {
  const std::string folder = asFolder(arguments.output);
  gable::TilePlan plan(nullptr);
  if (const int status = planFolder(arguments.derive, arguments.tiles, false, folder, plan)) {
    return status;
  }
  return tellPlan(plan, folder);
}

int runTilesJob(const JobArguments& arguments) {
  const double begin = secondsNow();
  const gable::TilePlan plan = gable::TilePlan::load(asFolder(arguments.folder));
  if (const int status = told(plan)) return status;
  std::vector<uint64_t> jobs;
  if (!parseJobs(arguments.jobs, plan.jobs(), jobs)) return kExitUsage;
  gable::Rules rules(nullptr);
  if (const int status = rulesOf(plan, arguments.limits, rules)) return status;
  gable::TileResult result;
  const Means means{arguments.threads, arguments.limits, begin};
  if (const int status = runJobs(plan, rules, jobs, means, result)) return status;
  return writeStats(arguments.stats, result, begin, rules.parseSeconds());
}

int runTilesJoin(const std::vector<std::string>& places, const std::string& output) {
  gable::FileLimits limits;
  limits.cancel = cancelFlag();
  const gable::DiagnosticList told = gable::joinTilesets(places, asFolder(output), limits);
  print(told);
  if (!gable::hasErrors(told)) answer().wrote(asFolder(output));
  return gable::hasErrors(told) ? statusOfTiles(told) : static_cast<int>(kExitDone);
}

int runTilesMerge(const MergeArguments& arguments) {
  const double begin = secondsNow();
  const std::string folder = asFolder(arguments.folder);
  ViewerPage page;
  if (arguments.viewer) {
    if (const int status = page.findOrTell(folder)) return status;
  }
  const gable::TilePlan plan = gable::TilePlan::load(folder);
  if (const int status = told(plan)) return status;
  const Means means{arguments.threads, arguments.limits, begin};
  gable::TileResult result = gable::mergeTiles(plan, means.run());
  if (!result.jobsToRun.empty() && arguments.mend) {
    note("runs " + std::to_string(result.jobsToRun.size()) + " of " + std::to_string(plan.jobs()) +
         " jobs again");
    gable::Rules rules(nullptr);
    if (const int status = rulesOf(plan, arguments.limits, rules)) return status;
    gable::TileResult again;
    if (const int status = runJobs(plan, rules, result.jobsToRun, means, again)) return status;
    result = gable::mergeTiles(plan, means.run());
  }
  if (const int status = told(result)) return status;
  if (const int status = page.write()) return status;
  answer().wrote(folder);
  return writeStats(arguments.stats, result, begin, 0);
}
