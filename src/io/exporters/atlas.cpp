// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Faces are looked at by mesh and list of materials, as leaves share both: first to see how far
// each material's pictures repeat, then to give copies of the meshes coordinates in the atlas. A
// cell of the atlas has a border of pixels about it, which filters of engines reach into.
#include "io/exporters/atlas.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "base/work.h"
#include "io/exporters/atlas_packing.h"
#include "io/image/image.h"
#include "material/library.h"
#include "math/trig.h"
#include "scene/flatten.h"

namespace gable {
namespace {

constexpr const char* kColorPath = "atlas.png";
constexpr const char* kSurfacePath = "atlas-metal-rough.png";
// Of a cell: half the side of a plain colour, and the border that takes three halvings.
constexpr uint32_t kPlain = 8, kBorder = 8;
// So often may a face show a picture along or up; and what rounding adds to a whole repeat.
constexpr double kMostRepeats = 2, kRounding = 1e-3;

// The place of a corner on a picture, in repeats.
Vec2 placeOn(const TextureMap& t, const Vec2& uv) {
  if (t.rw == 0) return {t.su * uv.x + t.tu, t.sv * uv.y + t.tv};
  const double c = cosDeg(t.rw), s = sinDeg(t.rw);
  return {c * t.su * uv.x - s * t.sv * uv.y + t.tu, s * t.su * uv.x + c * t.sv * uv.y + t.tv};
}

// What one face shows of a picture: from a whole repeat on.
struct FaceReach {
  Vec2 from, size;
};

template <class Visit>
void forEachCorner(const Mesh& m, size_t face, Visit&& visit) {
  for (const MeshLoop& loop : m.loopsOf(face)) {
    for (uint32_t i = 0; i < loop.cornerCount; ++i) visit(loop.firstCorner + i);
  }
}

FaceReach reachOf(const Mesh& m, size_t face, const TextureMap& map) {
  Vec2 low{1e300, 1e300}, high{-1e300, -1e300};
  forEachCorner(m, face, [&](uint32_t corner) {
    const Vec2 at = placeOn(map, m.uvs[0][corner]);
    low = {std::min(low.x, at.x), std::min(low.y, at.y)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y)};
  });
  const Vec2 from{std::floor(low.x + kRounding), std::floor(low.y + kRounding)};
  return {from, high - from};
}

uint8_t byteOf(double share) {
  return static_cast<uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
}

class AtlasMaker {
 public:
  AtlasMaker(const Scene& scene, const TextureReader& read, uint32_t side)
      : from_(scene), read_(read), side_(side), uses_(2 * scene.materials.size()) {}

  AtlasScene run() {
    out_.scene = from_;
    findUses();
    choose();
    if (cells_.size() < 2) return std::move(out_);
    place();
    draw();
    replace();
    return std::move(out_);
  }

 private:
  // How faces use a material, those that show its picture and those that have no coordinates for
  // it.
  struct Use {
    bool used = false;
    /// Of its picture, by the face that shows most.
    Vec2 most;
    /// Of cells_, once it is merged.
    std::optional<size_t> cell;
  };

  struct Cell {
    size_t use = 0;
    Image image;
    bool hasAlpha = false;
    uint32_t across = 1, up = 1;
    /// Of its pixels without the border.
    uint32_t x = 0, y = 0;
    uint32_t width() const { return image.width * across; }
    uint32_t height() const { return image.height * up; }
  };

  using Pair = std::pair<uint32_t, uint32_t>;

  uint32_t materialAt(const Pair& pair, uint32_t slot) const {
    Leaf leaf;
    leaf.mesh = pair.first;
    leaf.materials = pair.second;
    return materialIndexOf(from_, leaf, slot);
  }

  void findUses() {
    for (const Leaf& l : from_.leaves) pairs_.emplace(l.mesh, l.materials);
    for (const Pair& pair : pairs_) {
      const Mesh& m = *from_.meshes[pair.first];
      work(1 + m.corners.size());
      for (size_t f = 0; f < m.faceCount(); ++f) {
        const uint32_t material = materialAt(pair, m.faces[f].materialSlot);
        if (material != kNoMaterial) look(m, f, material);
      }
    }
  }

