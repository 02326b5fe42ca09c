// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Jobs and their merge. All that a job makes is a function of its plan, and each file is written
// aside and renamed, the part of a unit after its tiles. So a job may be killed at any time, run
// again, or run twice at once.

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <functional>
#include <mutex>

#include "base/bytes.h"
#include "base/files.h"
#include "base/parallel.h"
#include "engine/guard.h"
#include "engine/shape_record.h"
#include "engine/terrain_record.h"
#include "engine/tile_plan.h"
#include "engine/tile_source.h"
#include "tiles/placement.h"
#include "tiles/tile_part.h"

namespace gable {

namespace {

// The part of a unit; absent where it, or one of its tiles, is missing or damaged.
std::optional<TilePart> intactPart(const TilePlan::Impl& plan, const std::string& unit) {
  const Result<std::string> bytes = readFile(partPath(plan, unit));
  if (!bytes.ok()) return std::nullopt;
  std::optional<TilePart> part = partOf(bytes.value(), plan.id);
  if (part && !damagedFile(*part, plan.folder).empty()) part.reset();
  return part;
}

Error changed(const TilePlan::Impl& plan) {
  return {"tiles-plan-changed",
          "the rules '" + plan.rules + "' are not those that the plan in '" + plan.folder +
              "' was made with",
          "plan again, or put the old rules back"};
}

// Threads tell of what is done; whoever listens hears one at a time, and rising numbers.
class RisingProgress {
 public:
  explicit RisingProgress(const TileRun& run) : listener_(run.progress) {}

  void tell(size_t done, size_t total) {
    if (!listener_) return;
    const std::lock_guard lock(telling_);
    if (done <= told_) return;
    told_ = done;
    listener_(done, total);
  }

 private:
  const std::function<void(size_t, size_t)>& listener_;
  std::mutex telling_;
  size_t told_ = 0;
};

class JobRunner {
 public:
  JobRunner(const TilePlan::Impl& plan, const Rules& rules, const TileRun& run, Task& task,
            TileResult& result)
      : plan_(plan),
        rules_(rules),
        run_(run),
        settings_(plan.tiles),
        result_(result),
        progress_(run),
        begin_(now()) {
    settings_.derive.jobs = run.threads;
    settings_.derive.cancel = run.cancel;
    options_ = tileOptions(rules, settings_, plan.folder);
    options_.meter = &task.allowance();
  }

  std::optional<Error> run(uint64_t number) {
    if (auto e = formMistake(settings_)) return e;
    if (checksumOf(rules_) != plan_.rulesChecksum) return changed(plan_);
    const Result<TileJob> job = readJob(plan_, number);
    if (!job.ok()) return job.error();
    const Result<std::string> bytes = readShapes(job.value(), number);
    if (!bytes.ok()) return bytes.error();
    if (auto e = readTerrain()) return e;
    for (const JobUnit& unit : job.value().units) result_.shapes += unit.shapes;
    size_t offset = 0;
    for (const JobUnit& unit : job.value().units) {
      const std::string_view records = std::string_view(bytes.value()).substr(offset, unit.bytes);
      offset += records.size();
      if (auto e = runUnit(unit, records)) return e;
      done_ += unit.shapes;
    }
    return std::nullopt;
  }

 private:
  Result<std::string> readShapes(const TileJob& job, uint64_t number) const {
    const std::string path = shapesPath(plan_, number);
    Result<std::string> bytes = readFile(path, uint64_t{1} << 40);
    if (!bytes.ok()) return bytes;
    uint64_t units = 0;
    for (const JobUnit& unit : job.units) units += unit.bytes;
    if (bytes->size() == job.bytes && units == job.bytes && checksum(*bytes) == job.checksum) {
      return bytes;
    }
    return Error{"tiles-plan", "'" + path + "' is damaged",
                 "make the plan again; what is done stays"};
  }

  // Each job reads all of it: what is laid on the ground may reach into other units.
  std::optional<Error> readTerrain() {
    if (plan_.terrainChecksum == 0) return std::nullopt;
    const std::string path = terrainPath(plan_);
    const Result<std::string> bytes = readFile(path, uint64_t{1} << 40);
    if (!bytes.ok()) return bytes.error();
    if (std::max<uint64_t>(checksum(bytes.value()), 1) == plan_.terrainChecksum) {
      terrain_ = terrainOf(bytes.value());
    }
    if (terrain_) return std::nullopt;
    return Error{"tiles-plan", "'" + path + "' is damaged",
                 "make the plan again; what is done stays"};
  }

