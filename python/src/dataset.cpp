// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "gable/dataset.h"

#include "gable/names.h"
#include "watched.h"

namespace gable::python {

namespace {

template <class T>
std::optional<T> given(const py::dict& options, const char* name) {
  if (!options.contains(name) || options[name].is_none()) return std::nullopt;
  return options[name].cast<T>();
}

template <class T>
void set(T& field, const py::dict& options, const char* name) {
  if (const auto value = given<T>(options, name)) field = *value;
}

template <class T>
void set(std::optional<T>& field, const py::dict& options, const char* name) {
  if (auto value = given<T>(options, name)) field = std::move(value);
}

// A word that has been checked.
template <class T>
void setWord(T& field, const py::dict& options, const char* name,
             std::optional<T> (*named)(const std::string&)) {
  field = named(options[name].cast<std::string>()).value_or(field);
}

DatasetSettings settingsOf(const py::dict& options) {
  DatasetSettings s;
  setAttributes(s.derive, options["attributes"].cast<py::dict>());
  set(s.derive.seed, options, "seed");
  set(s.derive.startRule, options, "start_rule");
  set(s.count, options, "count");
  set(s.cameras, options, "cameras");
  setWord(s.placing, options, "placing", &datasetCamerasNamed);
  set(s.zoom, options, "zoom");
  setWord(s.labels, options, "labels", &datasetLabelsNamed);
  set(s.tags, options, "tags");
  setWord(s.format, options, "format", &datasetFormatNamed);
  s.model = given<std::string>(options, "model").value_or("");
  set(s.picture.width, options, "width");
  set(s.picture.height, options, "height");
  set(s.picture.samples, options, "samples");
  setWord(s.picture.lighting, options, "lighting", &lightingNamed);
  set(s.picture.fieldOfView, options, "field_of_view");
  set(s.picture.pitch, options, "pitch");
  if (const auto sun = given<std::pair<double, double>>(options, "sun")) {
    s.picture.sun = PictureSettings::Sun{sun->first, sun->second};
  }
  if (const auto shard = given<std::pair<uint64_t, uint64_t>>(options, "shard")) {
    s.shard = DatasetSettings::Shard{shard->first, shard->second};
  }
  set(s.jobs, options, "jobs");
  set(s.limits.seconds, options, "seconds");
  return s;
}

py::dict written(const Rules& rules, const Shapes& shapes, const std::string& folder,
                 const py::dict& options, const py::object& progress) {
  Watched watched;
  DatasetSettings settings = settingsOf(options);
  settings.derive.cancel = settings.picture.cancel = &watched.cancel;
  settings.limits.cancel = &watched.cancel;
  settings.progress = [&](size_t done, size_t total) {
    watched.total = total;
    watched.done = done;
  };
  const DatasetResult result =
      watch(watched, progress, [&] { return writeDataset(rules, shapes, folder, settings); });
  py::dict d;
  d["ok"] = result.ok || result.end == End::LimitReached;
  d["messages"] = messagesOf(result.diagnostics);
  d["items"] = result.items;
  d["made"] = result.made;
  d["done"] = result.done;
  d["is_whole"] = result.merged;
  return d;
}

}  // namespace

void bindDataset(py::module_& m) { m.def("dataset", &written); }

}  // namespace gable::python
