// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "engine/drawn_textures.h"

#include <gtest/gtest.h>

#include "material/builtin_textures.h"

namespace gable {
namespace {

std::string pattern(size_t number) { return builtinTexturePath(number); }

TEST(DrawnTextures, areDrawnOnceAndShared) {
  DrawnTextures textures;
  const TexturePicture first = textures.find(pattern(0));
  ASSERT_TRUE(first);
  EXPECT_GT(first->width, 0u);
  EXPECT_EQ(first->rgba.size(), size_t{first->width} * first->height * 4);
  EXPECT_EQ(textures.find(pattern(0)), first);
}

TEST(DrawnTextures, otherPathsAreNotTheirs) {
  DrawnTextures textures;
  EXPECT_EQ(textures.find("brick.png"), nullptr);
  EXPECT_TRUE(drawnWith("brick.png").empty());
  EXPECT_TRUE(textures.known("brick.png").empty());
}

TEST(DrawnTextures, areKnownOnceTheyAreDrawn) {
  DrawnTextures textures;
  EXPECT_TRUE(textures.known(pattern(1)).empty());
  // A path that is named twice, and one that is no drawn texture.
  textures.draw({pattern(1), pattern(0), pattern(1), "brick.png"}, 4);
  for (const size_t number : {0u, 1u}) {
    const std::vector<TexturePicture> known = textures.known(pattern(number));
    ASSERT_EQ(known.size(), drawnWith(pattern(number)).size());
    EXPECT_EQ(known[0], textures.find(pattern(number)));
    EXPECT_EQ(known[0]->rgba, drawTextures({pattern(number)})[0].rgba);
  }
}

}  // namespace
}  // namespace gable
