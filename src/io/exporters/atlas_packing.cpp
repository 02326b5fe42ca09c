// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/atlas_packing.h"

#include <algorithm>
#include <numeric>

#include "base/work.h"

namespace gable {
namespace {

constexpr uint32_t kLeastSide = 16;

struct Shelf {
  uint32_t y = 0, height = 0, used = 0;
};

// Fills the places of a sheet; true where all have one.
bool fill(const std::vector<PackedSize>& sizes, const std::vector<size_t>& order, Packing& sheet) {
  std::vector<Shelf> shelves;
  uint32_t bottom = 0;
  bool all = true;
  sheet.places.assign(sizes.size(), std::nullopt);
  for (const size_t i : order) {
    work(1 + shelves.size());
    const PackedSize& s = sizes[i];
    auto shelf = std::find_if(shelves.begin(), shelves.end(), [&](const Shelf& on) {
      return s.height <= on.height && s.width <= sheet.width - on.used;
    });
    if (shelf == shelves.end()) {
      if (s.width > sheet.width || s.height > sheet.height - bottom) {
        all = false;
        continue;
      }
      shelves.push_back({bottom, s.height, 0});
      bottom += s.height;
      shelf = shelves.end() - 1;
    }
    sheet.places[i] = Packing::Place{shelf->used, shelf->y};
    shelf->used += s.width;
  }
  return all;
}

}  // namespace

Packing pack(const std::vector<PackedSize>& sizes, uint32_t side) {
  std::vector<size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return sizes[a].height != sizes[b].height ? sizes[a].height > sizes[b].height
                                              : sizes[a].width > sizes[b].width;
  });
  Packing sheet;
  sheet.width = sheet.height = std::min(kLeastSide, side);
  while (!fill(sizes, order, sheet)) {
    if (sheet.width >= side && sheet.height >= side) break;
    uint32_t& shorter = sheet.height < sheet.width ? sheet.height : sheet.width;
    shorter = std::min(shorter * 2, side);
  }
  return sheet;
}

}  // namespace gable
