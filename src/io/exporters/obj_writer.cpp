// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// OBJ and MTL. Coordinates are world coordinates rounded to a micrometre; numbers are formatted
// into the buffer of the file. MTL can scale and shift a texture but not turn it, so where a
// material turns its colour texture the texture coordinates are written as they come out. Boxes
// have a way of their own: an unturned box has six different numbers and eight different indices,
// each of which is formatted once.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "base/files.h"
#include "base/number.h"
#include "base/work.h"
#include "geom/mesh/corner_normals.h"
#include "io/exporters/surface.h"
#include "io/exporters/textures.h"
#include "io/exporters/triangle_cache.h"
#include "io/exporters/write_model.h"
#include "io/uri.h"
#include "material/library.h"
#include "math/trig.h"
#include "scene/flatten.h"

namespace gable {
namespace {

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

// A word without what OBJ takes for an end: spaces and control characters become underscores.
std::string wordOf(const std::string& name, const char* fallback) {
  std::string out = name.empty() ? fallback : name;
  for (char& c : out) {
    if (static_cast<unsigned char>(c) <= ' ' || c == '#') c = '_';
  }
  return out;
}

double roundedUnits(double v) { return std::floor(std::fabs(v) * kUnits + 0.5) * (v < 0 ? -1 : 1); }

class ObjWriter {
 public:
  ObjWriter(const Scene& scene, const std::string& path, const WriteOptions& options)
      : scene_(scene),
        path_(path),
        stem_(path.substr(0, path.size() - extensionOf(path).size() - 1)),
        out_(path),
        triangles_(scene),
        textures_(options, report_.warnings) {}

  Result<WriteReport> write();

 private:
  void nameMaterials();
  void add(const Leaf& leaf, const Frame& world);
  bool addBox(const Leaf& leaf, const Frame& world);
  void addMesh(const Leaf& leaf, const Frame& world);
  void addFace(const Mesh& m, size_t face, const Leaf& leaf, bool turn);
  void putPolygon(const Mesh& m, const uint32_t* corners, size_t count, bool turn);
  bool hasArea(const Mesh& m, const uint32_t* corners, size_t count) const;
  void useMaterial(const Leaf& leaf, uint32_t slot);
  bool isLaidSlot(const Leaf& leaf, uint32_t slot) const;
  void layFace(const Mesh& m, size_t face, bool mirrored, std::vector<Vec2>& uvs) const;
  bool isTurned(const Leaf& leaf, uint32_t slot) const;
  void putUvs(const Mesh& m, const Leaf& leaf);
  void putLine(const char* word, const Vec3& v);
  std::string materialFile();
  void putMap(std::string& out, const char* statement, const Material& m, TextureLayer layer);

