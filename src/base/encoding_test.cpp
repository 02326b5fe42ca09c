// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "base/encoding.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

using namespace std::string_literals;

TEST(Encoding, utf8StaysAsItIs) {
  for (const std::string& text :
       {""s, "Lot --> X."s, "T\xc3\xbcr \xe2\x82\xac \xf0\x9f\x8f\xa0"s, "a\0b"s}) {
    EXPECT_TRUE(isUtf8(text));
    EXPECT_EQ(utf8Of(text), text);
  }
}

TEST(Encoding, allElseIsWindows1252) {
  EXPECT_EQ(utf8Of("T\xfcr"), "T\xc3\xbcr");
  EXPECT_EQ(utf8Of("5 \x80"), "5 \xe2\x82\xac");
  EXPECT_EQ(utf8Of("\x81"), "\xc2\x81");
  std::string every;
  for (int byte = 0; byte < 256; ++byte) every += static_cast<char>(byte);
  EXPECT_FALSE(isUtf8(every));
  EXPECT_TRUE(isUtf8(utf8Of(every)));
}

TEST(Encoding, utf16IsKnownByItsMark) {
  EXPECT_EQ(utf8Of("\xff\xfe"
                   "A\0\xfc\0"s),
            "A\xc3\xbc");
  EXPECT_EQ(utf8Of("\xfe\xff"
                   "\0A\0\xfc"s),
            "A\xc3\xbc");
  EXPECT_EQ(utf8Of("\xff\xfe\x3c\xd8\xe0\xdf"s), "\xf0\x9f\x8f\xa0");
  // A pair that is broken off, and half a unit.
  EXPECT_EQ(utf8Of("\xff\xfe\x3c\xd8"s), "\xef\xbf\xbd");
  EXPECT_EQ(utf8Of("\xff\xfe"
                   "A\0B"s),
            "A");
}

}  // namespace
}  // namespace gable
