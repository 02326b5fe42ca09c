// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// gable city: its arguments, which hold those of a derivation.
#pragma once

#include <optional>
#include <string>

#include "commands.h"
#include "common.h"
#include "tiles.h"

struct CityArguments {
  /// Its rules are a folder with city.cga, or a file; its shapes are the map.
  DeriveArguments derive;
  std::string box;
  std::string country;
  /// A file of heights; empty for a flat place.
  std::string terrain;
  /// Metres of soil below it.
  std::optional<double> soil;
  std::string output;
  /// Where the ground goes as GeoJSON.
  std::string plan;
  std::string stats;
  /// As of GenerateArguments.
  bool strict = false;
  ReportArguments reports;
  WriteArguments write;
  TileArguments tiles;
  /// Its output is empty where no picture is asked for; it has no derivation of its own.
  RenderArguments picture;
};
int runCity(const CityArguments& arguments);
