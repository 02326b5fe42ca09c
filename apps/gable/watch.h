// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Commands that run again whenever a file changes.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "common.h"

/// When files changed last, by their absolute path.
using FileTimes = std::map<std::string, std::filesystem::file_time_type>;

/// An absolute path without dots.
std::filesystem::path placeOf(const std::string& file);

/// Runs, and runs again whenever `times` differ, until Ctrl-C. `forget` takes out of the second
/// what the run itself has written. Gives the status of the last run.
struct Watched {
  std::function<FileTimes()> times;
  std::function<int()> run;
  std::function<void(FileTimes& before, const FileTimes& after)> forget;
};
int watch(const Watched& watched);

/// Of the files that a derivation reads: the rules with all that they import and name, the shapes,
/// and whatever rule files lie in the folder of the rules.
FileTimes inputTimes(const DeriveArguments& arguments);
