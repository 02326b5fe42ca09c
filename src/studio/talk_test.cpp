// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The language server over the studio's own connection: who is let in, what is answered, and that
// nothing outside of the project is read.
#include <gtest/gtest.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <filesystem>
#include <fstream>

#include "studio/testing/stranger.h"

namespace gable::studio {
namespace {

namespace fs = std::filesystem;
namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using namespace studio::testing;

const std::string kToken = "0123456789abcdef0123456789abcdef";

class Talk : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    base_ = fs::temp_directory_path() / ("gable_talk_" + name + std::to_string(getpid()));
    fs::create_directories(base_ / "project");
    std::ofstream(base_ / "project/inside.cga") << "Kept --> NIL\n";
    std::ofstream(base_ / "outside.cga") << "Secret --> NIL\n";
    fs::create_symlink(base_ / "outside.cga", base_ / "project/link.cga");
    StudioSettings settings;
    settings.project = (base_ / "project").string();
    settings.token = kToken;
    studio_.start(settings);
  }
  void TearDown() override {
    studio_.stop();
    fs::remove_all(base_);
  }

  /// Empty when the connection was accepted; else why not.
  std::string connect(const std::string& protocols, const std::string& origin = {},
                      const std::string& target = "/api/language") {
    beast::error_code error;
    stream_.emplace(io_);
    const asio::ip::tcp::endpoint to(asio::ip::address_v4::loopback(),
                                     static_cast<uint16_t>(studio_.port()));
    stream_->next_layer().connect(to, error);
    stream_->set_option(websocket::stream_base::decorator([&](websocket::request_type& r) {
      r.set(beast::http::field::sec_websocket_protocol, protocols);
      if (!origin.empty()) r.set(beast::http::field::origin, origin);
    }));
    const std::string host = "127.0.0.1:" + std::to_string(studio_.port());
    stream_->handshake(host, target, error);
    return error ? error.message() : "";
  }
  void say(const std::string& message) {
    beast::error_code error;
    stream_->write(asio::buffer(message), error);
  }
  /// The next message; empty when the connection has ended.
  std::string hear() {
    beast::flat_buffer buffer;
    beast::error_code error;
    stream_->read(buffer, error);
    return error ? "" : beast::buffers_to_string(buffer.data());
  }
  std::string ask(const std::string& method, const std::string& params) {
    say(R"({"jsonrpc":"2.0","id":1,"method":")" + method + R"(","params":)" + params + "}");
    std::string answer;
    do {
      answer = hear();
    } while (!answer.empty() && answer.find("\"id\":1") == std::string::npos);
    return answer;
  }
  std::string symbolsOf(const fs::path& file) {
    return ask("textDocument/documentSymbol",
               R"({"textDocument":{"uri":"file://)" + file.string() + R"("}})");
  }

  fs::path base_;
  RunningStudio studio_;
  asio::io_context io_;
  std::optional<websocket::stream<asio::ip::tcp::socket>> stream_;
};

TEST_F(Talk, answersThoseWithTheToken) {
  ASSERT_EQ(connect("gable-language, " + kToken), "");
  EXPECT_NE(ask("initialize", "{}").find("capabilities"), std::string::npos);
  say(R"({"jsonrpc":"2.0","method":"textDocument/didOpen","params":{"textDocument":)"
      R"json({"uri":"untitled:a.cga","version":1,"text":"Lot --> extrud(3)"}}})json");
  EXPECT_NE(hear().find("did you mean 'extrude'"), std::string::npos);
}

TEST_F(Talk, refusesStrangers) {
  EXPECT_NE(connect(""), "");
  EXPECT_NE(connect("gable-language"), "");
  EXPECT_NE(connect("gable-language, " + std::string(32, '0')), "");
  EXPECT_NE(connect("gable-language, " + kToken, "http://example.org"), "");
  EXPECT_NE(connect("gable-language, " + kToken, "", "/api/derive"), "");
  EXPECT_EQ(connect("gable-language, " + kToken), "");
}

TEST_F(Talk, readsNothingOutsideOfTheProject) {
  ASSERT_EQ(connect("gable-language, " + kToken), "");
  const std::string outside = R"({"rootUri":"file://)" + base_.string() + R"("})";
  ask("initialize", outside);
  EXPECT_NE(symbolsOf(base_ / "project/inside.cga").find("Kept"), std::string::npos);
  for (const char* name : {"outside.cga", "project/../outside.cga", "project/link.cga"}) {
    EXPECT_EQ(symbolsOf(base_ / name).find("Secret"), std::string::npos) << name;
  }
  EXPECT_EQ(ask("workspace/symbol", R"({"query":""})").find("Secret"), std::string::npos);
}

TEST_F(Talk, livesThroughNonsenseAndGoesOnForOthers) {
  ASSERT_EQ(connect("gable-language, " + kToken), "");
  for (const char* text : {"", "{", "[]", R"({"id":1,"method":7})", R"({"method":"exit"})"})
    say(text);
  EXPECT_NE(hear(), "");
  ASSERT_EQ(connect("gable-language, " + kToken), "");
  // More than a message may have.
  say(std::string(40u << 20, ' '));
  EXPECT_EQ(hear(), "");
  ASSERT_EQ(connect("gable-language, " + kToken), "");
  EXPECT_NE(ask("initialize", "{}").find("capabilities"), std::string::npos);
}

TEST_F(Talk, endsWithItsClientAndWithTheServer) {
  for (int i = 0; i < 300; ++i) {
    ASSERT_EQ(connect("gable-language, " + kToken), "") << i;
    say(R"({"jsonrpc":"2.0","id":1,"method":"initialize","params":{}})");
  }
  studio_.stop();
}

}  // namespace
}  // namespace gable::studio
