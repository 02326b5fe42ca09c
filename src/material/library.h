// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The library of materials: what each is made of, with true sizes. A material is a tile of so many
// metres that repeats in both directions; io/image/surface.h draws its pictures from the same
// entry. Lengths in metres, colours sRGB as 0xrrggbb.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/status.h"
#include "material/material.h"

namespace gable {

/// How a surface is built up; each kind reads the layout in its own way (io/image/surface.h).
enum class SurfaceKind : uint8_t {
  /// Units in courses with joints: bricks, blocks, slabs, panels.
  Masonry,
  /// Stones that touch: rubble, cobbles, gravel, rock, plates of bark.
  Stones,
  /// Ridges that part and meet along v, furrows between them: bark.
  Furrows,
  /// Patches over one another, each with a rim of its own: bark that sheds.
  Flakes,
  /// Mineral ground or coat: plaster, concrete, asphalt, sand, paint.
  Grain,
  /// Boards beside one another along v.
  Boards,
  /// Boards along u that lap over the one below.
  LappedBoards,
  /// Courses that lie over the one below: slates, shingles, flat tiles.
  Courses,
  /// Rolls up the slope in courses: clay tiles.
  Rolls,
  /// Sheets with standing seams up the slope.
  Seams,
  /// Many blades or straws.
  Strands,
  /// Many leaves.
  Leaves,
  /// Posts, rails and braces with filled panels.
  Frame,
  /// Panes between mullions.
  Panes,
  /// Waves.
  Water,
  /// Threads over and under.
  Weave,
};

enum class Bond : uint8_t { Stretcher, Header, Flemish, English, Stack, Random };

/// What a surface has beside its layout.
enum class SurfaceExtra : uint8_t {
  None,
  /// Masonry: holes of the ties of formwork.
  Ties,
  /// Grain: chips of stone in tar.
  Chips,
  /// Grain: ripples of wind, `joint` metres long.
  Ripples,
};

struct LibraryMaterial {
  const char* name;
  /// One sentence for lists.
  const char* doc;
  SurfaceKind kind;
  /// The tile.
  double width, height;
  /// Units across and up the tile, whole numbers; how much their borders wander, 0 to 1.
  int columns, rows;
  Bond bond;
  double wander;
  /// Width of joints or seams, and how high units stand above what lies between.
  double joint, relief;
  /// The colour that a tint replaces, the one it varies towards, and that of joints.
  uint32_t color, second, between;
  /// Share of the variation between units, and of that within them, 0 to 1.
  double variety, grain;
  /// Height of the grain.
  double grainHeight;
  double roughness;
  double metallic = 0;
  /// KHR_materials_ior, KHR_materials_transmission, KHR_materials_clearcoat; as glTF has them by
  /// default.
  double ior = 1.5, transmission = 0, clearcoat = 0;
  SurfaceExtra extra = SurfaceExtra::None;
};

/// Sorted by name.
std::span<const LibraryMaterial> materialLibrary();
/// Null when there is none.
const LibraryMaterial* libraryMaterial(std::string_view name);
/// "did you mean 'x'?", or where names are listed.
std::string materialHint(std::string_view name);
/// Fails with the code tint-capped where a tint is seen to be brighter than the material in a
/// channel: a picture can be made darker, but no brighter. Materials of others take any tint.
Status takesTint(std::string_view name, const Vec3& tint);

/// The pictures of a library material. Surface: occlusion in red, roughness in green, metalness in
/// blue.
enum class MaterialPicture : uint8_t { Color, Normal, Surface };
/// "builtin:materials/brick.flemish_color.jpg".
std::string materialPicturePath(const LibraryMaterial& m, MaterialPicture picture);
struct PictureName {
  const LibraryMaterial* material = nullptr;
  MaterialPicture picture = MaterialPicture::Color;
};
/// Without a material where the path is none of them.
PictureName materialPictureOf(std::string_view path);

/// The library's material in a tint, or in its own colour where `tint` is null. Its textures count
/// in metres. A channel of the tint that is brighter than the material's own stays at that.
Material laidMaterial(const LibraryMaterial& m, const Vec3* tint);

/// What the shader of a material is called whose textures are laid on faces in metres
/// (material/laying.h): this, and behind it the name of its entry.
inline constexpr std::string_view kLaidShader = "gable:";
inline bool isLaid(const Material& m) { return m.shader.starts_with(kLaidShader); }
/// Null for other materials, and for those that are not of the library.
const LibraryMaterial* libraryEntryOf(const Material& m);

}  // namespace gable
