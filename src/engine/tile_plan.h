// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The files of a plan (docs/design/tiles.md):
//
//   plan/plan.json         rules, settings, the square of the place; it is written last
//   plan/jobs/0.json       the units of a job, and its file of shapes
//   plan/shapes/0.shapes   records of shapes (engine/shape_record.h), unit after unit
//   plan/terrain.bin       the ground that a city lies on, where it does (engine/terrain_record.h)
//   plan/done/0123.part    what has come of a unit (tiles/tile_part.h)
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/impl.h"
#include "engine/tile_folder.h"
#include "gable/tiles.h"

namespace gable {

struct TilePlan::Impl {
  bool found = true;
  DiagnosticList diagnostics;
  /// Of the tiles.
  std::string folder;
  /// Of all that the tiles depend on; 0: there is no plan.
  uint64_t id = 0;
  std::string rules;
  uint64_t rulesChecksum = 0;
  LoadSettings load;
  TileSettings tiles;
  TileSquare square;
  std::shared_ptr<const GeoFrame> geo;
  uint64_t shapes = 0, jobs = 0;
  /// Of the bytes of plan/terrain.bin; 0: the place is flat.
  uint64_t terrainChecksum = 0;
  /// Its shapes are those of a map; see Shapes::Impl.
  bool ofMap = false;
  /// One process runs all jobs, and no other one is to.
  bool ofOneRun = false;
};

/// A job's unit, and how many bytes of the job's file are its shapes.
struct JobUnit {
  std::string name;
  uint64_t shapes = 0, bytes = 0;
};

struct TileJob {
  uint64_t bytes = 0, checksum = 0;
  std::vector<JobUnit> units;
};

/// Of the text of all rule files, and of the files that they name.
uint64_t checksumOf(const Rules& rules);

/// The plan as JSON; without an id, which is made of this and of the jobs, where it has none yet.
std::string settingsJson(const TilePlan::Impl& plan);
std::string jobJson(const TileJob& job, uint64_t plan);

/// Codes: tiles-plan.
Result<TilePlan::Impl> readPlan(const std::string& folder);
Result<TileJob> readJob(const TilePlan::Impl& plan, uint64_t job);

/// The error where others may be running the jobs of a plan of the folder, which would lose it.
/// Code: tiles-planned.
std::optional<Error> planInUse(const TileFolder& folder);

std::string jobPath(const TilePlan::Impl& plan, uint64_t job);
std::string shapesPath(const TilePlan::Impl& plan, uint64_t job);
std::string terrainPath(const TilePlan::Impl& plan);
std::string partPath(const TilePlan::Impl& plan, const std::string& unit);

}  // namespace gable
