// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The vertices of a feature are its own, by the transform of the first line. In one model they come
// one after the other, so that the boundaries of a feature count from where its vertices begin.
#include "io/importers/city_json_sequence.h"

#include <algorithm>
#include <optional>

#include "base/json_copy.h"
#include "base/work.h"

namespace gable {
namespace {

class Sequence {
 public:
  explicit Sequence(const std::string& path) : path_(path) {}

  Result<JsonValue> read(std::string_view text) {
    for (size_t line = 1; !text.empty(); ++line) {
      const size_t end = std::min(text.find('\n'), text.size());
      if (auto e = add(text.substr(0, end), line)) return *e;
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (head_.empty()) return broken("it has no line", 1);
    return parse(head_ + ",\"CityObjects\":{" + objects_ + "},\"vertices\":[" + vertices_ + "]}",
                 1);
  }

 private:
  Error broken(const std::string& why, size_t line) const {
    return {"shapes-broken", "'" + path_ + "', line " + std::to_string(line) + ": " + why,
            "check it with a validator of CityJSON"};
  }

  Result<JsonValue> parse(std::string_view text, size_t line) const {
    work(text.size());
    Result<JsonValue> root = parseJson(text);
    if (!root.ok() && root.error().code != "json-limit") return broken(root.error().message, line);
    return root;
  }

  std::optional<Error> add(std::string_view text, size_t line) {
    if (text.find_first_not_of(" \t\r") == std::string_view::npos) return std::nullopt;
    const Result<JsonValue> root = parse(text, line);
    if (!root.ok()) return root.error();
    const std::string& type = root.value()["type"].text();
    if (type != (head_.empty() ? "CityJSON" : "CityJSONFeature")) {
      return broken(
          head_.empty() ? "it does not begin with a CityJSON object" : "it is no CityJSONFeature",
          line);
    }
    if (head_.empty()) {
      addHead(root.value());
    } else {
      addFeature(root.value());
    }
    return std::nullopt;
  }

  // All but its end.
  void addHead(const JsonValue& root) {
    JsonWriter w(head_);
    w.beginObject();
    for (const auto& [name, value] : root.members()) {
      if (name != "CityObjects" && name != "vertices" && name != "appearance") {
        copy(w.key(name), value);
      }
    }
  }

  void addFeature(const JsonValue& root) {
    for (const auto& [id, object] : root["CityObjects"].members()) {
      if (!objects_.empty()) objects_ += ',';
      JsonWriter(objects_).value(id);
      objects_ += ':';
      JsonWriter w(objects_);
      addObject(w, object);
    }
    for (const JsonValue& vertex : root["vertices"].items()) {
      if (!vertices_.empty()) vertices_ += ',';
      JsonWriter w(vertices_);
      copy(w, vertex);
    }
    first_ += root["vertices"].size();
  }

  void addObject(JsonWriter& w, const JsonValue& object) const {
    w.beginObject();
    for (const auto& [name, value] : object.members()) {
      w.key(name);
      if (name != "geometry" || !value.isArray()) {
        copy(w, value);
        continue;
      }
      w.beginArray();
      for (const JsonValue& geometry : value.items()) addGeometry(w, geometry);
      w.endArray();
    }
    w.endObject();
  }

  void addGeometry(JsonWriter& w, const JsonValue& geometry) const {
    w.beginObject();
    for (const auto& [name, value] : geometry.members()) {
      if (name == "material" || name == "texture") continue;
      w.key(name);
      if (name == "boundaries") {
        addBoundaries(w, value);
      } else {
        copy(w, value);
      }
    }
    w.endObject();
  }

  void addBoundaries(JsonWriter& w, const JsonValue& v) const {
    work();
    if (!v.isArray()) {
      w.value(v.number(-1) + static_cast<double>(first_));
      return;
    }
    w.beginArray();
    for (const JsonValue& each : v.items()) addBoundaries(w, each);
    w.endArray();
  }

  const std::string& path_;
  std::string head_, objects_, vertices_;
  /// Vertices before the feature.
  uint64_t first_ = 0;
};

}  // namespace

bool isCityJsonSequence(std::string_view path) { return path.ends_with(".city.jsonl"); }

Result<JsonValue> parseGeometries(std::string_view text, const std::string& path) {
  if (isCityJsonSequence(path)) return Sequence(path).read(text);
  Result<JsonValue> root = parseJson(text);
  if (!root.ok()) {
    return Error{"shapes-broken", "'" + path + "': " + root.error().message, root.error().hint};
  }
  if (!root.value()["type"].isText()) {
    return Error{"shapes-broken", "'" + path + "' is JSON but not GeoJSON: it has no type", {}};
  }
  return root;
}

}  // namespace gable