  // Twice the material, and 1 more for those that show its picture.
  size_t useOf(const Mesh& m, uint32_t material) const {
    const bool shows = m.hasUv(0) && !mapOf(2 * material).path.empty();
    return 2 * size_t{material} + (shows ? 1 : 0);
  }
  static bool showsPicture(size_t use) { return use % 2 == 1; }
  const Material& materialOf(size_t use) const { return from_.materials[use / 2]; }
  const TextureMap& mapOf(size_t use) const { return materialOf(use).map(TextureLayer::Color); }

  void look(const Mesh& m, size_t face, uint32_t material) {
    const size_t number = useOf(m, material);
    Use& use = uses_[number];
    use.used = true;
    if (!showsPicture(number)) return;
    const TextureMap& map = mapOf(number);
    const Vec2 size = reachOf(m, face, map).size;
    use.most = {std::max(use.most.x, size.x), std::max(use.most.y, size.y)};
  }

  // Whether a material is nothing but a colour, a picture of it with its transparency, and how it
  // reflects.
  static bool isSimple(const Material& m) {
    if (libraryEntryOf(m) || m.emissive != Vec3{}) return false;
    for (size_t l = 0; l < kTextureLayers; ++l) {
      const auto layer = static_cast<TextureLayer>(l);
      const bool same = layer == TextureLayer::Opacity && m.maps[l] == m.map(TextureLayer::Color);
      if (layer != TextureLayer::Color && !same && !m.maps[l].path.empty()) return false;
    }
    return true;
  }

  void choose() {
    for (size_t i = 0; i < uses_.size(); ++i) {
      Use& use = uses_[i];
      if (!use.used) continue;
      const Material& m = materialOf(i);
      const double most = std::max(use.most.x, use.most.y);
      if (isLaid(m) || !(most <= kMostRepeats + kRounding)) {
        ++out_.counts.repeating;
      } else if (!isSimple(m)) {
        ++out_.counts.special;
      } else if (std::optional<Cell> cell = cellOf(i)) {
        use.cell = cells_.size();
        cells_.push_back(std::move(*cell));
      } else {
        ++out_.counts.large;
      }
    }
  }

  // None for a picture that cannot be read, which the writer tells of.
  std::optional<Cell> cellOf(size_t number) const {
    Cell cell;
    cell.use = number;
    const Material& m = materialOf(number);
    const Use& use = uses_[number];
    if (!showsPicture(number)) {
      cell.image = {kPlain, kPlain, std::vector<uint8_t>(kPlain * kPlain * 4, 255)};
    } else {
      const std::string& path = m.map(TextureLayer::Color).path;
      Result<std::string> bytes = read_(path);
      if (!bytes.ok()) return std::nullopt;
      Result<ImageHeader> header = readImageHeader(*bytes);
      Result<Image> image = decodeImage(*bytes);
      if (!header.ok() || !image.ok()) return std::nullopt;
      cell.image = std::move(*image);
      cell.hasAlpha = header->hasAlpha && m.opacityMode != OpacityMode::Opaque &&
                      !m.map(TextureLayer::Opacity).path.empty();
      const auto repeats = [](double most) { return most > 1 + kRounding ? 2u : 1u; };
      cell.across = repeats(use.most.x);
      cell.up = repeats(use.most.y);
      while (std::max(cell.width(), cell.height()) > side_ / 2) cell.image = halved(cell.image);
    }
    tint(m, cell);
    return cell;
  }

  // The material's own colour and opacity become part of the picture. Colours are powers of light,
  // nearly, so what is multiplied as light may be multiplied as colours.
  static void tint(const Material& m, Cell& cell) {
    const double factor[3] = {m.color.x, m.color.y, m.color.z};
    const double opacity = m.opacityMode == OpacityMode::Opaque ? 1 : m.opacity;
    for (size_t i = 0; i < cell.image.rgba.size(); ++i) {
      uint8_t& v = cell.image.rgba[i];
      if (i % 4 < 3)
        v = byteOf(v / 255.0 * factor[i % 4]);
      else
        v = byteOf((cell.hasAlpha ? v / 255.0 : 1) * opacity);
    }
  }