  std::optional<Error> runUnit(const JobUnit& unit, std::string_view records) {
    if (const std::optional<TilePart> part = intactPart(plan_, unit.name)) {
      result_.shapesBefore += unit.shapes;
      count(*part);
      return std::nullopt;
    }
    const Result<Shapes> shapes = shapesOf(unit, records);
    if (!shapes.ok()) return shapes.error();
    // What is left of the time of the whole job.
    DeriveSettings derive = settings_.derive;
    if (run_.limits.seconds) {
      derive.limits.seconds = std::max(0.0, *run_.limits.seconds - (now() - begin_));
    }
    ShapeSource source(rules_, shapes.value(), derive, told_, result_);
    if (run_.progress) {
      source.showProgress([this](size_t done) { progress_.tell(done_ + done, result_.shapes); });
    }
    TileUnit all{unit.name, {}};
    all.shapes.resize(shapes.value().size());
    for (uint32_t i = 0; i < all.shapes.size(); ++i) all.shapes[i] = i;
    TileDivision division;
    division.square = plan_.square;
    const Result<TilePart> part =
        writeTileUnit(source, division.squareOf(unit.name), all, options_);
    if (!part.ok()) return part.error();
    const std::string path = partPath(plan_, unit.name);
    // Where that fails, the file cannot be written, which is told.
    std::error_code ignored;
    std::filesystem::create_directories(folderOf(path), ignored);
    const Result<uint64_t> written = writeFile(path, partBytes(part.value(), plan_.id));
    if (!written.ok()) return written.error();
    count(part.value());
    return std::nullopt;
  }

  void count(const TilePart& part) {
    result_.tiles += part.tiles;
    result_.bytes += part.bytes;
    result_.triangles += part.triangles;
    result_.coarseTriangles += part.coarseTriangles;
    if (part.root) result_.levels = std::max<uint64_t>(result_.levels, part.root->levels);
  }

  Result<Shapes> shapesOf(const JobUnit& unit, std::string_view records) const {
    const auto impl = std::make_shared<Shapes::Impl>();
    impl->geo = plan_.geo;
    impl->terrain = terrain_;
    impl->ofMap = plan_.ofMap;
    impl->isWhole = false;
    ByteReader reader(records);
    for (uint64_t i = 0; i < unit.shapes && reader.ok(); ++i) {
      work(records.size() / unit.shapes);
      ShapeFootprint f;
      if (readRecord(reader, f)) impl->footprints.push_back(std::move(f));
    }
    if (impl->footprints.size() != unit.shapes || !reader.atEnd()) {
      return Error{"tiles-plan", "the shapes of unit " + unit.name + " are damaged",
                   "make the plan again; what is done stays"};
    }
    return Shapes(impl);
  }

  const TilePlan::Impl& plan_;
  const Rules& rules_;
  const TileRun& run_;
  TileSettings settings_;
  TileTreeOptions options_;
  TileResult& result_;
  std::shared_ptr<const TerrainSurface> terrain_;
  Told told_;
  RisingProgress progress_;
  double begin_;
  uint64_t done_ = 0;
};

class Merger {
 public:
  Merger(const TilePlan::Impl& plan, const TileRun& run, Task& task)
      : plan_(plan), run_(run), task_(task) {}

  std::optional<Error> run(TileResult& result) {
    if (auto e = formMistake(plan_.tiles)) return e;
    if (auto e = readJobs()) return e;
    check(result);
    if (!result.jobsToRun.empty()) return unfinished(result.jobsToRun);
    TileFolder folder(plan_.folder);
    if (auto e = folder.open()) return e;
    TileTreeOptions options;
    options.folder = folder.path();
    options.triangles = mostTriangles(plan_.tiles);
    options.form = formOf(plan_.tiles);
    options.threads = threads();
    options.meter = &task_.allowance();
    const Result<TilePart> all = writeTileTop(
        division_, [this](size_t unit) { return partAt(unit); }, options);
    if (!all.ok()) return all.error();
    takeCounts(all.value(), result);
    result.shapes = plan_.shapes;
    if (!all.value().root) {
      return Error{"tiles-empty", "nothing is built on the shapes, so there are no tiles",
                   "see that the shapes are where you look, and what the rules begin with"};
    }
    const Result<uint64_t> bytes = folder.close(all.value(), placementOf(plan_.geo.get()));
    if (!bytes.ok()) return bytes.error();
    result.bytes += bytes.value();
    return std::nullopt;
  }

 private:
  unsigned threads() const { return static_cast<unsigned>(std::max(0, run_.threads.value_or(0))); }

  std::optional<Error> readJobs() {
    division_.square = plan_.square;
    uint64_t shapes = 0;
    for (uint64_t j = 0; j < plan_.jobs; ++j) {
      work();
      const Result<TileJob> job = readJob(plan_, j);
      if (!job.ok()) return job.error();
      for (const JobUnit& unit : job.value().units) {
        // Squares come in the order of their names, and none lies in another.
        const bool follows =
            division_.units.empty() || (division_.units.back().name < unit.name &&
                                        !unit.name.starts_with(division_.units.back().name));
        if (!follows) return unitsDiffer(j);
        division_.units.push_back({unit.name, {}});
        jobOfUnit_.push_back(j);
        shapes += unit.shapes;
      }
    }
    return shapes == plan_.shapes ? std::nullopt : std::optional(unitsDiffer(plan_.jobs - 1));
  }

