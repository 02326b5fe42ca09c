// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "runtime/sharing.h"
#include "program/tag_effects.h"

#include <gtest/gtest.h>

#include <functional>

namespace gable {
namespace {

Shape boxShape() {
  Shape s;
  s.geometry.kind = GeometryKind::Box;
  s.size = {3, 4, 5};
  return s;
}

ShareKey keyWith(uint32_t effects, const std::function<void(Shape&)>& change = {},
                 std::vector<Value> arguments = {}, std::vector<Value> attributes = {}) {
  Shape s = boxShape();
  if (change) change(s);
  return sharedKey({77, effects, s, arguments, attributes});
}

TEST(Sharing, EqualCallsHaveEqualKeys) {
  EXPECT_EQ(keyWith(kPure), keyWith(kPure));
  EXPECT_EQ(keyWith(kPure, {}, {Value::of(2.0)}, {Value::of(3.0)}),
            keyWith(kPure, {}, {Value::of(2.0)}, {Value::of(3.0)}));
  // Where a shape stands, and what came before it, is nobody's business.
  EXPECT_EQ(keyWith(kPure), keyWith(kPure, [](Shape& s) {
              s.path = 99;
              s.split = {3, 7};
              s.comp = {1, 2};
              s.geometry.refSize = {1, 2, 3};
              s.pivot = Frame::moved({1, 0, 0});
            }));
}

TEST(Sharing, WhatACallIsGivenTellsItApart) {
  const ShareKey plain = keyWith(kPure);
  EXPECT_NE(plain, keyWith(kPure, [](Shape& s) { s.size.y = 4.5; }));
  EXPECT_NE(plain, keyWith(kPure, [](Shape& s) { s.material = MaterialId{4}; }));
  EXPECT_NE(plain, keyWith(kPure, [](Shape& s) { s.attributes = 5; }));
  EXPECT_NE(plain, keyWith(kPure, [](Shape& s) { s.geometry.kind = GeometryKind::QuadXy; }));
  EXPECT_NE(plain, keyWith(kPure, [](Shape& s) { s.trimVertical = !s.trimVertical; }));
  EXPECT_NE(plain, keyWith(kPure, {}, {Value::of(1.0)}));
  EXPECT_NE(plain, keyWith(kPure, {}, {}, {Value::of(1.0)}));
}

TEST(Sharing, EffectsBringInWhatTheyName) {
  const auto inSplit = [](Shape& s) { s.split = {3, 7}; };
  const auto inComp = [](Shape& s) { s.comp = {1, 2}; };
  const auto onPivot = [](Shape& s) { s.pivot = Frame::moved({1, 0, 0}); };
  EXPECT_NE(keyWith(kReadsSplit), keyWith(kReadsSplit, inSplit));
  EXPECT_EQ(keyWith(kReadsComp), keyWith(kReadsComp, inSplit));
  EXPECT_NE(keyWith(kReadsComp), keyWith(kReadsComp, inComp));
  EXPECT_NE(keyWith(kReadsPivot), keyWith(kReadsPivot, onPivot));
  EXPECT_NE(keyWith(kReadsPivotAxes), keyWith(kReadsPivotAxes, onPivot));
}

TEST(Sharing, TheOwnFrameHidesThePlace) {
  const auto moved = [](double x, uint32_t effects) {
    Shape s = boxShape();
    s.scope = Frame::moved({x, 2, 0});
    s.pivot = Frame::moved({x + 1, 2, 0});
    putIntoOwnFrame(s, effects, Frame(s.scope));
    return s;
  };
  for (const uint32_t effects : {uint32_t{kPure}, uint32_t{kReadsPivot}}) {
    // A tenth has no exact place in the second frame, and comes out the same even so.
    const Shape a = moved(0.1, effects), b = moved(1e5 + 0.1, effects);
    EXPECT_EQ(a.scope, Frame{});
    EXPECT_EQ(a.pivot, b.pivot);
    EXPECT_EQ(sharedKey({1, effects, a, {}, {}}), sharedKey({1, effects, b, {}, {}}));
  }
  EXPECT_EQ(moved(0, kReadsPivot).pivot.origin.x, 1);
  EXPECT_EQ(moved(0, kReadsPivotAxes).pivot.origin.x, 0);
}

TEST(Sharing, EqualPartsAreAlikeUnlessTheyHaveOtherTagsOrPlanes) {
  Shape s = boxShape();
  s.size = {100, 4, 5};
  const PartPlan alongX{Axis::X, false, 5, 0, 0}, alongY{Axis::Y, false, 4, 0, 0};
  const SplitPiece parts[] = {{0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {50, 1, 0}};
  EXPECT_TRUE(areAlike(s, kReadsTags, alongX, parts[0], parts[1]));
  EXPECT_FALSE(areAlike(s, kReadsTags, alongX, parts[0], {1, 2, 0}));
  s.geometry.tags[kSideLeft] = 7;
  EXPECT_FALSE(areAlike(s, kReadsTags, alongX, parts[0], parts[1]));
  EXPECT_TRUE(areAlike(s, kPure, alongX, parts[0], parts[1]));
  EXPECT_TRUE(areAlike(s, kReadsTags, alongX, parts[1], parts[2]));
  EXPECT_TRUE(areAlike(s, kReadsTags, alongY, parts[0], parts[1]));
  s.geometry.tags[kSideLeft] = 0;
  ShapeExtra extra;
  extra.trim.push_back({{-1, 0, 0}, 0, false});
  s.extra = makeRef<ShapeExtra>(extra);
  // The first one lies at the plane, the last one so far from it that it forgets it.
  EXPECT_FALSE(areAlike(s, kReadsTags, alongX, parts[0], parts[3]));
  EXPECT_FALSE(areAlike(s, kReadsTags, alongX, parts[0], parts[1]));
  EXPECT_TRUE(areAlike(s, kReadsTags, alongX, parts[2], parts[3]));
  EXPECT_TRUE(areAlike(s, kReadsTags, alongY, parts[0], parts[2]));
  extra.projections.emplace_back();
  s.extra = makeRef<ShapeExtra>(extra);
  EXPECT_FALSE(areAlike(s, kReadsTags, alongY, parts[0], parts[2]));
}

TEST(Sharing, TagsComeAlongWhereTheyAreRead) {
  const auto tagged = [](uint32_t tags, uint32_t effects) {
    Shape s = boxShape();
    s.geometry = primitive(GeometryKind::Box, tags);
    putIntoOwnFrame(s, effects, Frame(s.scope));
    return s.geometry;
  };
  EXPECT_EQ(tagged(1, kPure), tagged(2, kPure));
  EXPECT_FALSE(tagged(1, kReadsTags) == tagged(2, kReadsTags));
}

TEST(Sharing, TrimPlanesComeAlongWhereTheyAreSeen) {
  Shape s = boxShape();
  s.scope = Frame::moved({10, 0, 0});
  ShapeExtra extra;
  extra.trim.push_back({{1, 0, 0}, 12, false});
  s.extra = makeRef<ShapeExtra>(extra);
  Shape unseen = s;
  putIntoOwnFrame(unseen, kPure, Frame(s.scope));
  EXPECT_FALSE(unseen.extra);
  putIntoOwnFrame(s, kUsesTrim, Frame(s.scope));
  ASSERT_TRUE(s.extra);
  EXPECT_EQ(s.extra->trim[0].distance, 2);
}

}  // namespace
}  // namespace gable
