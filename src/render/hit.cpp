// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// From a hit to a surface: corner attributes are interpolated, textures read, normals turned to
// the viewer. Points on smooth faces are pushed out to the surface that their normals promise
// (Hanika 2021, Hacking the Shadow Terminator), so that low-polygon crowns cast no facet shadows on
// themselves.

#include <array>
#include <bit>

#include "material/laying.h"
#include "render/tracer.h"
#include "render/water.h"

namespace gable::rt {

namespace {

struct Corners {
  bool smooth = false;
  Vec3f normals[3];
  /// Where the pairs of each present set begin, by set.
  std::array<uint32_t, kUvSets> uvs;
  uint32_t present = 0;
};

/// Reads the head of a record; false when the triangle has none.
bool readCorners(const TriangleSet& set, uint32_t triangle, Corners& c) {
  const uint32_t first = set.triangles[triangle].attributes;
  if (first == kNone) return false;
  const uint32_t head = set.pool[first];
  uint32_t at = first + 1;
  c.smooth = head & 1;
  if (c.smooth) {
    for (uint32_t k = 0; k < 3; ++k) c.normals[k] = unpackNormal(set.pool[at + k]);
    at += 3;
  }
  c.present = head >> 1;
  for (size_t s = 0; s < kUvSets; ++s) {
    c.uvs[s] = at;
    if (c.present >> s & 1) at += 6;
  }
  return true;
}

Vec2f uvOfCorner(const TriangleSet& set, uint32_t first, uint32_t corner) {
  return {std::bit_cast<float>(set.pool[first + 2 * corner]),
          std::bit_cast<float>(set.pool[first + 2 * corner + 1])};
}

/// The set that a layer reads; -1 when the triangle has no coordinates for it.
int setOf(const Corners& c, size_t layer) {
  if (c.present >> layer & 1) return static_cast<int>(layer);
  return c.present & 1 ? 0 : -1;
}

Vec2f uvAt(const TriangleSet& set, const Corners& c, int uvSet, float u, float v) {
  const uint32_t first = c.uvs[static_cast<size_t>(uvSet)];
  const Vec2f a = uvOfCorner(set, first, 0), b = uvOfCorner(set, first, 1),
              d = uvOfCorner(set, first, 2);
  const float w = 1 - u - v;
  return {a.x * w + b.x * u + d.x * v, a.y * w + b.y * u + d.y * v};
}

Vec3 wide(const Vec3f& v) { return {v.x, v.y, v.z}; }

Vec3f turned(const Placement* p, const Vec3f& d) {
  return p ? p->x * d.x + p->y * d.y + p->z * d.z : d;
}

/// The corners of a triangle in the world.
std::array<Vec3f, 3> cornersAt(const TriangleSet& set, uint32_t triangle, const Placement* p) {
  std::array<Vec3f, 3> at;
  for (size_t k = 0; k < 3; ++k) {
    at[k] = turned(p, set.positions[set.triangles[triangle].corners[k]]);
    if (p) at[k] += p->origin;
  }
  return at;
}

/// Reads texture layers at one point of a triangle.
class LayerReader {
 public:
  LayerReader(const World& world, const SurfaceMaterial& material, const TriangleSet& set,
              const Corners& corners, float u, float v, float width = 0)
      : world_(world),
        material_(material),
        set_(set),
        corners_(corners),
        u_(u),
        v_(v),
        // How wide a texel is, is known only where textures lie in metres.
        width_(material.laid || width >= kNoDetails ? width : 0) {}

  /// Where a laid material's textures are read: at a point of the world, on a face with these axes.
  void lay(const FaceAxes& axes, const Vec3f& point) {
    const Vec2 metres = axes.at(wide(point));
    laidAt_ = {static_cast<float>(metres.x), static_cast<float>(metres.y)};
    last_ = nullptr;
  }

  bool read(TextureLayer layer, std::array<float, 4>& value) const {
    const size_t i = static_cast<size_t>(layer);
    const TextureLookup& map = material_.maps[i];
    if (map.image < 0) return false;
    const bool decode = isColor(layer);
    const int uvSet = material_.laid ? -1 : setOf(corners_, i);
    if (!material_.laid && uvSet < 0) return false;
    // Roughness, metalness and occlusion are often channels of one picture.
    const bool known = last_ && last_->image == map.image && lastSet_ == uvSet &&
                       lastIsColor_ == decode && *last_ == map;
    if (!known) {
      const Vec2f at = material_.laid ? laidAt_ : uvAt(set_, corners_, uvSet, u_, v_);
      lastValue_ = world_.textures.sample(map, at, decode, width_);
      last_ = &map;
      lastSet_ = uvSet;
      lastIsColor_ = decode;
    }
    value = lastValue_;
    return true;
  }

