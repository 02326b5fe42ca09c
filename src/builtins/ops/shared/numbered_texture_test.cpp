// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/ops/shared/numbered_texture.h"

#include <gtest/gtest.h>

#include "builtins/testing/op_fixture.h"

namespace gable {
namespace {

class NumberedTexture : public testing::Test {
 protected:
  NumberedTexture() {
    services_.files.addImage("textures/glass.png", 4, 4, true);
    services_.files.addImage("textures/wall.png", 4, 4, false);
  }
  const Material& worn(double number) {
    shape_ = boxShape({1, 1, 1});
    wearNumberedTexture(shape_, services_, number, 1, 0.25);
    return services_.materials().get(shape_.material);
  }

  FakeServices services_;
  Shape shape_;
};

TEST_F(NumberedTexture, picturesAreCountedByName) {
  EXPECT_EQ(worn(0).map(TextureLayer::Color).path, "textures/glass.png");
  const TextureMap wall = worn(1).map(TextureLayer::Color);
  EXPECT_EQ(wall.path, "textures/wall.png");
  EXPECT_EQ(wall.su, 0.5);
  EXPECT_EQ(wall.rw, 90);
}

TEST_F(NumberedTexture, transparentPicturesMakeTransparentBodies) {
  EXPECT_EQ(worn(0).map(TextureLayer::Opacity).path, "textures/glass.png");
  EXPECT_EQ(worn(0).map(TextureLayer::Opacity).su, 0.5);
  EXPECT_EQ(worn(1).map(TextureLayer::Opacity).path, "");
}

TEST_F(NumberedTexture, aNumberWithoutAPictureIsToldForEachShape) {
  EXPECT_EQ(worn(2).map(TextureLayer::Color).path, "");
  EXPECT_EQ(worn(2).map(TextureLayer::Color).path, "");
  EXPECT_EQ(worn(-1).map(TextureLayer::Color).path, "");
  ASSERT_EQ(services_.warnings.size(), 3u);
  EXPECT_EQ(services_.warnings[0].code, "unknown-texture");
  worn(1);
  EXPECT_EQ(services_.warnings.size(), 3u);
}

}  // namespace
}  // namespace gable
