// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "watched.h"

namespace gable::python {

namespace {

// Of an attribute, as DeriveSettings takes it.
std::string textOf(const std::string& name, py::handle object) {
  const RuleValue value = valueOf(name, object);
  const auto scalar = [](const RuleValue::Scalar& v) -> std::string {
    if (const auto* number = std::get_if<double>(&v))
      return py::repr(py::float_(*number)).cast<std::string>();
    if (const auto* flag = std::get_if<bool>(&v)) return *flag ? "true" : "false";
    return std::get<std::string>(v);
  };
  if (!value.array) return scalar(value.items[0]);
  std::string text = "[";
  for (size_t i = 0; i < value.items.size(); ++i) {
    if (i > 0) text += i % value.array->columns == 0 ? ';' : ',';
    text += scalar(value.items[i]);
  }
  return text + "]";
}

}  // namespace

void setAttributes(DeriveSettings& settings, const py::dict& attributes) {
  for (const auto& [key, value] : attributes) {
    const auto name = key.cast<std::string>();
    settings.attributes.emplace_back(name, textOf(name, value));
  }
}

namespace {

Model deriveWatched(const Rules& rules, const Shapes& shapes, const py::dict& attributes,
                    double seed, std::optional<std::string> startRule, std::optional<int> jobs,
                    std::optional<double> seconds, std::optional<uint64_t> bytes,
                    const py::object& progress) {
  Watched watched;
  DeriveSettings settings;
  settings.seed = seed;
  settings.startRule = std::move(startRule);
  settings.jobs = jobs;
  settings.limits.seconds = seconds;
  if (bytes) settings.limits.bytes = bytes;
  setAttributes(settings, attributes);
  settings.cancel = &watched.cancel;
  settings.progress = [&](size_t done, size_t total) {
    watched.total = total;
    watched.done = done;
  };
  return watch(watched, progress, [&] { return derive(rules, shapes, settings); });
}

}  // namespace

void bindDerive(py::module_& m) {
  m.def("derive", &deriveWatched, py::arg("rules"), py::arg("shapes"), py::arg("attributes"),
        py::arg("seed"), py::arg("start_rule"), py::arg("jobs"), py::arg("seconds"),
        py::arg("memory"), py::arg("progress"));
}

}  // namespace gable::python
