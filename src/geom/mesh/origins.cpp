// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A level is four sets of two numbers: x and y of the origin; its z and x of the begin; y and z of
// the begin; and the shape, negative where it was deleted, with its parent.
#include "geom/mesh/origins.h"

#include <algorithm>

#include "base/work.h"

namespace gable {

namespace {

constexpr size_t kSets = 4;
// What rounding moves, as a share of the extent: components lie on a grid in axes of their own.
constexpr double kSlack = 1e-7;

}  // namespace

size_t originLevels(const Mesh& m) { return m.notes.size() / kSets; }

void noteOrigins(Mesh& m, double shape) {
  const size_t first = m.notes.size();
  m.notes.resize(first + kSets);
  workMemory(m.corners.size() * kSets * sizeof(Vec2));
  for (const uint32_t c : m.corners) {
    const Vec3& p = m.positions[c];
    m.notes[first].push_back({p.x, p.y});
    m.notes[first + 1].push_back({p.z, p.x});
    m.notes[first + 2].push_back({p.y, p.z});
    m.notes[first + 3].push_back({shape, 0});
  }
}

void dropOrigins(Mesh& m, size_t levelsLeft) {
  if (originLevels(m) > levelsLeft) m.notes.resize(levelsLeft * kSets);
}

bool hasOrigins(const Mesh& m) {
  if (m.notes.empty()) return false;
  const std::vector<Vec2>& shapes = m.notes.back();
  return std::any_of(shapes.begin(), shapes.end(), [](const Vec2& s) { return s.x != 0; });
}

void markDeleted(Mesh& m) {
  if (m.notes.empty()) return;
  for (Vec2& s : m.notes.back()) s.x = -std::fabs(s.x);
}

bool isDeleted(const Mesh& m) {
  if (m.notes.empty()) return false;
  const std::vector<Vec2>& shapes = m.notes.back();
  return std::any_of(shapes.begin(), shapes.end(), [](const Vec2& s) { return s.x < 0; });
}

Origins::Origins(const Mesh& m, size_t level) {
  const size_t first = level * kSets;
  if (m.notes.size() < first + kSets || m.notes[first + 3].empty()) return;
  origins_ = &m.notes[first];
  both_ = &m.notes[first + 1];
  begins_ = &m.notes[first + 2];
  shapes_ = &m.notes[first + 3];
}

Vec3 Origins::origin(uint32_t corner) const {
  const Vec2 xy = (*origins_)[corner];
  return {xy.x, xy.y, (*both_)[corner].x};
}

Vec3 Origins::begin(uint32_t corner) const {
  const Vec2 yz = (*begins_)[corner];
  return {(*both_)[corner].y, yz.x, yz.y};
}

Handover::Handover(const Mesh& ending, const Frame& home) {
  const Origins origins(ending, originLevels(ending) - 1);
  Box3 box;
  for (const Vec3& p : ending.positions) box.include(home.point(p));
  slack_ = kSlack * (1 + length(box.size()));
  for (uint32_t c = 0; c < ending.corners.size(); ++c) {
    work();
    if (!origins.known(c)) continue;
    const Vec3 at = home.point(ending.at(c));
    const double moved = length(at - origins.begin(c));
    moved_ = moved_ || moved > slack_;
    const auto [known, fresh] = stayed_.try_emplace(keyOf(origins.origin(c)), Stayed{at, moved});
    if (!fresh && moved < known->second.moved) known->second = {at, moved};
  }
}

void Handover::begin(Mesh& m, const Frame& home, double shape) const {
  const size_t level = originLevels(m) - 1, first = level * kSets;
  const Origins origins(m, level);
  for (uint32_t c = 0; c < m.corners.size(); ++c) {
    work();
    if (!origins.known(c)) continue;
    const Vec3 at = home.point(m.at(c));
    const auto stayed = stayed_.find(keyOf(origins.origin(c)));
    if (stayed != stayed_.end() && length(at - stayed->second.at) > slack_) {
      m.notes[first][c] = {at.x, at.y};
      m.notes[first + 1][c].x = at.z;
    }
    m.notes[first + 1][c].y = at.x;
    m.notes[first + 2][c] = {at.y, at.z};
    const double parent = kept_ ? origins.shape(c) : origins.parent(c);
    m.notes[first + 3][c] = {shape, parent};
  }
}

}  // namespace gable