  void place() {
    std::vector<PackedSize> sizes;
    for (const Cell& c : cells_) {
      sizes.push_back({c.width() + 2 * kBorder, c.height() + 2 * kBorder});
    }
    const Packing sheet = pack(sizes, side_);
    color_.width = sheet.width;
    color_.height = sheet.height;
    for (size_t i = 0; i < cells_.size(); ++i) {
      if (sheet.places[i]) {
        cells_[i].x = sheet.places[i]->x + kBorder;
        cells_[i].y = sheet.places[i]->y + kBorder;
      } else {
        uses_[cells_[i].use].cell.reset();
        ++out_.counts.large;
      }
    }
  }

  void draw() {
    const size_t bytes = static_cast<size_t>(color_.width) * color_.height * 4;
    color_.rgba.assign(bytes, 255);
    surface_ = color_;
    bool alpha = false;
    for (const Cell& c : cells_) {
      if (!uses_[c.use].cell) continue;
      const Material& m = materialOf(c.use);
      alpha = alpha || isTransparent(c);
      const uint8_t surface[4] = {255, byteOf(m.roughness), byteOf(m.metallic), 255};
      paint(c, surface);
    }
    out_.pictures[kColorPath] = encodePng(color_, alpha ? 4 : 3).value();
    if (differs()) out_.pictures[kSurfacePath] = encodePng(surface_, 3).value();
  }

  // With its border: a picture that stands once ends in its own edge there, one that repeats goes
  // on.
  void paint(const Cell& c, const uint8_t* surface) {
    const auto clampTo = [](int64_t v, uint32_t size, bool repeats) {
      const auto n = static_cast<int64_t>(size);
      if (repeats) return static_cast<uint32_t>(((v % n) + n) % n);
      return static_cast<uint32_t>(std::clamp<int64_t>(v, 0, n - 1));
    };
    const int64_t border = kBorder;
    for (int64_t y = -border; y < c.height() + border; ++y) {
      work(c.width());
      // Repeats stand on the lower edge, from which v counts.
      const int64_t row = y - (c.height() - c.image.height);
      for (int64_t x = -border; x < c.width() + border; ++x) {
        const uint8_t* const pixel = c.image.at(clampTo(x, c.image.width, c.across > 1),
                                                clampTo(row, c.image.height, c.up > 1));
        const size_t at =
            (static_cast<size_t>(c.y + y) * color_.width + static_cast<size_t>(c.x + x)) * 4;
        std::copy(pixel, pixel + 4, color_.rgba.begin() + static_cast<std::ptrdiff_t>(at));
        std::copy(surface, surface + 4, surface_.rgba.begin() + static_cast<std::ptrdiff_t>(at));
      }
    }
  }

  bool isTransparent(const Cell& c) const {
    const Material& m = materialOf(c.use);
    return m.opacityMode != OpacityMode::Opaque && (m.opacity < 1 || c.hasAlpha);
  }

  // Whether the merged materials differ in how they reflect.
  bool differs() const {
    std::set<std::pair<double, double>> kinds;
    for (const Cell& c : cells_) {
      const Material& m = materialOf(c.use);
      if (uses_[c.use].cell) kinds.emplace(m.roughness, m.metallic);
    }
    return kinds.size() > 1;
  }

  // The material of the atlas that stands for a cell's.
  uint32_t mergedOf(const Cell& c) {
    const Material& from = materialOf(c.use);
    const bool clear = isTransparent(c);
    const bool mask = clear && from.opacityMode == OpacityMode::Mask;
    const Kind kind{clear, mask ? from.opacityCutoff : -1, from.doubleSided};
    const auto [at, fresh] =
        kinds_.try_emplace(kind, static_cast<uint32_t>(out_.scene.materials.size()));
    if (!fresh) return at->second;
    Material m;
    m.name = mask ? "atlas_mask" : clear ? "atlas_blend" : "atlas";
    if (!from.doubleSided) m.name += "_single";
    m.doubleSided = from.doubleSided;
    m.opacityMode = !clear ? OpacityMode::Opaque : from.opacityMode;
    m.opacityCutoff = from.opacityCutoff;
    m.map(TextureLayer::Color).path = kColorPath;
    if (clear) m.map(TextureLayer::Opacity).path = kColorPath;
    m.roughness = from.roughness;
    m.metallic = from.metallic;
    if (out_.pictures.contains(kSurfacePath)) {
      m.roughness = m.metallic = 1;
      m.map(TextureLayer::Roughness).path = m.map(TextureLayer::Metallic).path = kSurfacePath;
    }
    out_.scene.materials.push_back(std::move(m));
    return at->second;
  }

