// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// No exception leaves the library: reading and writing, and deriving, are run again and again, and
// each time a later allocation fails. Every run ends with a result that can be asked, and what is
// wrong with it is said. memory_test FOLDER.

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <new>

#include "gable/gable.h"

namespace {

/// Allocations until one fails; below 0: none does.
std::atomic<int64_t> left{-1};

void* allocated(size_t size) {
  if (left.load() >= 0 && left.fetch_sub(1) == 0) throw std::bad_alloc();
  if (void* memory = std::malloc(size ? size : 1)) return memory;
  throw std::bad_alloc();
}

const char kRules[] =
    "attr height = rand(5, 9)\n"
    "Lot --> split(x) { ~2 : House | ~1 : print(height) Tower }*\n"
    "House --> extrude(height) comp(f) { side : Wall | top : Roof }\n"
    "Wall --> split(x) { ~1 : color(\"#ff0000\") Window. | ~1 : set(height, 3) Pane }*\n"
    "Pane --> s('1, '1, 0.1) split(y) { ~0.5 : Glass. }*\n"
    "Tower --> primitiveCylinder(12) t(0, rand(2), 0) Top.\n"
    "Roof --> roofHip(30) report(\"roofs\", 1)\n";

/// Where allocations fail.
enum class Phase { Files, Derivation };

struct Outcome {
  bool whole = false, told = false;
  /// An allocation has failed.
  bool failed = false;
};

bool toldOfMemory(const gable::DiagnosticList& list) {
  for (const gable::Diagnostic& d : list) {
    if (d.code == "out-of-memory") return true;
  }
  return false;
}

/// The allocation of that number in a phase fails; below 0: none does.
Outcome runOnce(const std::string& path, int jobs, Phase phase, int64_t failing) {
  // What the caller allocates itself is none of the library's business.
  const std::string text = kRules, name = "test.cga";
  const gable::Shapes::Ring ring{{0, 0}, {9, 0}, {9, 7}, {4, 9}, {0, 7}};
  gable::DeriveSettings settings;
  settings.jobs = jobs;
  const bool inFiles = phase == Phase::Files;
  left = inFiles ? failing : -1;
  const gable::Rules rules = gable::Rules::parse(text, name);
  const gable::Shapes lot = gable::Shapes::polygon(ring);
  int64_t still = left.exchange(inFiles ? -1 : failing);
  const gable::Model model = gable::derive(rules, lot, settings);
  if (!inFiles) still = left.exchange(-1);
  if (inFiles && failing >= 0 && still >= 0) left = still;
  const gable::WriteResult written = model.write(path);
  const bool failed = (inFiles ? left.exchange(-1) : still) < 0;
  const bool whole = rules.ok() && lot.ok() && model.ok() && written.ok;
  const bool told = gable::hasErrors(rules.diagnostics()) || gable::hasErrors(lot.diagnostics()) ||
                    gable::hasErrors(model.diagnostics()) || toldOfMemory(model.diagnostics()) ||
                    gable::hasErrors(written.diagnostics);
  return {whole && model.statistics().leaves > 0, told, failed};
}

}  // namespace

void* operator new(size_t size) { return allocated(size); }
void* operator new[](size_t size) { return allocated(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, size_t) noexcept { std::free(memory); }

int main(int argc, char** argv) {
  // This is no googletest program: `--gtest_list_tests` is not the name of a folder.
  if (argc != 2 || argv[1][0] == '-') {
    std::fprintf(stderr, "usage: memory_test FOLDER\n");
    return 2;
  }
  std::filesystem::create_directories(argv[1]);
  const std::string path = std::string(argv[1]) + "/model.glb";
  if (!runOnce(path, 1, Phase::Files, -1).whole) return 1;
  int runs = 0, silent = 0;
  // Every allocation of the first hundreds, then ever wider apart, until a run meets none that
  // fails.
  for (const Phase phase : {Phase::Files, Phase::Derivation}) {
    for (const int jobs : {1, 2}) {
      for (int64_t n = 0;; n += 1 + n / 40) {
        const Outcome outcome = runOnce(path, jobs, phase, n);
        ++runs;
        if (outcome.failed && !outcome.whole && !outcome.told) ++silent;
        if (!outcome.failed) break;
      }
    }
  }
  std::printf("%d runs, %d without a word\n", runs, silent);
  return silent == 0 && runOnce(path, 2, Phase::Files, -1).whole ? 0 : 1;
}
