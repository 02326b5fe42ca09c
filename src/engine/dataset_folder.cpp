// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>

#include "base/bytes.h"
#include "base/files.h"
#include "base/json.h"
#include "base/number.h"
#include "engine/dataset.h"
#include "engine/shape_record.h"
#include "engine/tile_plan.h"
#include "gable/names.h"

namespace gable {

namespace {

/// Of the files of an item; a program with another one cannot go on with it.
constexpr int kFormat = 3;
constexpr const char* kDescription = "dataset.json";
constexpr const char* kLocks = "locks";

std::string numbered(size_t digits, uint64_t number) {
  const std::string text = std::to_string(number);
  return std::string(digits - std::min(digits, text.size()), '0') + text;
}

std::string checksumText(uint64_t checksum) {
  char text[32];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(checksum));
  return text;
}

uint64_t checksumOf(const Shapes& shapes) {
  std::string bytes;
  for (const ShapeFootprint& f : shapes.impl().footprints) appendRecord(f, bytes);
  return checksum(bytes);
}

template <class T>
void optional(JsonWriter& w, const char* name, const std::optional<T>& v) {
  w.key(name);
  if (v)
    w.value(*v);
  else
    w.null();
}

void writeDerive(JsonWriter& w, const DeriveSettings& derive) {
  w.field("seed", derive.seed).field("sharing", derive.sharing);
  w.field("startRule", derive.startRule.value_or(""));
  w.key("attributes").beginObject();
  for (const auto& [name, value] : derive.attributes) w.field(name, value);
  w.endObject();
}

void writeSun(JsonWriter& w, const PictureSettings& p) {
  w.key("sun").beginArray();
  if (p.sun) w.value(p.sun->elevation).value(p.sun->azimuth);
  w.endArray().key("sunTime").beginArray();
  if (p.sunTime) {
    const SunTime& t = *p.sunTime;
    if (t.place) w.value(t.place->latitude).value(t.place->longitude);
    w.value(t.year).value(t.month).value(t.day).value(t.hour);
    if (t.hoursEast) w.value(*t.hoursEast);
  }
  w.endArray();
}

void writePicture(JsonWriter& w, const PictureSettings& p) {
  w.field("width", p.width).field("height", p.height).field("samples", p.samples);
  w.field("bounces", p.bounces).field("denoise", p.denoise);
  w.field("look", lookNames()[static_cast<size_t>(p.look)]);
  w.field("lighting", lightingNames()[static_cast<size_t>(p.lighting)]);
  writeSun(w, p);
  if (p.clouds > 0) w.field("clouds", p.clouds);
  w.field("haziness", p.haziness).field("lamps", p.lamps).field("turn", p.turn);
  optional(w, "mist", p.mist);
  optional(w, "exposure", p.exposure);
  optional(w, "litRooms", p.litRooms);
  optional(w, "fieldOfView", p.fieldOfView);
  optional(w, "pitch", p.pitch);
  optional(w, "aperture", p.aperture);
  optional(w, "focus", p.focus);
  w.key("ground").beginArray();
  for (size_t k = 0; p.ground && k < 3; ++k) w.value((*p.ground)[k]);
  w.endArray().key("cut").beginArray();
  if (p.cut) w.value(p.cut->normal[0]).value(p.cut->normal[1]).value(p.cut->normal[2]);
  if (p.cut) w.value(p.cut->offset);
  w.endArray().field("cutSide", static_cast<int>(p.cutSide));
}

bool equal(const JsonValue& a, const JsonValue& b) {
  if (a.kind() != b.kind() || a.text() != b.text() || a.number(0) != b.number(0)) return false;
  if (a.boolean(false) != b.boolean(false) || a.size() != b.size()) return false;
  for (size_t i = 0; i < a.size(); ++i) {
    if (!equal(a.at(i), b.at(i))) return false;
  }
  if (a.members().size() != b.members().size()) return false;
  for (const auto& [name, value] : a.members()) {
    if (!equal(value, b[name])) return false;
  }
  return true;
}

struct Difference {
  std::string name;
  JsonValue before, now;
};

// The first member that is another one.
Difference differenceOf(const JsonValue& now, const JsonValue& before) {
  for (const auto& [name, value] : now.members()) {
    if (equal(value, before[name])) continue;
    return name == "picture" ? differenceOf(value, before[name])
                             : Difference{name, before[name], value};
  }
  return {};
}

// As a message shows it; empty for what is too long to be read there.
std::string shown(const JsonValue& v) {
  if (v.isNull()) return "none";
  if (v.isBool()) return v.boolean(false) ? "true" : "false";
  if (v.isNumber()) return shortestText(v.number(0));
  constexpr size_t kLongest = 60;
  if (v.isText()) return v.text().size() > kLongest ? std::string() : "'" + v.text() + "'";
  std::string out;
  for (const JsonValue& item : v.items()) {
    if (item.isArray() || item.isObject() || out.size() > kLongest) return {};
    out += (out.empty() ? "" : ", ") + shown(item);
  }
  return v.isArray() ? (out.empty() ? "none" : out) : out;
}

Error otherSettings(const std::string& path, const std::string& was, const std::string& is) {
  const Result<JsonValue> before = parseJson(was), now = parseJson(is);
  if (!before.ok() || before.value()["generator"].text() != "Gable") {
    return {"dataset-folder", "'" + path + "' is no description of a data set of Gable",
            "name another folder, or remove the file"};
  }
  const Difference other = differenceOf(now.value(), before.value());
  // What files hold is known by its hash, and no option says it.
  const bool ofFiles = other.name == "rules" || other.name == "shapes";
  const std::string old = ofFiles ? std::string() : shown(other.before), given = shown(other.now);
  return {ofFiles ? "dataset-folder" : "dataset-settings",
          "the data set of '" + path + "' was begun with another value of '" + other.name + "'" +
              (old.empty() || given.empty() ? std::string() : ": " + old + ", and now " + given),
          "go on with the settings of before, or name another folder"};
}

// Whether there is something else than what is written before the first item.
bool holdsOthers(const std::string& folder) {
  std::error_code error;
  for (auto at = std::filesystem::directory_iterator(folder, error);
       !error && at != std::filesystem::directory_iterator(); at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (name != kLocks && !name.starts_with(kDescription)) return true;
  }
  return false;
}

}  // namespace

