// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// GGX with Smith's height-correlated masking; directions are drawn from the visible normals
// (Heitz 2018). The body gets what the coat leaves: its share is Karis's fit of the coat's
// reflection over all directions, so that white stays white.

#include "render/surface.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <map>

#include "base/elementary.h"
#include "material/library.h"
#include "math/trig.h"
#include "render/tone.h"

namespace gable::rt {

namespace {

/// Coats rougher than this are part of the body.
constexpr float kNoCoat = 0.97f;
/// Keeps the highlight of the sun wider than single precision and the sampling can bear.
constexpr float kLeastAlpha = 0.0012f;
/// Share of the light from behind that a leaf lets through (styles, trees: 15 to 25 %).
constexpr float kLeafTransmission = 0.22f;
/// A leaf against the light is yellower than one in the light.
constexpr Vec3f kLeafTint{1.12f, 1.06f, 0.5f};
/// Of water: what it mirrors when looked at from above, and the roughest material that can be it.
constexpr float kWaterFacing = 0.02f, kWaterRoughness = 0.3f;

constexpr std::string_view kWaterWords[] = {"water", "pond", "pool",  "river",
                                            "lake",  "sea",  "canal", "stream"};
constexpr std::string_view kFoliageWords[] = {"foliage", "leaves", "frond", "fronds",
                                              "needles", "petals", "blades"};

constexpr std::string_view kSmokeWords[] = {"smoke", "steam", "fog", "cloud", "clouds"};
/// What glitters is no smoke.
constexpr float kSmokeRoughness = 0.5f;
/// Share of the light that smoke lets through to the side that is turned away.
constexpr float kSmokeTransmission = 0.45f;

template <size_t N>
bool isOneOf(std::string_view word, const std::string_view (&words)[N]) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

Vec3f fresnel(const Vec3f& facing, float cosine) {
  const float m = std::clamp(1 - cosine, 0.0f, 1.0f);
  const float m5 = m * m * m * m * m;
  return facing + (Vec3f{1, 1, 1} - facing) * m5;
}

/// Karis 2014, Physically Based Shading on Mobile: the coat's reflection is facing * a + b.
Vec3f coatReflection(const Vec3f& facing, float roughness, float cosine) {
  const float rx = 1 - roughness, ry = 0.0425f - 0.0275f * roughness;
  const float rz = 1.04f - 0.572f * roughness, rw = 0.022f * roughness - 0.04f;
  const float a004 = std::min(rx * rx, std::exp2(-9.28f * cosine)) * rx + ry;
  const float a = -1.04f * a004 + rz, b = 1.04f * a004 + rw;
  const Vec3f c = facing * a + Vec3f{b, b, b};
  return {std::clamp(c.x, 0.0f, 1.0f), std::clamp(c.y, 0.0f, 1.0f), std::clamp(c.z, 0.0f, 1.0f)};
}

float lambda(float alpha, float cosine) {
  const float c2 = std::max(1e-8f, cosine * cosine);
  return 0.5f * (std::sqrt(1 + alpha * alpha * (1 - c2) / c2) - 1);
}

/// A visible normal of the coat in the frame where z is the shading normal.
Vec3f visibleNormal(const Vec3f& view, float alpha, Vec2f u) {
  const Vec3f v = normalized({alpha * view.x, alpha * view.y, view.z});
  const float l = v.x * v.x + v.y * v.y;
  const Vec3f t1 = l > 0 ? Vec3f{-v.y, v.x, 0} * (1 / std::sqrt(l)) : Vec3f{1, 0, 0};
  const Vec3f t2 = cross(v, t1);
  const float r = std::sqrt(u.x), phi = 2 * kPif * u.y;
  const float p1 = r * std::cos(phi);
  const float s = 0.5f * (1 + v.z);
  const float p2 = (1 - s) * std::sqrt(std::max(0.0f, 1 - p1 * p1)) + s * r * std::sin(phi);
  const Vec3f n = t1 * p1 + t2 * p2 + v * std::sqrt(std::max(0.0f, 1 - p1 * p1 - p2 * p2));
  return normalized({alpha * n.x, alpha * n.y, std::max(0.0f, n.z)});
}

int32_t imageIndex(const std::string& path, const TextureSource* source, bool isColor,
                   std::map<std::string, int32_t>& known, TextureTable& table) {
  if (path.empty() || !source) return -1;
  const auto [at, isNew] = known.try_emplace(path, -1);
  if (isNew) {
    const TextureImage* image = source->find(path);
    const bool usable = image && image->width > 0 && image->height > 0 &&
                        image->rgba.size() >= static_cast<size_t>(image->width) * image->height * 4;
    if (usable) {
      at->second = static_cast<int32_t>(table.images.size());
      table.add(*image, isColor);
    }
  }
  return at->second;
}

TextureLookup lookupOf(const TextureMap& map, int32_t image) {
  // The picture is scaled by (su, sv), turned by rw and moved by (tu, tv).
  TextureLookup l;
  l.image = image;
  const double c = cosDeg(map.rw), s = sinDeg(map.rw);
  l.uu = static_cast<float>(c * map.su);
  l.uv = static_cast<float>(-s * map.sv);
  l.vu = static_cast<float>(s * map.su);
  l.vv = static_cast<float>(c * map.sv);
  l.u0 = static_cast<float>(map.tu);
  l.v0 = static_cast<float>(map.tv);
  return l;
}

/// By byte: its share of 255, and srgbToLinear of that.
struct ByteTables {
  std::array<float, 256> plain, decoded;
  ByteTables() {
    for (size_t i = 0; i < plain.size(); ++i) {
      plain[i] = static_cast<float>(i) / 255;
      decoded[i] = srgbToLinear(plain[i]);
    }
  }
};
const ByteTables& byteTables() {
  static const ByteTables tables;
  return tables;
}
float decodedByte(uint8_t v) { return byteTables().decoded[v]; }

/// Of linear light, by the least light of each byte: a search takes less than a power.
class SrgbBytes {
 public:
  SrgbBytes() {
    for (size_t i = 0; i < least_.size(); ++i) least_[i] = leastOf(static_cast<uint8_t>(i + 1));
  }
  uint8_t of(float linear) const {
    return static_cast<uint8_t>(std::upper_bound(least_.begin(), least_.end(), linear) -
                                least_.begin());
  }