  // Gives every leaf with a merged material the mesh and the materials that show the atlas.
  void replace() {
    for (const Cell& c : cells_) {
      if (uses_[c.use].cell) ++out_.counts.merged;
    }
    std::map<Pair, Pair> made;
    for (const Pair& pair : pairs_) made.emplace(pair, replaced(pair));
    for (Leaf& l : out_.scene.leaves) {
      std::tie(l.mesh, l.materials) = made.at({l.mesh, l.materials});
    }
    out_.counts.into = static_cast<uint32_t>(kinds_.size());
  }

  Pair replaced(const Pair& pair) {
    const Mesh& from = *from_.meshes[pair.first];
    std::vector<uint32_t> list;
    bool merges = false;
    for (const MeshFace& f : from.faces) {
      if (f.materialSlot >= list.size()) list.resize(f.materialSlot + 1u, kNoMaterial);
      const uint32_t material = materialAt(pair, f.materialSlot);
      const Cell* const cell = cellAt(from, material);
      list[f.materialSlot] = cell ? mergedOf(*cell) : material;
      merges = merges || cell;
    }
    if (!merges) return pair;
    Mesh mesh = from;
    if (!mesh.hasUv(0)) mesh.uvs[0].resize(mesh.corners.size());
    for (size_t f = 0; f < from.faceCount(); ++f) {
      const uint32_t material = materialAt(pair, from.faces[f].materialSlot);
      if (const Cell* const cell = cellAt(from, material)) setPlace(from, f, *cell, mesh.uvs[0]);
    }
    const auto number = static_cast<uint32_t>(out_.scene.meshes.size());
    out_.scene.meshes.push_back(makeRef<Mesh>(std::move(mesh)));
    const auto [at, fresh] =
        lists_.try_emplace(list, static_cast<uint32_t>(out_.scene.materialLists.size()));
    if (fresh) out_.scene.materialLists.push_back(std::move(list));
    return {number, at->second};
  }

  const Cell* cellAt(const Mesh& m, uint32_t material) const {
    if (material == kNoMaterial) return nullptr;
    const Use& use = uses_[useOf(m, material)];
    return use.cell ? &cells_[*use.cell] : nullptr;
  }

  void setPlace(const Mesh& m, size_t face, const Cell& c, std::vector<Vec2>& uvs) const {
    const bool plain = !showsPicture(c.use);
    const TextureMap& map = mapOf(c.use);
    const Vec2 from = plain ? Vec2{} : reachOf(m, face, map).from;
    forEachCorner(m, face, [&](uint32_t corner) {
      Vec2 at{c.width() / 2.0, c.height() / 2.0};
      if (!plain) {
        const Vec2 on = placeOn(map, m.uvs[0][corner]) - from;
        at = {std::clamp<double>(on.x * c.image.width, 0, c.width()),
              std::clamp<double>(on.y * c.image.height, 0, c.height())};
      }
      uvs[corner] = {(c.x + at.x) / color_.width, 1 - (c.y + c.height() - at.y) / color_.height};
    });
  }

  /// Whether it is clear, from which opacity on where it is a mask, whether it has two sides.
  using Kind = std::tuple<bool, double, bool>;

  const Scene& from_;
  const TextureReader& read_;
  uint32_t side_;
  std::vector<Use> uses_;
  std::vector<Cell> cells_;
  /// Meshes with their lists of materials, as leaves have them.
  std::set<Pair> pairs_;
  Image color_, surface_;
  std::map<Kind, uint32_t> kinds_;
  std::map<std::vector<uint32_t>, uint32_t> lists_;
  AtlasScene out_;
};

}  // namespace

AtlasScene withAtlas(const Scene& scene, const TextureReader& read, uint32_t side) {
  return AtlasMaker(scene, read, side).run();
}

}  // namespace gable
