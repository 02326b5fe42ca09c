// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "json/answers.h"

namespace gable {

namespace {

template <class T>
void writeChange(JsonWriter& json, const char* name, const Change<T>& change) {
  json.key(name).beginArray().value(change.first).value(change.second).endArray();
}

void writeTriple(JsonWriter& json, const char* name, const Triple& v) {
  json.key(name).beginArray().value(v[0]).value(v[1]).value(v[2]).endArray();
}

void writeSum(JsonWriter& json, const char* name, const FaceSum& sum) {
  json.key(name).beginObject().key("faces").value(sum.faces).key("area").value(sum.area);
  if (sum.bounds) {
    writeTriple(json, "min", sum.bounds->min);
    writeTriple(json, "max", sum.bounds->max);
  }
  json.endObject();
}

}  // namespace

std::string comparisonJson(const Comparison& c) {
  const auto& [a, b] = c.statistics;
  std::string out;
  JsonWriter json(out, 1);
  json.beginObject().key("same").value(c.same());
  writeChange<uint64_t>(json, "faces", {a.faces, b.faces});
  writeChange<uint64_t>(json, "vertices", {a.vertices, b.vertices});
  writeChange<uint64_t>(json, "triangles", {a.triangles, b.triangles});
  writeChange<uint64_t>(json, "materials", {a.materials, b.materials});
  writeChange<double>(json, "area", c.area);
  writeSum(json, "added", c.added);
  writeSum(json, "removed", c.removed);
  writeSum(json, "kept", c.kept);
  json.key("materialAreas").beginArray();
  for (const MaterialChange& m : c.materials) {
    json.beginObject().key("name").value(m.name).key("color").value(m.color);
    writeChange<double>(json, "area", m.area);
    json.endObject();
  }
  json.endArray().endObject();
  return out;
}

}  // namespace gable
