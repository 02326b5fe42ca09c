// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include <gtest/gtest.h>

#include <chrono>

#include "base/random.h"
#include "io/importers/asset.h"
#include "io/importers/mtl_file.h"
#include "io/importers/obj_file.h"
#include "io/importers/shape_input.h"

namespace gable {
namespace {

Result<Asset> read(const std::string& text, const std::string& mtl = {}) {
  AssetOptions o;
  o.path = "models/house.obj";
  o.readFile = [mtl](const std::string& path) -> Result<std::string> {
    if (path == "models/house.mtl") return mtl;
    return Error{"file-missing", "'" + path + "' is not there", {}};
  };
  return readObjAsset(text, o);
}

constexpr const char* kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ObjAsset, readsPolygonsWithMaterialsAndGroups) {
  const std::string text = std::string("mtllib house.mtl\n") + kSquare +
                           "v 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n"
                           "o House\ng Wall\nusemtl red\nf 1 2 3 4\n"
                           "g Roof\nusemtl tile roof\nf 1/1/1 2/2/1 3/3/1\n"
                           "usemtl red\nf -1 -5 -4\n";
  auto r = read(text,
                "newmtl red\nKd 1 0 0\nd 0.5\n\nnewmtl tile roof\nKd 0.5\n"
                "map_Kd -s 2 3 1 -clamp on tex\\tile roof.png\nnorm ../n.png\nPr 0.25\n");
  ASSERT_TRUE(r.ok()) << r.error().message;
  const Asset& a = *r;
  EXPECT_EQ(a.mesh->faceCount(), 3u);
  EXPECT_EQ(a.mesh->positions.size(), 5u);
  ASSERT_EQ(a.materials.size(), 2u);
  EXPECT_EQ(a.materials[0].color, (Vec3{1, 0, 0}));
  EXPECT_EQ(a.materials[0].opacity, 0.5);
  const Material& tile = a.materials[1];
  EXPECT_EQ(tile.name, "tile roof");
  EXPECT_EQ(tile.color, (Vec3{0.5, 0.5, 0.5}));
  EXPECT_EQ(tile.map(TextureLayer::Color).path, "models/tex/tile roof.png");
  EXPECT_EQ(tile.map(TextureLayer::Color).sv, 3);
  EXPECT_EQ(tile.map(TextureLayer::Normal).path, "n.png");
  EXPECT_EQ(tile.roughness, 0.25);
  EXPECT_EQ(a.groups, (std::vector<std::string>{"Wall", "Roof"}));
  EXPECT_EQ(a.faceGroups, (std::vector<uint32_t>{0, 1, 1}));
  EXPECT_EQ(a.mesh->faces[2].materialSlot, 0);
  EXPECT_TRUE(a.mesh->hasUv(0));
  EXPECT_EQ(a.mesh->uvs[0][6], (Vec2{1, 1}));
  EXPECT_EQ(a.mesh->normals[4], (Vec3{0, 0, 1}));
  EXPECT_TRUE(a.warnings.empty());
}

TEST(ObjAsset, wrongLinesAreCountedAndPassedOver) {
  auto r = read(std::string(kSquare) +
                "f 1 2 3 4\nf 1 2 9\nf 1 2\nf a b c\nf 0 1 2\nf -9 1 2\nf 1/7 2 3\nf 1/ 2/ 3/\n"
                "v nan 1 2\nf 1 2 5\nv 1e999 0 0\nf 1 2 6\nf 1 1 1 1\nf 1 2 1\nnonsense\n"
                "vn x\nvt\nf 4294967297 1 2\nf 99999999999999999999999 1 2\nusemtl\ng\no\n");
  ASSERT_TRUE(r.ok());
  EXPECT_EQ(r->mesh->faceCount(), 2u);
  EXPECT_EQ(r->warnings.size(), 2u);
}

TEST(ObjAsset, continuationsCommentsAndLineEnds) {
  auto r =
      read("# a square\r\nv 0 0 0\r\nv 1 \\\r\n 0 0\r\n\tv 1 1 0 # corner\nv 0 1 0\nf 1 2 \\\n3 4");
  ASSERT_TRUE(r.ok()) << r.error().message;
  EXPECT_NEAR(r->mesh->area(), 1, 1e-12);
}

TEST(ObjAsset, filesWithoutFacesAreErrors) {
  for (const char* text :
       {"", "v 0 0 0", "f 1 2 3", "\\\n\\\n\\", "v 1e12 0 0\nv 0 1 0\nv 0 0 2e13\nf 1 2 3"}) {
    const auto r = read(text);
    ASSERT_FALSE(r.ok()) << text;
    EXPECT_EQ(r.error().code, "asset-empty");
  }
}

TEST(ObjAsset, zUpModelsStandUp) {
  AssetOptions o;
  o.zUp = true;
  auto r = readObjAsset("v 0 0 0\nv 1 0 0\nv 1 0 2\nv 0 0 2\nf 1 2 3 4\n", o);
  ASSERT_TRUE(r.ok());
  EXPECT_EQ(r->bounds.size(), (Vec3{1, 2, 0}));
  EXPECT_EQ(r->mesh->normal(0), (Vec3{0, 0, 1}));
}

TEST(ObjAsset, readingIsLinear) {
  // Ten times the text must not take a hundred times as long; a line of many corners included.
  const auto text = [](int n) {
    std::string t;
    for (int i = 0; i < n; ++i) {
      t += "v " + std::to_string(i) + " " + std::to_string(i % 7) + " 0\n";
      t += "usemtl m" + std::to_string(i) + "\ng g" + std::to_string(i) + "\n";
      if (i > 2) t += "f -1 -2 -3\n";
    }
    t += "f";
    for (int i = 1; i <= n; ++i) t += " " + std::to_string(i);
    return t;
  };
  const auto seconds = [](const std::string& t) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_TRUE(read(t).ok());
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const double small = seconds(text(5000)), large = seconds(text(50000));
  EXPECT_LT(large, 40 * small + 0.5);
}

TEST(ObjAsset, garbageNeverHurts) {
  const std::string good =
      std::string("mtllib house.mtl\n") + kSquare +
      "vt 0 0\nvt 1 1\nvn 0 0 1\ng a\nusemtl m\ns 1\nf 1/1/1 2/2/1 3//1 4\nf -4 -3 -2\n";
  for (uint64_t seed = 0; seed < 3000; ++seed) {
    std::string text = good;
    for (uint64_t k = 0; k < 4; ++k) {
      const uint64_t bits = randomBits(hashCombine(seed, k));
      const size_t at = bits % text.size();
      switch (bits >> 60) {
        case 0: text.erase(at, 1 + (bits >> 20) % 9); break;
        case 1: text.insert(at, text.substr((bits >> 20) % text.size(), 12)); break;
        default: text[at] = static_cast<char>(bits >> 32);
      }
      if (text.empty()) text = " ";
    }
    const auto r = read(text, text);
    if (r.ok()) {
      EXPECT_TRUE(r.value().mesh->valid());
      EXPECT_EQ(r.value().faceGroups.size(), r.value().mesh->faceCount());
    }
  }
}

TEST(ObjAsset, moreMaterialsThanSlotsAreRefused) {
  std::string text = kSquare;
  for (int i = 0; i < 65534; ++i) text += "usemtl m" + std::to_string(i) + "\nf 1 2 3\n";
  const auto most = read(text, "");
  ASSERT_TRUE(most.ok());
  EXPECT_EQ(most.value().materials.size(), 65534u);
  EXPECT_EQ(most.value().mesh->faces.back().materialSlot, 65533);
  EXPECT_EQ(read(text + "usemtl one-more\nf 1 2 3\n", "").error().code, "asset-too-large");
}

TEST(ObjAsset, materialFilesAreReadOnce) {
  std::string text = kSquare;
  for (int i = 0; i < 50'000; ++i) text += "mtllib a.mtl\n";
  size_t times = 0;
  AssetOptions options;
  options.path = "a.obj";
  options.readFile = [&](const std::string&) -> Result<std::string> {
    ++times;
    return std::string("newmtl m\n");
  };
  EXPECT_TRUE(readObjAsset(text + "f 1 2 3\n", options).ok());
  EXPECT_EQ(times, 1u);
  for (int i = 0; i < 2000; ++i) text += "mtllib b" + std::to_string(i) + ".mtl\n";
  EXPECT_EQ(readObjAsset(text + "f 1 2 3\n", options).error().code, "asset-too-large");
}

TEST(ObjShapes, objectsOrGroupsAreShapes) {
  const std::string text =
      std::string(kSquare) + "o A\nf 1 2 3\no B\nf 1 3 4\nf 2 3 4\no A\nf 2 3 4\n";
  auto r = readObjShapes(text, {"x/lots.obj", {}, false});
  ASSERT_TRUE(r.ok());
  ASSERT_EQ(r->shapes.size(), 2u);
  EXPECT_EQ(r->shapes[0].name, "A");
  EXPECT_EQ(r->shapes[0].mesh.faceCount(), 2u);
  EXPECT_EQ(r->shapes[1].mesh.positions.size(), 4u);
  auto plain = readObjShapes(std::string(kSquare) + "f 1 2 3\n", {"x/lots.obj", {}, false});
  ASSERT_TRUE(plain.ok());
  EXPECT_EQ(plain->shapes[0].name, "lots");
  EXPECT_FALSE(readObjShapes("v 0 0 0\n", {"a.obj", {}, false}).ok());
}

TEST(ObjShapes, bringTextureCoordinates) {
  const std::string text = std::string(kSquare) +
                           "vt 0 0\nvt 4 0\nvt 4 1\nvt 0 1\no Street\nusemtl road\n"
                           "f 1/1 2/2 3/3 4/4\nusemtl kerb\nf 1 3 4\no Plain\nf 1 2 3\n";
  Result<ShapeFile> r = readObjShapes(text, {"street.obj", {}, false});
  ASSERT_TRUE(r.ok()) << r.error().message;
  ASSERT_EQ(r->shapes.size(), 2u);
  const Mesh& street = r->shapes[0].mesh;
  EXPECT_EQ(street.faceCount(), 2u);
  ASSERT_TRUE(street.hasUv(0));
  EXPECT_EQ(street.uvs[0][2], (Vec2{4, 1}));
  EXPECT_EQ(street.faces[1].materialSlot, 0);
  // Without any a shape is as plain as it can be.
  EXPECT_FALSE(r->shapes[1].mesh.hasUv(0));
}

TEST(Mtl, takesBumpFactorsXyzAndHalos) {
  std::vector<std::string> losses;
  const auto all =
      parseMtl("newmtl a\nKd xyz 0.9505 1 1.089\nmap_Bump -bm 0.4 bump.png\nd -halo 0.25\n",
               "m/a.mtl", losses);
  EXPECT_TRUE(losses.empty());
  const Material& m = all.at(0);
  EXPECT_NEAR(m.color.x, 1, 1e-3);
  EXPECT_NEAR(m.color.y, 1, 1e-3);
  EXPECT_EQ(m.map(TextureLayer::Bump).path, "m/bump.png");
  EXPECT_EQ(m.bumpValue, 0.4);
  EXPECT_EQ(m.opacity, 0.25);
}

TEST(Mtl, tellsWhatItLeavesOutByFileAndLine) {
  std::vector<std::string> losses;
  const auto all = parseMtl(
      "# by hand\nKd 1 0 0\nnewmtl a\nillum 2\nNi 1.4\nTf 1 1 1\nKd 1 0\nrefl sky.png\nmap_Ns "
      "gloss.png\nrefl sky.png\nTf 0 1 0\n",
      "m/a.mtl", losses);
  EXPECT_EQ(all.size(), 1u);
  EXPECT_EQ(losses,
            (std::vector<std::string>{"m/a.mtl:8: 'refl' has no counterpart; nor 'map_Ns', 'Tf'",
                                      "m/a.mtl:2: 'Kd' cannot be read"}));
}

TEST(ObjShapes, tellsLossesOfMaterialsOnceAFile) {
  AssetOptions options{"lot.obj", [](const std::string&) -> Result<std::string> {
                         return std::string("newmtl a\nrefl x.png\nnewmtl b\nrefl y.png\n");
                       }};
  auto r = readObjShapes("mtllib a.mtl\nv 0 0 0\nv 4 0 0\nv 4 0 -3\nusemtl a\nf 1 2 3\n", options);
  ASSERT_TRUE(r.ok());
  ASSERT_EQ(r->diagnostics.all().size(), 1u);
  EXPECT_EQ(r->diagnostics.all()[0].code, "read-with-loss");
  EXPECT_EQ(r->diagnostics.all()[0].message,
            "'lot.obj' is read with losses: a.mtl:2: 'refl' has no counterpart");
}

TEST(ObjShapes, footprintsThatFaceTheGroundAreTurned) {
  const std::string vertices = "v 0 0 0\nv 4 0 0\nv 4 0 3\nv 0 0 3\nv 0 2 0\n";
  Result<ShapeFile> down = readObjShapes(vertices + "f 1 2 3 4\n", {"lot.obj", {}, false});
  ASSERT_TRUE(down.ok());
  EXPECT_NEAR(down->shapes[0].mesh.normal(0).y, 1, 1e-12);
  ASSERT_EQ(down->diagnostics.all().size(), 1u);
  EXPECT_EQ(down->diagnostics.all()[0].code, "shape-turned");
  Result<ShapeFile> up = readObjShapes(vertices + "f 4 3 2 1\n", {"lot.obj", {}, false});
  ASSERT_TRUE(up.ok());
  EXPECT_TRUE(up->diagnostics.all().empty());
  // What has other faces is a body, and stays as it is.
  Result<ShapeFile> body =
      readObjShapes(vertices + "f 1 2 3 4\nf 1 5 2\n", {"body.obj", {}, false});
  ASSERT_TRUE(body.ok());
  EXPECT_NEAR(body->shapes[0].mesh.normal(0).y, -1, 1e-12);
}

TEST(ObjShapes, filesWithoutAPolygonSayWhy) {
  const auto message = [](const std::string& text) {
    const Result<ShapeFile> file = readObjShapes(text, {"lot.obj", {}, false});
    EXPECT_FALSE(file.ok());
    return file.ok() ? std::string() : file.error().message;
  };
  const std::string vertices = "v 0 0 0\nv 4 0 0\n\n# a comment\nv 8 0 0\n";
  EXPECT_NE(
      message(vertices + "f 1 2 \\\n9\n").find("line 7: the corner '9' names no vertex of the 3"),
      std::string::npos);
  EXPECT_NE(message(vertices + "f 1 2\n").find("line 6: a face has 3 to 100000 corners, not 2"),
            std::string::npos);
  EXPECT_NE(message(vertices + "f 1 2 3\n").find("no area"), std::string::npos);
  EXPECT_NE(message(vertices + "l 1 2 3\n").find("it has lines"), std::string::npos);
  EXPECT_NE(message(vertices).find("3 vertices and no faces"), std::string::npos);
}

TEST(RelativePaths, stayInOneForm) {
  EXPECT_EQ(relativeTo("a/b.obj", "c.png"), "a/c.png");
  EXPECT_EQ(relativeTo("a/b.obj", "../t/./c.png"), "t/c.png");
  EXPECT_EQ(relativeTo("b.obj", "..\\..\\c.png"), "../../c.png");
  EXPECT_EQ(relativeTo("a/b.obj", "/abs//c.png"), "/abs/c.png");
  EXPECT_EQ(relativeTo("a/b/c.obj", "../../../x"), "../x");
}

}  // namespace
}  // namespace gable
