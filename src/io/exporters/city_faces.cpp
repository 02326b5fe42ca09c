// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/city_faces.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"
#include "io/exporters/plan.h"

namespace gable {
namespace {

// Metres that a corner may lie beside the plane of its face, well below what checkers of city
// models allow (a centimetre).
constexpr double kFlat = 0.002;

bool isNear(const Vec3& p) {
  return std::fabs(p.x) < kFarthestCity && std::fabs(p.y) < kFarthestCity &&
         std::fabs(p.z) < kFarthestCity;
}

}  // namespace

Vec3 ringNormal(const std::vector<Vec3>& ring) {
  Vec3 sum;
  for (size_t i = 2; i < ring.size(); ++i) {
    sum += cross(ring[i - 1] - ring[0], ring[i] - ring[0]);
  }
  return sum;
}

CityKind kindBySight(const CityFace& face, double foot) {
  const double up = face.normal.y / length(face.normal);
  const auto isBelow = [&](double height) {
    const std::vector<Vec3>& ring = face.rings[0];
    return std::all_of(ring.begin(), ring.end(),
                       [&](const Vec3& p) { return p.y <= foot + height; });
  };
  if (up > kCityUp) return isBelow(kLeastRoof) ? CityKind::Floor : CityKind::Roof;
  if (up >= -kCityUp) return CityKind::Wall;
  return isBelow(kCityGround) ? CityKind::Ground : CityKind::Ceiling;
}

void CitySights::add(const CityFace& face, double foot) {
  areas_[kindBySight(face, foot)] += length(face.normal);
}

CityKind CitySights::oneWay() const {
  constexpr double kNearlyAll = 0.95;
  double all = 0;
  for (const auto& [kind, area] : areas_) all += area;
  for (const auto& [kind, area] : areas_) {
    if (area >= all * kNearlyAll) return kind;
  }
  return CityKind::Unknown;
}

bool CityFaces::isFlat(const CityFace& face) const {
  if (face.rings.size() == 1 && face.rings[0].size() == 3) return true;
  const Vec3 normal = normalized(face.normal), from = face.rings[0][0];
  for (const std::vector<Vec3>& ring : face.rings) {
    for (const Vec3& p : ring) {
      if (!(std::fabs(dot(p - from, normal)) <= kFlat)) return false;
    }
  }
  return true;
}

void CityFaces::give(CityFace& face, bool turn, const std::function<void(CityFace&)>& take) const {
  if (turn) {
    for (std::vector<Vec3>& ring : face.rings) std::reverse(ring.begin(), ring.end());
  }
  face.normal = ringNormal(face.rings[0]);
  if (dot(face.normal, face.normal) > 0 && isFinite(face.normal)) take(face);
}

void CityFaces::forEach(const Leaf& leaf, const Frame& world,
                        const std::function<void(CityFace&)>& take) {
  const Mesh& m = *scene_.meshes[leaf.mesh];
  work(m.corners.size() + 1);
  placed_.resize(m.positions.size());
  for (size_t i = 0; i < placed_.size(); ++i) {
    placed_[i] = world.point(scaled(m.positions[i], leaf.scale));
  }
  const bool turn = ((leaf.scale.x < 0) != (leaf.scale.y < 0)) != (leaf.scale.z < 0);
  for (size_t f = 0; f < m.faceCount(); ++f) {
    CityFace face;
    face.slot = m.faces[f].materialSlot;
    bool near = true;
    for (const MeshLoop& loop : m.loopsOf(f)) {
      std::vector<Vec3>& ring = face.rings.emplace_back();
      for (const uint32_t position : m.cornersOf(loop)) {
        ring.push_back(placed_[position]);
        near = near && isNear(placed_[position]);
      }
    }
    if (face.rings.empty() || face.rings[0].size() < 3) continue;
    if (!near) {
      ++leftOut_;
      continue;
    }
    face.normal = ringNormal(face.rings[0]);
    if (isFlat(face)) {
      give(face, turn, take);
      continue;
    }
    triangles_.clear();
    triangulator_.add(m, f, triangles_);
    for (const auto& t : triangles_) {
      CityFace corner;
      corner.slot = face.slot;
      corner.rings = {
          {placed_[m.corners[t[0]]], placed_[m.corners[t[1]]], placed_[m.corners[t[2]]]}};
      give(corner, turn, take);
    }
  }
}

Box3 CityFaces::boxOf(const Leaf& leaf, const Frame& world) {
  meshBounds_.resize(scene_.meshes.size());
  boundsKnown_.resize(scene_.meshes.size());
  if (!boundsKnown_[leaf.mesh]) {
    meshBounds_[leaf.mesh] = scene_.meshes[leaf.mesh]->bounds();
    boundsKnown_[leaf.mesh] = true;
  }
  return boundsAt(meshBounds_[leaf.mesh], world, leaf.scale);
}

}  // namespace gable
