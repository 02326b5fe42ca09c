// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Planning: shapes go to one file as they are read, and memory keeps the middle and the place of
// each. When all are there and divided, they go from it to the files of the jobs.

#include <algorithm>
#include <filesystem>

#include "base/bytes.h"
#include "base/file_pieces.h"
#include "base/files.h"
#include "base/hash.h"
#include "base/work.h"
#include "engine/city_rules.h"
#include "engine/footprint.h"
#include "engine/guard.h"
#include "engine/shape_record.h"
#include "engine/terrain_record.h"
#include "engine/tile_plan.h"
#include "engine/tile_source.h"

namespace gable {

namespace {

class Planner {
 public:
  Planner(const Rules& rules, const std::string& folder, const TilePlanSettings& settings,
          TilePlan::Impl& plan)
      : rules_(rules), settings_(settings), folder_(folder), plan_(plan) {}

  std::optional<Error> begin() {
    if (auto e = formMistake(settings_.tiles)) return e;
    if (settings_.ofOneRun && !settings_.tiles.replacePlan) {
      if (auto e = planInUse(folder_)) return e;
    }
    if (auto e = folder_.open()) return e;
    // A plan that is being written is none, and what jobs of an older one have made stays.
    const std::string plan = folder_.plan();
    std::error_code error;
    for (const char* old : {"plan.json", "terrain.bin", "jobs", "shapes"}) {
      std::filesystem::remove_all(plan + old, error);
      if (error) return folderError(plan + old, "removed", error);
    }
    for (const char* part : {"jobs", "shapes", "done"}) {
      std::filesystem::create_directories(plan + part, error);
      if (error) return folderError(plan + part, "made", error);
    }
    spool_.emplace(spoolPath());
    return std::nullopt;
  }

  void add(ShapeFootprint f) {
    if (f.index < 0) f.index = static_cast<int64_t>(middles_.size());
    middles_.push_back(middleOf(f));
    record_.clear();
    appendRecord(f, record_);
    offsets_.push_back(spool_->offset());
    spool_->append(record_);
    work(record_.size());
  }

  size_t size() const { return middles_.size(); }

  /// Before finish(), where the place has one.
  std::optional<Error> addTerrain(const TerrainSurface& terrain) {
    const std::string bytes = terrainBytes(terrain);
    plan_.folder = folder_.path();
    plan_.terrainChecksum = std::max<uint64_t>(checksum(bytes), 1);
    const Result<uint64_t> written = writeFile(terrainPath(plan_), bytes);
    if (!written.ok()) return written.error();
    return std::nullopt;
  }

  std::optional<Error> finish(std::shared_ptr<const GeoFrame> geo) {
    offsets_.push_back(spool_->offset());
    const Result<uint64_t> written = spool_->finish();
    if (!written.ok()) return written.error();
    spool_.reset();
    plan_.folder = folder_.path();
    plan_.rules = whole(settings_.rules);
    plan_.rulesChecksum = checksumOf(rules_);
    plan_.load = settings_.load;
    plan_.load.overlay.clear();
    plan_.load.before = nullptr;
    for (std::optional<std::string>* path : {&plan_.load.project, &plan_.load.search.workspace}) {
      if (*path) *path = whole(**path);
    }
    for (std::string& library : plan_.load.search.libraries) {
      const size_t name = library.find('=') + 1;
      library = library.substr(0, name) + whole(library.substr(name));
    }
    plan_.tiles = settings_.tiles;
    plan_.geo = std::move(geo);
    plan_.ofOneRun = settings_.ofOneRun;
    plan_.shapes = middles_.size();
    auto e = writeJobs();
    std::error_code ignored;
    std::filesystem::remove(spoolPath(), ignored);
    return e;
  }

 private:
  static Error folderError(const std::string& path, const char* what,
                           const std::error_code& error) {
    return {"tiles-folder", "'" + path + "' cannot be " + what + ": " + error.message(),
            "name another folder, or see to its permissions"};
  }

  std::string spoolPath() const { return folder_.plan() + "all.shapes"; }

  static std::string whole(const std::string& path) {
    std::error_code error;
    const std::filesystem::path out = std::filesystem::absolute(path, error);
    return error ? path : out.string();
  }

  std::optional<Error> writeJobs() {
    FilePieces spool;
    const Result<uint64_t> opened = spool.open(spoolPath());
    if (!opened.ok()) return opened.error();
    TileDivision division = divided(middles_, unitShapes(rules_));
    plan_.square = division.square;
    std::vector<TileJob> jobs;
    for (size_t at = 0; at < division.units.size();) {
      size_t end = at;
      uint64_t shapes = 0;
      while (end < division.units.size() &&
             (end == at || shapes + division.units[end].shapes.size() <= settings_.jobShapes)) {
        shapes += division.units[end++].shapes.size();
      }
      const Result<TileJob> job = writeShapes(spool, division, at, end, jobs.size());
      if (!job.ok()) return job.error();
      jobs.push_back(job.value());
      at = end;
    }
    plan_.jobs = jobs.size();
    return writePlan(jobs);
  }

