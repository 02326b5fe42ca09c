// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The studio without a server answers what it answers with one.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "base/json.h"
#include "gable/studio.h"

namespace gable {
namespace {

namespace fs = std::filesystem;

class Desk : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = ::testing::TempDir() + "gable-desk-" +
            ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(root_);
    fs::create_directories(root_);
    std::ofstream(root_ + "/a.cga") << kRules;
    settings_.project = root_;
  }
  void TearDown() override { fs::remove_all(root_); }

  static constexpr const char* kRules = "@StartRule\nLot --> extrude(3) Body.\n";
  std::string root_;
  StudioSettings settings_;
};

// The JSON behind the mark of a derivation's answer.
JsonValue told(const std::string& body) {
  uint32_t size = 0;
  std::memcpy(&size, body.data() + 4, sizeof size);
  return parseJson(body.substr(8, size)).value();
}

TEST_F(Desk, derivesAndExports) {
  StudioDesk desk(settings_);
  ASSERT_TRUE(desk.ok());
  const std::string request =
      R"({"page":"p","file":"a.cga","text":"Lot --> extrude(3) Body.","shapes":{"lot":[4,5]}})";
  const StudioAnswer derived = desk.answer({"POST", "/api/derive", {}, request});
  ASSERT_EQ(derived.status, 200);
  const JsonValue json = told(derived.body);
  EXPECT_EQ(json["end"].text(), "done");
  const std::string number = std::to_string(static_cast<uint64_t>(json["derivation"].number(0)));
  const StudioAnswer model = desk.answer(
      {"GET", "/api/export", {{"derivation", number}, {"format", "glb"}, {"page", "p"}}, {}});
  ASSERT_EQ(model.status, 200);
  EXPECT_EQ(model.body.substr(0, 4), "glTF");
}

TEST_F(Desk, readsAndWritesTheProject) {
  StudioDesk desk(settings_);
  EXPECT_EQ(desk.answer({"GET", "/api/file", {{"path", "a.cga"}}, {}}).body, kRules);
  const auto written =
      desk.answer({"PUT", "/api/file", {{"path", "b.cga"}, {"expected", "none"}}, "Lot --> NIL"});
  EXPECT_EQ(written.status, 200);
  EXPECT_EQ(desk.answer({"GET", "/api/file", {{"path", "b.cga"}}, {}}).body, "Lot --> NIL");
}

TEST_F(Desk, refusesAsTheServerDoes) {
  StudioDesk desk(settings_);
  EXPECT_EQ(desk.answer({"GET", "/api/nothing", {}, {}}).status, 404);
  EXPECT_EQ(desk.answer({"GET", "/api/file", {{"path", "../x"}}, {}}).status, 403);
  EXPECT_EQ(desk.answer({"POST", "/api/derive", {}, "{"}).status, 422);
}

TEST_F(Desk, missesItsFolder) {
  settings_.project = root_ + "/none";
  EXPECT_FALSE(StudioDesk(settings_).ok());
}

}  // namespace
}  // namespace gable
