// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include <gtest/gtest.h>

#include "base/child_process.h"
#include "base/random.h"
#include "io/importers/asset.h"
#include "io/importers/shape_input.h"

namespace gable {
namespace {

// A wall of 2 x 3 metres on the ground, with z up: in metres and in centimetres.
constexpr const char* kFbx = R"(; FBX 7.4.0 project file
FBXHeaderExtension:  {
	FBXHeaderVersion: 1003
	FBXVersion: 7400
}
GlobalSettings:  {
	Version: 1000
	Properties70:  {
		P: "UpAxis", "int", "Integer", "",2
		P: "UpAxisSign", "int", "Integer", "",1
		P: "FrontAxis", "int", "Integer", "",1
		P: "FrontAxisSign", "int", "Integer", "",-1
		P: "CoordAxis", "int", "Integer", "",0
		P: "CoordAxisSign", "int", "Integer", "",1
		P: "UnitScaleFactor", "double", "Number", "",100
	}
}
Objects:  {
	Geometry: 1, "Geometry::quad", "Mesh" {
		Vertices: *12 {
			a: 0,0,0,2,0,0,2,0,3,0,0,3
		}
		PolygonVertexIndex: *4 {
			a: 0,1,2,-4
		}
	}
	Model: 2, "Model::My Quad", "Mesh" {
		Version: 232
		Properties70:  {
		}
	}
	Material: 3, "Material::Brick", "" {
		Version: 102
		ShadingModel: "phong"
		Properties70:  {
			P: "DiffuseColor", "Color", "", "A",1,0,0
		}
	}
}
Connections:  {
	C: "OO",1,2
	C: "OO",2,0
	C: "OO",3,2
}
)";
constexpr const char* kDae = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
 <asset><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
 <library_geometries><geometry id="g"><mesh>
  <source id="p"><float_array id="pa" count="12">0 0 0 200 0 0 200 0 300 0 0 300</float_array>
   <technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
  <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
  <polylist count="1"><input semantic="VERTEX" source="#v" offset="0"/><vcount>4</vcount><p>0 1 2 3</p></polylist>
 </mesh></geometry></library_geometries>
 <library_visual_scenes><visual_scene id="s"><node id="n" name="Wall"><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
 <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
)";

AssetOptions named(const char* path) { return {path, {}, false}; }

class Converted : public ::testing::Test {
 protected:
  void SetUp() override {
    if (programBeside("gable-convert").empty()) GTEST_SKIP() << "gable-convert is not built";
  }
};

TEST_F(Converted, axesAndUnitsAreThoseOfTheFile) {
  for (const auto& [path, text] : {std::pair{"a.fbx", kFbx}, std::pair{"m/A.DAE", kDae}}) {
    Result<Asset> r = readAsset(text, named(path));
    ASSERT_TRUE(r.ok()) << r.error().message;
    // Polygons stay polygons.
    EXPECT_EQ(r->mesh->faceCount(), 1u) << path;
    EXPECT_NEAR(length(r->bounds.min), 0, 1e-6) << path;
    EXPECT_NEAR(length(r->bounds.max - Vec3{2, 3, 0}), 0, 1e-6) << path;
    EXPECT_EQ(r->groups.size(), 1u) << path;
  }
  Result<Asset> fbx = readAsset(kFbx, named("a.fbx"));
  EXPECT_EQ(fbx->groups[0], "My_Quad");
}

TEST_F(Converted, shapesAreReadAsWell) {
  Result<ShapeFile> r = readShapes(kDae, named("lots.dae"));
  ASSERT_TRUE(r.ok()) << r.error().message;
  ASSERT_EQ(r->shapes.size(), 1u);
  EXPECT_NEAR(r->shapes[0].mesh.area(), 6, 1e-6);
}

TEST_F(Converted, brokenFilesEndInAnError) {
  for (const char* path : {"a.fbx", "a.dae"}) {
    const std::string good = path[2] == 'f' ? kFbx : kDae;
    for (const std::string& bytes : {std::string(), std::string("no model"), good.substr(0, 300)}) {
      const Result<Asset> r = readAsset(bytes, named(path));
      ASSERT_FALSE(r.ok());
      EXPECT_EQ(r.error().code, "asset-broken") << r.error().message;
    }
    constexpr uint64_t kTries = 8;
    for (uint64_t seed = 0; seed < kTries; ++seed) {
      std::string bytes = good;
      for (uint64_t k = 0; k < 5; ++k) {
        const uint64_t bits = randomBits(hashCombine(seed, k));
        bytes[bits % bytes.size()] = static_cast<char>(bits >> 32);
      }
      const Result<Asset> r = readAsset(bytes, named(path));
      if (!r.ok()) {
        EXPECT_FALSE(r.error().message.empty());
      }
    }
  }
}

}  // namespace
}  // namespace gable
