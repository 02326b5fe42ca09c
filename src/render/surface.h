// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// How a surface answers light: materials as the tracer keeps them, and one shaded point.
//
// A surface is a Lambert body under a GGX coat (4 % facing reflection, as metallic turns it into
// the base colour), a share of which lets light through. Thin cut-out sheets (double sided, with an
// opacity map or in mask mode: leaves) also let a fifth of the light through diffusely, and so does
// what rules call foliage. Water is a coat with waves over what lies in it; its opacity is the
// share of the light that a metre of it takes.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "material/material.h"
#include "render/render.h"
#include "render/sampler.h"
#include "render/vec3f.h"

namespace gable::rt {

struct TextureLookup {
  /// Index into TextureTable::images, or -1.
  int32_t image = -1;
  /// u' = uu * u + uv * v + u0, the same for v.
  float uu = 1, uv = 0, u0 = 0, vu = 0, vv = 1, v0 = 0;
  bool operator==(const TextureLookup&) const = default;
};

/// The roughest surface that can be a pane.
constexpr float kPaneRoughness = 0.2f;

/// What a surface is by the name that rules gave its shape.
enum class Matter : uint8_t { Plain, Foliage, Water, Smoke };

/// By the words of a name: a Pond or DeepWater is Water, Foliage or PalmFronds are Foliage, Smoke
/// or SteamPuff are Smoke.
Matter matterNamed(std::string_view name);

struct SurfaceMaterial {
  /// Index into Scene::materials.
  uint32_t source = 0;
  Matter matter = Matter::Plain;
  /// Smooth enough for a window: at night there may be light behind it. Where a texture says how
  /// rough it is, parts of it may be too rough (Surface::pane).
  bool pane = false;
  Vec3f base{1, 1, 1};
  Vec3f emissive;
  /// With the mean of its texture.
  Vec3f meanEmissive;
  float roughness = 1, metallic = 0, opacity = 1;
  /// With the mean of its texture.
  float meanRoughness = 1;
  float facing = 0.04f;
  float transmission = 0;
  float cutoff = 0.5f;
  bool mask = false;
  /// Textures lie in metres, by the face (material/laying.h).
  bool laid = false;
  /// Some light may pass straight through.
  bool clear = false;
  /// Bit s: uv set s is needed.
  uint16_t uvSets = 0;
  std::array<TextureLookup, kTextureLayers> maps;
};

/// Whether the numbers of such a texture are sRGB.
constexpr bool isColor(TextureLayer layer) {
  return layer == TextureLayer::Color || layer == TextureLayer::Dirt ||
         layer == TextureLayer::Emissive;
}

struct TextureTable {
  std::vector<const TextureImage*> images;
  /// Whether any texel of the image lets light through.
  std::vector<bool> hasAlpha;
  /// The same images, each a quarter as wide as the one before it, the last kCoarse pixels a side
  /// at most: what is far away has the mean of its texels, and these stay in the processor's cache.
  std::vector<std::vector<TextureImage>> coarser;
  static constexpr uint32_t kCoarse = 32;

  /// `isColor`: its numbers are sRGB.
  void add(const TextureImage& image, bool isColor = true);
  /// Repeating, alpha last; `decode` takes the colours from sRGB to linear light. Of what is as
  /// wide as `width`, in the unit of `uv`, the nearest texel of the coarsest image whose texels are
  /// no wider; where all are, bilinear.
  std::array<float, 4> sample(const TextureLookup& map, Vec2f uv, bool decode,
                              float width = 0) const;
  /// Of all texels in linear light.
  Vec3f mean(int32_t image) const;
  /// Of all texels, as textures of roughness hold it.
  float meanRoughness(int32_t image) const;
};

/// Materials with their textures looked up; those without images have no lookups.
void makeMaterials(const std::vector<Material>& from, const TextureSource* source,
                   std::vector<SurfaceMaterial>& to, TextureTable& textures);

/// The same material for shapes of another matter; unchanged where it cannot be that.
SurfaceMaterial madeOf(const SurfaceMaterial& material, Matter matter);

/// How much a shell about smoke covers where it is met at an angle of this cosine: what lies within
/// it takes light by the length of the way through, so a ball has no outline. `opacity` is that
/// of a shell that is met straight on.
float opacityOfSmoke(float opacity, float cosine);

struct Surface {
  Vec3f point;
  /// Both on the viewer's side; `facet` of the triangle, `normal` for shading.
  Vec3f facet, normal;
  Vec3f base, emissive;
  float roughness = 1, metallic = 0, opacity = 1, facing = 0.04f, transmission = 0;
  /// Of water: metres after which 63 % of the light is gone; 0: nothing is seen in it.
  float clearWater = 0;
  Matter matter = Matter::Plain;
  bool pane = false;
  /// The picture's own ground, no part of the scene.
  bool isGround = false;
  /// Where a plane cuts through something solid.
  bool isCut = false;
  /// Index into World::materials, and the number of the piece among all; kNone for the ground.
  uint32_t material = 0xffffffff, piece = 0xffffffff;
};

/// The parts of a surface's answer towards `view`, worked out once a point.
struct Lobes {
  Vec3f diffuse;
  Vec3f facing;
  Vec3f through;
  float alpha = 1;
  /// Chance of sampling the coat.
  float coatChance = 0;
  /// Share of light the coat sends back towards the viewer, by colour.
  Vec3f coat;
};

Lobes lobesOf(const Surface& s, const Vec3f& view);
/// Reflected radiance towards `view` for unit irradiance density from `light`, cosine included.
Vec3f evaluate(const Surface& s, const Lobes& lobes, const Vec3f& view, const Vec3f& light);

struct Scatter {
  Vec3f direction;
  /// Value * cosine / density; black when the path ends here.
  Vec3f weight;
  /// The direction came from the coat.
  bool coat = false;
};
Scatter scatter(const Surface& s, const Lobes& lobes, const Vec3f& view, float pick, Vec2f u);

}  // namespace gable::rt