  Error unitsDiffer(uint64_t job) const {
    return {"tiles-plan",
            "the jobs of the plan in '" + plan_.folder +
                "' are not those it was made with, up to '" + jobPath(plan_, job) + "'",
            "make the plan again with 'gable tiles plan'; what is done is kept"};
  }

  void check(TileResult& result) const {
    std::vector<char> intact(division_.units.size(), 0);
    RisingProgress progress(run_);
    std::atomic<size_t> done{0};
    parallelFor(intact.size(), threads(), [&](size_t i, unsigned) {
      const WorkScope scope(task_.allowance());
      intact[i] = intactPart(plan_, division_.units[i].name).has_value();
      progress.tell(++done, intact.size());
    });
    for (size_t i = 0; i < intact.size(); ++i) {
      if (intact[i] || (!result.jobsToRun.empty() && result.jobsToRun.back() == jobOfUnit_[i])) {
        continue;
      }
      result.jobsToRun.push_back(jobOfUnit_[i]);
    }
  }

  Error unfinished(const std::vector<uint64_t>& jobs) const {
    constexpr size_t kShown = 8;
    std::string list;
    for (size_t i = 0; i < jobs.size() && i < kShown; ++i) {
      list += (i ? ", " : "") + std::to_string(jobs[i]);
    }
    if (jobs.size() > kShown) list += ", ...";
    return {"tiles-unfinished",
            "tiles of " + std::to_string(jobs.size()) + " of the " + std::to_string(plan_.jobs) +
                " jobs in '" + plan_.folder + "' are missing or damaged: " + list,
            "run these jobs again, or merge with --mend"};
  }

  Result<TilePart> partAt(size_t unit) const {
    const std::string path = partPath(plan_, division_.units[unit].name);
    const Result<std::string> bytes = readFile(path);
    if (!bytes.ok()) return bytes.error();
    std::optional<TilePart> part = partOf(bytes.value(), plan_.id);
    if (part) return std::move(*part);
    return Error{"file-unreadable", "'" + path + "' has changed while it was merged",
                 "merge again"};
  }

  const TilePlan::Impl& plan_;
  const TileRun& run_;
  Task& task_;
  TileDivision division_;
  std::vector<uint64_t> jobOfUnit_;
};

// One wish to stop, wherever the caller has put it.
TileRun settled(TileRun run) {
  if (!run.limits.cancel) run.limits.cancel = run.cancel;
  return run;
}

bool usable(const TilePlan& plan, TileResult& result) {
  if (plan.ok()) return true;
  result.diagnostics = plan.diagnostics();
  return false;
}

}  // namespace

TilePlan TilePlan::load(const std::string& folder) {
  return TilePlan(guarded<Impl>(Task("reading the plan of", folder, {}), [&] {
    auto impl = std::make_shared<Impl>();
    Result<Impl> plan = readPlan(folder);
    if (plan.ok()) {
      *impl = std::move(*plan);
    } else {
      impl->diagnostics.push_back(diagnosticOf(plan.error()));
    }
    return impl;
  }));
}

bool TilePlan::ok() const { return impl_->id != 0; }
const DiagnosticList& TilePlan::diagnostics() const { return impl_->diagnostics; }
uint64_t TilePlan::shapes() const { return impl_->shapes; }
uint64_t TilePlan::jobs() const { return impl_->jobs; }

Rules TilePlan::rules(const FileLimits& limits) const {
  LoadSettings load = impl_->load;
  load.limits = limits;
  return Rules::load(impl_->rules, load);
}

TileResult runTileJob(const TilePlan& plan, const Rules& rules, uint64_t job,
                      const TileRun& given) {
  const TileRun run = settled(given);
  return guardedResult<TileResult>(
      Task("writing", plan.impl().folder, run.limits), [&](Task& task) {
        TileResult result;
        if (!rules.ok() || !usable(plan, result)) return result;
        const double begin = now();
        const std::optional<Error> e = JobRunner(plan.impl(), rules, run, task, result).run(job);
        if (e) fail(result, *e);
        result.ok = !e;
        result.writeSeconds = now() - begin - result.deriveSeconds;
        return result;
      });
}

TileResult mergeTiles(const TilePlan& plan, const TileRun& given) {
  const TileRun run = settled(given);
  return guardedResult<TileResult>(
      Task("writing", plan.impl().folder, run.limits), [&](Task& task) {
        TileResult result;
        if (!usable(plan, result)) return result;
        const double begin = now();
        const std::optional<Error> e = Merger(plan.impl(), run, task).run(result);
        if (e) fail(result, *e);
        result.ok = !e;
        result.writeSeconds = now() - begin;
        return result;
      });
}

}  // namespace gable
