// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The engine as the playground has it, built natively: it derives, writes, and says of what it
// lacks where that works. tools/partners.sh playground tests the same as WebAssembly.
#include <gtest/gtest.h>

#include <fstream>

#include "base/temporary_folder.h"
#include "gable/studio.h"

namespace gable {
namespace {

class Playground : public ::testing::Test {
 protected:
  Playground() {
    settings_.project = folder_.path();
    desk_ = std::make_unique<StudioDesk>(settings_);
  }
  StudioAnswer ask(const std::string& method, const std::string& path, const std::string& body) {
    return desk_->answer({method, path, {}, body});
  }
  static Model house() {
    const Rules rules = Rules::parse(
        "Lot --> extrude(3) comp(f) { side : Wall. | top : Roof }\n"
        "@Label(\"roof\") Roof --> X.\n",
        "house.cga");
    return derive(rules, Shapes::lot(9, 7));
  }

  TemporaryFolder folder_;
  StudioSettings settings_;
  std::unique_ptr<StudioDesk> desk_;
};

TEST_F(Playground, derivesAndExports) {
  ASSERT_TRUE(desk_->ok());
  const StudioAnswer derived = ask(
      "POST", "/api/derive",
      R"({"page":"t","file":"a.cga","text":"Lot --> extrude(4) comp(f) { all : X. }","overlay":{},)"
      R"("start":"","seed":0,"attributes":{},"shapes":{"lot":[9,7]}})");
  ASSERT_EQ(derived.status, 200) << derived.body;
  EXPECT_EQ(derived.body.substr(0, 4), "GBS1");
  EXPECT_NE(derived.body.find("\"leaves\":6"), std::string::npos) << derived.body.substr(0, 2000);
}

TEST_F(Playground, writesModels) {
  const Model model = house();
  for (const char* name : {"a.glb", "a.obj", "a.usda", "a.ply", "a.city.json", "a.ifc"}) {
    const WriteResult result = model.write(folder_.path() + "/" + name);
    EXPECT_TRUE(result.ok) << name;
    EXPECT_GT(result.bytes, 0u) << name;
  }
}

TEST_F(Playground, saysWhereWhatItLacksWorks) {
  const auto told = [](const DiagnosticList& all) {
    std::string text;
    for (const Diagnostic& d : all) text += d.message + "; " + d.hint + "\n";
    return text;
  };
  const WriteResult picture = house().picture(folder_.path() + "/a.png");
  EXPECT_FALSE(picture.ok);
  EXPECT_NE(told(picture.diagnostics).find("Embree"), std::string::npos)
      << told(picture.diagnostics);
  for (const char* name : {"town.osm.pbf", "house.fbx"}) {
    const std::string path = folder_.path() + "/" + name;
    std::ofstream(path) << "something";
    const std::string all = name[0] == 'h' ? told(Model::load(path).diagnostics())
                                           : told(Shapes::load(path).diagnostics());
    EXPECT_NE(all.find("convert the"), std::string::npos) << name << ": " << all;
  }
}

}  // namespace
}  // namespace gable
