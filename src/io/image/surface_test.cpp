// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "io/image/surface.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "io/image/surface_noise.h"

namespace gable {

namespace {

// The mean step between neighbouring texels along one direction, over rows [from, to).
double meanStep(const SurfaceField& field, int x0, int x1, bool across) {
  double sum = 0;
  for (int i = 0; i < static_cast<int>(kSurfaceSize); ++i) {
    const double a = across ? field.at(x0, i).color.y : field.at(i, x0).color.y;
    const double b = across ? field.at(x1, i).color.y : field.at(i, x1).color.y;
    sum += std::fabs(a - b);
  }
  return sum / kSurfaceSize;
}

// Near any of the steps that a direction has: borders of units are larger than the steps in them.
double largestStep(const SurfaceField& field, bool across) {
  double most = 0;
  for (int x = 0; x + 1 < static_cast<int>(kSurfaceSize); ++x) {
    most = std::max(most, meanStep(field, x, x + 1, across));
  }
  return most;
}

}  // namespace

TEST(Surface, cellsAreThoseOfAllPointsAbout) {
  for (const double jitter : {0.0, 0.5, 1.0}) {
    const surface::Cells cells{6, 4, 1.2, 2.0, jitter, 11};
    const double wide = cells.width / cells.columns, high = cells.height / cells.rows;
    for (int n = 0; n < 400; ++n) {
      const auto number = static_cast<uint64_t>(n);
      const double u = surface::chance(number, 1, 5), v = surface::chance(number, 2, 5);
      // All of 7 x 7 cells, one by one.
      std::vector<std::pair<double, double>> points;
      const int ix = surface::floorOf(u * cells.columns), iy = surface::floorOf(v * cells.rows);
      for (int j = iy - 3; j <= iy + 3; ++j) {
        for (int i = ix - 3; i <= ix + 3; ++i) {
          const auto column = static_cast<uint64_t>(surface::wrapped(i, cells.columns));
          const auto row = static_cast<uint64_t>(surface::wrapped(j, cells.rows));
          const double aside = surface::chance(column, row, cells.seed) - 0.5;
          const double up = surface::chance(column, row, cells.seed + 1) - 0.5;
          points.emplace_back((i + 0.5 + jitter * aside - u * cells.columns) * wide,
                              (j + 0.5 + jitter * up - v * cells.rows) * high);
        }
      }
      const auto far = [](const auto& p) { return std::hypot(p.first, p.second); };
      const auto near =
          *std::min_element(points.begin(), points.end(),
                            [&](const auto& a, const auto& b) { return far(a) < far(b); });
      double border = 1e9;
      for (const auto& p : points) {
        const double ax = p.first - near.first, ay = p.second - near.second;
        if (std::hypot(ax, ay) == 0) continue;
        border = std::min(border, ((p.first + near.first) * ax + (p.second + near.second) * ay) /
                                      (2 * std::hypot(ax, ay)));
      }
      const surface::Cell cell = surface::cellAt(u, v, cells);
      EXPECT_NEAR(cell.point, far(near), 1e-12);
      EXPECT_NEAR(cell.border, border, 1e-12);
    }
  }
}

TEST(Surface, theLibraryIsSortedAndFoundByName) {
  const auto library = materialLibrary();
  EXPECT_EQ(library.size(), 50u);
  for (size_t i = 1; i < library.size(); ++i) {
    EXPECT_TRUE(std::string(library[i - 1].name) < library[i].name);
  }
  for (const LibraryMaterial& m : library) {
    EXPECT_TRUE(libraryMaterial(m.name) == &m);
    EXPECT_TRUE(m.width > 0 && m.height > 0 && m.columns > 0 && m.rows > 0);
    const std::string path = materialPicturePath(m, MaterialPicture::Normal);
    EXPECT_TRUE(materialPictureOf(path).material == &m);
  }
}

TEST(Surface, bricksHaveTheirTrueSize) {
  for (const char* name : {"brick.stretcher", "brick.flemish", "brick.english", "brick.stack"}) {
    const LibraryMaterial& m = *libraryMaterial(name);
    EXPECT_NEAR(m.height / m.rows, 0.075, 1e-12);
    EXPECT_NEAR(m.joint, 0.01, 1e-12);
    // A stretcher and its joint; in Flemish bond a header more.
    EXPECT_NEAR(m.width / m.columns, m.bond == Bond::Flemish ? 0.3375 : 0.225, 1e-12);
  }
}

TEST(Surface, noMaterialHasASeamOrLargePictures) {
  for (const LibraryMaterial& m : materialLibrary()) {
    const SurfaceField field = drawSurface(m);
    const int last = static_cast<int>(kSurfaceSize) - 1;
    EXPECT_TRUE(meanStep(field, last, 0, true) <= 1.25 * largestStep(field, true) + 1e-9);
    EXPECT_TRUE(meanStep(field, last, 0, false) <= 1.25 * largestStep(field, false) + 1e-9);
    size_t bytes = 0;
    for (const auto picture :
         {MaterialPicture::Color, MaterialPicture::Normal, MaterialPicture::Surface}) {
      auto jpeg = encodeMaterialPicture(pictureOf(field, m, picture), picture);
      EXPECT_TRUE(jpeg.ok());
      if (jpeg.ok()) bytes += jpeg->size();
    }
    EXPECT_LE(bytes, kMostMaterialBytes) << m.name;
  }
}

TEST(Surface, aTintBecomesTheColourOfTheMainPart) {
  const LibraryMaterial& m = *libraryMaterial("plaster.clean");
  const Vec3 grey{0.5, 0.5, 0.5};
  const Material tinted = laidMaterial(m, &grey);
  EXPECT_NEAR(tinted.color.x * 0xf4 / 255.0, 0.5, 1e-12);
  EXPECT_TRUE(isLaid(tinted));
  EXPECT_TRUE(libraryEntryOf(tinted) == &m);
  const Vec3 white{1, 1, 1};
  EXPECT_TRUE(laidMaterial(m, &white).color == white);
}

}  // namespace gable
