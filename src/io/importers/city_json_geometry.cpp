// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/city_json_geometry.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include "base/number.h"
#include "base/work.h"

namespace gable {

Vec3 cityJsonNormal(const std::vector<Vec3>& ring) {
  Vec3 sum;
  for (size_t i = 1; i + 1 < ring.size(); ++i) {
    sum += cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
  }
  return sum * 0.5;
}

std::string cityJsonText(const JsonValue& v) {
  if (v.isNumber()) return shortestText(v.number(0));
  if (v.isBool()) return v.boolean(false) ? "yes" : "no";
  return v.text();
}

// "https://www.opengis.net/def/crs/EPSG/0/7415" and "urn:ogc:def:crs:EPSG::7415".
std::string cityJsonSystem(const JsonValue& root) {
  const std::string& name = root["metadata"]["referenceSystem"].text();
  const size_t at = name.find_last_of("/:");
  if (at == std::string::npos || name.find("EPSG") == std::string::npos) return {};
  return "EPSG:" + name.substr(at + 1);
}

CityJsonGeometry::CityJsonGeometry(const JsonValue& root) {
  const JsonValue &scale = root["transform"]["scale"], &shift = root["transform"]["translate"];
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const JsonValue& v : root["vertices"].items()) {
    work();
    const auto at = [&](size_t i) {
      return v.at(i).number(none) * scale.at(i).number(1) + shift.at(i).number(0);
    };
    vertices_.push_back({at(0), at(1), at(2)});
  }
}

// The corners of a ring; false where one is none of the file's.
bool CityJsonGeometry::ring(const JsonValue& indices, const Skip& skip,
                            std::vector<Vec3>& out) const {
  for (const JsonValue& i : indices.items()) {
    work();
    const double at = i.number(-1);
    if (!(at >= 0) || !(at < static_cast<double>(vertices_.size()))) {
      skip("it names a vertex that is not there");
      return false;
    }
    const Vec3& p = vertices_[static_cast<size_t>(at)];
    if (!isFinite(p)) {
      skip("a vertex is not three numbers");
      return false;
    }
    if (out.empty() || !(out.back() == p)) out.push_back(p);
  }
  while (out.size() > 1 && out.back() == out.front()) out.pop_back();
  return true;
}

void CityJsonGeometry::addFace(const JsonValue& rings, std::string_view meaning, const Skip& skip,
                               CityJsonBody& to) const {
  CityJsonFace face;
  face.meaning = meaning;
  for (const JsonValue& r : rings.items()) {
    std::vector<Vec3> corners;
    if (!ring(r, skip, corners)) return;
    // Models are full of faces without an area: nothing is lost with them.
    if (corners.size() >= 3) {
      face.rings.push_back(std::move(corners));
    } else if (face.rings.empty()) {
      return;
    }
  }
  if (!face.rings.empty()) to.faces.push_back(std::move(face));
}

// Surfaces, in shells, in solids: `depth` lists of lists, semantics in lists of the same shape.
void CityJsonGeometry::addFaces(const JsonValue& boundaries, const JsonValue& semantics, int depth,
                                const Skip& skip, CityJsonBody& to) const {
  using Pair = std::pair<const JsonValue*, const JsonValue*>;
  std::vector<Pair> lists{{&boundaries, &semantics["values"]}};
  for (int d = 0; d < depth; ++d) {
    std::vector<Pair> next;
    for (const auto& [list, values] : lists) {
      for (size_t i = 0; i < list->size(); ++i) {
        work();
        next.emplace_back(&list->at(i), &values->at(i));
      }
    }
    lists = std::move(next);
  }
  for (const auto& [surface, value] : lists) {
    const double number = value->number(-1);
    const bool known = number >= 0 && number < 1e9;
    const JsonValue& of = semantics["surfaces"].at(known ? static_cast<size_t>(number) : SIZE_MAX);
    addFace(*surface, of["type"].text(), skip, to);
  }
}

std::vector<CityJsonBody> CityJsonGeometry::of(const JsonValue& object, const Skip& skip) const {
  std::vector<CityJsonBody> out;
  for (const JsonValue& g : object["geometry"].items()) {
    CityJsonBody one;
    if (!parseNumber(cityJsonText(g["lod"]), one.lod)) one.lod = 0;
    const std::string& type = g["type"].text();
    const JsonValue& at = g["boundaries"];
    if (type == "MultiSurface" || type == "CompositeSurface") {
      addFaces(at, g["semantics"], 1, skip, one);
    } else if (type == "Solid") {
      addFaces(at, g["semantics"], 2, skip, one);
    } else if (type == "MultiSolid" || type == "CompositeSolid") {
      addFaces(at, g["semantics"], 3, skip, one);
    } else if (type == "MultiLineString") {
      for (const JsonValue& line : at.items()) {
        one.lines.emplace_back();
        if (!ring(line, skip, one.lines.back())) one.lines.pop_back();
      }
    } else if (type == "MultiPoint" || type == "GeometryInstance") {
      one.lines.emplace_back();
      if (!ring(at, skip, one.lines.back())) one.lines.pop_back();
    }
    if (!one.faces.empty() || !one.lines.empty()) out.push_back(std::move(one));
  }
  return out;
}

}  // namespace gable