 private:
  static uint8_t byteOf(float linear) {
    return static_cast<uint8_t>(255 * linearToSrgb(linear) + 0.5f);
  }
  /// Halves what lies between the bits of two numbers: those above 0 are in the order of their
  /// bits.
  static float leastOf(uint8_t byte) {
    uint32_t below = 0, at = std::bit_cast<uint32_t>(1.0f);
    while (at - below > 1) {
      const uint32_t middle = below + (at - below) / 2;
      (byteOf(std::bit_cast<float>(middle)) < byte ? below : at) = middle;
    }
    return std::bit_cast<float>(at);
  }

  std::array<float, 255> least_;
};

/// How much less wide a coarser image is.
constexpr uint32_t kCoarser = 4;

/// Means of cells of pixels, of colours as light and written as sRGB again.
TextureImage coarserThan(const TextureImage& image, bool isColor) {
  const auto cells = [](uint32_t n) {
    return std::max(n / kCoarser, std::min(n, TextureTable::kCoarse));
  };
  TextureImage out{cells(image.width), cells(image.height), {}};
  out.rgba.reserve(static_cast<size_t>(out.width) * out.height * 4);
  const auto begin = [](uint32_t cell, uint32_t full, uint32_t n) {
    return static_cast<uint32_t>(static_cast<uint64_t>(cell) * full / n);
  };
  static const SrgbBytes srgb;
  const auto& numbers = isColor ? byteTables().decoded : byteTables().plain;
  for (uint32_t y = 0; y < out.height; ++y) {
    const uint32_t y0 = begin(y, image.height, out.height);
    const uint32_t y1 = begin(y + 1, image.height, out.height);
    for (uint32_t x = 0; x < out.width; ++x) {
      const uint32_t x0 = begin(x, image.width, out.width);
      const uint32_t x1 = begin(x + 1, image.width, out.width);
      float sum[4] = {};
      for (uint32_t row = y0; row < y1; ++row) {
        for (uint32_t column = x0; column < x1; ++column) {
          const uint8_t* const texel =
              &image.rgba[(static_cast<size_t>(row) * image.width + column) * 4];
          for (size_t k = 0; k < 3; ++k) sum[k] += numbers[texel[k]];
          sum[3] += byteTables().plain[texel[3]];
        }
      }
      const float share = 1 / static_cast<float>((y1 - y0) * (x1 - x0));
      for (size_t k = 0; k < 4; ++k) {
        const float mean = sum[k] * share;
        out.rgba.push_back(isColor && k < 3 ? srgb.of(mean)
                                            : static_cast<uint8_t>(255 * mean + 0.5f));
      }
    }
  }
  return out;
}

float unit(double v, double otherwise) {
  return static_cast<float>(std::isfinite(v) ? std::clamp(v, 0.0, 1.0) : otherwise);
}

SurfaceMaterial surfaceOf(const Material& m) {
  SurfaceMaterial s;
  s.base = isFinite(m.color) ? srgbToLinear(m.color) : Vec3f{};
  s.emissive = isFinite(m.emissive) ? srgbToLinear(m.emissive) : Vec3f{};
  s.roughness = unit(m.roughness, 1);
  s.metallic = unit(m.metallic, 0);
  s.opacity = unit(m.opacity, 1);
  s.cutoff = unit(m.opacityCutoff, 0.5);
  s.laid = isLaid(m);
  s.mask = m.opacityMode == OpacityMode::Mask;
  if (m.opacityMode == OpacityMode::Opaque) s.opacity = 1;
  // Materials of the older shader say reflectivity and shininess instead of roughness.
  if (m.reflectivity > 0 && m.roughness >= 1) {
    const Vec3f tint = isFinite(m.specular) ? srgbToLinear(m.specular) : Vec3f{};
    s.facing = std::max(0.04f, unit(m.reflectivity, 0) * maxOf(tint));
    s.roughness = static_cast<float>(std::sqrt(2 / (2 + std::clamp(m.shininess, 0.0, 1e4))));
  }
  return s;
}

}  // namespace

void TextureTable::add(const TextureImage& image, bool isColor) {
  images.push_back(&image);
  uint8_t all = 255;
  for (size_t i = 3; i < image.rgba.size(); i += 4) all &= image.rgba[i];
  hasAlpha.push_back(all < 255);
  std::vector<TextureImage>& levels = coarser.emplace_back();
  do {
    levels.push_back(coarserThan(levels.empty() ? image : levels.back(), isColor));
  } while (levels.back().width > kCoarse || levels.back().height > kCoarse);
}

namespace {

/// Where a texture is read, in shares of it.
Vec2f placeOf(const TextureLookup& map, Vec2f uv) {
  return {map.uu * uv.x + map.uv * uv.y + map.u0, map.vu * uv.x + map.vv * uv.y + map.v0};
}

std::array<float, 4> bilinear(const TextureImage& image, Vec2f at, bool decode) {
  const double w = image.width, h = image.height;
  const double u = at.x, v = at.y;
  // Texel centres lie at halves; v runs up, rows run down.
  double x = (u - std::floor(u)) * w - 0.5;
  double y = (1 - (v - std::floor(v))) * h - 0.5;
  if (!std::isfinite(x) || !std::isfinite(y)) x = y = 0;
  const double x0 = std::floor(x), y0 = std::floor(y);
  const float tx = static_cast<float>(x - x0), ty = static_cast<float>(y - y0);
  // From half a texel before the first to half a texel before the end.
  const auto wrapped = [](double place, uint32_t n) {
    const auto first = static_cast<int64_t>(place);
    const auto cell = static_cast<uint32_t>(first < 0 ? n - 1 : first);
    return std::array<uint32_t, 2>{cell, cell + 1 == n ? 0 : cell + 1};
  };
  const std::array<uint32_t, 2> xs = wrapped(x0, image.width), ys = wrapped(y0, image.height);
  const ByteTables& tables = byteTables();
  const std::array<float, 256>& colors = decode ? tables.decoded : tables.plain;
  std::array<float, 4> sum{};
  for (size_t j = 0; j < 2; ++j) {
    for (size_t i = 0; i < 2; ++i) {
      const float weight = (i ? tx : 1 - tx) * (j ? ty : 1 - ty);
      const uint8_t* texel = &image.rgba[(static_cast<size_t>(ys[j]) * image.width + xs[i]) * 4];
      for (size_t k = 0; k < 3; ++k) sum[k] += weight * colors[texel[k]];
      sum[3] += weight * tables.plain[texel[3]];
    }
  }
  return sum;
}

std::array<float, 4> nearest(const TextureImage& image, Vec2f at, bool decode) {
  const auto cell = [](float share, uint32_t n) {
    const float place = share * static_cast<float>(n);
    return place >= 0 ? std::min(static_cast<uint32_t>(std::min(place, 65535.0f)), n - 1) : 0;
  };
  const size_t x = cell(at.x - std::floor(at.x), image.width);
  const size_t y = cell(1 - (at.y - std::floor(at.y)), image.height);
  const uint8_t* const texel = &image.rgba[(y * image.width + x) * 4];
  const ByteTables& tables = byteTables();
  const std::array<float, 256>& colors = decode ? tables.decoded : tables.plain;
  return {colors[texel[0]], colors[texel[1]], colors[texel[2]], tables.plain[texel[3]]};
}

/// Whether a texel is no wider than that.
bool isWithin(const TextureImage& image, const TextureLookup& map, float width) {
  const float across = std::max(std::abs(map.uu), std::abs(map.uv));
  const float down = std::max(std::abs(map.vu), std::abs(map.vv));
  return width * across * static_cast<float>(image.width) >= 1 &&
         width * down * static_cast<float>(image.height) >= 1;
}

}  // namespace

std::array<float, 4> TextureTable::sample(const TextureLookup& map, Vec2f uv, bool decode,
                                          float width) const {
  const size_t i = static_cast<size_t>(map.image);
  const TextureImage* image = images[i];
  if (!isWithin(*image, map, width)) return bilinear(*image, placeOf(map, uv), decode);
  for (const TextureImage& next : coarser[i]) {
    if (!isWithin(next, map, width)) break;
    image = &next;
  }
  return nearest(*image, placeOf(map, uv), decode);
}

Vec3f TextureTable::mean(int32_t image) const {
  const std::vector<uint8_t>& texels = images[static_cast<size_t>(image)]->rgba;
  Vec3 sum;
  for (size_t i = 0; i + 3 < texels.size(); i += 4) {
    sum += toVec3({decodedByte(texels[i]), decodedByte(texels[i + 1]), decodedByte(texels[i + 2])});
  }
  return toVec3f(sum * (4.0 / static_cast<double>(texels.size())));
}

float TextureTable::meanRoughness(int32_t image) const {
  const std::vector<uint8_t>& texels = images[static_cast<size_t>(image)]->rgba;
  uint64_t sum = 0;
  for (size_t i = 1; i < texels.size(); i += 4) sum += texels[i];
  return static_cast<float>(static_cast<double>(sum) * (4.0 / 255) /
                            static_cast<double>(texels.size()));
}

void makeMaterials(const std::vector<Material>& from, const TextureSource* source,
                   std::vector<SurfaceMaterial>& to, TextureTable& textures) {
  std::map<std::string, int32_t> known;
  std::map<int32_t, float> roughnessOf;
  to.clear();
  for (const Material& m : from) {
    SurfaceMaterial s = surfaceOf(m);
    s.source = static_cast<uint32_t>(to.size());
    for (const TextureLayer layer :
         {TextureLayer::Color, TextureLayer::Dirt, TextureLayer::Opacity, TextureLayer::Normal,
          TextureLayer::Emissive, TextureLayer::Occlusion, TextureLayer::Roughness,
          TextureLayer::Metallic}) {
      const size_t i = static_cast<size_t>(layer);
      // Others are seen in the shadows that the tracer finds itself.
      if (layer == TextureLayer::Occlusion && !s.laid) continue;
      const int32_t image = imageIndex(m.maps[i].path, source, isColor(layer), known, textures);
      if (image < 0) continue;
      s.maps[i] = lookupOf(m.maps[i], image);
      if (!s.laid) s.uvSets |= static_cast<uint16_t>(1u << i);
    }
    const int32_t glow = s.maps[static_cast<size_t>(TextureLayer::Emissive)].image;
    s.meanEmissive = s.emissive;
    if (glow >= 0 && maxOf(s.emissive) > 0) s.meanEmissive *= textures.mean(glow);
    const int32_t rough = s.maps[static_cast<size_t>(TextureLayer::Roughness)].image;
    s.meanRoughness = s.roughness;
    if (rough >= 0) {
      const auto [at, isNew] = roughnessOf.try_emplace(rough, 0.0f);
      if (isNew) at->second = textures.meanRoughness(rough);
      s.meanRoughness *= at->second;
    }
    const Matter laidMatter =
        s.laid ? matterNamed(std::string_view(m.shader).substr(kLaidShader.size())) : Matter::Plain;
    s.pane = s.meanRoughness < kPaneRoughness && s.metallic < 0.5f && laidMatter != Matter::Water;
    const int32_t color = s.maps[static_cast<size_t>(TextureLayer::Color)].image;
    const bool cutOut = s.mask || s.maps[static_cast<size_t>(TextureLayer::Opacity)].image >= 0;
    const bool mapped = cutOut || (color >= 0 && textures.hasAlpha[static_cast<size_t>(color)]);
    s.clear = m.opacityMode != OpacityMode::Opaque && (s.opacity < 1 || mapped);
    if (m.doubleSided && cutOut && s.metallic == 0) s.transmission = kLeafTransmission;
    if (laidMatter == Matter::Water) s = madeOf(s, Matter::Water);
    to.push_back(s);
  }
  // A scene may name no material at all.
  if (to.empty()) to.emplace_back();
}

Matter matterNamed(std::string_view name) {
  // Words begin with capitals and at what is no letter: DeepWater, deep_water.
  std::string word;
  for (size_t i = 0; i <= name.size(); ++i) {
    const char c = i < name.size() ? name[i] : ' ';
    const bool capital = c >= 'A' && c <= 'Z', small = c >= 'a' && c <= 'z';
    if (!small) {
      if (isOneOf(word, kWaterWords)) return Matter::Water;
      if (isOneOf(word, kFoliageWords)) return Matter::Foliage;
      if (isOneOf(word, kSmokeWords)) return Matter::Smoke;
      word.clear();
    }
    if (small || capital) word += capital ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return Matter::Plain;
}

SurfaceMaterial madeOf(const SurfaceMaterial& material, Matter matter) {
  SurfaceMaterial m = material;
  if (matter == Matter::Foliage && m.metallic == 0 && m.opacity == 1) {
    m.matter = matter;
    m.transmission = kLeafTransmission;
  }
  if (matter == Matter::Water && m.roughness < kWaterRoughness && m.metallic == 0) {
    m.matter = matter;
    m.facing = kWaterFacing;
    m.pane = false;
    // Shadow rays pass it: the surface itself takes nothing.
    m.clear = m.opacity < 1;
  }
  if (matter == Matter::Smoke && m.opacity < 1 && m.roughness > kSmokeRoughness) {
    m.matter = matter;
    m.transmission = kSmokeTransmission;
  }
  return m;
}

float opacityOfSmoke(float opacity, float cosine) {
  return 1 - static_cast<float>(powOf(1 - static_cast<double>(opacity), std::abs(cosine)));
}

Lobes lobesOf(const Surface& s, const Vec3f& view) {
  Lobes lobes;
  const float f = s.facing;
  lobes.facing = mix({f, f, f}, s.base, s.metallic);
  lobes.alpha = std::max(kLeastAlpha, s.roughness * s.roughness);
  const float cosine = std::clamp(dot(s.normal, view), 0.0f, 1.0f);
  if (s.roughness < kNoCoat || s.metallic > 0) {
    lobes.coat = coatReflection(lobes.facing, s.roughness, cosine);
  }
  lobes.diffuse = s.base * (Vec3f{1, 1, 1} - lobes.coat) * (1 - s.metallic);
  if (s.matter == Matter::Smoke) {
    lobes.through = lobes.diffuse * s.transmission;
    lobes.diffuse *= 1 - s.transmission;
  } else if (s.transmission > 0) {
    const float most = std::max(maxOf(s.base), 1e-4f);
    lobes.through = kLeafTint * s.base * (s.transmission * (1 - std::min(1.0f, most)) / most);
  }
  const float coat = luminance(lobes.coat);
  const float body = luminance(lobes.diffuse) + luminance(lobes.through);
  if (coat > 0) lobes.coatChance = std::clamp(coat / (coat + body), 0.05f, 1.0f);
  return lobes;
}

Vec3f evaluate(const Surface& s, const Lobes& lobes, const Vec3f& view, const Vec3f& light) {
  const float cosLight = dot(s.normal, light);
  const float cosFacet = dot(s.facet, light);
  if (cosFacet <= 0) return lobes.through * (std::max(0.0f, -cosLight) / kPif);
  if (cosLight <= 0) return {};
  Vec3f value = lobes.diffuse * (1 / kPif);
  const float cosView = dot(s.normal, view);
  if (lobes.coatChance > 0 && cosView > 0) {
    const Vec3f half = normalized(view + light);
    const float ch = dot(s.normal, half);
    const float a2 = lobes.alpha * lobes.alpha;
    // Written so that nothing cancels near the highlight's centre.
    const Vec3f off = cross(s.normal, half);
    const float e = dot(off, off) + a2 * ch * ch;
    const float density = a2 / (kPif * e * e);
    const float masking = 1 / (1 + lambda(lobes.alpha, cosView) + lambda(lobes.alpha, cosLight));
    value += fresnel(lobes.facing, dot(view, half)) *
             (density * masking / (4 * cosView * std::max(1e-4f, cosLight)));
  }
  return value * cosLight;
}

Scatter scatter(const Surface& s, const Lobes& lobes, const Vec3f& view, float pick, Vec2f u) {
  Scatter out;
  if (pick < lobes.coatChance) {
    out.coat = true;
    Vec3f t, b;
    basisAround(s.normal, t, b);
    const Vec3f v = {dot(view, t), dot(view, b), std::max(1e-3f, dot(view, s.normal))};
    const Vec3f h = visibleNormal(v, lobes.alpha, u);
    const Vec3f l = h * (2 * dot(v, h)) - v;
    if (l.z <= 0) return out;
    out.direction = normalized(t * l.x + b * l.y + s.normal * l.z);
    if (dot(out.direction, s.facet) <= 0) return out;
    const float lv = lambda(lobes.alpha, v.z), ll = lambda(lobes.alpha, l.z);
    out.weight = fresnel(lobes.facing, dot(v, h)) * ((1 + lv) / (1 + lv + ll) / lobes.coatChance);
    return out;
  }
  const float bodyChance = 1 - lobes.coatChance;
  const float d = luminance(lobes.diffuse), t = luminance(lobes.through);
  if (d + t <= 0) return out;
  const float throughChance = t / (d + t);
  if ((pick - lobes.coatChance) / bodyChance < throughChance) {
    out.direction = cosineDirection(-s.normal, u);
    if (dot(out.direction, s.facet) >= 0) return out;
    out.weight = lobes.through * (1 / (throughChance * bodyChance));
  } else {
    out.direction = cosineDirection(s.normal, u);
    if (dot(out.direction, s.facet) <= 0) return out;
    out.weight = lobes.diffuse * (1 / ((1 - throughChance) * bodyChance));
  }
  return out;
}

}  // namespace gable::rt
