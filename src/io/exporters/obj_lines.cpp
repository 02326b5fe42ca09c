// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Boxes have a way of their own: an unturned box has six different numbers and eight different
// indices, each of which is formatted once.
#include "io/exporters/obj_lines.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

#include "base/number.h"
#include "base/work.h"
#include "geom/mesh/corner_normals.h"
#include "io/exporters/surface.h"
#include "material/library.h"
#include "math/trig.h"
#include "scene/flatten.h"

namespace gable {
namespace {

constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
constexpr int kDecimals = 6;
constexpr double kUnits = 1e6;
constexpr size_t kLineRoom = 4 * kNumberRoom;

// A short text that is formatted once and copied often.
struct Piece {
  char text[kNumberRoom];
  uint8_t size = 0;
  void set(double v) { size = static_cast<uint8_t>(writeFixed(text, v, kDecimals) - text); }
  void set(uint64_t v) { size = static_cast<uint8_t>(writeInteger(text, v) - text); }
  // Copies more than the text, which is cheaper than copying exactly.
  char* put(char* to) const {
    std::memcpy(to, text, 16);
    if (size > 16) std::memcpy(to + 16, text + 16, sizeof text - 16);
    return to + size;
  }
};

double roundedUnits(double v) { return std::floor(std::fabs(v) * kUnits + 0.5) * (v < 0 ? -1 : 1); }

}  // namespace

std::string objWord(const std::string& name, const char* fallback) {
  std::string out = name.empty() ? fallback : name;
  for (char& c : out) {
    if (static_cast<unsigned char>(c) <= ' ' || c == '#') c = '_';
  }
  return out;
}

// ---- What all blocks share --------------------------------------------------------------------

ObjPlan::ObjPlan(const Scene& scene) : scene_(scene) {
  std::map<std::string, int> taken;
  const auto add = [&](const Material& m) {
    const std::string name = objWord(m.name, colorText(m.color).c_str() + 1);
    const int times = ++taken[name];
    std::string unique = name;
    if (times > 1) {
      unique = name + "-" + std::to_string(times);
      while (taken.count(unique)) unique = name + "-" + std::to_string(++taken[name]);
      taken[unique] = 1;
    }
    materialNames_.push_back(unique);
    const TextureMap& map = m.map(TextureLayer::Color);
    laid_.push_back(gable::isLaid(m));
    turned_.push_back(gable::isLaid(m) || (!map.path.empty() && map.rw != 0));
  };
  for (const Material& m : scene_.materials) add(m);
  add(Material{});
  for (const std::string& n : scene_.names) groupLines_.push_back("g " + objWord(n, "leaf") + "\n");
  groupLines_.emplace_back("g leaf\n");
  slots_.resize(scene.meshes.size());
  for (size_t m = 0; m < slots_.size(); ++m) {
    work(scene.meshes[m]->faceCount() + 1);
    for (const MeshFace& face : scene.meshes[m]->faces) {
      std::vector<uint16_t>& slots = slots_[m];
      if (slots.empty() || slots.back() != face.materialSlot) slots.push_back(face.materialSlot);
    }
    std::sort(slots_[m].begin(), slots_[m].end());
    slots_[m].erase(std::unique(slots_[m].begin(), slots_[m].end()), slots_[m].end());
  }
}

std::string ObjPlan::materialLine(uint32_t material) const {
  return "usemtl " + materialNames_[material] + "\n";
}

std::string ObjPlan::rootLine(const Root& root) const {
  const bool named = root.name < scene_.names.size();
  return "o " + objWord(named ? scene_.names[root.name] : "", "shape") + "\n";
}

uint32_t ObjPlan::groupOf(const Leaf& leaf) const {
  return static_cast<uint32_t>(std::min<size_t>(leaf.name, groupLines_.size() - 1));
}

uint32_t ObjPlan::materialOf(const Leaf& leaf, uint32_t slot) const {
  return std::min<uint32_t>(materialIndexOf(scene_, leaf, slot),
                            static_cast<uint32_t>(scene_.materials.size()));
}

// Not where a side has no area after rounding.
bool ObjPlan::isPlainBox(const Leaf& leaf, const Frame& world) const {
  if (leaf.mesh != kUnitBox && leaf.mesh != kUnitBoxUv) return false;
  const Vec3& s = leaf.scale;
  constexpr double kThin = 3e-6, kFar = 1e9;
  const Vec3& o = world.origin;
  const bool plain = s.x > kThin && s.y > kThin && s.z > kThin && s.x < kFar && s.y < kFar &&
                     s.z < kFar && std::fabs(o.x) < kFar && std::fabs(o.y) < kFar &&
                     std::fabs(o.z) < kFar;
  return plain && !isLaid(leaf, 0) && !(leaf.mesh == kUnitBoxUv && isTurned(leaf, 0));
}

bool ObjPlan::hasUvs(const Leaf& leaf) const {
  const std::vector<uint16_t>& slots = slots_[leaf.mesh];
  return scene_.meshes[leaf.mesh]->hasUv(0) ||
         std::any_of(slots.begin(), slots.end(), [&](uint16_t s) { return isLaid(leaf, s); });
}

ObjCounts ObjPlan::countsOf(const Leaf& leaf, const Frame& world) const {
  if (isPlainBox(leaf, world)) return {8, 0, 0};
  const Mesh& m = *scene_.meshes[leaf.mesh];
  return {m.positions.size(), hasUvs(leaf) ? m.corners.size() : 0,
          m.normals.empty() ? 0 : m.corners.size()};
}

// ---- A block ------------------------------------------------------------------------------------

ObjLines::ObjLines(const ObjPlan& plan)
    : plan_(plan), meshTriangles_(plan.scene()), used_(plan.materialNames().size(), false) {}

void ObjLines::begin(const ObjCounts& before, TextBuffer& text) {
  out_ = &text;
  at_ = before;
  group_ = material_ = kNone;
}

void ObjLines::addRoot(const Root& root) {
  out_->append(plan_.rootLine(root));
  group_ = kNone;
}

void ObjLines::add(const Leaf& leaf, const Frame& world) {
  const uint32_t group = plan_.groupOf(leaf);
  if (group != group_) out_->append(plan_.groupLine(leaf));
  group_ = group;
  if (plan_.isPlainBox(leaf, world)) {
    addBox(leaf, world);
  } else {
    addMesh(leaf, world);
  }
}

void ObjLines::useMaterial(const Leaf& leaf, uint32_t slot) {
  const uint32_t m = plan_.materialOf(leaf, slot);
  if (m == material_) return;
  material_ = m;
  used_[m] = true;
  out_->append(plan_.materialLine(m));
}

void ObjLines::putLine(const char* word, const Vec3& v) {
  char* p = out_->reserve(kLineRoom);
  const size_t n = std::strlen(word);
  std::memcpy(p, word, n);
  p += n;
  for (size_t i = 0; i < 3; ++i) {
    *p++ = ' ';
    p = writeFixed(p, v[i], kDecimals);
  }
  *p++ = '\n';
  out_->advanceTo(p);
}

void ObjLines::addBox(const Leaf& leaf, const Frame& world) {
  const Vec3& s = leaf.scale;
  const Vec3& o = world.origin;
  const Mesh& m = *plan_.scene().meshes[leaf.mesh];
  useMaterial(leaf, 0);
  Piece index[8], numbers[6];
  for (unsigned i = 0; i < 8; ++i) index[i].set(at_.vertices + 1 + i);
  char* p = out_->reserve(8 * kLineRoom + 24 * 2 * kNumberRoom);
  if (!world.turned) {
    // As Frame::point computes them.
    for (size_t a = 0; a < 3; ++a) {
      numbers[2 * a].set(o[a]);
      numbers[2 * a + 1].set(o[a] + s[a]);
    }
  }
  for (const Vec3& corner : m.positions) {
    *p++ = 'v';
    if (world.turned) {
      const Vec3 at = world.point(scaled(corner, s));
      for (size_t a = 0; a < 3; ++a) {
        *p++ = ' ';
        p = writeFixed(p, at[a], kDecimals);
      }
    } else {
      for (size_t a = 0; a < 3; ++a) {
        *p++ = ' ';
        p = numbers[2 * a + (corner[a] > 0 ? 1 : 0)].put(p);
      }
    }
    *p++ = '\n';
  }
  const bool uv = leaf.mesh == kUnitBoxUv;
  for (uint32_t f = 0; f < 6; ++f) {
    *p++ = 'f';
    for (uint32_t k = 0; k < 4; ++k) {
      const uint32_t c = m.loops[m.faces[f].firstLoop].firstCorner + k;
      *p++ = ' ';
      p = index[m.corners[c]].put(p);
      if (uv) {
        *p++ = '/';
        const Vec2 t = m.uvs[0][c];
        *p++ = t.y == 0 ? (t.x == 0 ? '1' : '2') : (t.x == 0 ? '4' : '3');
      }
    }
    *p++ = '\n';
  }
  out_->advanceTo(p);
  at_.vertices += 8;
  triangles_ += 12;
}

bool ObjLines::hasArea(const Mesh& m, const uint32_t* corners, size_t count) const {
  // In the rounded numbers, relative to the first corner.
  const auto at = [&](size_t i) {
    const Vec3& p = placed_[m.corners[corners[i]]];
    return Vec3{roundedUnits(p.x), roundedUnits(p.y), roundedUnits(p.z)};
  };
  Vec3 sum;
  const Vec3 o = at(0);
  for (size_t i = 1; i + 1 < count; ++i) sum += cross(at(i) - o, at(i + 1) - o);
  return dot(sum, sum) > 0 && isFinite(sum);
}

void ObjLines::putPolygon(const Mesh& m, const uint32_t* corners, size_t count, bool turn) {
  if (count < 3 || !hasArea(m, corners, count)) return;
  out_->append("f");
  for (size_t i = 0; i < count; ++i) {
    const uint32_t c = corners[turn ? (count - i) % count : i];
    char* p = out_->reserve(kLineRoom);
    *p++ = ' ';
    p = writeInteger(p, at_.vertices + 1 + m.corners[c]);
    if (hasUv_ || hasNormals_) *p++ = '/';
    if (hasUv_) p = writeInteger(p, uvBase_ + 1 + c);
    if (hasNormals_) {
      *p++ = '/';
      p = writeInteger(p, normalBase_ + 1 + c);
    }
    out_->advanceTo(p);
  }
  out_->append("\n");
  triangles_ += count - 2;
}

void ObjLines::addFace(const Mesh& m, size_t face, const Leaf& leaf, bool turn) {
  useMaterial(leaf, m.faces[face].materialSlot);
  const auto loops = m.loopsOf(face);
  if (loops.size() == 1) {
    corners_.resize(loops[0].cornerCount);
    for (uint32_t i = 0; i < loops[0].cornerCount; ++i) corners_[i] = loops[0].firstCorner + i;
    putPolygon(m, corners_.data(), corners_.size(), turn);
    return;
  }
  const MeshTriangles& t = meshTriangles_.of(leaf.mesh);
  for (size_t i = face ? t.faceEnds[face - 1] : 0; i < t.faceEnds[face]; ++i) {
    putPolygon(m, t.triangles[i].data(), 3, turn);
  }
}

// In metres, from where the face stands.
void ObjLines::layFace(const Mesh& m, size_t face, bool mirrored, std::vector<Vec2>& uvs) const {
  Vec3 normal;
  for (const MeshLoop& loop : m.loopsOf(face)) {
    const auto at = [&](uint32_t i) { return placed_[m.corners[loop.firstCorner + i]]; };
    for (uint32_t i = 2; i < loop.cornerCount; ++i) {
      normal += cross(at(i - 1) - at(0), at(i) - at(0));
    }
  }
  const FaceAxes axes = layingAxes(unitOf(mirrored ? -normal : normal));
  for (const MeshLoop& loop : m.loopsOf(face)) {
    for (uint32_t i = loop.firstCorner; i < loop.firstCorner + loop.cornerCount; ++i) {
      const Vec2 uv = axes.at(placed_[m.corners[i]]);
      uvs[i] = std::isfinite(uv.x) && std::isfinite(uv.y) ? uv : Vec2{};
    }
  }
}

// As glTF's exporter and the pictures transform them: scaled, turned about the lower left, shifted.
void ObjLines::putUvs(const Mesh& m, const Leaf& leaf) {
  std::vector<Vec2> uvs = m.uvs[0];
  uvs.resize(m.corners.size());
  const bool mirrored = ((leaf.scale.x < 0) != (leaf.scale.y < 0)) != (leaf.scale.z < 0);
  for (size_t f = 0; f < m.faceCount(); ++f) {
    const uint32_t slot = m.faces[f].materialSlot;
    if (!plan_.isTurned(leaf, slot)) continue;
    if (plan_.isLaid(leaf, slot)) layFace(m, f, mirrored, uvs);
    const TextureMap& t = gable::materialOf(plan_.scene(), leaf, slot).map(TextureLayer::Color);
    const double c = cosDeg(t.rw), s = sinDeg(t.rw);
    for (const MeshLoop& loop : m.loopsOf(f)) {
      for (uint32_t i = loop.firstCorner; i < loop.firstCorner + loop.cornerCount; ++i) {
        const Vec2 uv{uvs[i].x * t.su, uvs[i].y * t.sv};
        uvs[i] = {t.tu + c * uv.x - s * uv.y, t.tv + s * uv.x + c * uv.y};
      }
    }
  }
  for (const Vec2& uv : uvs) {
    char* p = out_->reserve(kLineRoom);
    std::memcpy(p, "vt ", 3);
    p = writeFixed(p + 3, uv.x, kDecimals);
    *p++ = ' ';
    p = writeFixed(p, uv.y, kDecimals);
    *p++ = '\n';
    out_->advanceTo(p);
  }
}

void ObjLines::addMesh(const Leaf& leaf, const Frame& world) {
  const Mesh& m = *plan_.scene().meshes[leaf.mesh];
  work(m.corners.size());
  placed_.resize(m.positions.size());
  for (size_t i = 0; i < placed_.size(); ++i) {
    placed_[i] = world.point(scaled(m.positions[i], leaf.scale));
    putLine("v", isFinite(placed_[i]) ? placed_[i] : Vec3{});
  }
  hasUv_ = plan_.hasUvs(leaf);
  hasNormals_ = !m.normals.empty();
  uvBase_ = at_.uvs;
  normalBase_ = at_.normals;
  if (hasUv_) putUvs(m, leaf);
  if (hasNormals_) {
    for (const Vec3& n : cornerNormals(m)) {
      putLine("vn", world.direction(scaledNormal(n, leaf.scale)));
    }
  }
  at_.uvs += hasUv_ ? m.corners.size() : 0;
  at_.normals += hasNormals_ ? m.corners.size() : 0;
  const bool turn = ((leaf.scale.x < 0) != (leaf.scale.y < 0)) != (leaf.scale.z < 0);
  for (size_t f = 0; f < m.faceCount(); ++f) addFace(m, f, leaf, turn);
  at_.vertices += m.positions.size();
}

}  // namespace gable
