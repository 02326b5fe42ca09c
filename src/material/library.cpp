// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Sizes: bricks of 215 x 65 mm with joints of 10 mm; exposures of roofs, seams and boards as they
// are laid.
#include "material/library.h"

#include <algorithm>
#include <array>
#include <vector>

#include "base/text.h"

namespace gable {

namespace {

using K = SurfaceKind;
using B = Bond;
using X = SurfaceExtra;

// name, doc, kind, tile, columns, rows, bond, wander, joint, relief, colours, variety, grain, grain
// height, roughness, metallic, ior, transmission, clearcoat.
constexpr LibraryMaterial kLibrary[] = {
    {"ashlar", "Dressed limestone in courses of 0.3 m.", K::Masonry, 2.4, 2.4, 4, 8, B::Random, 0.5,
     0.006, 0.003, 0xe1d5bc, 0xc9b995, 0xb3a68d, 0.5, 0.35, 0.0008, 0.85},
    {"asphalt.new", "Dark asphalt.", K::Grain, 2,    2,   300,   300,  B::Stack, 0,   0, 0.003,
     0x3b3c3e,      0x55565a,        0x26272a, 0.15, 0.9, 0.002, 0.88, 0,        1.5, 0, 0,
     X::Chips},
    {"asphalt.worn",
     "Asphalt bleached and cracked by years.",
     K::Grain,
     4,
     4,
     400,
     400,
     B::Random,
     0,
     0.008,
     0.004,
     0x77766f,
     0x918f88,
     0x3a3a38,
     0.4,
     0.8,
     0.002,
     0.92,
     0,
     1.5,
     0,
     0,
     X::Chips},
    {"bark.birch", "Birch bark: white, with dark lenticels.", K::Stones, 1, 1, 3, 22, B::Stack, 0.9,
     -0.014, 0.002, 0xe4e0d6, 0xc3bcae, 0x3c3731, 0.35, 0.35, 0.0015, 0.7},
    {"bark.oak", "Oak bark: long ridges, deep furrows.", K::Furrows, 1, 1, 11, 2, B::Stack, 0.8,
     0.3, 0.02, 0x8a7a67, 0x9f9180, 0x3d342b, 0.6, 0.6, 0.005, 0.95},
    {"bark.palm", "Palm stem: the stumps of old leaves.", K::Furrows, 1, 1, 6, 6, B::Stack, 0.35,
     0.3, 0.02, 0x94826a, 0xa89880, 0x40352a, 0.6, 0.7, 0.004, 0.95},
    {"bark.pine", "Pine bark: long red plates between dark furrows.", K::Furrows, 1, 1, 8, 3,
     B::Stack, 0.9, 0.3, 0.02, 0x9c6a4a, 0xb88a68, 0x3f2a20, 0.7, 0.6, 0.005, 0.92},
    {"bark.plane", "Plane bark: flakes of grey, olive and cream.", K::Flakes, 1, 1, 7, 4, B::Stack,
     1, 0, 0.0012, 0xcfc5a6, 0x8b8a70, 0x98907c, 0.9, 0.35, 0.0008, 0.85},
    {"bark.smooth", "Smooth grey bark of young trees.", K::Stones, 1, 1, 2, 16, B::Stack, 0.9,
     -0.014, 0.0015, 0x8f8a80, 0x77726a, 0x5b554c, 0.35, 0.45, 0.0015, 0.85},
    {"boards.lap", "Painted weatherboards, 0.15 m to the weather: they take any tint.",
     K::LappedBoards, 2.4, 1.2, 1, 8, B::Stack, 0, 0.002, 0.014, 0xf1eee6, 0xdcd8cd, 0x524e45, 0.12,
     0.22, 0.0004, 0.6},
    {"boards.upright", "Upright boards of 0.15 m.", K::Boards, 1.2, 2.4, 8, 1, B::Stack, 0, 0.006,
     0.01, 0x9a6f48, 0x7a5232, 0x241a12, 0.5, 0.6, 0.0008, 0.75},
    {"brick.english", "Brown brick in English bond: courses of stretchers and headers in turns.",
     K::Masonry, 1.35, 1.35, 6, 18, B::English, 0, 0.01, 0.005, 0x8d6247, 0x6c4634, 0xb9b0a2, 0.6,
     0.4, 0.0012, 0.88},
    {"brick.flemish", "Red-brown brick in Flemish bond: stretchers and headers in turns.",
     K::Masonry, 1.35, 1.35, 4, 18, B::Flemish, 0, 0.01, 0.005, 0xa05f49, 0x7b4234, 0xc8c0b2, 0.6,
     0.4, 0.0012, 0.88},
    {"brick.header", "Dark clinker in header bond.", K::Masonry, 1.35, 1.35, 12, 18, B::Header, 0,
     0.01, 0.004, 0x6b4a42, 0x45312e, 0x8f8a82, 0.7, 0.35, 0.001, 0.6},
    {"brick.stack", "Yellow brick in stack bond: joints over joints.", K::Masonry, 1.35, 1.35, 6,
     18, B::Stack, 0, 0.01, 0.005, 0xc8b084, 0xa98d63, 0x958b7c, 0.5, 0.35, 0.0012, 0.88},
    {"brick.stretcher", "Orange-red brick in stretcher bond.", K::Masonry, 1.35, 1.35, 6, 18,
     B::Stretcher, 0, 0.01, 0.005, 0xb0664d, 0x8b4735, 0xcfc7b9, 0.55, 0.4, 0.0012, 0.88},
    {"brick.white", "Brick painted white: it takes any tint.", K::Masonry, 1.35, 1.35, 4, 18,
     B::Flemish, 0, 0.01, 0.003, 0xf1eee6, 0xe6e1d6, 0xe2ddd2, 0.3, 0.12, 0.0008, 0.7},
    {"cobble", "Round cobbles of 0.12 m.", K::Stones, 2, 2, 16, 16, B::Stack, 0.6, 0.018, 0.025,
     0x98928a, 0x7a756f, 0x4a443c, 0.7, 0.4, 0.0012, 0.8},
    {"concrete.cast",
     "Concrete from boards, with holes of the ties.",
     K::Masonry,
     2.4,
     2.4,
     2,
     12,
     B::Random,
     0.5,
     0.003,
     0.0015,
     0xb1afa9,
     0xa19f98,
     0x8d8b85,
     0.35,
     0.3,
     0.0008,
     0.9,
     0,
     1.5,
     0,
     0,
     X::Ties},
    {"concrete.panel", "Prefabricated panels of 2.4 x 1.2 m.", K::Masonry, 2.4, 2.4, 1, 2, B::Stack,
     0, 0.016, 0.014, 0xc4bfb4, 0xb3aea3, 0x4c4a46, 0.2, 0.3, 0.0006, 0.88},
    {"copper.new", "Bright copper with standing seams.", K::Seams, 1.2, 2.4, 2, 1, B::Stack, 0,
     0.014, 0.025, 0xc8855c, 0xa9683f, 0x8a5433, 0.25, 0.1, 0.0001, 0.38, 0.9},
    {"copper.old", "Green copper with standing seams.", K::Seams, 1.2, 2.4, 2, 1, B::Stack, 0,
     0.014, 0.025, 0x86b5a2, 0x5d8f7f, 0x4d5f52, 0.5, 0.6, 0.0004, 0.75, 0.1},
    {"fabric", "Canvas of blinds and awnings.", K::Weave, 0.25, 0.25, 64, 64, B::Stack, 0, 0.0006,
     0.0008, 0xe2d9c6, 0xcfc3aa, 0xa4977f, 0.3, 0.4, 0.0002, 0.92},
    {"flags", "Flagstones of 0.6 m.", K::Masonry, 3.6, 3.6, 5, 6, B::Random, 0.55, 0.012, 0.006,
     0xbab4a8, 0xa39c8f, 0x77705f, 0.6, 0.35, 0.0012, 0.85},
    {"glass",  "Clear glass.", K::Panes, 3,   3,   1,      1,    B::Stack, 0,    0,  0,
     0x54707c, 0x6d8994,       0x54707c, 0.2, 0.1, 0.0003, 0.05, 0,        1.52, 0.8},
    {"glass.curtain",
     "Curtain wall: modules of 1.5 m, storeys of 3.9 m.",
     K::Panes,
     6,
     7.8,
     4,
     2,
     B::Stack,
     0,
     0.06,
     0.06,
     0x5f8490,
     0x41606c,
     0x6b7074,
     0.5,
     0.1,
     0.0004,
     0.06,
     0,
     1.52,
     0,
     0.6},
    {"gravel", "Gravel of 20 to 40 mm.", K::Stones, 1.6, 1.6, 52, 52, B::Stack, 0.95, 0.006, 0.014,
     0xd6ccb6, 0xa99f8c, 0x766b5a, 0.9, 0.3, 0.0006, 0.92},
    {"hedge", "A clipped hedge.", K::Leaves, 1.2, 1.2, 90, 90, B::Stack, 0, 0.03, 0.05, 0x5b7a3a,
     0x7f9a4c, 0x1c2a12, 0.8, 0.2, 0.001, 0.7},
    {"ivy", "Ivy on a wall.", K::Leaves, 1.6, 1.6, 40, 40, B::Stack, 0, 0.075, 0.06, 0x4d6f35,
     0x6f8f4a, 0x1a2614, 0.8, 0.2, 0.001, 0.55},
    {"lawn", "Cut grass.", K::Strands, 1.6, 1.6, 210, 210, B::Random, 1, 0.05, 0.025, 0x7b9a48,
     0x9aac5c, 0x2f3d1c, 0.8, 0.2, 0.002, 0.9},
    {"meadow", "High grass with flowers.", K::Strands, 2.4, 2.4, 170, 170, B::Random, 1, 0.16, 0.09,
     0x8f9a52, 0xb7a868, 0x38421f, 0.9, 0.3, 0.003, 0.92},
    {"metal.painted",
     "Painted sheet: it takes any tint.",
     K::Grain,
     1,
     1,
     60,
     60,
     B::Stack,
     0,
     0,
     0.0002,
     0xe8e8e6,
     0xdcdcda,
     0xd2d2d0,
     0.1,
     0.06,
     0.0001,
     0.35,
     0,
     1.5,
     0,
     0.5},
    {"plaster.clean", "Float-finished plaster: it takes any tint.", K::Grain, 2.4, 2.4, 260, 260,
     B::Stack, 0, 0, 0.002, 0xf4f0e6, 0xe9e4d8, 0xded8ca, 0.15, 0.12, 0.0012, 0.92},
    {"plaster.weathered", "Plaster with stains, runs and cracks.", K::Grain, 3.6, 3.6, 300, 300,
     B::Random, 0, 0.004, 0.003, 0xe3d9c4, 0xc2b598, 0x8d8170, 0.8, 0.2, 0.0015, 0.94},
    {"rock", "A face of rock.", K::Stones, 4, 4, 7, 5, B::Stack, 1, -0.004, 0.05, 0x97928a,
     0x7c766d, 0x45413b, 0.6, 0.9, 0.04, 0.92},
    {"rubble", "A wall of rubble with wide joints.", K::Stones, 2.4, 2.4, 8, 12, B::Stack, 0.85,
     0.03, 0.03, 0xc9bda8, 0xa09480, 0xe2d8c3, 0.8, 0.5, 0.006, 0.92},
    {"rust", "Rusted steel.", K::Grain, 1.5, 1.5, 120, 120, B::Random, 0, 0, 0.001, 0xa0603a,
     0x6b3a24, 0x4a2b20, 0.9, 0.7, 0.0008, 0.88, 0.2},
    {"sand",    "Sand with ripples of wind.",
     K::Grain,  1.6,
     1.6,       300,
     300,       B::Stack,
     0,         0.1,
     0.008,     0xdcc9a0,
     0xc9b388,  0xb39c72,
     0.3,       0.35,
     0.001,     0.96,
     0,         1.5,
     0,         0,
     X::Ripples},
    {"sett", "Setts of 0.1 m in rows.", K::Masonry, 1.6, 1.6, 14, 16, B::Random, 0.3, 0.012, 0.012,
     0x8c8882, 0x6c6964, 0x4f483e, 0.6, 0.4, 0.0015, 0.8},
    {"shingles.asphalt", "Asphalt shingles, 0.14 m to the weather.", K::Courses, 2.24, 2.24, 7, 16,
     B::Random, 0.5, 0.004, 0.006, 0x8f8a84, 0x67625d, 0x3b3835, 0.7, 0.8, 0.0012, 0.95},
    {"shingles.wood", "Split shingles of larch, 0.16 m to the weather.", K::Courses, 1.92, 1.92, 16,
     12, B::Random, 0.7, 0.006, 0.012, 0x94826a, 0x6f604c, 0x2d251c, 0.8, 0.5, 0.0012, 0.88},
    {"slate", "Slates of 0.25 m, 0.2 m to the weather.", K::Courses, 2, 2, 8, 10, B::Stretcher, 0,
     0.004, 0.007, 0x6a717a, 0x545a62, 0x23262a, 0.6, 0.3, 0.0008, 0.55},
    {"soil", "Dug soil.", K::Stones, 1.6, 1.6, 34, 34, B::Stack, 1, -0.002, 0.02, 0x6b5541,
     0x4d3b2c, 0x33271d, 0.8, 0.8, 0.006, 0.97},
    {"thatch", "Thatch of reed.", K::Strands, 1.6, 1.6, 130, 130, B::Stack, 0.12, 0.3, 0.02,
     0xb39a68, 0x8c7950, 0x4a3d27, 0.8, 0.2, 0.001, 0.95},
    {"tile.flat", "Flat clay tiles with round tails, 0.15 m to the weather.", K::Courses, 1.8, 1.8,
     10, 12, B::Header, 0, 0.003, 0.012, 0xb0604a, 0x8a4534, 0x3c1d16, 0.6, 0.3, 0.0006, 0.85},
    {"tile.roman", "Roman tiles: a flat pan and a roll.", K::Rolls, 1.8, 1.75, 6, 5, B::Header, 0.3,
     0.09, 0.045, 0xbf6e4c, 0x9a5238, 0x4a2418, 0.6, 0.3, 0.0006, 0.85},
    {"tile.spanish", "Barrel tiles, covers over pans.", K::Rolls, 1.76, 1.75, 8, 5, B::Stack, 0.5,
     0.12, 0.07, 0xc98a62, 0xa8643f, 0x4d2a1a, 0.8, 0.35, 0.0006, 0.88},
    {"timber.frame", "Oak frame with plastered panels.", K::Frame, 2.4, 2.4, 2, 2, B::Stack, 0,
     0.16, 0.012, 0xefe8d8, 0xe2d9c4, 0x4a3524, 0.1, 0.1, 0.0012, 0.9},
    {"water",  "Water with small waves.",
     K::Water, 4,
     4,        9,
     9,        B::Stack,
     0,        0,
     0.005,    0x3a6670,
     0x2b515b, 0x2b515b,
     0.3,      0.1,
     0.002,    0.04,
     0,        1.33},
    {"zinc.seam", "Zinc with standing seams every 0.6 m.", K::Seams, 1.2, 2.4, 2, 1, B::Stack, 0,
     0.014, 0.025, 0x9ea6ad, 0x8a9299, 0x6c747b, 0.3, 0.25, 0.0002, 0.5, 0.6},
};

constexpr std::string_view kFolder = "builtin:materials/";
constexpr std::array<std::string_view, 3> kEndings{"_color.jpg", "_normal.jpg", "_surface.jpg"};

std::vector<std::string_view> names() {
  std::vector<std::string_view> out;
  for (const LibraryMaterial& m : kLibrary) out.push_back(m.name);
  return out;
}

Vec3 rgbOf(uint32_t hex) {
  return {(hex >> 16 & 255) / 255.0, (hex >> 8 & 255) / 255.0, (hex & 255) / 255.0};
}

}  // namespace

std::span<const LibraryMaterial> materialLibrary() { return kLibrary; }

const LibraryMaterial* libraryMaterial(std::string_view name) {
  const auto at =
      std::lower_bound(std::begin(kLibrary), std::end(kLibrary), name,
                       [](const LibraryMaterial& m, std::string_view n) { return m.name < n; });
  return at != std::end(kLibrary) && at->name == name ? &*at : nullptr;
}

Status takesTint(std::string_view name, const Vec3& tint) {
  constexpr double kSeen = 0.1;
  const LibraryMaterial* const m = libraryMaterial(name);
  if (!m) return {};
  const Vec3 own = rgbOf(m->color);
  if (std::max({tint.x - own.x, tint.y - own.y, tint.z - own.z}) < kSeen) return {};
  const Vec3 made{std::min(tint.x, own.x), std::min(tint.y, own.y), std::min(tint.z, own.z)};
  return Status::failure("tint-capped",
                         "the tint " + colorText(tint) + " is brighter than the material '" +
                             std::string(name) + "': the colour becomes " + colorText(made),
                         "take a darker tint, or a material that takes any: 'plaster.clean', "
                         "'brick.white', 'boards.lap' or 'metal.painted'");
}

std::string materialHint(std::string_view given) {
  const std::string name = lowerCase(given);
  const std::string hint =
      libraryMaterial(name) ? "did you mean '" + name + "'?" : didYouMean(name, names());
  if (!hint.empty()) return hint;
  // "brick", or nearly: all that begin so.
  const auto kind = [](std::string_view n) { return n.substr(0, n.find('.')); };
  std::vector<std::string_view> kinds;
  for (const std::string_view n : names()) kinds.push_back(kind(n));
  const std::string_view own = kind(name);
  const bool known = std::find(kinds.begin(), kinds.end(), own) != kinds.end();
  const std::string meant = known ? std::string(own) : nearestName(own, kinds);
  std::string list;
  for (const std::string_view n : names()) {
    if (kind(n) == meant) list += (list.empty() ? "there are " : ", ") + std::string(n);
  }
  if (!list.empty()) return list;
  kinds.erase(std::unique(kinds.begin(), kinds.end()), kinds.end());
  for (const std::string_view k : kinds)
    list += (list.empty() ? "there are " : ", ") + std::string(k);
  return list + "; 'gable asset material' lists all";
}

std::string materialPicturePath(const LibraryMaterial& m, MaterialPicture picture) {
  return std::string(kFolder) + m.name + std::string(kEndings[static_cast<size_t>(picture)]);
}

PictureName materialPictureOf(std::string_view path) {
  if (!path.starts_with(kFolder)) return {};
  path.remove_prefix(kFolder.size());
  for (size_t i = 0; i < kEndings.size(); ++i) {
    if (!path.ends_with(kEndings[i])) continue;
    return {libraryMaterial(path.substr(0, path.size() - kEndings[i].size())),
            static_cast<MaterialPicture>(i)};
  }
  return {};
}

Material laidMaterial(const LibraryMaterial& m, const Vec3* tint) {
  Material out;
  out.name = m.name;
  out.shader = std::string(kLaidShader) + m.name;
  // The picture holds the material's own colour. Gamma is close to a power, which a quotient of
  // sRGB components goes through.
  const Vec3 own = rgbOf(m.color);
  for (size_t i = 0; i < 3 && tint; ++i) out.color[i] = std::min(1.0, (*tint)[i] / own[i]);
  out.metallic = m.metallic > 0 ? 1 : 0;
  const auto lay = [&](TextureLayer layer, MaterialPicture picture) {
    TextureMap& map = out.map(layer);
    map.path = materialPicturePath(m, picture);
    map.su = 1 / m.width;
    map.sv = 1 / m.height;
  };
  lay(TextureLayer::Color, MaterialPicture::Color);
  lay(TextureLayer::Normal, MaterialPicture::Normal);
  lay(TextureLayer::Occlusion, MaterialPicture::Surface);
  lay(TextureLayer::Roughness, MaterialPicture::Surface);
  // Where nothing is metal too: writers then have one picture for the three.
  lay(TextureLayer::Metallic, MaterialPicture::Surface);
  return out;
}

const LibraryMaterial* libraryEntryOf(const Material& m) {
  return isLaid(m) ? libraryMaterial(std::string_view(m.shader).substr(kLaidShader.size()))
                   : nullptr;
}

}  // namespace gable
