// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rules against loops: the same boxes by rules (from the parsed program) and by hard-coded C++,
// both to the same flattened mesh in a reused buffer, on one thread. Loops write box by box; leaves
// of rules come in batches with the same axes, whose normals are made once.
//
// The workloads W1, W1x25 and W2 of bench/workloads.h. Runs are interleaved; the medians and their
// ratio are printed. With `--runs N` N runs (default 9). `--rules NAME` runs the rules of one
// workload alone until `--boxes N` are made (20 000 000), for a profiler; `--shared NAME` derives
// to a scene instead.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "base/files.h"
#include "builtins/catalogue.h"
#include "lang/compile/compile.h"
#include "lang/parser.h"
#include "lang/sema/analyse.h"
#include "runtime/leaf_stream.h"
#include "scene/vertex_buffer.h"
#include "workloads.h"

using namespace gable;
using namespace gable::bench;
using namespace std::string_literals;

namespace {

InitialShape shapeOf(const Lot& lot) {
  InitialShape s;
  MeshBuilder b;
  const uint32_t ring[] = {b.addPosition({0, 0, 0}), b.addPosition({lot.w, 0, 0}),
                           b.addPosition({lot.w, 0, -lot.d}), b.addPosition({0, 0, -lot.d})};
  b.addPolygon(ring);
  s.mesh = b.take();
  s.origin = Frame::moved({lot.x, 0, lot.z});
  if (lot.height > 0) s.attributes.emplace_back("height", Value::of(lot.height));
  return s;
}

std::vector<InitialShape> shapesOf(const Workload& w) {
  std::vector<InitialShape> out;
  for (const Lot& lot : w.lots) out.push_back(shapeOf(lot));
  return out;
}

// Those that are measured without a file: a tree of a million boxes is not.
std::vector<Workload> measured() {
  std::vector<Workload> all = workloads();
  std::erase_if(all, [](const Workload& w) { return w.name[1] == '3'; });
  return all;
}

// The rules of the workloads read no files.
class NoAssets final : public Assets {
 public:
  Ref<AssetModel> model(std::string_view, std::string_view, bool, std::string& why) override {
    why = "there are no files here";
    return {};
  }
  ImageInfo image(std::string_view, std::string_view) override { return {}; }
  Result<Material> material(std::string_view, std::string_view) override {
    return Error{"missing-file", "there are no files here", ""};
  }
  bool exists(std::string_view, std::string_view) override { return false; }
  std::vector<std::string> search(std::string_view, std::string_view) override { return {}; }
  bool text(std::string_view, std::string_view, std::string&) override { return false; }
  std::string resolve(std::string_view path, std::string_view) override {
    return std::string(path);
  }
};

Program compileText(std::string text, const std::shared_ptr<ValuePool>& pool) {
  Sources sources;
  Diagnostics diagnostics;
  const uint32_t file = sources.add("bench.cga", std::move(text));
  lang::AnalysisInput input{
      std::make_shared<const lang::Tree>(lang::parse(sources, file, diagnostics)), "bench.cga", ""};
  const auto resolved =
      lang::analyse(std::move(input), builtinCatalogue(), *pool, nullptr, sources, diagnostics);
  for (const Diagnostics::Entry& d : diagnostics.all())
    std::fputs(format(d, sources).c_str(), stderr);
  GABLE_CHECK(!diagnostics.hasErrors());
  return lang::compile(resolved, builtinCatalogue(), pool, sources, diagnostics);
}

// Of the processor, on this thread: other programs do not count. The mean of so many.
double secondsOf(int times, const std::function<void()>& work) {
  const auto now = [] {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec) * 1e-9;
  };
  const double begin = now();
  for (int k = 0; k < times; ++k) work();
  return (now() - begin) / times;
}

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

// The corner nearest to minus infinity of every box, sorted: rules and loops must agree.
std::vector<std::array<float, 3>> corners(const VertexBuffer& b) {
  std::vector<std::array<float, 3>> out;
  for (size_t v = 0; v + 24 <= b.vertexCount(); v += 24) {
    std::array<float, 3> least{1e9f, 1e9f, 1e9f};
    for (size_t k = 0; k < 24; ++k) {
      for (size_t a = 0; a < 3; ++a) {
        least[a] = std::min(least[a], std::round(b.vertices()[v + k].position[a] * 1000) / 1000);
      }
    }
    out.push_back(least);
  }
  std::sort(out.begin(), out.end());
  return out;
}

