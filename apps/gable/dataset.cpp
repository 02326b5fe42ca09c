// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// gable dataset: pictures of many seeds with what lies behind their pixels.

#include "gable/dataset.h"

#include "answer.h"
#include "commands.h"
#include "derive_settings.h"
#include "gable/names.h"
#include "memory.h"
#include "progress.h"

namespace {

/// "0/4": the first of four.
bool parseShard(const std::string& text, gable::DatasetSettings::Shard& shard) {
  double numbers[2];
  if (!parseNumbers(text, '/', {0, 1e9, true}, numbers, 2) || numbers[0] >= numbers[1])
    return false;
  shard.index = static_cast<uint64_t>(numbers[0]);
  shard.of = static_cast<uint64_t>(numbers[1]);
  return true;
}

int datasetSettings(const DatasetArguments& a, gable::DatasetSettings& s) {
  if (const int status = pictureSettings(a.picture, s.picture)) return status;
  s.picture.cancel = cancelFlag();
  s.count = a.count;
  s.cameras = a.cameras;
  s.placing = gable::datasetCamerasNamed(a.placing).value_or(s.placing);
  s.zoom = a.zoom;
  s.labels = gable::datasetLabelsNamed(a.labels).value_or(s.labels);
  s.tags = a.tags;
  s.format = gable::datasetFormatNamed(a.format).value_or(s.format);
  s.model = a.model == "none" ? std::string() : a.model;
  const std::string model = "model." + (s.model.empty() ? std::string("glb") : s.model);
  if (const int status = writeSettings(a.write, model, a.picture.derive.limits, s.write)) {
    return status;
  }
  s.jobs = a.picture.derive.jobs;
  s.limits = s.picture.limits;
  s.limits.cancel = cancelFlag();
  gable::DatasetSettings::Shard shard;
  if (!a.shard.empty()) {
    if (!parseShard(a.shard, shard)) {
      return wrongOption("--shard", "NUMBER/COUNT, such as 0/4 for the first of four", a.shard);
    }
    s.shard = shard;
  }
  return kExitDone;
}

int statusOfDataset(const gable::DatasetResult& result) {
  for (const gable::Diagnostic& d : result.diagnostics) {
    if (d.code == "dataset-folder" || d.code == "dataset-lock" || d.code.starts_with("file-")) {
      return kExitFile;
    }
  }
  if (result.end != gable::End::Done) return statusOf(result.diagnostics, kExitLimit);
  return result.ok ? static_cast<int>(kExitDone) : statusOf(result.diagnostics, kExitWrong);
}

}  // namespace

int runDataset(const DatasetArguments& arguments) {
  keepMemory();
  gable::DatasetSettings settings;
  if (const int status = datasetSettings(arguments, settings)) return status;
  Inputs inputs;
  if (const int status = readInputs(arguments.picture.derive, inputs)) return status;
  settings.derive = inputs.settings;
  const gable::DatasetResult result = [&] {
    Progress progress("drawing", "pictures");
    settings.progress = progress.callback();
    return gable::writeDataset(inputs.rules, inputs.shapes, arguments.output, settings);
  }();
  print(result.diagnostics);
  answer().member("items", std::to_string(result.items));
  answer().member("made", std::to_string(result.made));
  answer().member("done", std::to_string(result.done));
  answer().member("merged", result.merged ? "true" : "false");
  if (result.ok) answer().wrote(arguments.output);
  const bool stopped = result.end != gable::End::Done;
  if (stopped || (result.ok && !result.merged)) {
    note(std::to_string(result.done) + " of " + std::to_string(result.items) +
         " items are there; " +
         (stopped ? "the same command goes on"
                  : "others are making the rest, or their shards have it"));
  }
  return statusOfDataset(result);
}
