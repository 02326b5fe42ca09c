// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "render/render.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "base/work.h"
#include "material/library.h"
#include "render/test_scenes.h"
#include "render/tracer.h"

namespace gable {
namespace {

/// Mean linear light of a part of a picture, from left and from above in [0, 1].
Vec3 meanOf(const LinearImage& image, double x0 = 0, double y0 = 0, double x1 = 1, double y1 = 1) {
  Vec3 sum;
  double n = 0;
  for (uint32_t y = 0; y < image.height; ++y) {
    for (uint32_t x = 0; x < image.width; ++x) {
      const double u = (x + 0.5) / image.width, v = (y + 0.5) / image.height;
      if (u < x0 || u > x1 || v < y0 || v > y1) continue;
      const float* p = &image.rgb[(static_cast<size_t>(y) * image.width + x) * 3];
      sum += {p[0], p[1], p[2]};
      ++n;
    }
  }
  return sum * (1 / n);
}

double luminanceOf(const Vec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

void expectClean(const Picture& p) {
  ASSERT_EQ(p.image.rgb.size(), static_cast<size_t>(p.image.width) * p.image.height * 3);
  for (const float v : p.image.rgb) {
    ASSERT_TRUE(std::isfinite(v));
    ASSERT_GE(v, 0);
  }
}

/// A pillar of albedo 0.55 on the ground, seen through a narrow lens.
Vec3 lightOfWall(const Vec3& eye, const Vec3& target, double* level = nullptr) {
  SceneMaker m;
  m.box({-5, 0, -5}, {10, 12, 10}, m.material("#C4C4C4"));
  RenderOptions o = smallOptions(24, 24, 64);
  o.eye = eye;
  o.target = target;
  o.fov = 4;
  o.hazeDistance = 0;
  o.adaptExposure = false;
  const Picture p = render(m.finish(), o);
  if (level) {
    const std::vector<uint8_t> rgba = toRgba8(p.image);
    *level = rgba[(12 * 24 + 12) * 4 + 1];
  }
  return meanOf(p.image);
}

class Furnace : public testing::TestWithParam<std::pair<double, PictureLighting>> {};

TEST_P(Furnace, whiteBallIsAsBrightAsTheUniformSky) {
  const auto [roughness, lighting] = GetParam();
  SceneMaker m;
  m.mesh(ballMesh(), m.material("#ffffff", roughness));
  RenderOptions o = smallOptions(40, 40, 64);
  o.lighting = lighting;
  o.uniformSky = Vec3{0.5, 0.5, 0.5};
  o.ground = false;
  o.denoise = false;
  o.eye = Vec3{0, 0, 6};
  o.target = Vec3{0, 0, 0};
  o.fov = 25;
  const Picture p = render(m.finish(), o);
  // Single scattering at the coat loses a little energy on rough coats.
  EXPECT_NEAR(luminanceOf(meanOf(p.image)), 0.5, roughness == 1 ? 0.002 : 0.015);
  EXPECT_NEAR(luminanceOf(meanOf(p.image, 0.4, 0.4, 0.6, 0.6)), 0.5, 0.02);
}

constexpr PictureLighting kPaths = PictureLighting::Paths, kDirect = PictureLighting::Direct;
INSTANTIATE_TEST_SUITE_P(Roughness, Furnace,
                         testing::Values(std::pair(1.0, kPaths), std::pair(0.6, kPaths),
                                         std::pair(0.3, kPaths), std::pair(0.05, kPaths),
                                         std::pair(1.0, kDirect), std::pair(0.6, kDirect),
                                         std::pair(0.3, kDirect), std::pair(0.05, kDirect)));

TEST(Render, greyBallReflectsItsAlbedo) {
  SceneMaker m;
  m.mesh(ballMesh(), m.material("#808080"));
  RenderOptions o = smallOptions(40, 40, 32);
  o.uniformSky = Vec3{1, 1, 1};
  o.ground = false;
  o.eye = Vec3{0, 0, 6};
  o.target = Vec3{0, 0, 0};
  o.fov = 8;
  EXPECT_NEAR(meanOf(render(m.finish(), o).image).x, 0.2159, 0.004);
}

TEST(Render, shadedWallHasAQuarterOfTheSunlitWall) {
  double level = 0;
  const Vec3 lit = lightOfWall({0, 6, 60}, {0, 6, 0}, &level);
  const Vec3 shaded = lightOfWall({60, 6, 0}, {0, 6, 0});
  const double ratio = luminanceOf(shaded) / luminanceOf(lit);
  EXPECT_GE(ratio, 0.22);
  EXPECT_LE(ratio, 0.28);
  // Shade is cooler than sun.
  EXPECT_GT(shaded.z / shaded.x, lit.z / lit.x);
  EXPECT_GE(level, 195);
  EXPECT_LE(level, 222);
}

TEST(Render, directLightIsMuchAsThatOfPathsWithFewerRays) {
  const Scene scene = streetScene();
  RenderOptions o = smallOptions(192, 108, 16);
  o.adaptExposure = false;
  const Picture paths = render(scene, o);
  o.lighting = kDirect;
  const Picture direct = render(scene, o);
  expectClean(direct);
  double apart = 0;
  for (size_t i = 0; i < paths.image.rgb.size(); ++i) {
    apart += std::abs(paths.image.rgb[i] - direct.image.rgb[i]);
  }
  apart /= static_cast<double>(paths.image.rgb.size());
  const double mean = luminanceOf(meanOf(paths.image));
  EXPECT_NEAR(luminanceOf(meanOf(direct.image)), mean, 0.1 * mean);
  EXPECT_LT(apart, 0.1 * mean);
  EXPECT_LT(direct.stats.rays, paths.stats.rays / 3);
  // With few samples there is nothing to save.
  o.samples = 1;
  expectClean(render(scene, o));
}

TEST(Render, plainGroundTakesAPathAPixelAndIsEven) {
  SceneMaker m;
  m.box({-30, 0, -30}, {60, 0.01, 60}, m.material("#808080"));
  RenderOptions o = smallOptions(64, 64, 16);
  o.view = PictureView::Top;
  o.lighting = kDirect;
  o.adaptExposure = false;
  o.sunElevation = 40;
  const Scene scene = m.finish();
  const Picture p = render(scene, o);
  // To the surface, to the sun and to the sky; a little more at the border.
  EXPECT_LT(p.stats.rays, 64u * 64u * 4u);
  const double mean = luminanceOf(meanOf(p.image, 0.3, 0.3, 0.7, 0.7));
  for (const double x : {0.3, 0.4, 0.5, 0.6}) {
    EXPECT_NEAR(luminanceOf(meanOf(p.image, x, x, x + 0.05, x + 0.05)), mean, 0.02 * mean);
  }
  // It has the light that all samples of it have.
  o.denoise = false;
  EXPECT_NEAR(luminanceOf(meanOf(render(scene, o).image, 0.3, 0.3, 0.7, 0.7)), mean, 0.02 * mean);
}

TEST(Render, directLightIsSmoothedToWhatManySamplesShow) {
  const Scene scene = streetScene();
  RenderOptions o = smallOptions(96, 54, 16);
  o.adaptExposure = false;
  o.lighting = kDirect;
  const Picture smoothed = render(scene, o);
  o.samples = 256;
  o.denoise = false;
  const Picture many = render(scene, o);
  double apart = 0;
  for (size_t i = 0; i < many.image.rgb.size(); ++i) {
    apart += std::abs(many.image.rgb[i] - smoothed.image.rgb[i]);
  }
  apart /= static_cast<double>(many.image.rgb.size());
  EXPECT_LT(apart, 0.05 * luminanceOf(meanOf(many.image)));
}

class Shadow : public testing::TestWithParam<PictureLighting> {};

TEST_P(Shadow, liesAwayFromTheSun) {
  SceneMaker m;
  m.box({-1, 0, -1}, {2, 6, 2}, m.material("#C4C4C4"));
  m.box({-20, 0, -20}, {40, 0.01, 40}, m.material("#C4C4C4"));
  RenderOptions o = smallOptions(64, 64, 16);
  o.view = PictureView::Top;
  o.sunElevation = 45;
  o.sunAzimuth = 270;
  o.lighting = GetParam();
  const Picture p = render(m.finish(), o);
  // Six metres east of the box end the shadow; the plan is 45 metres wide.
  const double shadow = luminanceOf(meanOf(p.image, 0.56, 0.49, 0.61, 0.51));
  const double beyond = luminanceOf(meanOf(p.image, 0.70, 0.49, 0.75, 0.51));
  const double west = luminanceOf(meanOf(p.image, 0.39, 0.49, 0.44, 0.51));
  EXPECT_LT(shadow, 0.3 * beyond);
  EXPECT_NEAR(west / beyond, 1, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Lighting, Shadow, testing::Values(kPaths, kDirect));

TEST(Render, samePixelsForAnyNumberOfThreads) {
  const Scene scene = streetScene();
  for (const PictureView view : {PictureView::Iso, PictureView::Street}) {
    RenderOptions o = smallOptions(96, 54, 3);
    o.view = view;
    if (view == PictureView::Street) o.lighting = kDirect;
    o.threads = 1;
    const Picture one = render(scene, o);
    o.threads = 3;
    const Picture three = render(scene, o);
    EXPECT_EQ(one.image.rgb, three.image.rgb);
    EXPECT_EQ(toRgba8(one.image), toRgba8(three.image));
    o.seed = 2;
    EXPECT_NE(render(scene, o).image.rgb, one.image.rgb);
  }
}

TEST(Render, emptySceneShowsGroundAndSky) {
  const Scene scene;
  for (const PictureView view :
       {PictureView::Iso, PictureView::Top, PictureView::Front, PictureView::Street}) {
    RenderOptions o = smallOptions();
    o.view = view;
    const Picture p = render(scene, o);
    expectClean(p);
    EXPECT_GT(luminanceOf(meanOf(p.image)), 0.05);
  }
  RenderOptions none = smallOptions(0, 0);
  EXPECT_TRUE(render(scene, none).image.rgb.empty());
}

TEST(Render, leavesOutBrokenTriangles) {
  SceneMaker m;
  const uint32_t grey = m.material("#808080");
  const double inf = std::numeric_limits<double>::infinity();
  for (const Vec3& bad : {Vec3{std::nan(""), 0, 0}, Vec3{0, inf, 0}, Vec3{1e30, 0, 0}, Vec3{}}) {
    MeshBuilder b;
    const std::vector<uint32_t> p = {b.addPosition(bad), b.addPosition({1, 0, 0}),
                                     b.addPosition({2, 0, 0}), b.addPosition({0, 0, 0})};
    b.addPolygon(std::vector<uint32_t>{p[0], p[1], p[2], p[3]});
    b.addPolygon(std::vector<uint32_t>{p[0], p[0], p[1]});
    m.mesh(b.take(), grey, Frame(), {1, 0, 1});
  }
  m.box({0, 0, 0}, {4, 3, 0}, grey);
  m.box({0, 0, 0}, {-4, 3, 4}, grey);
  Material strange;
  strange.color = {std::nan(""), 2, -1};
  strange.roughness = std::nan("");
  strange.opacity = -3;
  m.box({6, 0, 0}, {2, 2, 2}, m.material(strange));
  const Scene& scene = m.finish();
  for (const PictureView view :
       {PictureView::Iso, PictureView::Top, PictureView::Front, PictureView::Street}) {
    RenderOptions o = smallOptions();
    o.view = view;
    expectClean(render(scene, o));
  }
}

TEST(Render, placedPrototypesLookLikeMergedOnes) {
  const auto make = [](bool shared) {
    SceneMaker m;
    const uint32_t grey = m.material("#909090");
    const auto content = [&](const Vec3& at) {
      for (int i = 0; i < 30; ++i) m.box(at + Vec3{0.1 * i, 0.2 * i, 0}, {1, 0.2, 1}, grey);
    };
    uint32_t stairs = 0;
    if (shared) {
      content({});
      stairs = m.prototype();
    }
    for (int k = 0; k < 6; ++k) {
      const Vec3 at{8.0 * k, 0, 3.0 * (k % 2)};
      if (shared)
        m.place(stairs, Frame::moved(at));
      else
        content(at);
    }
    return std::move(m.finish());
  };
  const RenderOptions o = smallOptions(96, 54, 16);
  const Picture a = render(make(true), o), b = render(make(false), o);
  EXPECT_EQ(a.stats.instances, 6u);
  EXPECT_EQ(a.stats.storedTriangles, 360u);
  EXPECT_EQ(a.stats.triangles, 2160u);
  EXPECT_EQ(b.stats.instances, 0u);
  EXPECT_EQ(b.stats.triangles, 2160u);
  for (int k = 0; k < 4; ++k) {
    const double x = 0.25 * k;
    EXPECT_NEAR(luminanceOf(meanOf(a.image, x, 0, x + 0.25, 1)) /
                    luminanceOf(meanOf(b.image, x, 0, x + 0.25, 1)),
                1, 0.02);
  }
}

TEST(Render, laterOfTwoCoincidingFacesShows) {
  SceneMaker m;
  m.box({-10, 0, -10}, {20, 1, 20}, m.material("#404040"));
  m.box({-10, 1, -10}, {20, 2, 20}, m.material("#ff0000"));
  m.leaves.back().scale.y = 0;
  m.box({-7, 1, -7}, {14, 0, 14}, m.material("#00ff00"));
  RenderOptions o = smallOptions(64, 64, 4);
  o.eye = Vec3{0, 12, 20};
  o.target = Vec3{0, 1, 0};
  o.fov = 20;
  const Picture p = render(m.finish(), o);
  // Every pixel of the middle is green, none red or grey.
  for (uint32_t y = 20; y < 44; ++y) {
    for (uint32_t x = 20; x < 44; ++x) {
      const float* c = &p.image.rgb[(y * 64 + x) * 3];
      EXPECT_GT(c[1], 3 * c[0]);
    }
  }
}

TEST(Render, emissiveFacesShineAtNight) {
  const auto brightness = [](const Vec3& emissive) {
    SceneMaker m;
    Material lamp;
    lamp.emissive = emissive;
    m.box({-1, 0, -1}, {2, 2, 2}, m.material(lamp));
    m.box({-8, -0.1, -8}, {16, 0.1, 16}, m.material("#808080"));
    RenderOptions o = smallOptions(48, 48, 32);
    o.sunElevation = -12;
    o.view = PictureView::Top;
    return luminanceOf(meanOf(render(m.finish(), o).image, 0.47, 0.47, 0.53, 0.53));
  };
  EXPECT_GT(brightness({1, 0.8, 0.6}), 3 * brightness({0, 0, 0}));
}

struct OneTexture : TextureSource {
  TextureImage image;
  mutable std::map<std::string, int> asked;
  const TextureImage* find(const std::string& path) const override {
    ++asked[path];
    return path == "quarters.png" ? &image : nullptr;
  }
};

/// Red and green above, blue and clear white below.
OneTexture quarters() {
  OneTexture t;
  t.image.width = t.image.height = 2;
  t.image.rgba = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 0};
  return t;
}

Picture planOfTexturedQuad(const OneTexture& textures, Material material) {
  SceneMaker m;
  material.map(TextureLayer::Color).path = "quarters.png";
  Leaf quad;
  quad.mesh = kUnitQuadXzUv;
  quad.scale = {10, 1, 10};
  quad.materials = m.material(material);
  m.leaves.push_back(quad);
  RenderOptions o = smallOptions(64, 64, 16);
  o.view = PictureView::Top;
  o.textures = &textures;
  o.groundHeight = -1;
  return render(m.finish(), o);
}

TEST(Render, texturesLieWithTheirFirstRowAtTheTopOfTheQuad) {
  const OneTexture textures = quarters();
  Material material;
  material.map(TextureLayer::Dirt).path = "missing.png";
  const Picture p = planOfTexturedQuad(textures, material);
  EXPECT_EQ(textures.asked.at("quarters.png"), 1);
  EXPECT_EQ(textures.asked.at("missing.png"), 1);
  // Each quarter's middle is a texel's centre.
  const Vec3 red = meanOf(p.image, 0.26, 0.26, 0.30, 0.30);
  const Vec3 green = meanOf(p.image, 0.70, 0.26, 0.74, 0.30);
  const Vec3 blue = meanOf(p.image, 0.26, 0.70, 0.30, 0.74);
  EXPECT_GT(red.x, 4 * red.y);
  EXPECT_GT(green.y, 4 * green.x);
  EXPECT_GT(blue.z, 4 * blue.x);
}

TEST(Render, textureScaleAndShiftMoveThePicture) {
  const OneTexture textures = quarters();
  Material material;
  material.map(TextureLayer::Color).tu = 0.5;
  const Picture p = planOfTexturedQuad(textures, material);
  const Vec3 left = meanOf(p.image, 0.26, 0.26, 0.30, 0.30);
  EXPECT_GT(left.y, 4 * left.x);
}

TEST(Render, cutOutTexelsShowWhatIsBehind) {
  const OneTexture textures = quarters();
  Material mask;
  mask.opacityMode = OpacityMode::Mask;
  const Vec3 through = meanOf(planOfTexturedQuad(textures, mask).image, 0.72, 0.72, 0.78, 0.78);
  Material opaque;
  opaque.opacityMode = OpacityMode::Opaque;
  const Vec3 solid = meanOf(planOfTexturedQuad(textures, opaque).image, 0.72, 0.72, 0.78, 0.78);
  EXPECT_LT(luminanceOf(through), 0.6 * luminanceOf(solid));
}

TEST(Render, aPictureThatIsColourAndOpacityCoversOnce) {
  OneTexture textures = quarters();
  for (size_t i = 3; i < textures.image.rgba.size(); i += 4) textures.image.rgba[i] = 160;
  Material color;
  color.opacityMode = OpacityMode::Mask;
  Material both = color;
  both.map(TextureLayer::Opacity).path = "quarters.png";
  EXPECT_EQ(planOfTexturedQuad(textures, both).image.rgb,
            planOfTexturedQuad(textures, color).image.rgb);
}

// Materials of the library say only by a texture that they are smooth.
TEST(Textures, coarseOnesHaveTheLightOfTheirCells) {
  // Black and white by turns, the right half red.
  TextureImage image{256, 128, {}};
  for (uint32_t y = 0; y < image.height; ++y) {
    for (uint32_t x = 0; x < image.width; ++x) {
      const uint8_t white = (x / 2 + y) % 2 ? 255 : 0;
      const bool red = x >= 128;
      for (const uint8_t v : {red ? uint8_t{255} : white, red ? uint8_t{0} : white,
                              red ? uint8_t{0} : white, uint8_t{255}}) {
        image.rgba.push_back(v);
      }
    }
  }
  rt::TextureTable table;
  table.add(image);
  rt::TextureLookup map;
  map.image = 0;
  for (const float width : {1 / 32.0f, 1 / 16.0f, 1e30f}) {
    for (const float v : {-3.7f, 0.0f, 0.4f, 0.999f}) {
      const std::array<float, 4> grey = table.sample(map, {0.3f, v}, true, width);
      EXPECT_NEAR(grey[0], 0.5, 0.01);
      EXPECT_NEAR(grey[2], 0.5, 0.01);
      EXPECT_EQ(grey[3], 1);
      const std::array<float, 4> red = table.sample(map, {-0.3f, v}, true, width);
      EXPECT_NEAR(red[0], 1, 1e-6);
      EXPECT_NEAR(red[1], 0, 1e-6);
    }
  }
  const float fine = 1 / 100.0f;
  const float texel = table.sample(map, {0.3f, 0.4f}, true, fine)[0];
  EXPECT_TRUE(texel == 0 || texel == 1) << "a texel as it is";
  EXPECT_FALSE(table.hasAlpha[0]);
}

TEST(Textures, coarseNumbersThatAreNoColourAreMeans) {
  TextureImage image{256, 256, {}};
  for (uint32_t i = 0; i < 256 * 256; ++i) {
    const uint8_t v = i % 2 ? 200 : 56;
    image.rgba.insert(image.rgba.end(), {v, v, v, 255});
  }
  rt::TextureTable table;
  table.add(image, false);
  rt::TextureLookup map;
  map.image = 0;
  EXPECT_NEAR(table.sample(map, {0.3f, 0.3f}, false, 1 / 64.0f)[0], 128 / 255.0f, 1e-6);
}

TEST(Render, panesAreAsSmoothAsTheirTexture) {
  const auto isPane = [](uint8_t rough, const char* shader) {
    OneTexture textures;
    textures.image.width = textures.image.height = 1;
    textures.image.rgba = {255, rough, 0, 255};
    Material laid;
    laid.shader = std::string(kLaidShader) + shader;
    laid.map(TextureLayer::Roughness).path = "quarters.png";
    std::vector<rt::SurfaceMaterial> made;
    rt::TextureTable table;
    rt::makeMaterials({laid}, &textures, made, table);
    return made[0].pane;
  };
  EXPECT_TRUE(isPane(13, "glass"));
  EXPECT_FALSE(isPane(200, "glass"));
  EXPECT_FALSE(isPane(13, "water"));
}

// A quad of one tile, a quarter of which is clear: that is the light that gets through.
TEST(Render, cutOutTexelsOfLaidMaterialsLetLightThrough) {
  const OneTexture textures = quarters();
  Material laid;
  laid.shader = std::string(kLaidShader) + "own";
  laid.opacityMode = OpacityMode::Blend;
  TextureMap& map = laid.map(TextureLayer::Color);
  map.path = "quarters.png";
  map.su = map.sv = 0.1;
  SceneMaker m;
  Leaf quad;
  quad.mesh = kUnitQuadXz;
  quad.scale = {10, 1, 10};
  quad.materials = m.material(laid);
  m.leaves.push_back(quad);
  const rt::World world = rt::makeWorld(m.finish(), &textures);
  const rt::TriangleSet& set = world.parts[0].clear;
  ASSERT_EQ(set.triangles.size(), 2u);
  constexpr int kSteps = 40;
  double sum = 0;
  int points = 0;
  for (uint32_t triangle = 0; triangle < 2; ++triangle) {
    for (int i = 0; i < kSteps; ++i) {
      for (int k = 0; i + k < kSteps; ++k) {
        const float u = (static_cast<float>(i) + 0.33f) / kSteps;
        const float v = (static_cast<float>(k) + 0.33f) / kSteps;
        sum += static_cast<double>(rt::clearness(world, set, triangle, rt::kNone, u, v));
        ++points;
      }
    }
  }
  EXPECT_NEAR(sum / points, 0.25, 0.02);
}

TEST(Render, clearPanesLetSunlightThrough) {
  const auto floorUnder = [](double opacity) {
    SceneMaker m;
    Material pane;
    pane.opacity = opacity;
    m.box({-20, 0, -20}, {40, 0.1, 40}, m.material("#808080"));
    m.box({-10, 5, -10}, {20, 0.01, 20}, m.material(pane));
    RenderOptions o = smallOptions(32, 32, 32);
    o.eye = Vec3{0, 2, 15};
    o.target = Vec3{3, 0, -2};
    o.fov = 6;
    return luminanceOf(meanOf(render(m.finish(), o).image));
  };
  EXPECT_GT(floorUnder(0.1), 2.5 * floorUnder(1));
}

TEST(Render, glassMirrorsTheSkyMostAtGrazingAngles) {
  const auto glass = [](double height) {
    SceneMaker m;
    m.box({-50, -0.1, -50}, {100, 0.1, 100}, m.material("#2B3338", 0.06));
    RenderOptions o = smallOptions(24, 24, 32);
    o.eye = Vec3{0, height, 10};
    o.target = Vec3{0, 0, 0};
    o.fov = 5;
    o.sunElevation = 80;
    return luminanceOf(meanOf(render(m.finish(), o).image));
  };
  EXPECT_GT(glass(1), 2 * glass(10));
}

TEST(Render, progressRisesAndCanEndThePicture) {
  const Scene scene = streetScene();
  RenderOptions o = smallOptions(96, 54, 1);
  double last = 0;
  bool rising = true;
  o.progress = [&](double share) {
    rising = rising && share >= last;
    last = share;
    return true;
  };
  EXPECT_FALSE(render(scene, o).cancelled);
  EXPECT_TRUE(rising);
  EXPECT_EQ(last, 1);
  o.progress = [](double share) { return share < 0.3; };
  const Picture ended = render(scene, o);
  EXPECT_TRUE(ended.cancelled);
  expectClean(ended);
}

/// Says stop at the look of a number.
class StopAt final : public WorkMeter {
 public:
  explicit StopAt(int look) : left_(look) {}
  bool look(uint64_t, uint64_t) override { return --left_ >= 0; }
  int left() const { return left_; }

 private:
  int left_;
};

TEST(Render, aMeterStopsEachPartOfAPicture) {
  const Scene scene = streetScene();
  const auto drawn = [&](StopAt& meter) {
    const WorkScope scope(meter);
    return guarded([&] {
             RenderOptions o = smallOptions(96, 54, 1);
             o.threads = 1;
             o.progress = [&](double) {
               if (meter.look(0, 0)) return true;
               throw Unwinding(Status::failure(kWorkStopped, {}));
             };
             render(scene, o);
             return Status();
           })
        .ok();
  };
  constexpr int kMany = 1 << 20;
  StopAt never(kMany);
  EXPECT_TRUE(drawn(never));
  const int looks = kMany - never.left();
  EXPECT_GT(looks, 50);
  for (const int at : {0, 1, 2, looks / 4, looks / 2, looks - 1}) {
    StopAt meter(at);
    EXPECT_FALSE(drawn(meter)) << at << " of " << looks;
    // Nothing goes on behind a stop.
    EXPECT_GE(meter.left(), -2) << at << " of " << looks;
  }
}

TEST(Render, smoothingBringsFewSamplesNearerToMany) {
  const Scene scene = streetScene();
  RenderOptions o = smallOptions(128, 72, 4);
  const Picture smooth = render(scene, o);
  o.denoise = false;
  const Picture noisy = render(scene, o);
  o.samples = 128;
  o.seed = 7;
  const Picture many = render(scene, o);
  const auto error = [&](const Picture& p) {
    const std::vector<uint8_t> a = toRgba8(p.image), b = toRgba8(many.image);
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum / static_cast<double>(a.size()));
  };
  EXPECT_LT(error(smooth), 0.8 * error(noisy));
}

TEST(Render, skyIsBrightButNotWhite) {
  RenderOptions o = smallOptions(32, 32, 4);
  o.eye = Vec3{0, 2, 0};
  o.target = Vec3{0, 4, -10};
  o.fov = 20;
  const std::vector<uint8_t> rgba = toRgba8(render(Scene(), o).image);
  for (size_t i = 0; i < rgba.size(); i += 4) {
    EXPECT_GE(rgba[i + 1], 180);
    EXPECT_LE(rgba[i + 1], 242);
    EXPECT_GT(rgba[i + 2], rgba[i]);
  }
}

TEST(Tone, curveRisesAndEndsBelowWhite) {
  LinearImage ramp;
  ramp.width = 256;
  ramp.height = 1;
  for (int i = 0; i < 256; ++i) {
    for (int k = 0; k < 3; ++k) ramp.rgb.push_back(static_cast<float>(i * i) / 4096);
  }
  const std::vector<uint8_t> rgba = toRgba8(ramp);
  for (size_t i = 1; i < 256; ++i) EXPECT_GE(rgba[4 * i] + 1, rgba[4 * (i - 1)]);
  EXPECT_LE(rgba[0], 1);
  EXPECT_GE(rgba[4 * 255], 250);
}

}  // namespace
}  // namespace gable
