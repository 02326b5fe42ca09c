// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/normal_table.h"

#include <gtest/gtest.h>

#include <cstring>

namespace gable {
namespace {

std::vector<float> restored(const NormalTable& table, const std::vector<uint32_t>& numbers) {
  std::vector<float> out;
  for (const uint32_t n : numbers) {
    for (size_t i = 0; i < 3; ++i) out.push_back(table.normals().at(n * size_t{3} + i));
  }
  return out;
}

TEST(NormalTable, holdsEachNormalOnceAsTheyCome) {
  const std::vector<float> normals{0, 1, 0, 0, 1, 0, 1, 0, 0, 0, 1, 0};
  NormalTable table;
  EXPECT_EQ(table.number(normals), (std::vector<uint32_t>{0, 0, 1, 0}));
  EXPECT_EQ(table.normals(), (std::vector<float>{0, 1, 0, 1, 0, 0}));
}

TEST(NormalTable, tellsApartWhatDiffersByABit) {
  const std::vector<float> normals{0, 1, 0, -0.0f, 1, 0, 0, 1, 1e-45f};
  NormalTable table;
  EXPECT_EQ(table.number(normals), (std::vector<uint32_t>{0, 1, 2}));
}

TEST(NormalTable, restoresManyAndForgetsThem) {
  std::vector<float> normals;
  for (int i = 0; i < 5000; ++i) {
    for (const int k : {i % 177, i % 13, 1}) normals.push_back(static_cast<float>(k));
  }
  NormalTable table;
  const std::vector<float> back = restored(table, table.number(normals));
  EXPECT_EQ(std::memcmp(back.data(), normals.data(), normals.size() * sizeof(float)), 0);
  EXPECT_LT(table.normals().size(), normals.size());
  EXPECT_TRUE(table.number({}).empty());
  EXPECT_TRUE(table.normals().empty());
}

}  // namespace
}  // namespace gable
