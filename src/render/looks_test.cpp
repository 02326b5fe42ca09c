// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What pictures have beside daylight: layers, cuts, drawings, lamps, water, mist, lenses.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "render/render.h"
#include "render/test_scenes.h"
#include "render/tone.h"

namespace gable {
namespace {

/// Mean luminance of a part of a picture, from left and from above in [0, 1].
double levelOf(const LinearImage& image, double x0 = 0, double y0 = 0, double x1 = 1,
               double y1 = 1) {
  double sum = 0, n = 0;
  for (uint32_t y = 0; y < image.height; ++y) {
    for (uint32_t x = 0; x < image.width; ++x) {
      const double u = (x + 0.5) / image.width, v = (y + 0.5) / image.height;
      if (u < x0 || u > x1 || v < y0 || v > y1) continue;
      const float* p = &image.rgb[(static_cast<size_t>(y) * image.width + x) * 3];
      sum += static_cast<double>(rt::luminance({p[0], p[1], p[2]}));
      ++n;
    }
  }
  return sum / n;
}

/// Two boxes of 4 m side by side, seen from 20 m before their fronts at z = 4.
Scene twoBoxes() {
  SceneMaker m;
  m.box({-5, 0, 0}, {4, 4, 4}, m.material("#ff0000"));
  m.box({1, 0, 0}, {4, 4, 4}, m.material("#00ff00"));
  return std::move(m.finish());
}

RenderOptions straightAhead() {
  RenderOptions o = smallOptions(80, 40);
  o.eye = Vec3{0, 2, 24};
  o.target = Vec3{0, 2, 0};
  o.fov = 40;
  o.layers = true;
  return o;
}

TEST(Layers, tellDepthNormalAndColourOfEachPixel) {
  const Picture p = render(twoBoxes(), straightAhead());
  const size_t red = 20 * 80 + 28, green = 20 * 80 + 52, sky = 40;
  EXPECT_NEAR(p.layers.depth[red], 20, 1e-3);
  EXPECT_NEAR(p.layers.normals[3 * red + 2], 1, 1e-4);
  EXPECT_NEAR(p.layers.albedo[3 * red], 1, 1e-4);
  EXPECT_NEAR(p.layers.albedo[3 * green + 1], 1, 1e-4);
  EXPECT_EQ(p.layers.depth[sky], 0);
  EXPECT_EQ(p.layers.instances[sky], 0u);
  EXPECT_NE(p.layers.instances[red], p.layers.instances[green]);
  EXPECT_NE(p.layers.materials[red], p.layers.materials[green]);
  EXPECT_EQ(p.layers.objects[red], 1u);
}

TEST(Layers, areAbsentUnlessAskedFor) {
  RenderOptions o = straightAhead();
  o.layers = false;
  EXPECT_TRUE(render(twoBoxes(), o).layers.depth.empty());
}

// Each placed copy of each leaf has a number, whether it is placed or merged, and the same one from
// every camera.
TEST(Layers, numberInstancesTheSameFromEverywhere) {
  SceneMaker m;
  const uint32_t grey = m.material("#909090");
  for (int i = 0; i < 40; ++i) m.box({0, 0.1 * i, 0}, {1, 0.1, 1}, grey);
  const uint32_t stack = m.prototype();
  for (int k = 0; k < 5; ++k) m.place(stack, Frame::moved({3.0 * k, 0, 0}));
  const Scene scene = m.finish();
  RenderOptions o = smallOptions(200, 120, 1);
  o.layers = true;
  o.view = PictureView::Front;
  const Renderer renderer(scene);
  const Picture front = renderer.render(o);
  std::set<uint32_t> seen(front.layers.instances.begin(), front.layers.instances.end());
  seen.erase(0);
  EXPECT_EQ(seen.size(), 200u);
  EXPECT_LE(*seen.rbegin(), 200u);
  o.view = PictureView::Top;
  for (const uint32_t number : renderer.render(o).layers.instances) {
    EXPECT_TRUE(number == 0 || seen.count(number));
  }
}

TEST(Layers, areTheSameForAnyNumberOfThreads) {
  const Scene scene = streetScene();
  RenderOptions o = smallOptions(96, 54, 1);
  o.layers = true;
  o.threads = 1;
  const Picture one = render(scene, o);
  o.threads = 3;
  const Picture three = render(scene, o);
  EXPECT_EQ(one.layers.instances, three.layers.instances);
  EXPECT_EQ(one.layers.depth, three.layers.depth);
}

TEST(Cut, leavesOutWhatLiesBeyondAndFillsSolids) {
  const Scene scene = twoBoxes();
  RenderOptions o = straightAhead();
  o.cut = CutPlane{{0, 0, 1}, 2};
  const Picture p = render(scene, o);
  const size_t red = 20 * 80 + 28;
  EXPECT_NEAR(p.layers.depth[red], 22, 1e-3);
  // The cut face is dark, whatever the box is made of, and is no part of it.
  EXPECT_LT(p.layers.albedo[3 * red], 0.1f);
  EXPECT_EQ(p.layers.instances[red], 0u);
  o.cut = CutPlane{{0, 0, 1}, -1};
  EXPECT_EQ(render(scene, o).layers.instances[red], 0u);
}

TEST(Cut, showsTheInsideOfWhatIsHollow) {
  SceneMaker m;
  const uint32_t grey = m.material("#808080");
  // Four walls of half a metre about a room, and a floor.
  m.box({-4, 0, -4}, {8, 4, 0.5}, grey);
  m.box({-4, 0, 3.5}, {8, 4, 0.5}, grey);
  m.box({-4, 0, -3.5}, {0.5, 4, 7}, grey);
  m.box({3.5, 0, -3.5}, {0.5, 4, 7}, grey);
  RenderOptions o = straightAhead();
  o.cut = CutPlane{{0, 0, 1}, 0};
  const Picture p = render(m.finish(), o);
  // The room's far wall in the middle, the cut wall at its side.
  EXPECT_NEAR(p.layers.depth[20 * 80 + 40], 27.5, 1e-2);
  const double metre = 40 / (24 * tanDeg(20));
  const size_t wall = static_cast<size_t>(20 * 80 + 40 + 3.75 * metre);
  EXPECT_NEAR(p.layers.depth[wall], 24, 1e-2);
}

// Rules leave out the faces that houses stand on.
TEST(Cut, fillsWhatHasNoUnderside) {
  SceneMaker m;
  MeshBuilder b;
  std::vector<uint32_t> at;
  for (const Vec3& p : {Vec3{-4, 0, 4}, Vec3{4, 0, 4}, Vec3{4, 0, -4}, Vec3{-4, 0, -4}}) {
    at.push_back(b.addPosition(p));
    at.push_back(b.addPosition(p + Vec3{0, 4, 0}));
  }
  for (uint32_t k = 0; k < 4; ++k) {
    const uint32_t n = (k + 1) % 4;
    b.addPolygon(std::vector<uint32_t>{at[2 * k], at[2 * n], at[2 * n + 1], at[2 * k + 1]});
  }
  b.addPolygon(std::vector<uint32_t>{at[1], at[3], at[5], at[7]});
  m.mesh(b.take(), m.material("#ff0000"));
  RenderOptions o = straightAhead();
  o.cut = CutPlane{{0, 0, 1}, 0};
  o.groundHeight = 0;
  // From above, rays leave the house by its underside.
  o.eye = Vec3{0, 10, 24};
  const Picture p = render(m.finish(), o);
  for (size_t y = 18; y < 24; ++y) EXPECT_LT(p.layers.albedo[3 * (y * 80 + 40)], 0.1f) << y;
}

// A house without thickness: its roof has an underside, and its windows stand back.
TEST(Cut, fillsUnderRoofsWithUndersidesAndBehindPanesSetBack) {
  SceneMaker m;
  MeshBuilder b;
  const auto quad = [&](const Vec3& from, const Vec3& along, const Vec3& up) {
    std::vector<uint32_t> at;
    for (const Vec3& p : {from, from + along, from + along + up, from + up}) {
      at.push_back(b.addPosition(p));
    }
    b.addPolygon(at);
  };
  const Vec3 corner[] = {{-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}};
  for (int k = 0; k < 4; ++k) {
    const Vec3 along = (corner[(k + 1) % 4] - corner[k]) * (1 / 8.0);
    const Vec3 in{-along.z * -0.15, 0, along.x * -0.15}, up{0, 1, 0};
    quad(corner[k], along * 8, up);
    quad(corner[k] + up * 3, along * 8, up);
    for (int i = 0; i < 4; ++i) {
      quad(corner[k] + up + along * (2 * i), along, up * 2);
      quad(corner[k] + up + along * (2 * i + 1) + in, along, up * 2);
    }
  }
  m.mesh(b.take(), m.material("#ff0000"));
  m.box({-4, 4, -4}, {8, 2, 8}, m.material("#ff0000"));
  RenderOptions o = straightAhead();
  o.cut = CutPlane{{0, 0, 1}, 0};
  o.groundHeight = 0;
  const Picture p = render(m.finish(), o);
  int filled = 0, points = 0;
  for (uint32_t y = 0; y < 40; ++y) {
    for (uint32_t x = 0; x < 80; ++x) {
      const size_t i = y * 80 + x;
      const double metre = 40 / (24 * tanDeg(20));
      const double across = (x + 0.5 - 40) / metre, high = 2 - (y + 0.5 - 20) / metre;
      if (std::abs(across) > 3.8 || high < 0.1 || high > 3.9) continue;
      ++points;
      filled += p.layers.albedo[3 * i] < 0.1f;
    }
  }
  EXPECT_EQ(filled, points);
}

/// A parallelogram whose normal is cross(along, up).
void addQuad(MeshBuilder& b, const Vec3& from, const Vec3& along, const Vec3& up) {
  std::vector<uint32_t> at;
  for (const Vec3& p : {from, from + along, from + along + up, from + up}) {
    at.push_back(b.addPosition(p));
  }
  b.addPolygon(at);
}

/// Four walls without thickness about 8 x 8 m, seen from outside or from within.
Mesh skin(double high, bool fromWithin) {
  const Vec3 corner[] = {{-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}};
  MeshBuilder b;
  for (int k = 0; k < 4; ++k) {
    const Vec3 from = corner[k], along = corner[(k + 1) % 4] - from;
    if (fromWithin)
      addQuad(b, from + along, -along, {0, high, 0});
    else
      addQuad(b, from, along, {0, high, 0});
  }
  return b.take();
}

/// What the cut through the middle shows at a height above the ground: the depth of the cut face
/// is 24.
double depthAtHeight(const Scene& scene, double height) {
  RenderOptions o = straightAhead();
  o.cut = CutPlane{{0, 0, 1}, 0};
  o.groundHeight = 0;
  const Picture p = render(scene, o);
  const double metre = 40 / (24 * tanDeg(20));
  const size_t row = static_cast<size_t>(20 - (height - 2) * metre);
  return static_cast<double>(p.layers.depth[row * 80 + 43]);
}

// All walls have bars at one height: a closed box there is no skin, whatever is behind it.
TEST(Cut, fillsASkinWithClosedBarsInItsWindowsUnderASlab) {
  SceneMaker m;
  const uint32_t grey = m.material("#808080");
  m.mesh(skin(1.5, false), grey);
  Frame above;
  above.origin = {0, 2, 0};
  m.mesh(skin(1.5, false), grey, above);
  for (const double z : {-4.0, 3.9}) m.box({-4, 1.5, z}, {8, 0.5, 0.1}, grey);
  for (const double x : {-4.0, 3.9}) m.box({x, 1.5, -4}, {0.1, 0.5, 8}, grey);
  // An attic: a box about it that is open below.
  m.box({-4.5, 4.5, -4.5}, {9, 0.2, 9}, grey);
  for (const double z : {-4.5, 4.3}) m.box({-4.5, 3.5, z}, {9, 1, 0.2}, grey);
  for (const double x : {-4.5, 4.3}) m.box({x, 3.5, -4.5}, {0.2, 1, 9}, grey);
  const Scene scene = m.finish();
  for (const double height : {0.5, 1.75, 3.2, 4.0}) {
    EXPECT_NEAR(depthAtHeight(scene, height), 24, 1e-2) << height;
  }
}

TEST(Cut, leavesRoomsOpenWhoseWallsAreFacesToo) {
  SceneMaker m;
  const uint32_t grey = m.material("#808080");
  m.mesh(skin(3.5, true), grey);
  m.box({-4.5, 3.5, -4.5}, {9, 0.2, 9}, grey);
  m.box({-4, 0, -4}, {8, 0.1, 8}, grey);
  const Scene scene = m.finish();
  EXPECT_NEAR(depthAtHeight(scene, 1.75), 28, 1e-2);
}

TEST(Cut, leavesOpenWhatOneSeesOutOf) {
  SceneMaker m;
  const uint32_t grey = m.material("#808080");
  // A bus stop: a wall and a roof.
  MeshBuilder b;
  addQuad(b, {-4, 0, 4}, {8, 0, 0}, {0, 3, 0});
  m.mesh(b.take(), grey);
  m.box({-4, 3, -4}, {8, 0.2, 8}, grey);
  EXPECT_GT(std::abs(depthAtHeight(m.finish(), 1.5) - 24), 1);
}

TEST(Cut, framesWhatItLeaves) {
  SceneMaker m;
  const uint32_t grey = m.material("#808080");
  m.box({-2, 0, -4}, {4, 4, 4}, grey);
  m.box({-30, 0, 20}, {60, 4, 4}, grey);
  const Scene scene = m.finish();
  RenderOptions o = smallOptions(80, 45, 1);
  o.layers = true;
  o.cut = CutPlane{{0, 0, 1}, -1};
  o.frontAzimuth = 180;
  const Picture p = render(scene, o);
  size_t shown = 0;
  for (const uint32_t number : p.layers.objects) shown += number > 0;
  EXPECT_GT(shown, p.layers.objects.size() / 8);
}

TEST(Cut, goesThroughTheHouseAndNotItsGarden) {
  SceneMaker m;
  const uint32_t grey = m.material("#808080");
  m.box({-5, 0, -4}, {10, 6, 4}, grey);
  m.box({-5, 0, 0}, {10, 0.1, 30}, grey);
  const Scene scene = m.finish();
  RenderOptions o = straightAhead();
  o.look = PictureLook::Section;
  o.frontAzimuth = 180;
  o.groundHeight = 0;
  const Picture p = render(scene, o);
  EXPECT_FALSE(p.isCutAway);
  // In the middle of the picture the cut face of the house, at z = -2.
  EXPECT_NEAR(static_cast<double>(p.layers.depth[20 * 80 + 43]), 26, 0.3);
  o.cut = CutPlane{{0, 0, 1}, -100};
  EXPECT_TRUE(render(scene, o).isCutAway);
}

TEST(Looks, sectionIsCutAtItsFrontOnPaper) {
  RenderOptions o = smallOptions(64, 48, 8);
  o.look = PictureLook::Section;
  const Picture p = render(twoBoxes(), o);
  const std::vector<uint8_t> rgba = toRgba8(p.image);
  EXPECT_GT(rgba[0], 225);
  EXPECT_GT(rgba[2], 215);
  double darkest = 255;
  for (size_t i = 0; i < rgba.size(); i += 4) darkest = std::min<double>(darkest, rgba[i + 1]);
  EXPECT_LT(darkest, 90);
}

TEST(Looks, aBlockOfSoilEndsWhereTheModelDoes) {
  SceneMaker m;
  m.box({-40, 0, -40}, {80, 1, 80}, m.material("#808080"));
  const Scene scene = m.finish();
  RenderOptions o = smallOptions(96, 54, 1);
  o.layers = true;
  o.view = PictureView::Iso;
  const auto shows = [&](bool block) {
    o.groundBlock = block;
    const Picture p = render(scene, o);
    // The middle, and the lower left corner.
    return std::pair(p.layers.depth[27 * 96 + 48] > 0, p.layers.depth[53 * 96] > 0);
  };
  EXPECT_EQ(shows(false), std::pair(true, true));
  EXPECT_EQ(shows(true), std::pair(true, false));
}

TEST(Looks, clayIsOfOneColour) {
  RenderOptions o = smallOptions(64, 36, 16);
  o.look = PictureLook::Clay;
  const Picture p = render(twoBoxes(), o);
  for (uint32_t y = 18; y < 36; ++y) {
    for (uint32_t x = 0; x < 64; ++x) {
      const float* c = &p.image.rgb[(y * 64 + x) * 3];
      EXPECT_LT(std::abs(c[0] - c[1]), 0.35f * c[1]);
    }
  }
}

TEST(Looks, panesOfClayAreAShadeDarker) {
  SceneMaker m;
  m.box({-4, 0, 0}, {8, 4, 4}, m.material("#808080"));
  m.box({-4, 0, 3.98}, {4, 4, 0.04}, m.material("#808080", 0.05));
  RenderOptions o = straightAhead();
  o.look = PictureLook::Clay;
  o.samples = 16;
  const Picture p = render(m.finish(), o);
  const double pane = levelOf(p.image, 0.4, 0.45, 0.48, 0.55);
  const double wall = levelOf(p.image, 0.52, 0.45, 0.6, 0.55);
  EXPECT_LT(pane, 0.75 * wall);
  EXPECT_GT(pane, 0.3 * wall);
}

TEST(Looks, drawingsArePaperWithLines) {
  const Scene scene = streetScene();
  for (const PictureLook look : {PictureLook::Ink, PictureLook::Blueprint}) {
    RenderOptions o = smallOptions(160, 90, 1);
    o.look = look;
    o.threads = 1;
    const Picture one = render(scene, o);
    o.threads = 3;
    EXPECT_EQ(one.image.rgb, render(scene, o).image.rgb);
    const std::vector<uint8_t> rgba = toRgba8(one.image);
    size_t paper = 0, lines = 0;
    for (size_t i = 0; i < rgba.size(); i += 4) {
      const int grey = (rgba[i] + rgba[i + 1] + rgba[i + 2]) / 3;
      const bool isInk = look == PictureLook::Ink;
      paper += isInk ? grey > 200 : grey < 140;
      lines += isInk ? grey < 150 : grey > 150;
    }
    EXPECT_GT(paper, rgba.size() / 4 / 4);
    EXPECT_GT(lines, rgba.size() / 4 / 400);
  }
}

/// The sky from the horizon up, 60 degrees across, away from the sun.
Picture nightSky(double sunElevation) {
  SceneMaker m;
  m.box({-1, 0, -1}, {2, 1, 2}, m.material("#808080"));
  RenderOptions o = smallOptions(200, 100, 4);
  o.sunElevation = sunElevation;
  o.sunAzimuth = 180;
  o.eye = Vec3{0, 2, -10};
  o.target = Vec3{0, 14, -40};
  o.fov = 60;
  return render(m.finish(), o);
}

TEST(Night, isDarkBlueWithStars) {
  const std::vector<uint8_t> night = toRgba8(nightSky(-18).image);
  std::vector<int> levels;
  int64_t red = 0, blue = 0;
  for (size_t i = 0; i < night.size() / 2; i += 4) {
    levels.push_back(night[i + 1]);
    red += night[i];
    blue += night[i + 2];
  }
  std::sort(levels.begin(), levels.end());
  EXPECT_LT(levels[levels.size() / 2], 50);
  EXPECT_GT(levels[levels.size() / 2], 4);
  EXPECT_GT(blue, red * 5 / 4);
  // A few pixels are stars, and some of them bright.
  EXPECT_GT(levels.back(), 80);
  const auto stars = std::count_if(levels.begin(), levels.end(),
                                   [&](int v) { return v > levels[levels.size() / 2] + 25; });
  EXPECT_GT(stars, 5);
  EXPECT_LT(stars, static_cast<int64_t>(levels.size() / 40));
}

TEST(Night, comesAfterDuskAndItsStarsToo) {
  const double dusk = levelOf(nightSky(-3).image), night = levelOf(nightSky(-18).image);
  EXPECT_GT(dusk, 3 * night);
  const std::vector<uint8_t> evening = toRgba8(nightSky(-2).image);
  // Even, row by row.
  for (size_t y = 0; y < 40; ++y) {
    for (size_t x = 1; x < 200; ++x) {
      const size_t i = 4 * (y * 200 + x) + 1;
      ASSERT_LT(std::abs(evening[i] - evening[i - 4]), 8);
    }
  }
}

TEST(Lamps, lightTheirSurroundingsAtNightWithFewSamples) {
  SceneMaker m;
  Material lamp;
  lamp.emissive = {1, 0.9, 0.7};
  m.box({-0.2, 3, -0.2}, {0.4, 0.4, 0.4}, m.material(lamp));
  m.box({-20, -0.1, -20}, {40, 0.1, 40}, m.material("#808080"));
  const Scene scene = m.finish();
  RenderOptions o = smallOptions(48, 48, 4);
  o.sunElevation = -14;
  o.view = PictureView::Top;
  o.adaptExposure = false;
  o.denoise = false;
  const Picture p = render(scene, o);
  const double below = levelOf(p.image, 0.52, 0.44, 0.56, 0.56);
  EXPECT_GT(below, 4 * levelOf(p.image, 0.05, 0.05, 0.1, 0.95));
  o.lampPower = 0;
  EXPECT_GT(below, 3 * levelOf(render(scene, o).image, 0.52, 0.44, 0.56, 0.56));
}

// What one lamp gives by the law of squares, against the sum over many paths.
TEST(Lamps, giveWhatTheyShould) {
  const auto level = [](int parts) {
    SceneMaker m;
    Material lamp;
    lamp.emissive = {1, 1, 1};
    const uint32_t shining = m.material(lamp);
    // The same square lamp in one piece or in many: the tree must not matter.
    for (int i = 0; i < parts; ++i) {
      for (int j = 0; j < parts; ++j) {
        m.box({-1 + 2.0 * i / parts, 4, -1 + 2.0 * j / parts}, {2.0 / parts, 0, 2.0 / parts},
              shining);
      }
    }
    m.box({-20, -0.1, -20}, {40, 0.1, 40}, m.material("#808080"));
    RenderOptions o = smallOptions(32, 32, 64);
    o.sunElevation = -14;
    o.eye = Vec3{0, 3, 6};
    o.target = Vec3{0, 0, 0};
    o.fov = 20;
    o.bounces = 0;
    o.adaptExposure = false;
    o.hazeDistance = 0;
    return levelOf(render(m.finish(), o).image);
  };
  const double one = level(1);
  EXPECT_NEAR(level(12) / one, 1, 0.03);
}

TEST(Lamps, someRoomsAreLitAtNightAndNoneByDay) {
  SceneMaker m;
  const uint32_t glass = m.material("#20262a", 0.05), wall = m.material("#808080");
  m.box({0, 0, 0}, {80, 16, 4}, wall);
  for (int i = 0; i < 19; ++i) {
    for (int k = 0; k < 4; ++k) m.box({1 + 4.0 * i, 1 + 4.0 * k, 4}, {2, 2, 0.02}, glass);
  }
  const Scene scene = m.finish();
  const auto bright = [&](double elevation, std::optional<double> share) {
    RenderOptions o = smallOptions(240, 60, 4);
    o.view = PictureView::Front;
    o.sunElevation = elevation;
    o.sunAzimuth = 0;
    o.litRooms = share;
    o.adaptExposure = false;
    o.frontAzimuth = 180;
    o.ground = false;
    const Picture p = render(scene, o);
    int count = 0;
    for (size_t i = 0; i < p.image.rgb.size(); i += 3) {
      count += p.image.rgb[i] > 0.25f && p.image.rgb[i] > 1.4f * p.image.rgb[i + 2];
    }
    return count;
  };
  const int some = bright(-40, std::nullopt), all = bright(-40, 1.0);
  EXPECT_EQ(bright(-40, 0.0), 0);
  EXPECT_EQ(bright(40, std::nullopt), 0);
  EXPECT_GT(some, all / 6);
  EXPECT_LT(some, 2 * all / 3);
}

Scene pondOver(double opacity, const char* bottom) {
  SceneMaker m;
  m.scene.names.push_back("DeepPond");
  Material water;
  parseColor("#3a6670", water.color, water.opacity);
  water.roughness = 0.04;
  water.opacity = opacity;
  m.box({-30, -1, -30}, {60, 0.01, 60}, m.material(bottom));
  m.box({-30, 0, -30}, {60, 0, 60}, m.material(water));
  m.leaves.back().name = static_cast<uint32_t>(m.scene.names.size() - 1);
  return std::move(m.finish());
}

TEST(Water, showsItsBottomAsFarAsItIsClear) {
  const auto difference = [](double opacity) {
    RenderOptions o = smallOptions(24, 24, 32);
    o.eye = Vec3{0, 8, 3};
    o.target = Vec3{0, 0, 0};
    o.fov = 20;
    o.adaptExposure = false;
    return levelOf(render(pondOver(opacity, "#ffffff"), o).image) -
           levelOf(render(pondOver(opacity, "#000000"), o).image);
  };
  const double clear = difference(0.1), murky = difference(0.9), opaque = difference(1);
  EXPECT_GT(clear, 2 * murky);
  EXPECT_GT(murky, 0.005);
  EXPECT_NEAR(opaque, 0, 0.002);
}

// A dark sheet over a floor that shines, seen at so many degrees above the sheet.
double levelThrough(const char* name, double degrees) {
  SceneMaker m;
  m.scene.names.push_back(name);
  Material sheet;
  parseColor("#101010", sheet.color, sheet.opacity);
  sheet.roughness = 1;
  sheet.opacity = 0.6;
  Material floor;
  floor.emissive = {0.3, 0.3, 0.3};
  m.box({-90, -1, -90}, {180, 0.01, 180}, m.material(floor));
  m.box({-40, 0, -40}, {80, 0, 80}, m.material(sheet));
  m.leaves.back().name = static_cast<uint32_t>(m.scene.names.size() - 1);
  RenderOptions o = smallOptions(24, 24, 64);
  const double angle = degrees * kPi / 180;
  o.eye = Vec3{0, 30 * std::sin(angle), 30 * std::cos(angle)};
  o.target = Vec3{0, 0, 0};
  o.fov = 8;
  o.adaptExposure = false;
  return levelOf(render(std::move(m.finish()), o).image);
}

// A black ball that covers a third, before a wall that shines.
double levelBehindBall(bool smooth) {
  SceneMaker m;
  Material ball, wall;
  parseColor("#000000", ball.color, ball.opacity);
  ball.roughness = 1;
  ball.opacity = 0.33;
  wall.emissive = {0.5, 0.5, 0.5};
  Mesh mesh = ballMesh(5);
  if (!smooth) mesh.normals.clear();
  for (MeshFace& face : mesh.faces) face.smooth = smooth;
  m.mesh(std::move(mesh), m.material(ball));
  m.box({-9, -9, -4}, {18, 18, 0.1}, m.material(wall));
  RenderOptions o = smallOptions(48, 48, 64);
  o.eye = Vec3{0, 0, 9};
  o.target = Vec3{0, 0, 0};
  o.fov = 11;
  o.adaptExposure = false;
  o.denoise = false;
  return levelOf(render(m.finish(), o).image);
}

TEST(Clear, roundThingsAreMetAsOftenAsFlatOnes) {
  EXPECT_NEAR(levelBehindBall(true), levelBehindBall(false), 0.004);
}

TEST(Smoke, coversByTheLengthOfTheWayThrough) {
  EXPECT_NEAR(levelThrough("Smoke", 88), levelThrough("Sheet", 88), 0.06);
  EXPECT_GT(levelThrough("ThinSmoke", 15), 1.2 * levelThrough("Sheet", 15));
}

TEST(Water, hasWavesThatBreakTheMirror) {
  const auto variation = [](bool isPond) {
    Scene scene = pondOver(1, "#000000");
    if (!isPond) scene.names.back() = "Mirror";
    RenderOptions o = smallOptions(96, 48, 16);
    o.eye = Vec3{0, 2, 14};
    o.target = Vec3{0, 0, 4};
    o.fov = 30;
    o.sunAzimuth = 180;
    o.denoise = false;
    const Picture p = render(scene, o);
    double sum = 0;
    for (size_t i = 3; i < p.image.rgb.size(); i += 3) {
      sum += std::abs(p.image.rgb[i + 2] - p.image.rgb[i - 1]);
    }
    return sum;
  };
  EXPECT_GT(variation(true), 2 * variation(false));
}

// The same glitter whichever paths draw it, where the sun's mirror image breaks up in small waves.
TEST(Water, glittersWithoutSpeckle) {
  RenderOptions o = smallOptions(96, 48, 16);
  o.eye = Vec3{0, 14, 28};
  o.target = Vec3{0, 0, 6};
  o.fov = 30;
  o.sunElevation = 38;
  o.sunAzimuth = 0;
  o.adaptExposure = false;
  o.exposureStops = -2;
  const Scene scene = pondOver(1, "#000000");
  const std::vector<float> one = render(scene, o).image.rgb;
  o.seed = 2;
  const std::vector<float> other = render(scene, o).image.rgb;
  double difference = 0, light = 0;
  for (size_t i = 0; i < one.size(); ++i) {
    difference += std::abs(static_cast<double>(one[i]) - static_cast<double>(other[i]));
    light += static_cast<double>(one[i]);
  }
  EXPECT_LT(difference, 0.015 * light);
}

TEST(Leaves, ofFoliageLetLightThrough) {
  const auto under = [](const char* name) {
    SceneMaker m;
    m.scene.names.push_back(name);
    m.box({-10, 3, -10}, {20, 0, 20}, m.material("#6B8743"));
    m.leaves.back().name = static_cast<uint32_t>(m.scene.names.size() - 1);
    RenderOptions o = smallOptions(24, 24, 32);
    o.eye = Vec3{0, 1, 4};
    o.target = Vec3{0, 3, 0};
    o.fov = 20;
    o.sunElevation = 70;
    o.adaptExposure = false;
    return levelOf(render(m.finish(), o).image);
  };
  EXPECT_GT(under("PalmFoliage"), 1.3 * under("Awning"));
}

TEST(Lens, blursWhatIsOutOfFocus) {
  const auto edge = [](double aperture, double focus) {
    RenderOptions o = straightAhead();
    o.samples = 64;
    o.layers = false;
    o.aperture = aperture;
    o.focus = focus;
    o.denoise = false;
    const Picture p = render(twoBoxes(), o);
    // The steepest change from pixel to pixel along a row through both boxes.
    double most = 0;
    for (size_t x = 1; x < 80; ++x) {
      const float* c = &p.image.rgb[(20 * 80 + x) * 3];
      most = std::max(most, std::abs(static_cast<double>(c[1]) - static_cast<double>(c[-2])));
    }
    return most;
  };
  const double sharp = edge(0, 20);
  EXPECT_GT(edge(0.01, 20), 0.7 * sharp);
  EXPECT_LT(edge(0.01, 3), 0.5 * sharp);
}

TEST(Mist, takesColourByDistance) {
  RenderOptions o = straightAhead();
  o.layers = false;
  o.samples = 16;
  const auto redness = [&](double mist) {
    o.hazeDistance = mist;
    const Picture p = render(twoBoxes(), o);
    const float* c = &p.image.rgb[(20 * 80 + 28) * 3];
    return c[0] / (c[0] + c[1] + c[2]);
  };
  EXPECT_GT(redness(0), redness(60) + 0.05f);
  EXPECT_GT(redness(60), redness(10) + 0.05f);
}

TEST(Turntable, comesBackToWhereItBegan) {
  const Scene scene = twoBoxes();
  const Renderer renderer(scene);
  RenderOptions o = smallOptions();
  const Camera start = renderer.cameraOf(o);
  o.orbit = 180;
  const Camera half = renderer.cameraOf(o);
  const Vec3 middle{0, start.eye.y, 2};
  EXPECT_LT(length(half.eye - (middle * 2 - start.eye)), 1e-6);
  o.orbit = 360;
  EXPECT_LT(length(renderer.cameraOf(o).eye - start.eye), 1e-6);
}

}  // namespace
}  // namespace gable