std::string descriptionOf(const Rules& rules, const Shapes& shapes, const Categories& categories,
                          const DatasetSettings& s) {
  std::string text;
  JsonWriter w(text, 1);
  w.beginObject().field("generator", "Gable").field("version", version());
  w.field("format", kFormat);
  w.field("rules", checksumText(checksumOf(rules)));
  w.field("shapes", checksumText(checksumOf(shapes)));
  writeDerive(w, s.derive);
  w.field("cameras", s.cameras);
  w.field("placing", datasetCamerasNames()[static_cast<size_t>(s.placing)]);
  w.field("zoom", s.zoom);
  w.field("labels", datasetLabelsNames()[static_cast<size_t>(s.labels)]);
  w.field("list", datasetFormatNames()[static_cast<size_t>(s.format)]);
  w.key("tags").beginArray();
  for (const std::string& tag : s.tags) w.value(tag);
  w.endArray();
  w.field("model", s.model).field("instancing", static_cast<int>(s.write.instancing));
  w.field("vertices", static_cast<int>(s.write.vertices));
  w.field("detail", static_cast<int>(s.write.detail));
  w.key("picture").beginObject();
  writePicture(w, s.picture);
  w.endObject().key("categories").beginArray();
  for (size_t i = 0; i < categories.size(); ++i) {
    w.beginObject().field("id", static_cast<uint64_t>(i + 1)).field("name", categories[i]);
    w.endObject();
  }
  w.endArray().endObject();
  return text + "\n";
}

DatasetFolder::DatasetFolder(const std::string& path, const DatasetSettings& settings)
    : path_(path.ends_with('/') ? path : path + '/'), settings_(settings) {}

std::string DatasetFolder::item(uint64_t seed, uint32_t camera) const {
  size_t digits = 2;
  for (uint32_t most = settings_.cameras - 1; most >= 100; most /= 10) ++digits;
  return numbered(6, seed) + "/" + numbered(digits, camera);
}

std::string DatasetFolder::model(uint64_t seed) const { return numbered(6, seed) + "/model"; }

std::string DatasetFolder::lock(uint64_t seed) const {
  // Another process may have removed the empty folder.
  std::error_code ignored;
  std::filesystem::create_directories(path_ + kLocks, ignored);
  return path_ + kLocks + "/" + numbered(6, seed);
}

bool DatasetFolder::has(const std::string& part) const {
  std::error_code error;
  return std::filesystem::is_directory(path_ + part, error);
}

uint32_t DatasetFolder::itemsOf(uint64_t seed) const {
  uint32_t items = 0;
  for (uint32_t c = 0; c < settings_.cameras; ++c) items += has(item(seed, c)) ? 1 : 0;
  return items;
}

bool DatasetFolder::isWhole(uint64_t seed) const {
  return itemsOf(seed) == settings_.cameras && (settings_.model.empty() || has(model(seed)));
}

std::optional<Error> DatasetFolder::open(std::string description) {
  description_ = std::move(description);
  std::error_code error;
  std::filesystem::create_directories(path_ + kLocks, error);
  if (error) {
    return Error{"dataset-folder", "the folder '" + path_ + "' cannot be made: " + error.message(),
                 "name another one, or see to its permissions"};
  }
  const bool others = holdsOthers(path_);
  // Looked for after the others: who writes others has written it before.
  if (fileExists(path_ + kDescription)) return begin();
  if (!others) return std::nullopt;
  return Error{"dataset-folder",
               "the folder '" + path_ + "' has files, and no dataset.json that says what they are",
               "name another folder"};
}

std::optional<Error> DatasetFolder::begin() const {
  const std::string path = path_ + kDescription;
  if (!fileExists(path)) {
    const Result<uint64_t> written = writeFile(path, description_);
    if (!written.ok()) return written.error();
  }
  const Result<std::string> text = readFile(path);
  if (!text.ok()) return text.error();
  if (text.value() == description_) return std::nullopt;
  return otherSettings(path, text.value(), description_);
}

void DatasetFolder::close() const {
  std::error_code ignored;
  std::filesystem::remove(path_ + kLocks, ignored);
  std::filesystem::remove(path_, ignored);
}

DiagnosticList DatasetFolder::put(
    const std::string& part,
    const std::function<DiagnosticList(const std::string& aside)>& fill) const {
  const std::string place = path_ + part, aside = place + ".part/";
  std::error_code error;
  // What a killed process has left: the lock says that nobody is writing there.
  std::filesystem::remove_all(aside, error);
  std::filesystem::create_directories(aside, error);
  DiagnosticList wrong = fill(aside);
  if (wrong.empty()) {
    std::filesystem::rename(aside, place, error);
    if (!error) return wrong;
    wrong.push_back(
        diagnosticOf(Error{"file-unwritable", "'" + place + "' cannot be made: " + error.message(),
                           "see to the permissions of the folder"}));
  }
  std::filesystem::remove_all(aside, error);
  return wrong;
}

}  // namespace gable
