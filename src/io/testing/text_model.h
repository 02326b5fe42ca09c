// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Plain readers of our own STL and PLY files for tests.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "math/box.h"
#include "math/vec.h"

namespace gable::testing {

struct Soup {
  /// As the file tells them, by polygon; STL only.
  std::vector<Vec3> normals;
  std::vector<std::vector<Vec3>> polygons;
  Box3 bounds;
  double area = 0, volume = 0, smallest = 1e300;
  uint64_t triangles = 0;

  void add(std::vector<Vec3> p) {
    Vec3 sum;
    for (size_t i = 1; i + 1 < p.size(); ++i) {
      sum += cross(p[i] - p[0], p[i + 1] - p[0]);
      volume += dot(p[0], cross(p[i], p[i + 1])) / 6;
    }
    for (const Vec3& v : p) bounds.include(v);
    area += length(sum) / 2;
    smallest = std::min(smallest, length(sum) / 2);
    triangles += p.size() - 2;
    polygons.push_back(std::move(p));
  }
};

template <class T>
T take(const std::string& bytes, size_t& at) {
  T v{};
  if (at + sizeof v <= bytes.size()) std::memcpy(&v, bytes.data() + at, sizeof v);
  at += sizeof v;
  return v;
}

inline Soup readStl(const std::string& bytes) {
  Soup out;
  size_t at = 80;
  const auto count = take<uint32_t>(bytes, at);
  for (uint32_t i = 0; i < count && at < bytes.size(); ++i) {
    std::vector<Vec3> p;
    for (int k = 0; k < 4; ++k) {
      const auto x = take<float>(bytes, at), y = take<float>(bytes, at), z = take<float>(bytes, at);
      p.push_back({x, y, z});
    }
    at += 2;
    out.normals.push_back(p[0]);
    p.erase(p.begin());
    out.add(std::move(p));
  }
  return out;
}

inline Soup readPly(const std::string& bytes) {
  Soup out;
  const size_t end = bytes.find("end_header\n");
  const std::string head = bytes.substr(0, end);
  const auto number = [&](const std::string& after) {
    return std::stoul(head.substr(head.find(after) + after.size()));
  };
  const bool wide = head.find("property double x") != std::string::npos;
  size_t at = end + 11;
  std::vector<Vec3> vertices;
  for (size_t n = number("element vertex "); n > 0; --n) {
    Vec3 p;
    for (size_t k = 0; k < 3; ++k) {
      p[k] = wide ? take<double>(bytes, at) : static_cast<double>(take<float>(bytes, at));
    }
    at += 4;
    vertices.push_back(p);
  }
  for (size_t n = number("element face "); n > 0; --n) {
    std::vector<Vec3> p;
    for (int corners = take<uint8_t>(bytes, at); corners > 0; --corners) {
      p.push_back(vertices.at(static_cast<size_t>(take<int32_t>(bytes, at))));
    }
    out.add(std::move(p));
  }
  return out;
}

}  // namespace gable::testing
