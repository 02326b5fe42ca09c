// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// gable tiles: rules and shapes as a folder of 3D Tiles, at once or as a plan, its jobs and their
// merge.

#include "tiles.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "derive_settings.h"
#include "folders.h"
#include "json/tiles_json.h"

namespace {

/// Where the page that shows tiles lies; empty, with a message, where it is not built.
std::string viewerFolder() {
  const std::string from =
      folderWith("viewer.js", {"../studio/viewer", "../share/gable/studio/viewer"});
  if (from.empty()) {
    std::fputs("gable: the page for --viewer is not built; ./run studio builds it\n", stderr);
  }
  return from;
}

/// Whether the page may be put there: it may be from before, and nothing else of that name.
bool mayHoldViewer(const std::string& folder) {
  std::error_code error;
  if (!std::filesystem::exists(folder + "index.html", error)) return true;
  std::string before;
  if (!readText(folder + "index.html", before)) return false;
  if (before.find("name=\"generator\" content=\"Gable\"") != std::string::npos) return true;
  std::fprintf(stderr, "gable: '%sindex.html' is a page of another program; remove it first\n",
               folder.c_str());
  return false;
}

int writeViewer(const std::string& from, const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  for (const char* name : {"viewer.js", "index.html"}) {
    std::string text;
    if (!readText(from + "/" + name, text)) return kExitFile;
    if (const int status = writeText(folder + name, text)) return status;
  }
  return kExitDone;
}

int statusOfTiles(const gable::DiagnosticList& diagnostics) {
  for (const gable::Diagnostic& d : diagnostics) {
    if (d.code == "attribute-value" || d.code == "tiles-job") return kExitUsage;
    if (d.code == "tiles-folder" || d.code == "tiles-plan" || d.code.starts_with("file-")) {
      return kExitFile;
    }
  }
  return statusOf(diagnostics, kExitWrong);
}

/// Prints what there is to say; the exit status.
int told(const gable::TileResult& result) {
  print(result.diagnostics);
  for (const std::string& line : result.prints) std::fprintf(stderr, "%s\n", line.c_str());
  if (result.end != gable::End::Done) return kExitLimit;
  return result.ok ? static_cast<int>(kExitDone) : statusOfTiles(result.diagnostics);
}

int told(const gable::TilePlan& plan) {
  print(plan.diagnostics());
  return plan.ok() ? static_cast<int>(kExitDone) : statusOfTiles(plan.diagnostics());
}

gable::TileRun runOf(const std::optional<int>& threads, const LimitArguments& limits) {
  gable::TileRun run;
  run.jobs = threads;
  run.limits = fileLimits(limits);
  // Places take what time they take.
  if (!limits.maxSeconds) run.limits.seconds.reset();
  run.cancel = cancelFlag();
  return run;
}

int writeStats(const std::string& path, const gable::TileResult& result, double begin,
               double parseSeconds) {
  if (path.empty()) return kExitDone;
  gable::RunFigures figures;
  figures.parseSeconds = parseSeconds;
  figures.totalSeconds = secondsNow() - begin;
  figures.peakBytes = peakBytes();
  return writeText(path, gable::tilesJson(result, figures));
}

/// Maps are read a piece at a time; others are in memory first.
int planFolder(const DeriveArguments& derive, const TileArguments& tiles, uint64_t jobShapes,
               const std::string& folder, gable::TilePlan& plan) {
  gable::TilePlanSettings settings;
  settings.rules = derive.rules;
  settings.load = {derive.project, derive.dialect, derive.style, derive.search};
  settings.jobShapes = jobShapes;
  settings.tiles.triangles = tiles.triangles;
  settings.tiles.compress = tiles.compress;
  settings.tiles.limits = fileLimits(derive.limits);
  if (!derive.limits.maxSeconds) settings.tiles.limits.seconds.reset();
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
            const std::vector<uint64_t>& jobs, gable::TileRun run, gable::TileResult& result) {
  ProgressLine progress("writing tiles");
  const std::function<void(size_t, size_t)> show = progress.callback();
  for (size_t i = 0; i < jobs.size(); ++i) {
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
    std::fprintf(stderr, "gable: '%s' names no jobs of the plan; it has 0 to %.0f, as 3 or 3-17\n",
                 text.c_str(), range.most);
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

/// Plans, runs all jobs and merges, in this process: memory does not grow with the map, and what
/// was begun before goes on.
int runInPieces(const TilesArguments& arguments, const std::string& folder, double begin) {
  std::string viewer;
  if (arguments.tiles.viewer) {
    viewer = viewerFolder();
    if (viewer.empty() || !mayHoldViewer(folder)) return kExitFile;
  }
  gable::TilePlan plan(nullptr);
  constexpr uint64_t kJobShapes = 16'384;
  if (const int status = planFolder(arguments.derive, arguments.tiles, kJobShapes, folder, plan)) {
    return status;
  }
  const double planned = secondsNow();
  gable::Rules rules = plan.rules(fileLimits(arguments.derive.limits));
  std::vector<uint64_t> jobs;
  for (uint64_t j = 0; j < plan.jobs(); ++j) jobs.push_back(j);
  const gable::TileRun run = runOf(arguments.derive.jobs, arguments.derive.limits);
  gable::TileResult made;
  if (const int status = runJobs(plan, rules, jobs, run, made)) return status;
  gable::TileResult result = gable::mergeTiles(plan, run);
  if (const int status = told(result)) return status;
  result.deriveSeconds = made.deriveSeconds;
  result.writeSeconds += made.writeSeconds;
  if (arguments.tiles.viewer) {
    if (const int status = writeViewer(viewer, folder)) return status;
  }
  return writeStats(arguments.stats, result, begin, planned - begin);
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

int writeTileFolder(const gable::Rules& rules, const gable::Shapes& shapes,
                    const std::string& folder, const gable::DeriveSettings& settings,
                    const TileArguments& arguments, const LimitArguments& limits,
                    gable::TileResult& result) {
  // Before what takes long.
  std::string viewer;
  if (arguments.viewer) {
    viewer = viewerFolder();
    if (viewer.empty() || !mayHoldViewer(folder)) return kExitFile;
  }
  ProgressLine progress("writing tiles");
  gable::TileSettings tiles;
  tiles.derive = settings;
  tiles.derive.progress = progress.callback();
  tiles.triangles = arguments.triangles;
  tiles.compress = arguments.compress;
  tiles.limits = fileLimits(limits);
  // Places take what time they take.
  if (!limits.maxSeconds) tiles.limits.seconds.reset();
  result = gable::writeTiles(rules, shapes, folder, tiles);
  if (const int status = told(result)) return status;
  return arguments.viewer ? writeViewer(viewer, folder) : kExitDone;
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
  if (const int status = writeTileFolder(inputs.rules, inputs.shapes, folder, inputs.settings,
                                         arguments.tiles, arguments.derive.limits, result)) {
    return status;
  }
  return writeStats(arguments.stats, result, begin, inputs.rules.parseSeconds());
}

int runTilesPlan(const PlanArguments& arguments) {
  const std::string folder = asFolder(arguments.output);
  gable::TilePlan plan(nullptr);
  if (const int status =
          planFolder(arguments.derive, arguments.tiles, arguments.jobShapes, folder, plan)) {
    return status;
  }
  std::printf("%llu jobs for %llu shapes in %s\n", static_cast<unsigned long long>(plan.jobs()),
              static_cast<unsigned long long>(plan.shapes()), folder.c_str());
  return kExitDone;
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
  const gable::TileRun run = runOf(arguments.threads, arguments.limits);
  if (const int status = runJobs(plan, rules, jobs, run, result)) return status;
  return writeStats(arguments.stats, result, begin, rules.parseSeconds());
}

int runTilesMerge(const MergeArguments& arguments) {
  const double begin = secondsNow();
  const std::string folder = asFolder(arguments.folder);
  std::string viewer;
  if (arguments.viewer) {
    viewer = viewerFolder();
    if (viewer.empty() || !mayHoldViewer(folder)) return kExitFile;
  }
  const gable::TilePlan plan = gable::TilePlan::load(folder);
  if (const int status = told(plan)) return status;
  const gable::TileRun run = runOf(arguments.threads, arguments.limits);
  gable::TileResult result = gable::mergeTiles(plan, run);
  if (!result.jobsToRun.empty() && arguments.mend) {
    std::fprintf(stderr, "gable: runs %zu of %llu jobs again\n", result.jobsToRun.size(),
                 static_cast<unsigned long long>(plan.jobs()));
    gable::Rules rules(nullptr);
    if (const int status = rulesOf(plan, arguments.limits, rules)) return status;
    gable::TileResult again;
    if (const int status = runJobs(plan, rules, result.jobsToRun, run, again)) return status;
    result = gable::mergeTiles(plan, run);
  }
  if (const int status = told(result)) return status;
  if (arguments.viewer) {
    if (const int status = writeViewer(viewer, folder)) return status;
  }
  return writeStats(arguments.stats, result, begin, 0);
}
