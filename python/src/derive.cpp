// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A derivation runs on a thread of its own without Python's lock, while the calling thread waits
// for it and sees to Ctrl-C and the progress function.

#include <atomic>
#include <chrono>
#include <future>
#include <thread>

#include "bindings.h"

namespace gable::python {

namespace {

constexpr std::chrono::milliseconds kBetweenLooks{50};

// What the calling thread sees of work that goes on.
struct Watched {
  std::atomic<bool> cancel{false};
  std::atomic<size_t> done{0}, total{0};
};

// Runs `work` beside, and what Python wants meanwhile. Ctrl-C and an exception of the progress
// function end the work; they are raised when it has ended.
template <class Work>
auto watch(Watched& watched, const py::object& progress, Work&& work) {
  auto result = std::async(std::launch::async, std::forward<Work>(work));
  std::pair<size_t, size_t> told{0, 0};
  const auto tell = [&] {
    const std::pair<size_t, size_t> now{watched.done, watched.total};
    if (progress.is_none() || now == told || now.second == 0) return;
    told = now;
    progress(now.first, now.second);
  };
  try {
    for (;;) {
      std::future_status status;
      {
        const py::gil_scoped_release released;
        status = result.wait_for(kBetweenLooks);
      }
      if (status == std::future_status::ready) break;
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      tell();
    }
    tell();
  } catch (...) {
    watched.cancel = true;
    const py::gil_scoped_release released;
    result.wait();
    throw;
  }
  return result.get();
}

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
  for (const auto& [key, value] : attributes) {
    const auto name = key.cast<std::string>();
    settings.attributes.emplace_back(name, textOf(name, value));
  }
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
