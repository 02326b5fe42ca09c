// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Vectors: what the original runtime was measured to do, and what the language's reference says.
// The files lie beside the repository (GABLE_SHARED, else ../shared); without them the tests are
// skipped.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>

#include "base/files.h"
#include "base/json.h"
#include "engine/impl.h"
#include "geom/mesh/face_triangles.h"
#include "json/answers.h"
#include "scene/flatten.h"

namespace gable {
namespace {

std::string sharedFolder() {
  if (const char* given = std::getenv("GABLE_SHARED")) return given;
  return std::string(GABLE_SOURCE_DIR) + "/../shared";
}

std::string dataPath(const std::string& name) { return sharedFolder() + "/data/prt/" + name; }

JsonValue readData(const std::string& name) {
  const Result<std::string> text = readFile(dataPath(name));
  if (!text.ok()) return {};
  Result<JsonValue> value = parseJson(text.value());
  return value.ok() ? value.value() : JsonValue{};
}

std::string textOf(const JsonValue& v) {
  if (v.isBool()) return v.boolean(false) ? "true" : "false";
  if (v.isText()) return v.text();
  if (v.isNumber()) return numberText(v.number(0));
  std::string out = "[";
  for (size_t i = 0; i < v.size(); ++i) out += (i ? "," : "") + textOf(v.at(i));
  return out + "]";
}

Shapes shapesOf(const JsonValue& v) {
  if (v.isText()) return Shapes::load(dataPath(v.text()));
  std::vector<std::array<double, 3>> vertices;
  for (const JsonValue& p : v["vertices"].items()) {
    vertices.push_back({p.at(0).number(0), p.at(1).number(0), p.at(2).number(0)});
  }
  const auto lists = [](const JsonValue& from) {
    std::vector<std::vector<uint32_t>> out;
    for (const JsonValue& list : from.items()) {
      out.emplace_back();
      for (const JsonValue& i : list.items())
        out.back().push_back(static_cast<uint32_t>(i.number(0)));
    }
    return out;
  };
  auto faces = lists(v["faces"]);
  if (faces.empty()) {
    faces.emplace_back();
    for (uint32_t i = 0; i < vertices.size(); ++i) faces[0].push_back(i);
  }
  return Shapes::mesh(vertices, faces, lists(v["holes"]));
}

class Vector : public testing::Test {
 protected:
  void SetUp() override {
    all_ = readData("vectors.json");
    if (all_["vectors"].size() == 0) GTEST_SKIP() << "no measured vectors in " << sharedFolder();
  }

  const JsonValue& vector(const std::string& id) {
    for (const JsonValue& v : all_["vectors"].items()) {
      if (v["id"].text() == id) return v;
    }
    ADD_FAILURE() << "there is no vector " << id;
    return all_;
  }

  Model run(const JsonValue& v, const std::string& style = "") {
    LoadSettings load;
    if (!style.empty()) load.style = style;
    const Rules rules = Rules::load(dataPath(v["rule"].text()), load);
    EXPECT_TRUE(rules.ok()) << render(rules.diagnostics());
    shapes_ = std::make_unique<Shapes>(shapesOf(v["shape"]));
    DeriveSettings settings;
    if (const std::string start = v["start"].text(); !start.empty()) settings.startRule = start;
    settings.seed = v["seed"].number(0);
    for (const auto& [name, value] : v["attrs"].members()) {
      settings.attributes.emplace_back(name, textOf(value));
    }
    Model model = derive(rules, *shapes_, settings);
    EXPECT_TRUE(model.ok()) << render(model.diagnostics());
    return model;
  }

  static const Scene& scene(const Model& m) { return m.impl().result.scene; }

