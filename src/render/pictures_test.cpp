// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Pictures for the eye: with GABLE_PICTURES=<folder> the street scene is written there as PPM
// files, one a view, with levels and speed on standard output. Without it only small pictures are
// made.

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "render/render.h"
#include "render/test_scenes.h"

namespace gable {
namespace {

void writePpm(const std::string& path, const LinearImage& image) {
  const std::vector<uint8_t> rgba = toRgba8(image);
  std::FILE* file = std::fopen(path.c_str(), "wb");
  ASSERT_NE(file, nullptr) << path;
  std::fprintf(file, "P6\n%u %u\n255\n", image.width, image.height);
  for (size_t i = 0; i < rgba.size(); i += 4) std::fwrite(&rgba[i], 1, 3, file);
  std::fclose(file);
}

TEST(Pictures, ofTheStreetForTheEye) {
  const char* folder = std::getenv("GABLE_PICTURES");
  if (!folder) GTEST_SKIP() << "set GABLE_PICTURES to a folder to get pictures to look at";
  const char* samples = std::getenv("GABLE_SAMPLES");
  const Scene scene = streetScene();
  const std::pair<PictureView, const char*> views[] = {{PictureView::Iso, "iso"},
                                                       {PictureView::Front, "front"},
                                                       {PictureView::Street, "street"},
                                                       {PictureView::Top, "top"}};
  for (const auto& [view, name] : views) {
    RenderOptions options;
    options.view = view;
    options.width = 1280;
    options.height = 720;
    options.samples = samples ? static_cast<uint32_t>(std::atoi(samples)) : 16;
    const Picture picture = render(scene, options);
    writePpm(std::string(folder) + "/" + name + ".ppm", picture.image);
    const RenderStats& s = picture.stats;
    std::printf(
        "%-7s %llu triangles (%llu stored), %.1f Mrays, %.2f Mrays/s, prepare %.2f trace "
        "%.2f denoise %.2f s\n",
        name, static_cast<unsigned long long>(s.triangles),
        static_cast<unsigned long long>(s.storedTriangles), static_cast<double>(s.rays) * 1e-6,
        static_cast<double>(s.rays) * 1e-6 / s.seconds.trace, s.seconds.prepare, s.seconds.trace,
        s.seconds.denoise);
  }
}

}  // namespace
}  // namespace gable
