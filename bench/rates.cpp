// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// How fast two threads derive what was published of a system on a graphics card (Steinberger et al.
// 2014, "Parallel Generation of Architecture on the GPU"): 38 000 low buildings, here of 40 parts
// each, and 520 towers of 2885 terminals, here of 4000. Every building has sizes of its own, so
// whole buildings cannot be shared.
//
//   bench_rates [--runs N] [--jobs N] [--small]
//
// Prints for each, with equal parts shared and with each part derived: buildings and terminals a
// second by the clock and by the processor time of all threads divided by their number, which other
// programs on the machine disturb less. Medians. Parsing is not measured; making the scene is.

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "gable/gable.h"

namespace {

struct Case {
  const char* name;
  const char* rules;
  int buildings;
  double width, height;
  double buildingsASecond, terminalsASecond;
};

constexpr Case kCases[] = {
    {"buildings of 40 parts", "parts.cga", 38000, 8, 15, 131000, 0},
    {"towers of 4000 terminals", "facade.cga", 520, 30, 0, 0, 12.5e6},
};

double processorSeconds() {
  rusage u{};
  getrusage(RUSAGE_SELF, &u);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
  };
  return seconds(u.ru_utime) + seconds(u.ru_stime);
}

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

// Lots in rows, in metres, each a little wider than the one before.
gable::Shapes lotsOf(const Case& c, int count) {
  std::string text =
      R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:25832"}},"features":[)";
  for (int i = 0; i < count; ++i) {
    const double grow = 1 + (i % 997) * 1e-4, w = c.width * grow, d = c.width * 0.7 * grow;
    const double x = (i % 200) * c.width * 1.5, y = i / 200 * c.width * 1.5;
    char feature[512];
    std::snprintf(feature, sizeof feature,
                  "%s{\"type\":\"Feature\",\"properties\":{\"height\":%.9g},\"geometry\":{\"type\":"
                  "\"Polygon\",\"coordinates\":[[[%.9g,%.9g],[%.9g,%.9g],[%.9g,%.9g],[%.9g,%.9g],"
                  "[%.9g,%.9g]]]}}",
                  i ? "," : "", c.height > 0 ? c.height * grow * 0.95 : 0.0, x, y, x + w, y, x + w,
                  y + d, x, y + d, x, y);
    text += feature;
  }
  return gable::Shapes::parse(text + "]}", "lots.geojson");
}

bool measure(const Case& c, int runs, int jobs, bool small, bool sharing) {
  const gable::Rules rules = gable::Rules::load(std::string(GABLE_BENCH_DIR "/boxes/") + c.rules);
  for (const gable::Diagnostic& m : rules.diagnostics()) std::fputs(m.rendered.c_str(), stderr);
  const int count = small ? 20 : c.buildings;
  const gable::Shapes lots = lotsOf(c, count);
  if (!rules.ok() || !lots.ok()) return false;
  gable::DeriveSettings settings;
  settings.jobs = jobs;
  settings.sharing = sharing;
  std::vector<double> clock, busy;
  double terminals = 0;
  for (int run = 0; run < runs; ++run) {
    const double before = processorSeconds();
    const auto begin = std::chrono::steady_clock::now();
    const gable::Model model = gable::derive(rules, lots, settings);
    clock.push_back(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    busy.push_back((processorSeconds() - before) / jobs);
    if (!model.ok()) return false;
    terminals = static_cast<double>(model.leafCount());
  }
  const double seconds = median(clock), own = median(busy);
  std::printf(
      "%-24s %s, %d buildings, %.0f terminals, %d threads: %.0f buildings/s, %.1f M terminals/s "
      "(by processor time %.0f, %.1f)",
      c.name, sharing ? "shared" : "each derived", count, terminals, jobs, count / seconds,
      terminals / seconds * 1e-6, count / own, terminals / own * 1e-6);
  if (c.buildingsASecond > 0) std::printf("; asked for: %.0f buildings/s\n", c.buildingsASecond);
  if (c.terminalsASecond > 0) {
    std::printf("; asked for: %.1f M terminals/s\n", c.terminalsASecond * 1e-6);
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  int runs = 5, jobs = 2;
  bool small = false;
  for (int i = 1; i < argc; ++i) {
    const auto number = [&] { return i + 1 < argc ? std::max(1, std::atoi(argv[++i])) : 1; };
    if (std::strcmp(argv[i], "--runs") == 0)
      runs = number();
    else if (std::strcmp(argv[i], "--jobs") == 0)
      jobs = number();
    else if (std::strcmp(argv[i], "--small") == 0)
      small = true;
    else {
      std::fputs("bench_rates [--runs N] [--jobs N] [--small]\n", stderr);
      return 2;
    }
  }
  for (const Case& c : kCases) {
    for (const bool sharing : {true, false}) {
      if (!measure(c, runs, jobs, small, sharing)) return 1;
    }
  }
  return 0;
}