  float opacity() const {
    float opacity = material_.opacity;
    std::array<float, 4> texel;
    // One of them, as files that are written have it: both may be the same picture.
    if (read(TextureLayer::Opacity, texel)) {
      const int32_t image = material_.maps[static_cast<size_t>(TextureLayer::Opacity)].image;
      const bool alpha = world_.textures.hasAlpha[static_cast<size_t>(image)];
      opacity *= alpha ? texel[3] : luminance({texel[0], texel[1], texel[2]});
    } else if (read(TextureLayer::Color, texel)) {
      opacity *= texel[3];
    }
    if (material_.mask) opacity = opacity >= material_.cutoff ? 1.0f : 0.0f;
    return opacity;
  }

 private:
  const World& world_;
  const SurfaceMaterial& material_;
  const TriangleSet& set_;
  const Corners& corners_;
  float u_, v_;
  float width_;
  Vec2f laidAt_{0, 0};
  /// What was read last.
  mutable const TextureLookup* last_ = nullptr;
  mutable std::array<float, 4> lastValue_{};
  mutable int lastSet_ = -1;
  mutable bool lastIsColor_ = false;
};

Vec3f colorOf(const std::array<float, 4>& texel) { return {texel[0], texel[1], texel[2]}; }

/// The same for a laid material, whose directions follow from the face.
void bendLaidNormal(const FaceAxes& axes, const std::array<float, 4>& texel, Surface& s) {
  const Vec3f u{static_cast<float>(axes.u.x), static_cast<float>(axes.u.y),
                static_cast<float>(axes.u.z)};
  const Vec3f t = normalized(u - s.normal * dot(u, s.normal));
  const Vec3f up{static_cast<float>(axes.v.x), static_cast<float>(axes.v.y),
                 static_cast<float>(axes.v.z)};
  const Vec3f b = normalized(up - s.normal * dot(up, s.normal));
  const Vec3f n =
      t * (2 * texel[0] - 1) + b * (2 * texel[1] - 1) + s.normal * std::max(0.1f, 2 * texel[2] - 1);
  if (isFinite(n) && length(n) > 0) s.normal = normalized(n);
}

/// Bends the normal by the normal map, in the frame of the map's uv directions.
void bendNormal(const TriangleSet& set, const Corners& c, const Vec3f corner[3],
                const std::array<float, 4>& texel, Surface& s) {
  const int uvSet = setOf(c, static_cast<size_t>(TextureLayer::Normal));
  const uint32_t first = c.uvs[static_cast<size_t>(uvSet)];
  const Vec2f a = uvOfCorner(set, first, 0), b = uvOfCorner(set, first, 1),
              d = uvOfCorner(set, first, 2);
  const float du1 = b.x - a.x, dv1 = b.y - a.y, du2 = d.x - a.x, dv2 = d.y - a.y;
  const float det = du1 * dv2 - du2 * dv1;
  if (!(std::abs(det) > 1e-12f)) return;
  const Vec3f e1 = corner[1] - corner[0], e2 = corner[2] - corner[0];
  const Vec3f along = (e1 * dv2 - e2 * dv1) * (1 / det), up = (e2 * du1 - e1 * du2) * (1 / det);
  const Vec3f t = normalized(along - s.normal * dot(along, s.normal));
  const Vec3f bt = normalized(up - s.normal * dot(up, s.normal));
  const Vec3f n = t * (2 * texel[0] - 1) + bt * (2 * texel[1] - 1) +
                  s.normal * std::max(0.1f, 2 * texel[2] - 1);
  if (isFinite(n) && length(n) > 0) s.normal = normalized(n);
}

/// A shading normal that looks away from the viewer would darken the outline of smooth shapes.
void faceViewer(Surface& s, const Ray& ray) {
  const Vec3f view = -normalized(ray.direction);
  const float facing = dot(s.normal, view);
  if (facing < 0.02f) s.normal = normalized(s.normal + view * (0.02f - facing));
}

}  // namespace

float clearness(const World& world, const TriangleSet& set, uint32_t triangle, uint32_t placement,
                float u, float v) {
  const SurfaceMaterial& material = world.materials[set.triangles[triangle].material];
  if (material.matter == Matter::Water) return 1;
  Corners corners;
  readCorners(set, triangle, corners);
  LayerReader layers(world, material, set, corners, u, v);
  if (material.laid) {
    const Placement* const placed = placement == kNone ? nullptr : &world.placements[placement];
    const std::array<Vec3f, 3> at = cornersAt(set, triangle, placed);
    const Vec3f a = at[1] - at[0], b = at[2] - at[0];
    layers.lay(layingAxes(normalized(wide(cross(a, b)))), at[0] + a * u + b * v);
  }
  return 1 - layers.opacity();
}

namespace {

Surface shellAt(const World& world, const Hit& hit, const Ray& ray, float width) {
  const Placement* placement = hit.placement == kNone ? nullptr : &world.placements[hit.placement];
  const Part& part = world.parts[placement ? placement->part : 0];
  const TriangleSet& set = part.set(hit.clear);
  const TriangleSet::Triangle& triangle = set.triangles[hit.triangle];
  const SurfaceMaterial& m = world.materials[triangle.material];

  Surface s;
  s.base = m.base;
  s.emissive = m.emissive;
  s.roughness = m.roughness;
  s.metallic = m.metallic;
  s.opacity = m.opacity;
  s.facing = m.facing;
  s.transmission = m.transmission;
  s.matter = m.matter;
  s.pane = m.pane;
  s.material = triangle.material;
  s.piece = (placement ? placement->firstPiece : 0) + triangle.piece;
  s.point = ray.origin + ray.direction * hit.distance;
  s.facet = normalized(hit.normal);
  const bool behind = dot(s.facet, ray.direction) > 0;
  if (behind) s.facet = -s.facet;
  s.normal = s.facet;

  if (m.matter == Matter::Water) {
    makeWater(s, normalized(ray.direction), hit.distance, width);
    faceViewer(s, ray);
    return s;
  }

  Corners corners;
  if (!readCorners(set, hit.triangle, corners) && !m.laid) return s;
  const std::array<Vec3f, 3> at = cornersAt(set, hit.triangle, placement);
  const float w = 1 - hit.u - hit.v;
  if (corners.smooth) {
    Vec3f n[3];
    for (size_t k = 0; k < 3; ++k) {
      n[k] = turned(placement, corners.normals[k]);
      if (dot(n[k], s.facet) < 0) n[k] = -n[k];
    }
    const Vec3f normal = normalized(n[0] * w + n[1] * hit.u + n[2] * hit.v);
    if (dot(normal, normal) > 0) {
      s.normal = normal;
      const float weights[3] = {w, hit.u, hit.v};
      Vec3f lift;
      for (size_t k = 0; k < 3; ++k) {
        lift += n[k] * (weights[k] * std::max(0.0f, -dot(s.point - at[k], n[k])));
      }
      s.point += lift;
    }
  }

  // The holes of leaves and grilles are never coarse.
  LayerReader layers(world, m, set, corners, hit.u, hit.v, hit.clear ? 0 : width);
  FaceAxes axes;
  if (m.laid) {
    axes = layingAxes(normalized(wide(hit.normal)));
    layers.lay(axes, ray.origin + ray.direction * hit.distance);
  }
  std::array<float, 4> texel;
  if (layers.read(TextureLayer::Color, texel)) s.base *= colorOf(texel);
  if (layers.read(TextureLayer::Dirt, texel)) {
    s.base = mix(s.base, s.base * colorOf(texel), texel[3]);
  }
  if (layers.read(TextureLayer::Emissive, texel)) s.emissive *= colorOf(texel);
  if (layers.read(TextureLayer::Roughness, texel)) {
    s.roughness *= texel[1];
    // The bars between panes are not lit from behind.
    s.pane = m.pane && s.roughness < kPaneRoughness;
  }
  if (layers.read(TextureLayer::Metallic, texel)) s.metallic *= texel[2];
  if (layers.read(TextureLayer::Occlusion, texel)) s.base *= texel[0];
  if (width < kNoDetails && layers.read(TextureLayer::Normal, texel)) {
    if (m.laid)
      bendLaidNormal(axes, texel, s);
    else
      bendNormal(set, corners, at.data(), texel, s);
  }
  if (hit.clear) s.opacity = layers.opacity();

  faceViewer(s, ray);
  return s;
}

const TriangleSet& setAt(const World& world, const Hit& hit) {
  const uint32_t part = hit.placement == kNone ? 0 : world.placements[hit.placement].part;
  return world.parts[part].set(hit.clear);
}

}  // namespace

void fetchTriangle(const World& world, const Hit& hit) {
  __builtin_prefetch(&setAt(world, hit).triangles[hit.triangle]);
}

void fetchCorners(const World& world, const Hit& hit) {
  const TriangleSet& set = setAt(world, hit);
  const TriangleSet::Triangle& triangle = set.triangles[hit.triangle];
  __builtin_prefetch(&world.materials[triangle.material]);
  if (triangle.attributes == kNone) return;
  __builtin_prefetch(&set.pool[triangle.attributes]);
  __builtin_prefetch(&set.positions[triangle.corners[0]]);
}

Surface surfaceAt(const World& world, const Hit& hit, const Ray& ray, float width) {
  Surface s = shellAt(world, hit, ray, width);
  if (s.matter == Matter::Smoke) {
    s.opacity = opacityOfSmoke(s.opacity, dot(s.normal, normalized(ray.direction)));
  }
  return s;
}

}  // namespace gable::rt
