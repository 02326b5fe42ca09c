// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// gable tiles, and what gable city has of it.
#pragma once

#include <string>
#include <vector>

#include "common.h"
#include "gable/tiles.h"

struct TileArguments {
  /// 0: what TileSettings takes.
  uint64_t triangles = 0;
  /// Compress the tiles.
  bool compress = false;
  /// Words of WriteSettings; empty where they are not given.
  std::string instancing, vertices;
  /// Put the page that shows the tiles beside them.
  bool viewer = false;
  /// Of a plan.
  uint64_t jobShapes = 16'384;
  /// Write the plan alone: others run its jobs.
  bool onlyPlan = false;
  /// Write into the folder of a plan whose jobs others may be running.
  bool replacePlan = false;
};

struct TilesArguments {
  DeriveArguments derive;
  TileArguments tiles;
  std::string output;
  std::string stats;
};
int runTiles(const TilesArguments& arguments);

struct PlanArguments {
  DeriveArguments derive;
  TileArguments tiles;
  std::string output;
};
int runTilesPlan(const PlanArguments& arguments);

struct JobArguments {
  std::string folder;
  /// "3" or "3-17".
  std::string jobs;
  std::optional<int> threads;
  LimitArguments limits;
  std::string stats;
};
int runTilesJob(const JobArguments& arguments);

struct MergeArguments {
  std::string folder;
  /// Run the jobs that are missing, here.
  bool mend = false;
  bool viewer = false;
  std::optional<int> threads;
  LimitArguments limits;
  std::string stats;
};
int runTilesMerge(const MergeArguments& arguments);

struct SubmitArguments {
  std::string folder;
  bool slurm = false, parallel = false;
  /// Write the scripts, and run nothing.
  bool dry = false;
  uint64_t tries = 3;
  /// Further options of sbatch or parallel.
  std::string options;
};
int runTilesSubmit(const SubmitArguments& arguments);

/// gable tiles join.
int runTilesJoin(const std::vector<std::string>& places, const std::string& output);

/// The folder that an output names: "monaco/", "monaco/tileset.json", a folder that is there; empty
/// when it names none.
std::string tileFolder(const std::string& output);

/// The same, or the output itself as a folder.
std::string asFolder(const std::string& output);

/// Shapes in memory, and how they are derived.
struct PlacedShapes {
  const gable::Rules& rules;
  const gable::Shapes& shapes;
  const gable::DeriveSettings& settings;
};

/// Plans them, runs all jobs and merges, or plans alone; `derive` says where the rules come from.
/// What was begun before goes on. Prints what there is to say, and gives an exit status.
int makeTiles(const DeriveArguments& derive, const TileArguments& tiles, const PlacedShapes& placed,
              const std::string& folder, gable::TileResult& result);