  const Scene& scene_;
  std::string path_, stem_;
  WriteReport report_;
  FileWriter out_;
  TriangleCache triangles_;
  TextureSet textures_;
  // Whole lines, by Scene::names and by material (the last is the default material's).
  std::vector<std::string> groupLines_, materialNames_, materialLines_;
  // By material, the default one included; turned: its texture is, or lies in metres.
  std::vector<bool> materialUsed_, turned_, laid_;
  uint32_t group_ = kNoMaterial, material_ = kNoMaterial;
  bool anyMaterial_ = false;
  uint64_t vertices_ = 0, uvs_ = 0, normals_ = 0;
  // Textures that are turned in another way than their material's colour.
  uint64_t misplacedMaps_ = 0;
  // Of the leaf at hand.
  std::vector<Vec3> placed_;
  std::vector<uint32_t> corners_;
  uint64_t uvBase_ = 0, normalBase_ = 0;
  bool hasUv_ = false, hasNormals_ = false;
};

void ObjWriter::nameMaterials() {
  std::map<std::string, int> taken;
  const auto add = [&](const Material& m) {
    const std::string name = wordOf(m.name, colorText(m.color).c_str() + 1);
    const int times = ++taken[name];
    std::string unique = name;
    if (times > 1) {
      unique = name + "-" + std::to_string(times);
      while (taken.count(unique)) unique = name + "-" + std::to_string(++taken[name]);
      taken[unique] = 1;
    }
    materialNames_.push_back(unique);
    materialLines_.push_back("usemtl " + unique + "\n");
    const TextureMap& map = m.map(TextureLayer::Color);
    laid_.push_back(isLaid(m));
    turned_.push_back(isLaid(m) || (!map.path.empty() && map.rw != 0));
  };
  for (const Material& m : scene_.materials) add(m);
  add(Material{});
  materialUsed_.assign(materialNames_.size(), false);
  for (const std::string& n : scene_.names) groupLines_.push_back("g " + wordOf(n, "leaf") + "\n");
  groupLines_.emplace_back("g leaf\n");
}

void ObjWriter::useMaterial(const Leaf& leaf, uint32_t slot) {
  const uint32_t m = std::min<uint32_t>(materialIndexOf(scene_, leaf, slot),
                                        static_cast<uint32_t>(scene_.materials.size()));
  if (anyMaterial_ && m == material_) return;
  anyMaterial_ = true;
  material_ = m;
  materialUsed_[m] = true;
  out_.append(materialLines_[m]);
}

void ObjWriter::putLine(const char* word, const Vec3& v) {
  char* p = out_.reserve(kLineRoom);
  const size_t n = std::strlen(word);
  std::memcpy(p, word, n);
  p += n;
  for (size_t i = 0; i < 3; ++i) {
    *p++ = ' ';
    p = writeFixed(p, v[i], kDecimals);
  }
  *p++ = '\n';
  out_.advanceTo(p);
}

// False when the box has a side without area after rounding, or is anything but plain.
bool ObjWriter::addBox(const Leaf& leaf, const Frame& world) {
  const Vec3& s = leaf.scale;
  constexpr double kThin = 3e-6, kFar = 1e9;
  const Vec3& o = world.origin;
  const bool plain = s.x > kThin && s.y > kThin && s.z > kThin && s.x < kFar && s.y < kFar &&
                     s.z < kFar && std::fabs(o.x) < kFar && std::fabs(o.y) < kFar &&
                     std::fabs(o.z) < kFar;
  if (!plain || isLaidSlot(leaf, 0) || (leaf.mesh == kUnitBoxUv && isTurned(leaf, 0))) return false;
  const Mesh& m = *scene_.meshes[leaf.mesh];
  useMaterial(leaf, 0);
  Piece index[8], numbers[6];
  for (unsigned i = 0; i < 8; ++i) index[i].set(vertices_ + 1 + i);
  char* p = out_.reserve(8 * kLineRoom + 24 * 2 * kNumberRoom);
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
  out_.advanceTo(p);
  vertices_ += 8;
  report_.triangles += 12;
  return true;
}

bool ObjWriter::hasArea(const Mesh& m, const uint32_t* corners, size_t count) const {
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

void ObjWriter::putPolygon(const Mesh& m, const uint32_t* corners, size_t count, bool turn) {
  if (count < 3 || !hasArea(m, corners, count)) return;
  out_.append("f", 1);
  for (size_t i = 0; i < count; ++i) {
    const uint32_t c = corners[turn ? (count - i) % count : i];
    char* p = out_.reserve(kLineRoom);
    *p++ = ' ';
    p = writeInteger(p, vertices_ + 1 + m.corners[c]);
    if (hasUv_ || hasNormals_) *p++ = '/';
    if (hasUv_) p = writeInteger(p, uvBase_ + 1 + c);
    if (hasNormals_) {
      *p++ = '/';
      p = writeInteger(p, normalBase_ + 1 + c);
    }
    out_.advanceTo(p);
  }
  out_.append("\n", 1);
  report_.triangles += count - 2;
}

void ObjWriter::addFace(const Mesh& m, size_t face, const Leaf& leaf, bool turn) {
  useMaterial(leaf, m.faces[face].materialSlot);
  const auto loops = m.loopsOf(face);
  if (loops.size() == 1) {
    corners_.resize(loops[0].cornerCount);
    for (uint32_t i = 0; i < loops[0].cornerCount; ++i) corners_[i] = loops[0].firstCorner + i;
    putPolygon(m, corners_.data(), corners_.size(), turn);
    return;
  }
  const MeshTriangles& t = triangles_.of(leaf.mesh);
  for (size_t i = face ? t.faceEnds[face - 1] : 0; i < t.faceEnds[face]; ++i) {
    putPolygon(m, t.triangles[i].data(), 3, turn);
  }
}

bool ObjWriter::isTurned(const Leaf& leaf, uint32_t slot) const {
  const uint32_t m = materialIndexOf(scene_, leaf, slot);
  return m < scene_.materials.size() && turned_[m];
}

bool ObjWriter::isLaidSlot(const Leaf& leaf, uint32_t slot) const {
  const uint32_t m = materialIndexOf(scene_, leaf, slot);
  return m < scene_.materials.size() && laid_[m];
}

// In metres, from where the face stands.
void ObjWriter::layFace(const Mesh& m, size_t face, bool mirrored, std::vector<Vec2>& uvs) const {
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
void ObjWriter::putUvs(const Mesh& m, const Leaf& leaf) {
  std::vector<Vec2> uvs = m.uvs[0];
  uvs.resize(m.corners.size());
  const bool mirrored = ((leaf.scale.x < 0) != (leaf.scale.y < 0)) != (leaf.scale.z < 0);
  for (size_t f = 0; f < m.faceCount(); ++f) {
    const uint32_t slot = m.faces[f].materialSlot;
    if (!isTurned(leaf, slot)) continue;
    if (isLaidSlot(leaf, slot)) layFace(m, f, mirrored, uvs);
    const TextureMap& t = materialOf(scene_, leaf, slot).map(TextureLayer::Color);
    const double c = cosDeg(t.rw), s = sinDeg(t.rw);
    for (const MeshLoop& loop : m.loopsOf(f)) {
      for (uint32_t i = loop.firstCorner; i < loop.firstCorner + loop.cornerCount; ++i) {
        const Vec2 uv{uvs[i].x * t.su, uvs[i].y * t.sv};
        uvs[i] = {t.tu + c * uv.x - s * uv.y, t.tv + s * uv.x + c * uv.y};
      }
    }
  }
  for (const Vec2& uv : uvs) {
    char* p = out_.reserve(kLineRoom);
    std::memcpy(p, "vt ", 3);
    p = writeFixed(p + 3, uv.x, kDecimals);
    *p++ = ' ';
    p = writeFixed(p, uv.y, kDecimals);
    *p++ = '\n';
    out_.advanceTo(p);
  }
}

void ObjWriter::addMesh(const Leaf& leaf, const Frame& world) {
  const Mesh& m = *scene_.meshes[leaf.mesh];
  work(m.corners.size());
  placed_.resize(m.positions.size());
  for (size_t i = 0; i < placed_.size(); ++i) {
    placed_[i] = world.point(scaled(m.positions[i], leaf.scale));
    putLine("v", isFinite(placed_[i]) ? placed_[i] : Vec3{});
  }
  hasUv_ = m.hasUv(0);
  for (size_t f = 0; f < m.faceCount() && !hasUv_; ++f) {
    hasUv_ = isLaidSlot(leaf, m.faces[f].materialSlot);
  }
  hasNormals_ = !m.normals.empty();
  uvBase_ = uvs_;
  normalBase_ = normals_;
  if (hasUv_) putUvs(m, leaf);
  if (hasNormals_) {
    for (const Vec3& n : cornerNormals(m)) {
      putLine("vn", world.direction(scaledNormal(n, leaf.scale)));
    }
  }
  uvs_ += hasUv_ ? m.corners.size() : 0;
  normals_ += hasNormals_ ? m.corners.size() : 0;
  const bool turn = ((leaf.scale.x < 0) != (leaf.scale.y < 0)) != (leaf.scale.z < 0);
  for (size_t f = 0; f < m.faceCount(); ++f) addFace(m, f, leaf, turn);
  vertices_ += m.positions.size();
}

void ObjWriter::add(const Leaf& leaf, const Frame& world) {
  const auto name = std::min<size_t>(leaf.name, groupLines_.size() - 1);
  if (name != group_) out_.append(groupLines_[name]);
  group_ = static_cast<uint32_t>(name);
  if ((leaf.mesh == kUnitBox || leaf.mesh == kUnitBoxUv) && addBox(leaf, world)) return;
  addMesh(leaf, world);
}

// MTL's options for a texture's scale and shift.
std::string placingOf(const TextureMap& map) {
  std::string out;
  if (map.su != 1 || map.sv != 1) {
    out += " -s " + shortestText(map.su) + " " + shortestText(map.sv) + " 1";
  }
  if (map.tu != 0 || map.tv != 0) {
    out += " -o " + shortestText(map.tu) + " " + shortestText(map.tv) + " 0";
  }
  return out;
}

void ObjWriter::putMap(std::string& out, const char* statement, const Material& m,
                       TextureLayer layer) {
  const TextureMap& map = m.map(layer);
  const int texture = textures_.add(map.path);
  if (texture == TextureSet::kNone) return;
  out += statement;
  const TextureMap& color = m.map(TextureLayer::Color);
  const bool baked = !color.path.empty() && (color.rw != 0 || isLaid(m));
  if (baked) {
    const auto placing = [](const TextureMap& t) {
      return std::array<double, 5>{t.su, t.sv, t.tu, t.tv, t.rw};
    };
    misplacedMaps_ += placing(map) == placing(color) ? 0 : 1;
  } else {
    misplacedMaps_ += map.rw != 0 ? 1 : 0;
  }
  if (!baked) out += placingOf(map);
  const ModelTexture& t = textures_.all()[static_cast<size_t>(texture)];
  out += " " + fileNameOf(stem_) + "-" + t.name + "\n";
}

std::string ObjWriter::materialFile() {
  std::string out = "# written by Gable\n";
  const Material plain;
  const auto color = [&](const char* word, const Vec3& c) {
    out += word;
    for (size_t i = 0; i < 3; ++i) out += " " + shortestText(c[i]);
    out += '\n';
  };
  for (size_t i = 0; i < materialNames_.size(); ++i) {
    if (!materialUsed_[i]) continue;
    const Material& m = i < scene_.materials.size() ? scene_.materials[i] : plain;
    out += "\nnewmtl " + materialNames_[i] + "\n";
    color("Kd", m.color);
    color("Ka", m.ambient);
    color("Ks", m.specular);
    if (m.emissive != Vec3{}) color("Ke", m.emissive);
    out += "Ns " + shortestText(m.shininess) + "\n";
    out += "d " + shortestText(m.opacity) + "\n";
    out += "Pr " + shortestText(m.roughness) + "\nPm " + shortestText(m.metallic) + "\n";
    putMap(out, "map_Kd", m, TextureLayer::Color);
    putMap(out, "map_bump", m, TextureLayer::Bump);
    putMap(out, "map_Ka", m, TextureLayer::Occlusion);
    putMap(out, "map_Ks", m, TextureLayer::Specular);
    putMap(out, "map_d", m, TextureLayer::Opacity);
    putMap(out, "norm", m, TextureLayer::Normal);
    putMap(out, "map_Ke", m, TextureLayer::Emissive);
    // MTL has no words for the channels of one picture, and readers take the whole of it.
    if (m.map(TextureLayer::Roughness).path == m.map(TextureLayer::Metallic).path) continue;
    putMap(out, "map_Pr", m, TextureLayer::Roughness);
    putMap(out, "map_Pm", m, TextureLayer::Metallic);
  }
  return out;
}

Result<WriteReport> ObjWriter::write() {
  nameMaterials();
  out_.append("# written by Gable; metres, y up\n");
  out_.append("mtllib " + wordOf(fileNameOf(stem_), "model") + ".mtl\n");
  // The uv coordinates of unit boxes, numbers 1 to 4.
  out_.append("vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\ns off\n");
  uvs_ = 4;
  for (const Root& root : scene_.roots) {
    if (out_.failed()) break;
    out_.append("o " +
                wordOf(root.name < scene_.names.size() ? scene_.names[root.name] : "", "shape"));
    out_.append("\n", 1);
    group_ = kNoMaterial;
    forEachLeaf(scene_, scene_.prototypes[root.instance.prototype], root.instance.frame,
                [&](const Leaf& leaf, const Frame& world) { add(leaf, world); });
  }
  const std::string materials = materialFile();
  if (misplacedMaps_ > 0) {
    report_.warnings.push_back(std::to_string(misplacedMaps_) +
                               " textures lie as their material's colour texture does: OBJ has one "
                               "set of texture coordinates, and MTL cannot turn");
  }
  for (const ModelTexture& t : textures_.all()) {
    const std::string file = stem_ + "-" + t.name;
    const Result<uint64_t> bytes = writeFile(file, t.bytes);
    if (!bytes.ok()) return bytes.error();
    report_.bytes += bytes.value();
    report_.files.push_back(file);
  }
  const std::string materialPath = folderOf(stem_) + wordOf(fileNameOf(stem_), "model") + ".mtl";
  const Result<uint64_t> more = writeFile(materialPath, materials);
  if (!more.ok()) return more.error();
  const Result<uint64_t> bytes = out_.finish();
  if (!bytes.ok()) return bytes.error();
  report_.bytes += more.value() + bytes.value();
  report_.files.insert(report_.files.begin(), {path_, materialPath});
  return report_;
}

}  // namespace

Result<WriteReport> writeObj(const Scene& scene, const std::string& path,
                             const WriteOptions& options) {
  return ObjWriter(scene, path, options).write();
}

}  // namespace gable
