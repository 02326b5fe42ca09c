// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Models are written to a folder of their own in the system's place for such things; what lies in
// it then goes to the page, as it is or, where there are several files, as an archive.

#include "studio/export.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <utility>
#include <vector>

#include "base/files.h"
#include "base/json.h"
#include "gable/sun.h"
#include "studio/zip.h"

namespace gable::studio {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFormats[] = {"glb", "gltf", "obj", "ply", "stl", "png"};
constexpr uint64_t kMostLeavesWritten = 20'000'000;
/// Somebody at a page waits for the picture.
constexpr int kPageSamples = 32;
constexpr uint64_t kLargestArchive = 2ull << 30;

/// A folder that goes with everything in it.
struct Folder {
  Folder() {
    std::string name = (fs::temp_directory_path() / "gable-XXXXXX").string();
    if (mkdtemp(name.data())) path = name;
  }
  ~Folder() {
    std::error_code ignored;
    if (!path.empty()) fs::remove_all(path, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string path;
};

std::vector<std::string> filesBelow(const std::string& folder) {
  std::vector<std::string> out;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error)) {
    if (at->is_regular_file(error)) out.push_back(at->path().string());
  }
  std::sort(out.begin(), out.end());
  return out;
}

uint64_t bytesBelow(const std::string& folder) {
  uint64_t sum = 0;
  for (const std::string& file : filesBelow(folder)) {
    std::error_code error;
    const uint64_t size = fs::file_size(file, error);
    if (!error) sum += size;
  }
  return sum;
}

Result<Exported> collected(const std::string& folder, const std::string& format) {
  const std::vector<std::string> files = filesBelow(folder);
  if (bytesBelow(folder) > kLargestArchive) {
    return Error{"model-too-large", "the files are too large to be sent to a page",
                 "gable generate has no such limit"};
  }
  std::vector<std::pair<std::string, std::string>> contents;
  for (const std::string& file : files) {
    Result<std::string> bytes = readFile(file);
    if (!bytes.ok()) return bytes.error();
    contents.emplace_back(file.substr(folder.size() + 1), std::move(bytes.value()));
  }
  if (contents.size() == 1) return Exported{std::move(contents[0].second), format};
  return Exported{zipped(contents), format + ".zip"};
}

// The share of the sky that clouds hide in pictures: a fair day.
constexpr double kFairClouds = 0.25;

// The numbers of a JSON array, if there are `count` and all lie within the bounds.
bool readNumbers(const std::string& text, size_t count, double least, double most,
                 std::vector<double>& out) {
  const Result<JsonValue> json = parseJson(text, {2, 20});
  if (!json.ok() || json.value().size() != count) return false;
  for (const JsonValue& each : json.value().items()) {
    const double value = each.number(std::numeric_limits<double>::quiet_NaN());
    if (!(value >= least && value <= most)) return false;
    out.push_back(value);
  }
  return true;
}

}  // namespace

Result<PictureSettings> pictureOf(const std::string& camera, const std::string& size,
                                  const std::string& sun) {
  PictureSettings out;
  out.clouds = kFairClouds;
  std::vector<double> numbers;
  if (!size.empty()) {
    if (!readNumbers(size, 2, 16, 4096, numbers)) {
      return Error{"request-wrong", "'size' is [width, height], 16 to 4096 each", ""};
    }
    out.width = static_cast<int>(numbers[0]);
    out.height = static_cast<int>(numbers[1]);
  }
  if (!sun.empty()) {
    std::vector<double> angles;
    if (!readNumbers(sun, 2, -360, 360, angles) || std::abs(angles[0]) > 90) {
      return Error{"request-wrong", "'sun' is [elevation, azimuth] in degrees", ""};
    }
    out.sun = PictureSettings::Sun{angles[0], angles[1]};
  }
  if (camera.empty()) return out;
  std::vector<double> at;
  const bool read = readNumbers(camera, 7, -1e7, 1e7, at);
  const bool apart = read && (at[0] != at[3] || at[1] != at[4] || at[2] != at[5]);
  if (!apart || !(at[6] >= 1 && at[6] <= 170)) {
    return Error{"request-wrong", "'camera' is [eye, target, angle]: seven numbers of a camera",
                 ""};
  }
  out.camera = PictureSettings::Camera{{at[0], at[1], at[2]}, {at[3], at[4], at[5]}};
  out.fieldOfView = at[6];
  out.samples = kPageSamples;
  return out;
}

