// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <gtest/gtest.h>

#include "builtins/ops/subdivide/shared/perimeter.h"
#include "builtins/testing/op_fixture.h"
#include "builtins/testing/polygons.h"

namespace gable {
namespace {

SplitPieces equalSections(double whole, uint32_t count) {
  SplitPieces out;
  for (uint32_t i = 0; i < count; ++i) out.push_back({i * whole / count, whole / count, 0});
  return out;
}

TEST(Perimeter, sectionsAndRemainderShareTheFace) {
  FakeServices services;
  const MeshRef mesh = meshInScope(quadShape(10, 6));
  Perimeter perimeter(*mesh, 0, nullptr, services);
  EXPECT_NEAR(perimeter.length(), 32, 1e-9);
  ASSERT_TRUE(perimeter.setBack(equalSections(32, 8), 0, std::vector<double>(8, 1)).ok());
  double sum = 0;
  for (uint32_t i = 0; i < 8; ++i) sum += perimeter.section(i).area();
  EXPECT_NEAR(sum, 60 - 8 * 4, 1e-4);
  EXPECT_NEAR(perimeter.remainder().area(), 8 * 4, 1e-4);
}

TEST(Perimeter, edgesGetTagsOfTheirPart) {
  FakeServices services;
  const MeshRef mesh = meshInScope(quadShape(10, 6));
  Perimeter perimeter(*mesh, 0, nullptr, services);
  SplitPieces sections;
  sections.push_back({0, 4, 0});
  ASSERT_TRUE(perimeter.setBack(sections, 2, {3}).ok());
  const auto tags = [&](const Mesh& m, std::string_view tag) {
    return std::count_if(m.edgeTags.begin(), m.edgeTags.end(),
                         [&](uint32_t t) { return services.tags().has(t, tag); });
  };
  const Mesh section = perimeter.section(0), rest = perimeter.remainder();
  EXPECT_EQ(tags(section, "setback.front"), 1);
  EXPECT_EQ(tags(section, "setback.back"), 1);
  EXPECT_EQ(tags(section, "setback.side"), 2);
  EXPECT_EQ(tags(rest, "setback.back"), 1);
  EXPECT_EQ(tags(rest, "setback.side"), 2);
  EXPECT_EQ(tags(rest, "setback.remainder"), 5);
}

TEST(Perimeter, hostilePolygonsAreTiled) {
  const std::vector<TestPolygon> polygons = hostilePolygons(16, true);
  if (polygons.empty()) GTEST_SKIP() << "the corpus is not here (set GABLE_SHARED)";
  for (const TestPolygon& p : polygons) {
    FakeServices services;
    const Shape s = polygonShape(p.rings);
    const MeshRef mesh = meshInScope(s);
    const double extent = std::max(s.size.x, s.size.z);
    Perimeter perimeter(*mesh, 1, nullptr, services);
    const Status status =
        perimeter.setBack(equalSections(perimeter.length(), 5), 0.3 * extent,
                          {0.05 * extent, 0.2 * extent, 0, 0.1 * extent, 0.2 * extent});
    if (!status.ok()) {
      ADD_FAILURE() << p.number << " " << status.code();
      continue;
    }
    const Mesh rest = perimeter.remainder();
    ASSERT_TRUE(rest.valid()) << p.number;
    double sum = rest.area();
    for (uint32_t i = 0; i < 5; ++i) {
      const Mesh m = perimeter.section(i);
      ASSERT_TRUE(m.valid()) << p.number;
      sum += m.area();
    }
    EXPECT_NEAR(sum, mesh->area(), 1e-5 * extent * extent + 1e-3 * extent) << p.number;
  }
}

}  // namespace
}  // namespace gable