bool agree(const VertexBuffer& a, const VertexBuffer& b) {
  const auto x = corners(a), y = corners(b);
  if (x.size() != y.size()) return false;
  for (size_t i = 0; i < x.size(); ++i) {
    for (size_t k = 0; k < 3; ++k) {
      if (std::fabs(x[i][k] - y[i][k]) > 2e-3) return false;
    }
  }
  return true;
}

// A workload's rules, parsed and ready.
class Subject {
 public:
  explicit Subject(const Workload& w)
      : shapes_(shapesOf(w)),
        pool_(std::make_shared<ValuePool>()),
        program_(compileText(readFile(GABLE_BENCH_DIR "/boxes/"s + w.rules).value(), pool_)),
        environment_(pool_, assets_),
        stream_(program_, environment_, oneJob()) {}

  // To a flattened mesh.
  void derive(VertexBuffer& out) {
    out.clear();
    stream_.run(shapes_, [&](const PlacedLeaves& placed) {
      appendBoxes(placed.axes, placed.origin, placed.leaves, out);
    });
  }
  // To a scene, with sharing.
  void deriveShared() { gable::derive(program_, shapes_, environment_, oneJob()); }

 private:
  static DeriveOptions oneJob() {
    DeriveOptions options;
    options.jobs = 1;
    return options;
  }
  const std::vector<InitialShape> shapes_;
  NoAssets assets_;
  std::shared_ptr<ValuePool> pool_;
  Program program_;
  Environment environment_;
  LeafStream stream_;
};

bool run(const Workload& w, int runs) {
  Subject subject(w);
  VertexBuffer byRules, byLoops;
  const auto rules = [&] { subject.derive(byRules); };
  const auto sharedOnly = [&] { subject.deriveShared(); };
  const auto loops = [&] {
    byLoops.clear();
    boxesByLoops(w, [&](const Frame& axes, const Vec3& origin, const Vec3& size) {
      appendBox(axes, origin, size, byLoops);
    });
  };
  rules();
  loops();
  const bool same = agree(byRules, byLoops) && byLoops.vertexCount() == w.boxes * 24;
  std::vector<double> ruleSeconds, loopSeconds, sharedSeconds, coldSeconds;
  // What is timed takes some milliseconds. A shared derivation takes a tenth of one, of which most
  // is waiting for memory where the loops have just filled the caches: that is told apart.
  const int repeat = w.boxes < 50000 ? 20 : 1;
  constexpr int kShared = 20;
  for (int i = 0; i < runs; ++i) {
    ruleSeconds.push_back(secondsOf(repeat, rules));
    loopSeconds.push_back(secondsOf(repeat, loops));
    coldSeconds.push_back(secondsOf(1, sharedOnly));
    sharedSeconds.push_back(secondsOf(kShared, sharedOnly));
  }
  const double boxes = static_cast<double>(w.boxes);
  const double rule = median(ruleSeconds), loop = median(loopSeconds);
  std::printf(
      "%-6s rules %6.2f M boxes/s   loops %6.2f M boxes/s   ratio %.2f   "
      "shared derivation %.1f times the loops (%.1f with cold caches)%s%s\n",
      w.name, boxes / rule * 1e-6, boxes / loop * 1e-6, rule / loop, loop / median(sharedSeconds),
      loop / median(coldSeconds), same ? "" : "   THE BOXES DIFFER",
      boxes / loop < 8e6 ? "   LOOPS TOO SLOW" : "");
  return same;
}

// The rules alone, for so many boxes.
void profile(const Workload& w, size_t limit, bool shared) {
  Subject subject(w);
  VertexBuffer out;
  size_t boxes = 0;
  const double seconds = secondsOf(1, [&] {
    for (; boxes < limit; boxes += w.boxes) shared ? subject.deriveShared() : subject.derive(out);
  });
  std::printf("%-6s rules %6.2f M boxes/s\n", w.name, static_cast<double>(boxes) / seconds * 1e-6);
}

}  // namespace

int main(int argc, char** argv) {
  int runs = 9;
  const char *only = nullptr, *shared = nullptr;
  size_t boxes = 20000000;
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], "--runs") == 0) runs = std::max(1, std::atoi(argv[i + 1]));
    if (std::strcmp(argv[i], "--rules") == 0) only = argv[i + 1];
    if (std::strcmp(argv[i], "--shared") == 0) shared = only = argv[i + 1];
    if (std::strcmp(argv[i], "--boxes") == 0) boxes = std::strtoull(argv[i + 1], nullptr, 10);
  }
  if (only) {
    for (const Workload& w : measured()) {
      if (std::strcmp(w.name, only) == 0) profile(w, boxes, shared != nullptr);
    }
    return 0;
  }
  bool same = true;
  for (const Workload& w : measured()) same = run(w, runs) && same;
  return same ? 0 : 1;
}