Result<std::string> sunJson(const Model& model, const std::string& day, const std::string& hour,
                            const std::string& place) {
  std::vector<double> date, at, where;
  const bool read = readNumbers(day, 3, 1, 9999, date) &&
                    readNumbers("[" + hour + "]", 1, 0, 24, at) &&
                    (place.empty() || readNumbers(place, 2, -180, 180, where));
  if (!read) {
    return Error{"request-wrong",
                 "'day' is [year, month, day], 'hour' 0 to 24, 'place' [latitude, longitude]", ""};
  }
  SunTime time;
  if (!place.empty()) time.place = SunTime::Place{where[0], where[1]};
  time.year = static_cast<int>(date[0]);
  time.month = static_cast<int>(date[1]);
  time.day = static_cast<int>(date[2]);
  time.hour = at[0];
  const std::optional<PictureSettings::Sun> sun = sunOver(model, time);
  // What lies on no map is nothing wrong.
  if (!sun && place.empty()) return std::string("null");
  if (!sun) {
    return Error{"place-unknown", "nobody knows where the sun stands there and then",
                 "give a latitude of -90 to 90 and a longitude, and a year of 1950 to 2050"};
  }
  std::string text;
  JsonWriter json(text);
  json.beginObject().key("elevation").value(sun->elevation);
  json.key("azimuth").value(sun->azimuth).endObject();
  return text;
}

Result<Exported> Exports::write(const Model& model, const std::string& format,
                                const std::string& page, const Session::Cancel& cancel,
                                const PictureSettings& picture) {
  if (std::none_of(std::begin(kFormats), std::end(kFormats),
                   [&](const char* f) { return format == f; })) {
    return Error{"format-unknown", "models are not written as '" + format + "' here",
                 "glb, gltf, obj, ply, stl and png are"};
  }
  if (model.leafCount() > kMostLeavesWritten) {
    return Error{"model-too-large", "the model has too many leaves to be written here",
                 "gable generate has no such limit"};
  }
  const Folder folder;
  if (folder.path.empty()) return Error{"file-unwritable", "there is no room for files", ""};
  auto work = std::make_shared<Work>();
  work->folder = folder.path;
  {
    const std::lock_guard lock(mutex_);
    works_[page] = work;
  }
  WriteResult written;
  const std::string file = folder.path + "/model." + format;
  if (format == "png") {
    PictureSettings settings = picture;
    settings.cancel = cancel.get();
    settings.progress = [&work](size_t done, size_t total) {
      work->done = done;
      work->total = total;
    };
    written = model.picture(file, settings);
  } else {
    WriteSettings settings;
    settings.limits.cancel = cancel.get();
    written = model.write(file, settings);
  }
  {
    const std::lock_guard lock(mutex_);
    if (works_[page] == work) works_.erase(page);
  }
  if (cancel && cancel->load()) return Error{"cancelled", "the export was stopped", ""};
  if (!written.ok) {
    if (written.diagnostics.empty()) return Error{"file-unwritable", "nothing was written", ""};
    const Diagnostic& why = written.diagnostics[0];
    return Error{why.code, why.message, why.hint};
  }
  return collected(folder.path, format);
}

std::string Exports::progressJson(const std::string& page) const {
  std::shared_ptr<Work> work;
  {
    const std::lock_guard lock(mutex_);
    const auto at = works_.find(page);
    if (at != works_.end()) work = at->second;
  }
  std::string out;
  JsonWriter json(out);
  json.beginObject().key("busy").value(work != nullptr);
  json.key("done").value(work ? work->done.load() : uint64_t{0});
  json.key("total").value(work ? work->total.load() : uint64_t{0});
  json.key("bytes").value(work ? bytesBelow(work->folder) : uint64_t{0}).endObject();
  return out;
}

}  // namespace gable::studio
