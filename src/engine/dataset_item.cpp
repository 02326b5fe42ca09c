// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The files of an item. Outlines of instances are runs of pixels down the columns, as COCO has
// them: the lengths of runs outside and inside by turns, beginning outside.

#include <algorithm>

#include "engine/dataset.h"
#include "engine/picture_files.h"

namespace gable {

namespace {

/// zlib's: of layers, which are many.
constexpr int kLevel = 1;

struct Region {
  uint32_t instance = 0, category = 0;
  int left = 0, top = 0, right = 0, bottom = 0;
  uint64_t area = 0;
  /// First pixels and lengths, down the columns.
  std::vector<std::pair<uint32_t, uint32_t>> runs;

  void add(uint32_t place, int x, int y) {
    if (area++ == 0) left = right = x, top = bottom = y;
    left = std::min(left, x);
    right = std::max(right, x);
    top = std::min(top, y);
    bottom = std::max(bottom, y);
    if (!runs.empty() && runs.back().first + runs.back().second == place)
      ++runs.back().second;
    else
      runs.emplace_back(place, 1);
  }
};

// In the order of the instances' numbers; what has no category is left out.
std::vector<Region> regionsOf(const PictureData& picture, const Marks& marks) {
  std::vector<uint32_t> present = marks.instances;
  std::sort(present.begin(), present.end());
  present.erase(std::unique(present.begin(), present.end()), present.end());
  std::vector<Region> regions(present.size());
  const auto width = static_cast<size_t>(picture.width),
             height = static_cast<size_t>(picture.height);
  size_t last = 0;
  for (size_t x = 0; x < width; ++x) {
    for (size_t y = 0; y < height; ++y) {
      const size_t i = y * width + x;
      const uint32_t instance = marks.instances[i];
      if (instance == 0 || marks.categories[i] == 0) continue;
      if (present[last] != instance) {
        last = static_cast<size_t>(std::lower_bound(present.begin(), present.end(), instance) -
                                   present.begin());
      }
      Region& r = regions[last];
      r.instance = instance;
      r.category = marks.categories[i];
      r.add(static_cast<uint32_t>(x * height + y), static_cast<int>(x), static_cast<int>(y));
    }
  }
  std::erase_if(regions, [](const Region& r) { return r.area == 0; });
  return regions;
}

void writeRegion(JsonWriter& w, const PictureData& picture, const Region& r) {
  w.beginObject().field("instance", r.instance).field("category_id", r.category);
  w.key("bbox").beginArray().value(r.left).value(r.top);
  w.value(r.right - r.left + 1).value(r.bottom - r.top + 1).endArray();
  w.field("area", r.area).field("iscrowd", 0);
  w.key("segmentation").beginObject();
  w.key("size").beginArray().value(picture.height).value(picture.width).endArray();
  w.key("counts").beginArray();
  uint32_t at = 0;
  for (const auto& [first, length] : r.runs) {
    w.value(first - at).value(length);
    at = first + length;
  }
  const auto pixels = static_cast<uint32_t>(picture.width) * static_cast<uint32_t>(picture.height);
  if (at < pixels) w.value(pixels - at);
  w.endArray().endObject().endObject();
}

// Pixels from the world: x to the right, y down, z ahead, as OpenCV has cameras.
void writeMatrices(JsonWriter& w, const PictureData& picture) {
  const PictureData::Pose& p = picture.pose;
  const double focal = picture.width / (2 * p.halfWidth);
  const auto row = [&w](std::initializer_list<double> numbers) {
    w.beginArray();
    for (const double n : numbers) w.value(n);
    w.endArray();
  };
  w.key("intrinsics").beginArray();
  row({focal, 0, picture.width / 2.0});
  row({0, focal, picture.height * (1 - p.horizon)});
  row({0, 0, 1});
  w.endArray();
  w.key("worldToCamera").beginArray();
  const auto axis = [&](const Triple& a, double sign) {
    const double along = a[0] * p.eye[0] + a[1] * p.eye[1] + a[2] * p.eye[2];
    row({sign * a[0], sign * a[1], sign * a[2], -sign * along});
  };
  axis(p.right, 1);
  axis(p.up, -1);
  axis(p.forward, 1);
  row({0, 0, 0, 1});
  w.endArray();
}

std::string itemJson(const DatasetItem& item, const PictureData& picture,
                     const std::vector<Region>& regions) {
  std::string text;
  JsonWriter w(text);
  w.beginObject().field("name", item.name).field("id", item.id);
  w.field("seed", item.seed).field("number", item.camera);
  writeCamera(w, picture);
  writeMatrices(w, picture);
  w.key("annotations").beginArray();
  for (const Region& r : regions) writeRegion(w, picture, r);
  w.endArray().endObject();
  return text + "\n";
}

}  // namespace

DiagnosticList writeItem(const DatasetItem& item, const PictureData& picture, const Marks& marks,
                         const std::string& folder) {
  PictureFiles files(picture, folder, kLevel);
  files.writeColors("image.png");
  files.writeFloats("depth.pfm", picture.layers.depth);
  files.writeNormals("normal.png");
  files.writeAlbedo("albedo.png");
  files.writeNumbers("instance.png", marks.instances);
  files.writeNumbers("semantic.png", marks.categories);
  files.write("item.json", itemJson(item, picture, regionsOf(picture, marks)));
  return files.result().diagnostics;
}

}  // namespace gable
