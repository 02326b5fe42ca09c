// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The parts of a data set (gable/dataset.h). Its folder:
//
//   dataset.json             the settings and the categories; it is written before the first item
//   locks/000003             locked while somebody makes the items of that seed
//   000003/model/model.glb   the mesh of a seed, by its place among the seeds
//   000003/01/               the item of a camera: image.png, depth.pfm, normal.png, albedo.png,
//                            instance.png, semantic.png, item.json
//   coco.json, items.json    the list of all items; it is written last
//
// A folder of a seed's folder is written aside and renamed, so it is whole or not there.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "engine/impl.h"
#include "engine/leaf_labels.h"
#include "gable/dataset.h"

namespace gable {

/// What all items have in common: the id of a category is its place in the list, from 1.
using Categories = std::vector<std::string>;

/// From the rules, so that it is the same for all items. Code: dataset-labels (there are none).
Result<Categories> categoriesOf(const Rules& rules, const DatasetSettings& settings);

/// By pixel: numbers of instances and ids of categories, 0 for none.
struct Marks {
  std::vector<uint32_t> instances, categories;
};

/// Finds the marks of pictures of one model.
class Labeller {
 public:
  Labeller(const Rules& rules, const Categories& categories, DatasetLabels labels,
           const Model& model);
  Marks marks(const PictureLayers& layers) const;

 private:
  /// By node of the trace its own category, 0 for none.
  std::vector<uint32_t> labelled(const Rules& rules, const DerivationTrace& trace) const;

  DatasetLabels labels_;
  std::map<std::string, uint32_t> ids_;
  /// Of Label and Tag.
  LeafMarks leaves_;
};

/// What the camera of an item sees, and by which light.
PictureSettings pictureOf(const PictureMaker& maker, const DatasetSettings& settings, double seed,
                          uint32_t camera);

/// The text of dataset.json: all that the bytes of an item depend on. How many seeds there are is
/// not among it: a data set may grow.
std::string descriptionOf(const Rules& rules, const Shapes& shapes, const Categories& categories,
                          const DatasetSettings& settings);

/// The names of the folders, and which are there.
class DatasetFolder {
 public:
  DatasetFolder(const std::string& path, const DatasetSettings& settings);

  /// Ends in a slash.
  const std::string& path() const { return path_; }
  /// "000003/01", "000003/model".
  std::string item(uint64_t seed, uint32_t camera) const;
  std::string model(uint64_t seed) const;
  /// The file to lock; makes its folder.
  std::string lock(uint64_t seed) const;
  bool has(const std::string& part) const;
  /// Items that are there.
  uint32_t itemsOf(uint64_t seed) const;
  /// With the mesh.
  bool isWhole(uint64_t seed) const;

  /// Makes the folder, or sees that it is a data set of this description. Code: dataset-folder.
  std::optional<Error> open(std::string description);
  /// Writes dataset.json where it is not there; any thread may call. Code: dataset-folder (another
  /// process has begun with other settings).
  std::optional<Error> begin() const;
  /// Removes what is empty.
  void close() const;
  /// Fills a part: `fill` writes into a folder aside, which takes its place.
  DiagnosticList put(const std::string& part,
                     const std::function<DiagnosticList(const std::string& aside)>& fill) const;

 private:
  std::string path_, description_;
  const DatasetSettings& settings_;
};

struct DatasetItem {
  std::string name;
  uint64_t id = 0;
  double seed = 0;
  uint32_t camera = 0;
};

/// Writes the files of an item into a folder that is there.
DiagnosticList writeItem(const DatasetItem& item, const PictureData& picture, const Marks& marks,
                         const std::string& folder);

/// Writes the list of all items.
DiagnosticList writeList(const DatasetFolder& folder, const DatasetSettings& settings,
                         const Categories& categories);

}  // namespace gable