  Result<TileJob> writeShapes(const FilePieces& spool, const TileDivision& division, size_t first,
                              size_t end, uint64_t number) {
    TileJob job;
    std::string bytes;
    for (size_t u = first; u < end; ++u) {
      const TileUnit& unit = division.units[u];
      const size_t before = bytes.size();
      for (const uint32_t s : unit.shapes) {
        work();
        const size_t at = bytes.size(), size = offsets_[s + 1] - offsets_[s];
        bytes.resize(at + size);
        const Result<size_t> read = spool.readAt(offsets_[s], bytes.data() + at, size);
        if (!read.ok()) return read.error();
      }
      job.units.push_back({unit.name, unit.shapes.size(), bytes.size() - before});
      const uint64_t shapes = checksum(std::string_view(bytes).substr(before));
      units_ = hashCombine(hashBytes(unit.name, units_), shapes);
    }
    job.bytes = bytes.size();
    job.checksum = checksum(bytes);
    const Result<uint64_t> written = writeFile(shapesPath(plan_, number), bytes);
    if (!written.ok()) return written.error();
    return job;
  }

  std::optional<Error> writePlan(const std::vector<TileJob>& jobs) {
    plan_.id = 0;
    // Where the rules lie, how the units are divided into jobs and who runs those is no matter.
    TilePlan::Impl nowhere = plan_;
    nowhere.rules.clear();
    nowhere.load = {};
    nowhere.load.style = plan_.load.style;
    nowhere.jobs = 0;
    nowhere.ofOneRun = false;
    plan_.id = std::max<uint64_t>(hashBytes(settingsJson(nowhere), units_), 1);
    for (uint64_t j = 0; j < jobs.size(); ++j) {
      const Result<uint64_t> written = writeFile(jobPath(plan_, j), jobJson(jobs[j], plan_.id));
      if (!written.ok()) return written.error();
    }
    const Result<uint64_t> written = writeFile(folder_.plan() + "plan.json", settingsJson(plan_));
    if (!written.ok()) return written.error();
    return std::nullopt;
  }

  const Rules& rules_;
  const TilePlanSettings& settings_;
  TileFolder folder_;
  TilePlan::Impl& plan_;
  std::optional<FileWriter> spool_;
  std::string record_;
  std::vector<Vec2> middles_;
  // Of each shape in the file of all, and the end of the last.
  std::vector<uint64_t> offsets_;
  // A hash of all units with their shapes.
  uint64_t units_ = 0;
};

std::shared_ptr<TilePlan::Impl> refused(const DiagnosticList& diagnostics) {
  auto plan = std::make_shared<TilePlan::Impl>();
  plan->diagnostics = diagnostics;
  return plan;
}

std::shared_ptr<TilePlan::Impl> refused(const Error& e) { return refused({diagnosticOf(e)}); }

void settle(TilePlan::Impl& plan, const std::optional<Error>& e, const Rules& rules) {
  if (e) {
    plan.id = 0;
    plan.diagnostics.push_back(diagnosticOf(*e));
  } else if (unitShapes(rules) == 0) {
    warnTogether(plan.diagnostics);
  }
}

std::shared_ptr<TilePlan::Impl> planned(const Rules& rules, const Shapes& shapes,
                                        const std::string& folder,
                                        const TilePlanSettings& settings) {
  if (!shapes.impl().textures.empty()) {
    return refused(Error{"tiles-plan", "the file of shapes brings pictures, which a plan does not",
                         "use 'gable tiles' without a plan"});
  }
  auto plan = std::make_shared<TilePlan::Impl>();
  Planner planner(rules, folder, settings, *plan);
  std::optional<Error> e = planner.begin();
  plan->ofMap = shapes.impl().ofMap;
  plan->diagnostics = cityRuleNotes(shapes.impl(), rules.impl());
  if (!e) {
    for (const ShapeFootprint& f : shapes.impl().footprints) planner.add(f);
    if (shapes.impl().terrain) e = planner.addTerrain(*shapes.impl().terrain);
    if (!e) e = planner.finish(shapes.impl().geo);
  }
  settle(*plan, e, rules);
  return plan;
}

std::shared_ptr<TilePlan::Impl> streamed(const Rules& rules, const std::string& map,
                                         const FeatureSelection& selection,
                                         const std::string& folder,
                                         const TilePlanSettings& settings) {
  auto plan = std::make_shared<TilePlan::Impl>();
  Planner planner(rules, folder, settings, *plan);
  std::optional<Error> e = planner.begin();
  if (!e) {
    const Result<ShapeFile> file =
        streamShapes(shapeFileOptions(map), {selection.layer, selection.key, selection.value},
                     [&](ShapeInput&& input) { planner.add(footprint(std::move(input))); });
    if (file.ok()) {
      plan->diagnostics = listOf(file.value().diagnostics, Sources{});
      // What is wrong with some features is told, and the others are planned.
      if (planner.size() == 0) return refused(plan->diagnostics);
      e = planner.finish(file.value().geo);
    } else {
      e = file.error();
    }
  }
  settle(*plan, e, rules);
  return plan;
}

}  // namespace

bool isReadInPieces(const std::string& map) { return isStreamed(map); }

TilePlan planTiles(const Rules& rules, const Shapes& shapes, const std::string& folder,
                   const TilePlanSettings& settings) {
  return TilePlan(guarded<TilePlan::Impl>(Task("planning", folder, settings.tiles.limits), [&] {
    return planned(rules, shapes, folder, settings);
  }));
}

TilePlan planTiles(const Rules& rules, const std::string& map, const FeatureSelection& selection,
                   const std::string& folder, const TilePlanSettings& settings) {
  if (!isStreamed(map)) {
    const Shapes shapes = Shapes::load(map, settings.tiles.limits, selection);
    if (!shapes.ok() || shapes.size() == 0) return TilePlan(refused(shapes.diagnostics()));
    return planTiles(rules, shapes, folder, settings);
  }
  return TilePlan(guarded<TilePlan::Impl>(Task("planning", folder, settings.tiles.limits), [&] {
    return streamed(rules, map, selection, folder, settings);
  }));
}

}  // namespace gable
