// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// For tests of the park notation only: what a grammar makes, counted and measured by the names of
// leaves.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/files.h"
#include "engine/impl.h"
#include "gable/gable.h"
#include "geom/mesh/topology.h"
#include "geom/region/corpus.h"
#include "lang/region_texts.h"
#include "math/trig.h"
#include "scene/scene.h"

namespace gable::park_testing {

struct Made {
  std::map<std::string, int> count;
  std::map<std::string, double> area;
  std::map<std::string, std::vector<Vec3>> places;
  std::map<std::string, bool> closed;
  DiagnosticList diagnostics;
  /// Of the boxes' diagonals: the length of straight lines.
  std::map<std::string, double> length;
  double whole = 0;

  bool has(const std::string& code) const {
    for (const Diagnostic& m : diagnostics) {
      if (m.code == code) return true;
    }
    return false;
  }
};

inline Made collect(const Rules& rules, const Model& model) {
  Made out;
  out.diagnostics = rules.diagnostics();
  out.diagnostics.insert(out.diagnostics.end(), model.diagnostics().begin(),
                         model.diagnostics().end());
  const Scene& scene = model.impl().result.scene;
  forEachLeaf(scene, [&](const Leaf& leaf, const Frame& world) {
    const std::string symbol = scene.names[leaf.name];
    const Mesh placed = transformed(*scene.meshes[leaf.mesh], leaf.scale, world);
    ++out.count[symbol];
    out.area[symbol] += placed.area();
    out.length[symbol] += length(placed.bounds().size());
    out.whole += placed.area();
    out.places[symbol].push_back(placed.bounds().center());
    const bool closed = Topology(placed).closed();
    const auto [at, isNew] = out.closed.emplace(symbol, closed);
    if (!isNew) at->second = at->second && closed;
  });
  return out;
}

inline Made run(const std::string& text, const Shapes& shapes, double seed = 1,
                const std::string& name = "test.park", bool sharing = true) {
  const Rules rules = Rules::parse(text, name);
  DeriveSettings settings;
  settings.seed = seed;
  settings.jobs = 1;
  settings.sharing = sharing;
  return collect(rules, derive(rules, shapes, settings));
}

/// Every `stride`-th polygon of the corpus; all of them with GABLE_WHOLE_CORPUS. None where the
/// corpus is not.
inline void forCorpus(size_t stride, const std::function<void(const Polygon&, size_t)>& visit) {
  const char* all = std::getenv("GABLE_WHOLE_CORPUS");
  const size_t step = all && *all ? 1 : stride;
  const std::vector<corpus::Case> cases = corpus::loadCorpus(step);
  for (size_t i = 0; i < cases.size(); ++i) visit({cases[i].ring, {}}, i * step);
}

inline Made rules(const std::string& text, const Shapes& shapes, double seed = 1) {
  return run(text, shapes, seed, "test.cga");
}

inline Shapes cShape() {
  return Shapes::polygon(
      {{0, 0}, {30, 0}, {30, 8}, {10, 8}, {10, 22}, {30, 22}, {30, 30}, {0, 30}});
}

// The length of the edges that a selection of the notation means, on the region that comes of a lot
// by `before`.
inline double selectedLength(const std::string& selection, const Shapes& shapes,
                             const std::string& before = "R") {
  const Made m = rules("Lot --> " + before + "\nR --> parametrise(" +
                           lang::RegionTexts().lines(selection) + ") { Line. } X.",
                       shapes);
  for (const Diagnostic& x : m.diagnostics) ADD_FAILURE() << selection << ": " << x.message;
  return m.length.count("Line") ? m.length.at("Line") : 0;
}

inline std::string grammarOf(const std::string& path) {
  const Result<std::string> text = readFile(std::string(GABLE_SOURCE_DIR) + path);
  return text.ok() ? text.value() : std::string();
}
/// A grammar as the notation's author wrote it down.
inline std::string documented(const std::string& name) {
  return grammarOf("/tests/dialects/park/documents/" + name + ".park");
}
inline std::string example(const std::string& name) {
  return grammarOf("/examples/park/" + name + ".park");
}

inline const Shapes kLot = Shapes::lot(20, 20);

}  // namespace gable::park_testing
