// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A plain reader of our own GLB files for tests, apart from the importer: every triangle in the
// world, and what the JSON says.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "base/files.h"
#include "base/json.h"
#include "math/box.h"
#include "scene/flatten.h"

namespace gable::testing {

struct WorldTriangle {
  Vec3 p[3];
  Vec3 normal[3];
  /// In the picture of the material's colour; nothing where it has none.
  Vec2 uv[3];
  int material = -1;
};

struct GlbModel {
  std::string bytes;
  JsonValue json;
  std::vector<WorldTriangle> triangles;
  /// Of meshes as often as they are shown.
  size_t vertices = 0;
  size_t nodes = 0, meshes = 0;
  double area = 0;
  Box3 bounds;

  const char* buffer() const { return bytes.data() + bufferAt_; }

  void read(const std::string& path) {
    bytes = readFile(path).value();
    const auto word = [&](size_t at) {
      uint32_t v = 0;
      std::memcpy(&v, bytes.data() + at, 4);
      return v;
    };
    ASSERT_GE(bytes.size(), 20u);
    ASSERT_EQ(word(0), 0x46546c67u);
    ASSERT_EQ(word(8), bytes.size());
    json = parseJson(std::string_view(bytes).substr(20, word(12))).value();
    bufferAt_ = 28 + word(12);
    nodes = json["nodes"].size();
    meshes = json["meshes"].size();
    for (const JsonValue& n : json["scenes"].at(0)["nodes"].items()) {
      visit(index(n), Frame{}, {1, 1, 1});
    }
  }

 private:
  static size_t index(const JsonValue& v) { return static_cast<size_t>(v.number(-1)); }

  // Children of scaled nodes do not occur in our files.
  void visit(size_t node, const Frame& around, const Vec3& parentScale) {
    const JsonValue& n = json["nodes"].at(node);
    EXPECT_EQ(parentScale, (Vec3{1, 1, 1}));
    const JsonValue &t = n["translation"], &q = n["rotation"], &s = n["scale"];
    Frame f;
    if (q.size() == 4) f = fromQuaternion(q);
    if (t.size() == 3) f.origin = {t.at(0).number(0), t.at(1).number(0), t.at(2).number(0)};
    Vec3 scale{1, 1, 1};
    if (s.size() == 3) scale = {s.at(0).number(0), s.at(1).number(0), s.at(2).number(0)};
    const Frame world = around * f;
    const JsonValue& instancing = n["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    if (instancing.isObject()) {
      const size_t count = index(accessor(instancing["TRANSLATION"])["count"]);
      for (size_t i = 0; i < count; ++i) {
        const Frame inner = instance(instancing, i);
        const float* is = floats(instancing["SCALE"], i, 12);
        addMesh(n, world * inner, {is[0], is[1], is[2]});
      }
    } else if (n["mesh"].isNumber()) {
      addMesh(n, world, scale);
    }
    for (const JsonValue& c : n["children"].items()) visit(index(c), world, scale);
  }

