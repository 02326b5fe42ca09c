// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// How fast a ProGen3d grammar becomes a scene, on one thread and without a file:
// bench/million.grammar by the public interface, from derivation to the finished scene. Prints
// boxes a second of processor time (the median of the runs, so that other programs on the machine
// count little) and bytes a box (the peak of resident memory above that before the first run).
//
//   bench_progen3d [--runs N] [--no-sharing] [GRAMMAR]

#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

#include "gable/gable.h"

namespace {

double peakBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024;
}

}  // namespace

int main(int argc, char** argv) {
  std::string path = GABLE_BENCH_DIR "/million.grammar";
  int runs = 5;
  gable::DeriveSettings settings;
  settings.jobs = 1;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--runs") == 0 && i + 1 < argc)
      runs = std::max(1, std::atoi(argv[++i]));
    else if (std::strcmp(argv[i], "--no-sharing") == 0)
      settings.sharing = false;
    else
      path = argv[i];
  }
  const gable::Rules rules = gable::Rules::load(path);
  for (const gable::Diagnostic& m : rules.diagnostics()) std::fputs(m.rendered.c_str(), stderr);
  if (!rules.ok()) return 1;
  const gable::Shapes lot = gable::Shapes::lot(20, 20);
  const double before = peakBytes();
  double boxes = 0, bytes = 0;
  std::vector<double> seconds;
  for (int run = 0; run < runs; ++run) {
    const std::clock_t begin = std::clock();
    const gable::Model model = gable::derive(rules, lot, settings);
    seconds.push_back(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    if (run == 0) bytes = peakBytes() - before;
    boxes = static_cast<double>(model.statistics().leaves);
    if (!model.ok()) return 1;
  }
  std::sort(seconds.begin(), seconds.end());
  std::printf("%.0f boxes   %.2f M boxes/s (best %.2f)   %.0f bytes a box\n", boxes,
              boxes / seconds[seconds.size() / 2] * 1e-6, boxes / seconds[0] * 1e-6,
              boxes > 0 ? bytes / boxes : 0);
  return 0;
}
