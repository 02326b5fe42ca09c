// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rules against loops: the same boxes by rules (from the parsed program) and by hard-coded C++,
// both to the same flattened mesh in a reused buffer, on one thread. Loops write box by box; leaves
// of rules come in batches with the same axes, whose normals are made once.
//
//   W1      a building of 20 x 10 bays on four sides, 5 boxes a bay: 4000 boxes
//   W1x25   the same 25 times over
//   W2      1000 buildings of 100 boxes with sizes of their own
//
// Runs are interleaved; the medians and their ratio are printed. With `--runs N` N runs (default
// 9). `--rules NAME` runs the rules of one workload alone until `--boxes N` are made (20 000 000),
// for a profiler; `--shared NAME` derives to a scene instead.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "builtins/catalogue.h"
#include "lang/compile/compile.h"
#include "lang/parser.h"
#include "lang/sema/analyse.h"
#include "runtime/leaf_stream.h"
#include "scene/vertex_buffer.h"

using namespace gable;

namespace {

constexpr const char* kFacadeRules = R"(
Lot --> extrude(60) comp(f) { side : Facade }
Facade --> split(y) { ~3 : Floor }*
Floor --> split(x) { ~(scope.sx / 10) : Bay }*
Bay --> split(x) { 0.15 : Frame | ~1 : Middle | 0.15 : Frame }
Middle --> split(y) { 0.15 : Frame | ~1 : Glass | 0.15 : Frame }
Frame --> s('1, '1, 0.2) primitiveCube()
Glass --> s('1, '1, 0.05) primitiveCube()
)";

// 5 floors of 4 bays of 5 boxes, stacked slabs: 100 boxes a building.
constexpr const char* kTownRules = R"(
attr height = 15
Lot --> extrude(height) split(y) { ~3 : Floor }*
Floor --> split(x) { ~(scope.sx / 4) : Bay }*
Bay --> split(z) { ~(scope.sz / 5) : Box. }*
)";

struct Workload {
  const char* name;
  const char* rules;
  std::vector<InitialShape> shapes;
  size_t boxes;
  std::function<void(VertexBuffer&)> loops;
};

InitialShape lot(double x, double z, double w, double d, double height) {
  InitialShape s;
  MeshBuilder b;
  const uint32_t ring[] = {b.addPosition({0, 0, 0}), b.addPosition({w, 0, 0}),
                           b.addPosition({w, 0, -d}), b.addPosition({0, 0, -d})};
  b.addPolygon(ring);
  s.mesh = b.take();
  s.origin = Frame::moved({x, 0, z});
  if (height > 0) s.attributes.emplace_back("height", Value::of(height));
  return s;
}

// One facade by loops: the frame has x along it, y up and z outwards.
void facadeByLoops(const Frame& facade, double width, VertexBuffer& out) {
  const double bay = width / 10;
  for (int floor = 0; floor < 20; ++floor) {
    for (int i = 0; i < 10; ++i) {
      Frame f = facade;
      const auto box = [&](double x, double y, double w, double h, double d) {
        f.origin = facade.point({i * bay + x, floor * 3.0 + y, 0});
        appendBox(f, f.origin, {w, h, d}, out);
      };
      box(0, 0, 0.15, 3, 0.2);
      box(0.15, 0, bay - 0.3, 0.15, 0.2);
      box(0.15, 0.15, bay - 0.3, 2.7, 0.05);
      box(0.15, 2.85, bay - 0.3, 0.15, 0.2);
      box(bay - 0.15, 0, 0.15, 3, 0.2);
    }
  }
}

void buildingByLoops(double x, double z, VertexBuffer& out) {
  const Vec3 up{0, 1, 0};
  facadeByLoops(Frame::of({x, 0, z}, {1, 0, 0}, up, {0, 0, 1}), 30, out);
  facadeByLoops(Frame::of({x + 30, 0, z}, {0, 0, -1}, up, {1, 0, 0}), 20, out);
  facadeByLoops(Frame::of({x + 30, 0, z - 20}, {-1, 0, 0}, up, {0, 0, -1}), 30, out);
  facadeByLoops(Frame::of({x, 0, z - 20}, {0, 0, 1}, up, {-1, 0, 0}), 20, out);
}

struct House {
  double x, z, w, d, h;
};

std::vector<House> houses() {
  std::vector<House> out;
  for (int i = 0; i < 1000; ++i) {
    const double j = std::fmod(i * 0.618033988749895, 1.0);
    const double k = std::fmod(i * 0.754877666246693, 1.0);
    out.push_back({(i % 40) * 30.0, -(i / 40) * 30.0, 8 + 6 * j, 8 + 6 * k, 13.6 + 2.6 * j});
  }
  return out;
}