  static Frame fromQuaternion(const JsonValue& q) {
    return rotation(q.at(0).number(0), q.at(1).number(0), q.at(2).number(0), q.at(3).number(0));
  }
  static Frame rotation(double x, double y, double z, double w) {
    EXPECT_NEAR(x * x + y * y + z * z + w * w, 1, 1e-6);
    return Frame::of({}, {1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
                     {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
                     {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)});
  }
  Frame instance(const JsonValue& attributes, size_t i) const {
    const float* t = floats(attributes["TRANSLATION"], i, 12);
    const float* q = floats(attributes["ROTATION"], i, 16);
    Frame f = rotation(q[0], q[1], q[2], q[3]);
    f.origin = {t[0], t[1], t[2]};
    return f;
  }

  const JsonValue& accessor(const JsonValue& number) const {
    return json["accessors"].at(index(number));
  }
  size_t place(const JsonValue& a, size_t& stride) const {
    const JsonValue& view = json["bufferViews"].at(index(a["bufferView"]));
    stride = view["byteStride"].isNumber() ? index(view["byteStride"]) : 0;
    return index(view["byteOffset"]) + (a["byteOffset"].isNumber() ? index(a["byteOffset"]) : 0);
  }
  const float* floats(const JsonValue& number, size_t i, size_t packed) const {
    size_t stride = 0;
    const size_t at = place(accessor(number), stride);
    return reinterpret_cast<const float*>(buffer() + at + i * (stride ? stride : packed));
  }

  // A vector of floats or of the integers of KHR_mesh_quantization.
  Vec3 vector(const JsonValue& number, size_t i, size_t width = 3) const {
    const JsonValue& a = accessor(number);
    size_t stride = 0;
    const char* at = buffer() + place(a, stride) + i * stride;
    const auto read = [&](auto unit, size_t k) {
      std::memcpy(&unit, at + k * sizeof unit, sizeof unit);
      return static_cast<double>(unit);
    };
    Vec3 v;
    for (size_t k = 0; k < width; ++k) {
      switch (static_cast<int>(a["componentType"].number(0))) {
        case 5120: v[k] = read(int8_t{}, k) / 127; break;
        case 5123: v[k] = read(uint16_t{}, k) / (a["normalized"].boolean(false) ? 65535 : 1); break;
        default: v[k] = read(float{}, k);
      }
    }
    return v;
  }

  // As KHR_texture_transform says.
  Vec2 textured(const JsonValue& primitive, size_t i) const {
    const JsonValue& map = json["materials"].at(
        index(primitive["material"]))["pbrMetallicRoughness"]["baseColorTexture"];
    const JsonValue& uv = primitive["attributes"]["TEXCOORD_0"];
    if (!map.isObject() || !uv.isNumber()) return {};
    const Vec3 at = vector(uv, i, 2);
    const JsonValue& t = map["extensions"]["KHR_texture_transform"];
    if (!t.isObject()) return {at.x, at.y};
    const double turn = t["rotation"].number(0);
    const double x = at.x * t["scale"].at(0).number(1), y = at.y * t["scale"].at(1).number(1);
    return {t["offset"].at(0).number(0) + std::cos(turn) * x - std::sin(turn) * y,
            t["offset"].at(1).number(0) + std::sin(turn) * x + std::cos(turn) * y};
  }

  void addMesh(const JsonValue& node, const Frame& world, const Vec3& scale) {
    const JsonValue& mesh = json["meshes"].at(index(node["mesh"]));
    for (const JsonValue& p : mesh["primitives"].items()) addPrimitive(p, world, scale);
  }

  void addPrimitive(const JsonValue& p, const Frame& world, const Vec3& scale) {
    const JsonValue& indices = accessor(p["indices"]);
    const size_t count = index(indices["count"]);
    ASSERT_EQ(count % 3, 0u);
    ASSERT_GT(count, 0u);
    size_t stride = 0;
    const char* indexed = buffer() + place(indices, stride);
    const bool wide = indices["componentType"].number(0) == 5125;
    const bool mirrors = scale.x * scale.y * scale.z < 0;
    const bool flat = p["attributes"]["NORMAL"].isNull();
    vertices += index(accessor(p["attributes"]["POSITION"])["count"]);
    for (size_t i = 0; i < count; i += 3) {
      WorldTriangle t;
      t.material = static_cast<int>(index(p["material"]));
      for (size_t k = 0; k < 3; ++k) {
        uint32_t v = 0;
        std::memcpy(&v, indexed + (i + k) * (wide ? 4 : 2), wide ? 4 : 2);
        const Vec3 at = vector(p["attributes"]["POSITION"], v);
        ASSERT_TRUE(std::isfinite(at.x) && std::isfinite(at.y) && std::isfinite(at.z));
        const size_t to = mirrors ? 2 - k : k;
        t.p[to] = world.point(scaled(at, scale));
        bounds.include(t.p[to]);
        t.uv[to] = textured(p, v);
        if (flat) continue;
        const Vec3 normal = vector(p["attributes"]["NORMAL"], v);
        const bool coarse = accessor(p["attributes"]["NORMAL"])["componentType"].number(0) == 5120;
        ASSERT_NEAR(dot(normal, normal), 1, coarse ? 0.02 : 1e-5);
        t.normal[to] = world.direction(normal);
      }
      const Vec3 n = cross(t.p[1] - t.p[0], t.p[2] - t.p[0]);
      EXPECT_GT(length(n), 0);
      // A reader makes them.
      for (size_t k = 0; k < 3 && flat; ++k) t.normal[k] = n * (1 / length(n));
      area += length(n) / 2;
      triangles.push_back(t);
    }
  }

  size_t bufferAt_ = 0;
};

/// The area of all faces of a flattened scene.
inline double areaOf(const Scene& s) {
  double area = 0;
  for (const PlacedLeaf& leaf : flatLeaves(s)) area += worldMesh(s, leaf).area();
  return area;
}

}  // namespace gable::testing
