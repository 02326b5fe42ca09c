// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "lsp/framing.h"

#include <gtest/gtest.h>

#include "lsp/uri.h"

namespace gable::lsp {
namespace {

TEST(Framing, takesMessagesOutOfPieces) {
  const std::string stream = framed("{\"a\":1}") + framed("{}");
  Framing f;
  std::string bodies;
  for (const char c : stream) {
    f.feed(std::string_view(&c, 1));
    while (const auto frame = f.next()) bodies += frame->body;
  }
  EXPECT_EQ(bodies, "{\"a\":1}{}");
}

TEST(Framing, goesOnAfterABadHead) {
  Framing f;
  f.feed("Nonsense: 3\r\n\r\n" + framed("{}"));
  EXPECT_FALSE(f.next()->trouble.empty());
  EXPECT_EQ(f.next()->body, "{}");
  f.feed("content-LENGTH:  2 \r\nContent-Type: x\r\n\r\n[]");
  EXPECT_EQ(f.next()->body, "[]");
}

TEST(Framing, passesOverWhatIsTooLarge) {
  Framing f;
  const uint64_t size = Framing::kLargestMessage + 10;
  f.feed("Content-Length: " + std::to_string(size) + "\r\n\r\n");
  EXPECT_FALSE(f.next()->trouble.empty());
  const std::string piece(1 << 20, 'x');
  for (uint64_t sent = 0; sent < size; sent += piece.size()) {
    f.feed(std::string_view(piece).substr(0, std::min<uint64_t>(piece.size(), size - sent)));
    EXPECT_FALSE(f.next());
  }
  f.feed(framed("{}"));
  EXPECT_EQ(f.next()->body, "{}");
}

TEST(Framing, givesUpAHeadWithoutEnd) {
  Framing f;
  f.feed(std::string(Framing::kLargestHead + 1, 'x'));
  EXPECT_FALSE(f.next()->trouble.empty());
  f.feed(framed("{}"));
  EXPECT_EQ(f.next()->body, "{}");
  f.feed("Content-Length: 99999999999999999999999\r\n\r\n" + framed("[]"));
  EXPECT_FALSE(f.next()->trouble.empty());
  EXPECT_EQ(f.next()->body, "[]");
}

TEST(Uri, leadsBothWays) {
  EXPECT_EQ(*pathOfUri("file:///a%20b/c%C3%A9.cga"), "/a b/c\xc3\xa9.cga");
  EXPECT_EQ(*pathOfUri("file://localhost/a"), "/a");
  EXPECT_EQ(uriOfPath("/a b/c\xc3\xa9.cga"), "file:///a%20b/c%C3%A9.cga");
  EXPECT_FALSE(pathOfUri("untitled:Untitled-1"));
  EXPECT_FALSE(pathOfUri("file:///a%00b"));
}

}  // namespace
}  // namespace gable::lsp