void houseByLoops(const House& house, VertexBuffer& out) {
  const Frame upright;
  const double floor = house.h / 5, bay = house.w / 4, part = house.d / 5;
  for (int f = 0; f < 5; ++f) {
    for (int b = 0; b < 4; ++b) {
      for (int p = 0; p < 5; ++p) {
        appendBox(upright, {house.x + b * bay, f * floor, house.z - house.d + p * part},
                  {bay, floor, part}, out);
      }
    }
  }
}

std::vector<Workload> workloads() {
  std::vector<Workload> all;
  all.push_back({"W1", kFacadeRules, {lot(0, 0, 30, 20, 0)}, 4000, [](VertexBuffer& out) {
                   buildingByLoops(0, 0, out);
                 }});
  std::vector<InitialShape> row;
  for (int i = 0; i < 25; ++i) row.push_back(lot(i * 50.0, 0, 30, 20, 0));
  all.push_back({"W1x25", kFacadeRules, std::move(row), 100000, [](VertexBuffer& out) {
                   for (int i = 0; i < 25; ++i) buildingByLoops(i * 50.0, 0, out);
                 }});
  std::vector<InitialShape> town;
  for (const House& h : houses()) town.push_back(lot(h.x, h.z, h.w, h.d, h.h));
  all.push_back({"W2", kTownRules, std::move(town), 100000, [](VertexBuffer& out) {
                   for (const House& h : houses()) houseByLoops(h, out);
                 }});
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

Program compileText(const char* text, const std::shared_ptr<ValuePool>& pool) {
  Sources sources;
  Diagnostics diagnostics;
  const uint32_t file = sources.add("bench.cga", text);
  lang::AnalysisInput input{lang::parse(sources, file, diagnostics), "bench.cga", ""};
  const auto resolved =
      lang::analyse(std::move(input), builtinCatalogue(), *pool, nullptr, sources, diagnostics);
  for (const Diagnostics::Entry& d : diagnostics.all())
    std::fputs(format(d, sources).c_str(), stderr);
  GABLE_CHECK(!diagnostics.hasErrors());
  return lang::compile(resolved, builtinCatalogue(), pool, sources, diagnostics);
}

// Of the processor, on this thread: other programs do not count.
double secondsOf(const std::function<void()>& work) {
  const auto now = [] {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec) * 1e-9;
  };
  const double begin = now();
  work();
  return now() - begin;
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
      : workload_(w),
        pool_(std::make_shared<ValuePool>()),
        program_(compileText(w.rules, pool_)),
        environment_(pool_, assets_),
        stream_(program_, environment_, oneJob()) {}

  // To a flattened mesh.
  void derive(VertexBuffer& out) {
    out.clear();
    stream_.run(workload_.shapes, [&](const PlacedLeaves& placed) {
      appendBoxes(placed.axes, placed.origin, placed.leaves, out);
    });
  }
  // To a scene, with sharing.
  void deriveShared() { gable::derive(program_, workload_.shapes, environment_, oneJob()); }

 private:
  static DeriveOptions oneJob() {
    DeriveOptions options;
    options.jobs = 1;
    return options;
  }
  const Workload& workload_;
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
    w.loops(byLoops);
  };
  rules();
  loops();
  const bool same = agree(byRules, byLoops) && byLoops.vertexCount() == w.boxes * 24;
  std::vector<double> ruleSeconds, loopSeconds, sharedSeconds;
  const int repeat = w.boxes < 50000 ? 20 : 1;
  for (int i = 0; i < runs; ++i) {
    const auto times = [&](const auto& work) {
      return secondsOf([&] {
               for (int k = 0; k < repeat; ++k) work();
             }) /
             repeat;
    };
    ruleSeconds.push_back(times(rules));
    loopSeconds.push_back(times(loops));
    sharedSeconds.push_back(times(sharedOnly));
  }
  const double boxes = static_cast<double>(w.boxes);
  const double rule = median(ruleSeconds), loop = median(loopSeconds),
               shared = median(sharedSeconds);
  std::printf(
      "%-6s rules %6.2f M boxes/s   loops %6.2f M boxes/s   ratio %.2f   "
      "shared derivation %.1f times the loops%s%s\n",
      w.name, boxes / rule * 1e-6, boxes / loop * 1e-6, rule / loop, loop / shared,
      same ? "" : "   THE BOXES DIFFER", boxes / loop < 8e6 ? "   LOOPS TOO SLOW" : "");
  return same;
}

// The rules alone, for so many boxes.
void profile(const Workload& w, size_t limit, bool shared) {
  Subject subject(w);
  VertexBuffer out;
  size_t boxes = 0;
  const double seconds = secondsOf([&] {
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
    for (const Workload& w : workloads()) {
      if (std::strcmp(w.name, only) == 0) profile(w, boxes, shared != nullptr);
    }
    return 0;
  }
  bool same = true;
  for (const Workload& w : workloads()) same = run(w, runs) && same;
  return same ? 0 : 1;
}
