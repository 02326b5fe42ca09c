// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Two passes of joined sets: of all that touch, and of what is unknown among it.
#include "city/rows.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/hash.h"
#include "base/work.h"
#include "geom/region/segment_grid.h"

namespace gable {
namespace {

// Shorter walls join nothing, in metres; nor does what is smaller, in square metres.
constexpr double kLeastWall = 3;
constexpr double kLeastHouse = 40;
// A known house beside a group tells of so many in it: a lone tower says nothing of a quarter.
constexpr size_t kSpeaksFor = 3;

// Pairs of buildings with the length of the wall between them.
std::map<std::pair<uint32_t, uint32_t>, double> wallsBetween(
    const std::vector<GroundPiece>& ground, const std::vector<BuildingFacts>& facts) {
  const auto isHouse = [&](const GroundPiece& p) {
    return p.surface == Surface::Footprint && p.feature != GroundPiece::kNothing &&
           facts[p.feature].area >= kLeastHouse;
  };
  std::map<std::pair<uint32_t, uint32_t>, double> out;
  for (const GroundPiece& p : ground) {
    if (!isHouse(p)) continue;
    const std::vector<Segment> edges = edgesOf(p.polygon);
    for (size_t i = 0; i < edges.size(); ++i) {
      work();
      const uint32_t b = p.beyond[i];
      if (b == GroundPiece::kNothing || !isHouse(ground[b])) continue;
      const uint32_t other = ground[b].feature;
      if (p.feature < other) out[{p.feature, other}] += length(edges[i].b - edges[i].a);
    }
  }
  return out;
}

double middleOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

void joinRows(const std::vector<GroundPiece>& ground, const std::vector<MapFeature>& features,
              std::vector<BuildingFacts>& facts) {
  DisjointSets rows(features.size()), unknown(features.size());
  std::set<uint32_t> members;
  std::map<uint32_t, std::vector<double>> beside;
  const auto walls = wallsBetween(ground, facts);
  for (const auto& [pair, wall] : walls) {
    if (wall < kLeastWall) continue;
    const auto [a, b] = pair;
    rows.join(a, b);
    members.insert(a);
    members.insert(b);
    if (facts[a].levels == 0 && facts[b].levels == 0) unknown.join(a, b);
  }
  for (const auto& [pair, wall] : walls) {
    if (wall < kLeastWall) continue;
    const auto [a, b] = pair;
    if (facts[a].levels == 0 && facts[b].levels > 0) {
      beside[unknown.find(a)].push_back(facts[b].levels);
    }
    if (facts[b].levels == 0 && facts[a].levels > 0) {
      beside[unknown.find(b)].push_back(facts[a].levels);
    }
  }
  std::map<uint32_t, std::vector<double>> guesses;
  std::map<uint32_t, size_t> sizes;
  std::map<uint32_t, std::map<std::string_view, size_t>> roofs;
  for (const uint32_t i : members) {
    ++sizes[unknown.find(i)];
    if (facts[i].levels == 0 && facts[i].guessedLevels > 0) {
      guesses[unknown.find(i)].push_back(facts[i].guessedLevels);
    }
    const std::string_view roof = features[i].tag("roof:shape");
    if (!roof.empty()) ++roofs[rows.find(i)][roof];
  }
  for (const uint32_t i : members) {
    const uint32_t row = rows.find(i), group = unknown.find(i);
    const uint64_t bits = mix64(hashBytes(features[row].id));
    facts[i].rowChance = static_cast<double>(bits >> 11) * 0x1p-53;
    size_t most = 0;
    for (const auto& [roof, count] : roofs[row]) {
      if (count <= most) continue;
      most = count;
      facts[i].rowRoof = roof;
    }
    if (facts[i].levels > 0) continue;
    if (beside.count(group) > 0 && kSpeaksFor * beside[group].size() >= sizes[group]) {
      facts[i].guessedLevels = middleOf(beside[group]);
    } else if (guesses.count(group) > 0) {
      facts[i].guessedLevels = middleOf(guesses[group]);
    }
  }
}

}  // namespace gable
