// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A place as 3D Tiles 1.1: a folder of files that browsers stream (docs/guide/tiles.md).
//
//   gable::City city = gable::City::load("monaco.osm.pbf");
//   gable::Rules rules = gable::Rules::load("city.cga");
//   gable::writeTiles(rules, city.shapes(), "monaco/");
//
// What is too large for one process is planned, made in jobs by any number of them, and merged. The
// files are those of writeTiles(), byte for byte:
//
//   gable::TilePlan plan = gable::planTiles(rules, "land.fgb", {}, "land/", settings);
//   for (uint64_t job = 0; job < plan.jobs(); ++job) gable::runTileJob(plan, rules, job);
//   gable::mergeTiles(plan);
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gable/derive.h"
#include "gable/diagnostic.h"
#include "gable/limits.h"
#include "gable/model.h"

namespace gable {

struct TileSettings {
  /// Limits on shapes, vertices and steps are those of a batch of shapes; seconds and the wish to
  /// stop are those of all. `trace`, `remember` and `before` have no effect.
  DeriveSettings derive;
  /// How many triangles a tile has at most; a coarse one as far as that can be. 0: as many as take
  /// a browser's main thread no longer than 30 ms (docs/design/tiles.md): 49,152 compressed ones,
  /// 16,384 others.
  uint64_t triangles = 0;
  /// EXT_meshopt_compression and KHR_mesh_quantization: vertices are up to two millimetres from
  /// their places. An error where canCompressTiles() is false.
  bool compress = false;
  /// Parts that occur several times in a tile. Auto and Gpu: by EXT_mesh_gpu_instancing. Nodes: by
  /// nodes that share vertices, for readers without it. None: not at all. Shapes is an error.
  Instancing instancing = Instancing::Auto;
  /// Auto and Compact: integers of KHR_mesh_quantization, half a millimetre from their places.
  /// Float: single precision, for readers without it. Bare is an error.
  Vertices vertices = Vertices::Auto;
  /// A folder may hold a plan whose jobs others run: writing the whole place there in one process
  /// ends them, and is an error (tiles-planned) where this is false. The tiles of finished jobs
  /// stay where they fit.
  bool replacePlan = false;
  /// Of all, deriving included.
  FileLimits limits;
};

/// Whether this build can.
bool canCompressTiles();

struct TileResult {
  bool ok = false;
  /// Other than Done: tiles that were finished are there, and no tileset.
  End end = End::Done;
  DiagnosticList diagnostics;
  /// What the rules printed, tile by tile.
  std::vector<std::string> prints;
  /// Files, and levels of them.
  uint64_t tiles = 0, levels = 0;
  uint64_t shapes = 0;
  /// Of the tiles that show everything, and of the coarse ones above them.
  uint64_t triangles = 0, coarseTriangles = 0;
  /// Of all files.
  uint64_t bytes = 0;
  double deriveSeconds = 0, writeSeconds = 0;
  /// Of a job: shapes whose tiles were there already.
  uint64_t shapesBefore = 0;
  /// Of a merge: the jobs that are to be run first, as tiles are missing or damaged.
  std::vector<uint64_t> jobsToRun;
};

/// Derives the rules on the shapes a batch at a time, and writes `folder`/tileset.json with tiles
/// in `folder`/tiles. Memory holds the shapes and a batch, never the whole place. Other files in
/// the folder stay; a tileset of another program is left alone, with an error.
TileResult writeTiles(const Rules& rules, const Shapes& shapes, const std::string& folder,
                      const TileSettings& settings = {});

struct TilePlanSettings {
  /// Where the rules come from; jobs load them again by this. Relative paths are kept as whole
  /// ones.
  std::string rules;
  LoadSettings load;
  /// Threads and seeds of single shapes are no part of a plan.
  TileSettings tiles;
  /// About how many shapes a job has; the files do not depend on it.
  uint64_t jobShapes = 16'384;
  /// Whoever plans runs all jobs and merges: what finds the plan of a run that was stopped may
  /// begin anew. Of other plans see TileSettings::replacePlan.
  bool ofOneRun = false;
};

/// Work on tiles in jobs, and what they need: files in `folder`/plan, which mergeTiles() removes.
class TilePlan {
 public:
  /// The plan of a folder. Codes: tiles-plan.
  static TilePlan load(const std::string& folder);

  bool ok() const;
  const DiagnosticList& diagnostics() const;
  uint64_t shapes() const;
  uint64_t jobs() const;
  /// With the settings of the plan.
  Rules rules(const FileLimits& limits = {}) const;

  struct Impl;
  explicit TilePlan(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  const Impl& impl() const { return *impl_; }

 private:
  std::shared_ptr<const Impl> impl_;
};

/// Divides shapes into jobs; the terrain of a city goes with them. Where the folder has a plan of
/// the same rules, shapes and settings, what its jobs have finished stays.
TilePlan planTiles(const Rules& rules, const Shapes& shapes, const std::string& folder,
                   const TilePlanSettings& settings);

/// The same for a file of shapes. Maps, but those of OpenStreetMap, are read a piece at a time: of
/// each shape memory holds 32 bytes.
TilePlan planTiles(const Rules& rules, const std::string& map, const FeatureSelection& selection,
                   const std::string& folder, const TilePlanSettings& settings);

/// Whether a file of shapes is read a piece at a time.
bool isReadInPieces(const std::string& map);

/// What of TileSettings is not the plan's: threads, limits in time and memory, progress,
/// cancelling.
struct TileRun {
  std::optional<int> threads;
  /// Of a job or a merge, deriving included.
  FileLimits limits;
  /// Called by one thread at a time, with rising numbers.
  std::function<void(size_t done, size_t total)> progress;
  /// Ends the job or the merge soon after it becomes true. May be null; limits.cancel is heard
  /// between batches alone.
  std::atomic<bool>* cancel = nullptr;
};

/// Makes the tiles of a job that are missing or damaged. Any number of jobs may run at a time, on
/// any machines that share the folder; a job may be run again at any time. Codes: tiles-job,
/// tiles-plan, tiles-plan-changed, and those of writeTiles().
TileResult runTileJob(const TilePlan& plan, const Rules& rules, uint64_t job,
                      const TileRun& run = {});

/// Checks the tiles of all jobs, writes those above them and the tileset, and removes the plan.
/// Where tiles are missing or damaged the error tiles-unfinished names the jobs, and nothing is
/// written.
TileResult mergeTiles(const TilePlan& plan, const TileRun& run = {});

/// Writes `land`/tileset.json above tilesets in folders within it, each of which lies on the Earth
/// by its own transform: a country of many places. Empty, or why not. Codes: tiles-join,
/// tiles-folder, and those of files.
DiagnosticList joinTilesets(const std::vector<std::string>& folders, const std::string& land,
                            const FileLimits& limits = {});

}  // namespace gable
