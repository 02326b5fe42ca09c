// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Data sets for learning: of many seeds and cameras a picture each, with depth, normals, colours,
// instances, labels, the camera and a mesh (docs/guide/datasets.md).
//
//   gable::DatasetSettings settings;
//   settings.count = 1000;
//   settings.labels = gable::DatasetLabels::Rule;
//   gable::writeDataset(gable::Rules::load("house.cga"), gable::Shapes::lot(20, 20), "houses",
//                       settings);
//
// All that an item is follows from its seed and the number of its camera, so the files are the
// same for any number of threads and processes. A run that was stopped goes on when it is started
// again; any number of processes may write into one folder at a time.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gable/derive.h"
#include "gable/model.h"
#include "gable/picture.h"
#include "gable/rules.h"
#include "gable/shapes.h"

namespace gable {

/// Where the cameras of a seed stand. Orbit: evenly around the model, from an angle that the seed
/// draws, at a height that it draws. Sampled: each on a side, at a height, towards a part and with
/// a lens that it draws.
enum class DatasetCameras : uint8_t { Orbit, Sampled };

/// What pixels are told apart by. Rule: the rule that made the leaf; an instance is a leaf. Label:
/// the nearest rule above it with @Label; an instance is a shape of that rule with all that came of
/// it. Tag: the last tag that all faces of a shape above it were given; an instance is the shape
/// that was given it, with all that came of it. Labels and tags are derived without sharing.
enum class DatasetLabels : uint8_t { Rule, Label, Tag };

/// Which file lists all items. Coco: coco.json, with the outlines of instances as pycocotools read
/// them. Json: items.json, with cameras and files.
enum class DatasetFormat : uint8_t { Coco, Json };

struct DatasetSettings {
  /// Its seed is the first one; the others follow by 1.
  DeriveSettings derive;
  /// Light, lens and size. View, camera, layers and limits have no effect; where there is no sun,
  /// each item draws one, and where there is no pitch, as DatasetCameras says.
  PictureSettings picture;
  uint64_t count = 1;
  uint32_t cameras = 4;
  DatasetCameras placing = DatasetCameras::Orbit;
  /// So many times nearer a longer lens brings what cameras look at, whose whole fits a picture at
  /// 1; from a tenth to a hundred.
  double zoom = 1;
  DatasetLabels labels = DatasetLabels::Rule;
  /// Of DatasetLabels::Tag: the categories in this order; where a shape is given several, the first
  /// one counts. A tag's name or its beginning by dots; ? stands for one part, * for some. Empty:
  /// all that the rules name in `tag`, in the order of the alphabet.
  std::vector<std::string> tags;
  DatasetFormat format = DatasetFormat::Coco;
  /// The extension of the mesh of each seed, as Model::write has them; empty: no mesh.
  std::string model = "glb";
  WriteSettings write;
  /// Only the seeds whose place modulo `of` is `index`; else whatever no other process is making.
  struct Shard {
    uint64_t index = 0, of = 1;
  };
  std::optional<Shard> shard;
  /// Threads; absent: one a processor. Seeds are made side by side.
  std::optional<int> jobs;
  /// Called by one thread at a time with the items that are there, of all.
  std::function<void(size_t done, size_t total)> progress;
  /// Of all; when it ends, what is whole stays.
  FileLimits limits{std::nullopt};

  DatasetSettings() {
    picture.width = picture.height = 512;
    picture.samples = 16;
  }
};

struct DatasetResult {
  bool ok = false;
  End end = End::Done;
  DiagnosticList diagnostics;
  /// All that the settings ask for, those that this call has made, and those that are there now.
  uint64_t items = 0, made = 0, done = 0;
  /// All items are there, and the list of them.
  bool merged = false;
};

/// Makes the items of a folder that are missing and nobody else is making. Whoever makes the last
/// one writes the list of all. Codes: dataset-folder (the folder has something else),
/// dataset-settings, dataset-labels, dataset-lock, and those of derive, pictures and files.
DatasetResult writeDataset(const Rules& rules, const Shapes& shapes, const std::string& folder,
                           const DatasetSettings& settings = {});

}  // namespace gable
