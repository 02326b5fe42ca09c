// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The tileset of a land: one node, whose children are the tilesets of places. Each has a transform
// of its own, from its plane to the Earth; its box is turned with it here. Where nothing of a place
// would be seen, it is not asked for.

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "base/files.h"
#include "base/json.h"
#include "engine/guard.h"
#include "engine/impl.h"
#include "engine/tile_folder.h"
#include "gable/tiles.h"
#include "io/uri.h"
#include "math/box.h"

namespace gable {

namespace {

struct Place {
  std::string uri;
  Vec3 center;
  std::array<Vec3, 3> axes;
  double error = 0;
};

Error joinError(const std::string& what, const std::string& hint) {
  return {"tiles-join", what, hint};
}

bool readNumbers(const JsonValue& from, double* to, size_t count) {
  if (from.size() != count) return false;
  for (size_t i = 0; i < count; ++i) {
    to[i] = from.at(i).number(NAN);
    if (!std::isfinite(to[i])) return false;
  }
  return true;
}

// From the folder of the land, which it must lie in: a static server gives nothing of what is
// outside.
Result<std::string> uriWithin(const std::string& land, const std::string& place) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path from = fs::weakly_canonical(land, error), to = fs::weakly_canonical(place, error);
  const std::string path = error ? std::string() : to.lexically_relative(from).string();
  if (path.empty() || path == "." || path.starts_with("..")) {
    return joinError("'" + place + "' does not lie in '" + land + "'",
                     "make the tileset of all in a folder that holds those of the places");
  }
  return uriOf(path + (path.ends_with('/') ? "" : "/") + "tileset.json");
}

Result<JsonValue> readTileset(const std::string& path) {
  constexpr uint64_t kLargest = 64 << 20;
  const Result<std::string> text = readFile(path, kLargest);
  if (!text.ok()) return text.error();
  Result<JsonValue> json = parseJson(text.value());
  if (!json.ok()) {
    return joinError("'" + path + "' is damaged: " + json.error().message, "make the tiles again");
  }
  return json;
}

Result<Place> readPlace(const std::string& land, const std::string& folder) {
  const std::string path = TileFolder(folder).path() + "tileset.json";
  const Result<JsonValue> json = readTileset(path);
  if (!json.ok()) return json.error();
  const JsonValue& root = json.value()["root"];
  std::array<double, 12> box{};
  std::array<double, 16> m{};
  Place out;
  out.error = json.value()["geometricError"].number(NAN);
  if (!readNumbers(root["boundingVolume"]["box"], box.data(), box.size()) ||
      !std::isfinite(out.error)) {
    return joinError("'" + path + "' has no box, or no error",
                     "join tilesets that 'gable tiles' and 'gable city' have made");
  }
  if (!readNumbers(root["transform"], m.data(), m.size())) {
    return joinError("'" + path + "' does not say where it lies on the Earth",
                     "make it of a map in degrees, or with a projection that is known");
  }
  const auto turned = [&](size_t i) {
    const double x = box[i], y = box[i + 1], z = box[i + 2];
    return Vec3{m[0] * x + m[4] * y + m[8] * z, m[1] * x + m[5] * y + m[9] * z,
                m[2] * x + m[6] * y + m[10] * z};
  };
  out.center = turned(0) + Vec3{m[12], m[13], m[14]};
  for (size_t a = 0; a < 3; ++a) out.axes[a] = turned(3 + 3 * a);
  const Result<std::string> uri = uriWithin(land, folder);
  if (!uri.ok()) return uri.error();
  out.uri = uri.value();
  return out;
}

void writeBox(JsonWriter& w, const Vec3& center, const std::array<Vec3, 3>& axes) {
  w.key("boundingVolume").beginObject().key("box").beginArray();
  for (const Vec3& v : {center, axes[0], axes[1], axes[2]}) w.value(v.x).value(v.y).value(v.z);
  w.endArray().endObject();
}

std::string landJson(const std::vector<Place>& places) {
  Box3 all;
  double error = 0;
  for (const Place& p : places) {
    const auto reach = [&](auto axis) {
      return std::fabs(axis(p.axes[0])) + std::fabs(axis(p.axes[1])) + std::fabs(axis(p.axes[2]));
    };
    const Vec3 half{reach([](const Vec3& v) { return v.x; }),
                    reach([](const Vec3& v) { return v.y; }),
                    reach([](const Vec3& v) { return v.z; })};
    all.include(p.center - half);
    all.include(p.center + half);
    error = std::max(error, p.error);
  }
  const Vec3 half = all.size() * 0.5;
  std::string out;
  JsonWriter w(out, 1);
  w.beginObject().key("asset").beginObject().field("version", "1.1").field("generator", "Gable");
  w.key("extras").beginObject().field("joined", true).endObject().endObject();
  // Beyond this even the coarsest tiles say nothing.
  w.field("geometricError", error).key("root").beginObject();
  writeBox(w, all.center(), {Vec3{half.x, 0, 0}, Vec3{0, half.y, 0}, Vec3{0, 0, half.z}});
  w.field("geometricError", error).field("refine", "ADD").key("children").beginArray();
  for (const Place& p : places) {
    w.beginObject();
    writeBox(w, p.center, p.axes);
    w.field("geometricError", p.error);
    w.key("content").beginObject().field("uri", p.uri).endObject().endObject();
  }
  w.endArray().endObject().endObject();
  out += '\n';
  return out;
}

// What is there may be an older one of the same kind, and nothing else.
std::optional<Error> mayWrite(const std::string& path) {
  if (!fileExists(path)) return std::nullopt;
  const Result<JsonValue> json = readTileset(path);
  if (json.ok() && json.value()["asset"]["extras"]["joined"].boolean(false)) return std::nullopt;
  return Error{"tiles-folder", "'" + path + "' is a tileset of a place, or of another program",
               "name another folder, or remove the file"};
}

std::optional<Error> join(const std::vector<std::string>& folders, const std::string& land) {
  std::vector<Place> places;
  for (const std::string& folder : folders) {
    work();
    Result<Place> place = readPlace(land, folder);
    if (!place.ok()) return place.error();
    places.push_back(std::move(*place));
  }
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return a.uri < b.uri; });
  for (size_t i = 1; i < places.size(); ++i) {
    if (places[i].uri == places[i - 1].uri) {
      return joinError("'" + places[i].uri + "' is named twice", "name each place once");
    }
  }
  if (places.empty()) return joinError("there is no place to join", "name folders of tiles");
  const std::string path = TileFolder(land).path() + "tileset.json";
  if (auto e = mayWrite(path)) return e;
  const Result<uint64_t> written = writeFile(path, landJson(places));
  if (!written.ok()) return written.error();
  return std::nullopt;
}

}  // namespace

DiagnosticList joinTilesets(const std::vector<std::string>& folders, const std::string& land,
                            const FileLimits& limits) {
  Task task("joining the tilesets of", land, limits);
  try {
    const WorkScope scope(task.allowance());
    const std::optional<Error> e = join(folders, land);
    return e ? DiagnosticList{diagnosticOf(*e)} : DiagnosticList{};
  } catch (...) {
    return {task.diagnosticOfException()};
  }
}

}  // namespace gable
