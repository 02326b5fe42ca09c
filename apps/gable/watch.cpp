// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "watch.h"

#include <chrono>
#include <cstdio>
#include <thread>

#include "answer.h"

namespace fs = std::filesystem;

namespace {

constexpr std::chrono::milliseconds kBetweenLooks{300};

// The first file that is new, has gone or has another time.
std::string changedFile(const FileTimes& before, const FileTimes& after) {
  for (const auto& [file, time] : after) {
    const auto found = before.find(file);
    if (found == before.end() || found->second != time) return file;
  }
  for (const auto& [file, time] : before) {
    if (!after.contains(file)) return file;
  }
  return {};
}

void add(FileTimes& times, const std::string& file) {
  if (file.empty()) return;
  std::error_code error;
  const fs::path place = placeOf(file);
  const auto time = fs::last_write_time(place, error);
  if (!error) times[place.string()] = time;
}

}  // namespace

fs::path placeOf(const std::string& file) {
  std::error_code error;
  return fs::absolute(file, error).lexically_normal();
}

int watch(const Watched& watched) {
  int status = kExitDone;
  while (!*cancelFlag()) {
    // Taken before the run, so that an edit during it starts another.
    FileTimes before = watched.times();
    status = watched.run();
    // What follows is the answer of another run.
    printAnswer(status);
    std::fflush(stdout);
    // What the command line says wrongly, no save mends.
    if (status == kExitUsage) return status;
    if (status != kExitDone) tell("waiting for a change; Ctrl-C ends\n");
    FileTimes after = watched.times();
    if (watched.forget) watched.forget(before, after);
    while (!*cancelFlag() && after == before) {
      std::this_thread::sleep_for(kBetweenLooks);
      after = watched.times();
    }
    if (*cancelFlag()) break;
    tell("\n" + changedFile(before, after) + " has changed\n");
    // The run that follows may take long.
    std::fflush(stdout);
  }
  return status;
}

FileTimes inputTimes(const DeriveArguments& arguments) {
  FileTimes times;
  add(times, arguments.rules);
  add(times, arguments.shapes);
  const gable::Rules rules = gable::Rules::load(
      arguments.rules, {arguments.project, arguments.dialect, {}, arguments.search});
  for (const gable::ImportInfo& import : rules.imports()) add(times, import.file);
  for (const gable::AssetUse& asset : rules.assets()) add(times, asset.file);
  // An import that was missing may come.
  std::error_code error;
  const fs::path own = placeOf(arguments.rules);
  fs::directory_iterator at(own.parent_path(), error);
  for (; !error && at != fs::directory_iterator(); at.increment(error)) {
    if (at->path().extension() == own.extension()) add(times, at->path().string());
  }
  return times;
}