  JsonValue all_;
  std::unique_ptr<Shapes> shapes_;
};

void expectReports(const JsonValue& expected, const Scene& scene) {
  std::map<std::string, std::vector<const PlainValue*>> made;
  for (const Report& r : scene.reports) made[r.key].push_back(&r.value);
  for (const auto& [key, want] : expected.members()) {
    const auto& values = made[key];
    ASSERT_EQ(values.size(), static_cast<size_t>(want["n"].number(-1))) << key;
    if (want.find("sum")) {
      double sum = 0;
      for (const PlainValue* v : values) sum += v->number;
      EXPECT_NEAR(sum, want["sum"].number(NAN), 1e-9) << key;
    }
    if (want["value"].isText()) {
      EXPECT_EQ(values[0]->text, want["value"].text()) << key;
    }
    if (want["value"].isBool()) {
      EXPECT_EQ(values[0]->number != 0, want["value"].boolean(false));
    }
  }
}

TEST_F(Vector, extrusionTriangulatedFaces) {
  const JsonValue& v = vector("extrusion-triangulated-faces");
  EXPECT_EQ(count(scene(run(v))).triangles, v["expect"]["face_count_triangles"].number(0));
}

TEST_F(Vector, extrusionHeightFixed) {
  const JsonValue& v = vector("extrusion-height-fixed");
  const Model model = run(v);
  size_t points = 0;
  for (const PlacedLeaf& leaf : flatLeaves(scene(model))) {
    for (const Vec3& p : worldMesh(scene(model), leaf).positions) {
      ++points;
      const double y = std::fabs(p.y);
      EXPECT_TRUE(std::fabs(y) < 1e-3 || std::fabs(y - 23) < 1e-3) << y;
    }
  }
  EXPECT_EQ(points, 8u);
}

TEST_F(Vector, extrusionQuadCounts) {
  const JsonValue& v = vector("extrusion-quad-counts");
  const Model model = run(v);
  EXPECT_EQ(count(scene(model)).vertices, v["expect"]["vertex_count_unmerged"].number(0));
  EXPECT_EQ(count(scene(model)).faces, v["expect"]["face_count_polygons"].number(0));
  expectReports(v["expect"]["reports"], scene(model));
}

TEST_F(Vector, attributesAsEvaluated) {
  for (const char* id :
       {"extrusion-default-attributes", "array-default-attrs", "array2d-default-attrs"}) {
    const JsonValue& v = vector(id);
    Result<JsonValue> made = parseJson(valuesJson(run(v).attributes(0)));
    ASSERT_TRUE(made.ok());
    const auto& expected = v["expect"]["attributes"].members();
    EXPECT_EQ(made->members().size(), expected.size()) << id;
    for (const auto& [name, value] : expected) {
      EXPECT_EQ(textOf((*made)[name]), textOf(value)) << id << " " << name;
    }
  }
}

TEST_F(Vector, printsOfHolesAndArrays) {
  for (const char* id : {"holes-counts", "array-print-format"}) {
    const JsonValue& v = vector(id);
    const Model model = run(v);
    std::string prints;
    for (const std::string& line : model.prints()) prints += line + "\n";
    EXPECT_EQ(prints, v["expect"]["prints"].text()) << id;
  }
}

TEST_F(Vector, aHoleNamedTwiceIsOneError) {
  const Shapes shapes = shapesOf(vector("holes-invalid")["shape"]);
  size_t errors = 0;
  for (const Diagnostic& m : shapes.diagnostics()) errors += m.isError() ? 1 : 0;
  EXPECT_EQ(errors, 1u);
}

TEST_F(Vector, importOverride) {
  const JsonValue& v = vector("import-override");
  expectReports(v["expect"]["reports"], scene(run(v)));
}

TEST_F(Vector, cubeSharesItsVertices) {
  const JsonValue& v = vector("cube-shared-vertices");
  const Model model = run(v);
  ASSERT_EQ(scene(model).leaves.size(), 1u);
  const Mesh& mesh = *scene(model).meshes[scene(model).leaves[0].mesh];
  const JsonValue& expect = v["expect"];
  EXPECT_EQ(mesh.positions.size(), expect["vertex_count"].number(0));
  ASSERT_EQ(mesh.faceCount(), expect["faces_prt_order"].size());
  std::vector<Vec2> uvs;
  for (size_t f = 0; f < mesh.faceCount(); ++f) {
    const MeshLoop& loop = mesh.loopsOf(f)[0];
    for (uint32_t c = 0; c < loop.cornerCount; ++c) {
      EXPECT_EQ(mesh.corners[loop.firstCorner + c],
                expect["faces_prt_order"].at(f).at(c).number(-1));
      const Vec2 uv = mesh.uvs[0][loop.firstCorner + c];
      size_t index = 0;
      while (index < uvs.size() && !(uvs[index] == uv)) ++index;
      if (index == uvs.size()) uvs.push_back(uv);
      EXPECT_EQ(index, expect["uv_indices_per_face_prt_order"].at(f).at(c).number(-1));
    }
  }
}

TEST_F(Vector, cubeFacesWithTwoUvSets) {
  const JsonValue& v = vector("cube-comp-f-two-uvsets");
  const Model model = run(v);
  const JsonValue& expect = v["expect"];
  EXPECT_EQ(count(scene(model)).leaves, expect["leaf_shapes"].number(0));
  EXPECT_EQ(count(scene(model)).vertices, expect["vertex_count"].number(0));
  for (const PlacedLeaf& leaf : flatLeaves(scene(model))) {
    const Mesh mesh = worldMesh(scene(model), leaf);
    ASSERT_EQ(mesh.faceCount(), 1u);
    EXPECT_EQ(mesh.corners, (std::vector<uint32_t>{0, 1, 2, 3}));
    EXPECT_TRUE(mesh.hasUv(0) && mesh.hasUv(2));
  }
}

TEST_F(Vector, attributesPerLeaf) {
  const JsonValue& v = vector("generic-attrs-per-leaf");
  const Model model = run(v);
  std::vector<std::string> foo;
  std::vector<double> ranges{0};
  for (const PlacedLeaf& leaf : flatLeaves(scene(model))) {
    const auto& set = scene(model).attributeSets[leaf.leaf->attributes];
    ASSERT_EQ(set.size(), 1u);
    foo.push_back(scene(model).attributeValues[set[0]].values[0].text);
    ranges.push_back(ranges.back() +
                     static_cast<double>(worldMesh(scene(model), leaf).faceCount()));
  }
  EXPECT_EQ(textOf(v["expect"]["leaf_attr_foo"]), "[" + foo[0] + "," + foo[1] + "]");
  EXPECT_EQ(ranges, (std::vector<double>{0, 6, 12}));
}

TEST_F(Vector, styles) {
  const JsonValue& v = vector("style-override");
  for (const auto& [style, height] : v["expect"]["default_h"].members()) {
    const Model model = run(v, style == "Default" ? "" : style);
    EXPECT_NEAR(count(scene(model)).bounds.size().y, height.number(0), 1e-9) << style;
  }
}

// ---- The reference ------------------------------------------------------------------------------

class Reference : public testing::Test {
 protected:
  void SetUp() override {
    doc_ = readData("doc_vectors.json");
    if (doc_["expr"].size() == 0)
      GTEST_SKIP() << "no vectors of the reference in " << sharedFolder();
  }
  static Model run(const std::string& rules, double lot = 10) {
    const Rules r = Rules::parse(rules, "vector.cga");
    EXPECT_TRUE(r.ok()) << render(r.diagnostics()) << rules;
    return derive(r, Shapes::lot(lot, lot), {});
  }
  JsonValue doc_;
};

TEST_F(Reference, expressions) {
  for (const JsonValue& pair : doc_["expr"].items()) {
    const std::string &written = pair.at(0).text(), &result = pair.at(1).text();
    const Model m = run("Lot --> print(str(" + written + ")) print(str(" + result + "))");
    ASSERT_EQ(m.prints().size(), 2u) << written;
    EXPECT_EQ(m.prints()[0], m.prints()[1]) << written;
  }
}

TEST_F(Reference, splitSizes) {
  for (const JsonValue& v : doc_["split_sizes_scope_sx_10"].items()) {
    std::string split = v["split"].text();
    const size_t cube = split.find("split");
    std::string rules = "Lot --> s(10, 0, 10) primitiveCube() " + split.substr(cube) + "\n";
    for (const char* name : {"X", "Y", "Z", "A", "B"}) {
      rules += std::string(name) +
               " --> report(\"size\", scope.sx) report(\"index\", split.index) " +
               "report(\"total\", split.total)\n";
    }
    const Model m = run(rules);
    std::vector<double> sizes, indices, totals;
    for (const Report& r : m.impl().result.scene.reports) {
      (r.key == "size" ? sizes : r.key == "index" ? indices : totals).push_back(r.value.number);
    }
    const JsonValue& expected = v["sizes"];
    if (expected.isArray()) {
      ASSERT_EQ(sizes.size(), expected.size()) << split;
    }
    for (size_t i = 0; i < expected.size(); ++i) {
      EXPECT_NEAR(sizes[i], expected.at(i).number(0), 1e-9) << split << " part " << i;
    }
    for (size_t i = 0; i < indices.size(); ++i) {
      EXPECT_EQ(indices[i], static_cast<double>(i)) << split;
      EXPECT_EQ(totals[i], static_cast<double>(indices.size())) << split;
    }
  }
}

TEST_F(Reference, repeatedSplitsFollowTheNotes) {
  const auto sizes = [](const std::string& split) {
    const Model m = run("Lot --> " + split + "\nX --> report(\"s\", scope.sx)\nY --> X\nZ --> X\n");
    std::vector<double> out;
    for (const Report& r : m.impl().result.scene.reports) out.push_back(r.value.number);
    return out;
  };
  const auto two = sizes("split(x){~2:X|~1:Y}*");
  ASSERT_EQ(two.size(), 6u);
  for (size_t i = 0; i < 6; ++i) EXPECT_NEAR(two[i], (i % 2 ? 1 : 2) * 10.0 / 9, 1e-9);
  const auto inner = sizes("split(x){1:X|{~1:Y|0.2:Z|~1:Y}*|1:X}");
  ASSERT_EQ(inner.size(), 14u);
  EXPECT_NEAR(inner[1], 0.9, 1e-9);
  EXPECT_NEAR(inner[2], 0.2, 1e-9);
}

TEST_F(Reference, treeKeys) {
  const Model m =
      run("Init --> center(xz) extrude(10) print(getTreeKey()) comp(f){front:Facade}\n"
          "Facade --> print(getTreeKey()) split(y){'0.5:Floor}*\n"
          "Floor --> print(getTreeKey()) split(x){'0.1:Wall|'0.3:Window|'0.1:Wall}*\n"
          "Wall --> print(getTreeKey())\nWindow --> print(getTreeKey())\n");
  for (const JsonValue& key : doc_["tree_key"]["keys"].items()) {
    const std::string text = key.text().substr(0, key.text().find(' '));
    EXPECT_NE(std::find(m.prints().begin(), m.prints().end(), text), m.prints().end()) << text;
  }
}

TEST_F(Reference, componentAttributes) {
  const Model m =
      run("Lot --> primitiveCube() comp(f){front:Front|side:Side|all=All}\n"
          "Front --> print(comp.sel + comp.index + \"/\" + comp.total)\n"
          "Side --> print(comp.sel + comp.index + \"/\" + comp.total)\n"
          "All --> print(comp.index + \"/\" + comp.total)\n");
  EXPECT_EQ(m.prints(),
            (std::vector<std::string>{"front0/1", "side0/3", "side1/3", "side2/3", "0/1"}));
}

TEST_F(Reference, selectorAngles) {
  // A face turned by an angle about x: which of the four classes takes it.
  const auto classOf = [](double degrees) {
    const Model m = run("Lot --> primitiveQuad(4, 4) r(" + numberText(degrees) +
                        ", 0, 0) alignScopeToAxes() comp(f){horizontal: print(\"horizontal\") NIL "
                        "| aslant: print(\"aslant\") NIL | vertical: print(\"vertical\") NIL | "
                        "nutant: print(\"nutant\") NIL}");
    return m.prints().empty() ? std::string() : m.prints()[0];
  };
  EXPECT_EQ(classOf(0), "horizontal");
  EXPECT_EQ(classOf(10), "horizontal");
  EXPECT_EQ(classOf(12), "aslant");
  EXPECT_EQ(classOf(78), "aslant");
  EXPECT_EQ(classOf(80), "vertical");
  EXPECT_EQ(classOf(100), "vertical");
  EXPECT_EQ(classOf(103), "nutant");
  EXPECT_EQ(classOf(168), "nutant");
  EXPECT_EQ(classOf(170), "horizontal");
}

TEST_F(Reference, limits) {
  const JsonValue& limits = doc_["limits"];
  const Limits ours;
  EXPECT_EQ(ours.depth, limits["max_derivation_depth"].number(0));
  EXPECT_EQ(ours.width, limits["max_derivation_width"].number(0));
  EXPECT_EQ(ours.functionDepth, limits["max_function_call_depth"].number(0));
  EXPECT_EQ(ours.arraySize, limits["array_size"].number(0));
  const Shape shape;
  EXPECT_EQ(shape.trimVertical, doc_["trim_plane"]["default_enabled"]["vertical"].boolean(false));
  EXPECT_EQ(shape.trimHorizontal,
            doc_["trim_plane"]["default_enabled"]["horizontal"].boolean(true));
}

}  // namespace
}  // namespace gable
