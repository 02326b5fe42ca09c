// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// More of what a stranger may try, address by address and notation by notation.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <future>
#include <thread>

#include "base/json.h"
#include "gable/studio.h"
#include "studio/http.h"
#include "studio/testing/stranger.h"

namespace gable::studio {
namespace {

namespace fs = std::filesystem;
using namespace studio::testing;
using Clock = std::chrono::steady_clock;

// A bare server with little patience: everybody is admitted, everything is answered with a word.
class Impatient : public ::testing::Test {
 protected:
  void start(HttpSettings settings, std::string answer = "word") {
    server_ = std::make_unique<HttpServer>(
        settings, [](const HttpRequest&) { return HttpResponse{}; },
        [answer](const HttpRequest&) {
          return HttpResponse{200, "text/plain", answer, {}};
        });
    port_ = server_->listen().value();
    thread_ = std::thread([this] { server_->run(stop_); });
  }
  void TearDown() override {
    stop_ = true;
    thread_.join();
  }
  std::string ask() const {
    const int s = connectTo(port_);
    send(s, "GET /x HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n");
    const std::string out = receive(s);
    close(s);
    return out;
  }

  std::unique_ptr<HttpServer> server_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
  int port_ = 0;
};

TEST_F(Impatient, aHeadThatNeverEndsIsGivenUp) {
  HttpSettings settings;
  settings.headSeconds = 0.2;
  start(settings);
  const int s = connectTo(port_);
  send(s, "GET /x HTTP/1.1\r\nHost: ");
  // Returns only when the server closes.
  const int code = status(receive(s));
  EXPECT_TRUE(code == 0 || code >= 400) << code;
  close(s);
  EXPECT_EQ(status(ask()), 200);
}

TEST_F(Impatient, aBodyThatTricklesIsGivenUp) {
  HttpSettings settings;
  settings.bodySeconds = 0.3;
  start(settings);
  const int s = connectTo(port_);
  send(s, "PUT /x HTTP/1.1\r\nHost: x\r\nContent-Length: 1000000\r\n\r\n");
  // A byte now and then does not win more time.
  const auto begin = Clock::now();
  bool open = true;
  while (open && Clock::now() - begin < std::chrono::seconds(20)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    open = send(s, "x");
  }
  EXPECT_FALSE(open);
  close(s);
  EXPECT_EQ(status(ask()), 200);
}

TEST_F(Impatient, aClientThatDoesNotReadIsGivenUp) {
  HttpSettings settings;
  settings.writeSeconds = 0.3;
  settings.maxConnections = 1;
  start(settings, std::string(size_t{64} << 20, 'x'));
  const int s = connectTo(port_);
  send(s, "GET /x HTTP/1.1\r\nHost: x\r\n\r\n");
  // The one place is free again some time after.
  const auto begin = Clock::now();
  std::string answer;
  while (answer.empty() && Clock::now() - begin < std::chrono::seconds(20)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    answer = ask();
  }
  EXPECT_EQ(status(answer), 200);
  close(s);
}

// Many connections together hold no more than one budget of bytes; it is free again afterwards.
TEST_F(Impatient, theBodiesOfAllConnectionsHaveOneBudget) {
  HttpSettings settings;
  settings.maxBody = 1000;
  settings.maxBodies = 2500;
  start(settings);
  const auto begin = [&](const char* more) {
    const int s = connectTo(port_);
    send(s,
         std::string("PUT /x HTTP/1.1\r\nHost: x\r\nConnection: close\r\n") + more + "\r\n\r\nx");
    return s;
  };
  for (int round = 0; round < 3; ++round) {
    const int a = begin("Content-Length: 1000"), b = begin("Transfer-Encoding: chunked");
    // Both have their share once a small request behind them is answered.
    EXPECT_EQ(status(ask()), 200);
    const int c = begin("Content-Length: 600");
    EXPECT_EQ(status(receive(c)), 503);
    const int d = begin("Content-Length: 1");
    EXPECT_EQ(status(receive(d)), 200);
    send(a, std::string(999, 'x'));
    EXPECT_EQ(status(receive(a)), 200);
    for (const int s : {a, b, c, d}) close(s);
    // The server learns of b's end on its own time.
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
}

TEST(Answers, whatAHandlerThrowsIsToldAsADiagnostic) {
  std::atomic<bool> stop{false};
  HttpServer server(
      {}, [](const HttpRequest&) { return HttpResponse{}; },
      [](const HttpRequest& r) -> HttpResponse {
        if (r.path == "/memory") throw std::bad_alloc();
        throw std::runtime_error("x");
      });
  const int port = server.listen().value();
  std::thread thread([&] { server.run(stop); });
  for (const auto& [path, code] :
       {std::pair{"/memory", "out-of-memory"}, {"/", "internal-error"}}) {
    const int s = connectTo(port);
    send(s, std::string("GET ") + path + " HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n");
    const std::string answer = receive(s);
    EXPECT_EQ(status(answer), 500);
    const Result<JsonValue> told = parseJson(answer.substr(answer.find("\r\n\r\n") + 4));
    ASSERT_TRUE(told.ok()) << answer;
    EXPECT_EQ(told.value()["code"].text(), code);
    EXPECT_FALSE(told.value()["hint"].text().empty());
    close(s);
  }
  stop = true;
  thread.join();
}

TEST(Answers, largeOnesComeInPiecesThatAreGivenBack) {
  std::atomic<bool> stop{false};
  std::promise<std::vector<std::string>> back;
  std::promise<void> after;
  HttpServer server(
      {}, [](const HttpRequest&) { return HttpResponse{}; },
      [&](const HttpRequest&) {
        HttpResponse out{200, "text/plain", "head ", {}};
        out.rest = {std::string(1 << 20, 'a'), "", "end"};
        out.sent = [&](std::vector<std::string> pieces) { back.set_value(std::move(pieces)); };
        out.after = [&] { after.set_value(); };
        return out;
      });
  const int port = server.listen().value();
  std::thread thread([&] { server.run(stop); });
  const int s = connectTo(port);
  send(s, "GET / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n");
  const std::string answer = receive(s);
  EXPECT_NE(answer.find("Content-Length: 1048584\r\n"), std::string::npos);
  EXPECT_EQ(answer.substr(answer.find("\r\n\r\n") + 4),
            "head " + std::string(1 << 20, 'a') + "end");
  EXPECT_EQ(back.get_future().get().size(), 4u);
  after.get_future().get();
  close(s);
  stop = true;
  thread.join();
}

TEST_F(Impatient, aBodyInPiecesEndsWhereItIsTooLarge) {
  HttpSettings settings;
  settings.maxBody = 1 << 20;
  start(settings);
  const int s = connectTo(port_);
  send(s, "PUT /x HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n");
  const std::string piece = "10000\r\n" + std::string(0x10000, 'x') + "\r\n";
  bool open = true;
  for (int i = 0; i < 64 && open; ++i) open = send(s, piece);
  const std::string answer = receive(s);
  EXPECT_TRUE(answer.empty() || status(answer) == 413) << answer.substr(0, 100);
  EXPECT_TRUE(!open || status(answer) == 413);
  close(s);
  EXPECT_EQ(status(ask()), 200);
}

TEST_F(Impatient, moreAtOnceThanItTakesAreAnsweredOrSentAway) {
  start({});
  // Both ends of a connection are files of this process.
  std::vector<int> all;
  for (int i = 0; i < 600; ++i) {
    all.push_back(connectTo(port_));
    send(all.back(), "GET /x HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n");
  }
  int served = 0;
  for (const int s : all) {
    const int code = status(receive(s));
    EXPECT_TRUE(code == 200 || code == 503 || code == 0) << code;
    served += code == 200;
    close(s);
  }
  EXPECT_GE(served, 64);
  EXPECT_EQ(status(ask()), 200);
}

// The studio on a folder, beside which there is a secret.
class Stranger : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = ::testing::TempDir() + "gable-stranger-" +
            ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(root_);
    fs::create_directories(root_ + "/project/rules");
    fs::create_directories(root_ + "/page");
    std::ofstream(root_ + "/secret.obj") << "v 31415 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    std::ofstream(root_ + "/project/rules/a.cga") << "@StartRule\nLot --> extrude(3) Body\n";
    StudioSettings settings;
    settings.project = root_ + "/project";
    settings.page = root_ + "/page";
    settings.token = "right";
    studio_.start(settings);
  }
  void TearDown() override {
    studio_.stop();
    fs::remove_all(root_);
  }
  std::string ask(const std::string& line, const std::string& body = {},
                  const std::string& more = "X-Gable-Token: right\r\n") const {
    const int s = connectTo(studio_.port());
    send(s, line + " HTTP/1.1\r\nHost: localhost:" + std::to_string(studio_.port()) + "\r\n" +
                more + "Connection: close\r\nContent-Length: " + std::to_string(body.size()) +
                "\r\n\r\n" + body);
    const std::string out = receive(s);
    close(s);
    return out;
  }
  std::string derived(const std::string& file, const std::string& text) const {
    std::string body;
    JsonWriter json(body);
    json.beginObject().key("file").value(file).key("text").value(text).key("page").value("p");
    json.key("shapes").raw(R"({"lot":[20,20]})").key("limits").raw(R"({"seconds":0.5})");
    json.endObject();
    return ask("POST /api/derive", body);
  }

  std::string root_;
  RunningStudio studio_;
};

TEST_F(Stranger, largeTextsAreNotConverted) {
  const std::string address = "POST /api/convert?path=rules/a.park";
  EXPECT_EQ(status(ask(address, "A -> LAWN\n")), 200);
  EXPECT_EQ(status(ask(address, std::string((8 << 20) + 1, ' '))), 413);
}

TEST_F(Stranger, noAddressLeadsOutOfTheProject) {
  const std::vector<std::string> outside = {
      "..%2Fsecret.obj", "%2e%2e%2Fsecret.obj", "rules%2F..%2F..%2Fsecret.obj",
      "..%5Csecret.obj", "%2Fetc%2Fpasswd",     ".gable%2Frecovery%2Fa.cga"};
  for (const std::string& path : outside) {
    for (const char* address :
         {"GET /api/file?path=", "GET /api/previous?path=", "GET /api/model?path=",
          "GET /api/recovery?path=", "PUT /api/file?path=", "PUT /api/recovery?path=",
          "POST /api/convert?path=", "GET /api/example-picture?name=",
          "POST /api/example-copy?name=", "GET /api/texture?derivation=1&path="}) {
      const std::string answer = ask(address + path, "x");
      EXPECT_GE(status(answer), 400) << address << path;
      EXPECT_EQ(answer.find("31415"), std::string::npos) << address << path;
    }
  }
  for (const char* file :
       {"../secret.obj", "/etc/passwd", ".gable/x.obj", "rules/../../secret.obj"}) {
    const std::string name = std::string("\"") + file + "\"";
    EXPECT_GE(status(ask("POST /api/shapes", "{\"shapes\":{\"file\":" + name + "}}")), 400) << file;
    EXPECT_GE(status(ask("POST /api/derive", "{\"file\":" + name + ",\"text\":\"\"}")), 400)
        << file;
    EXPECT_GE(status(ask("POST /api/asset", "{\"path\":" + name + ",\"to\":\"a.glb\"}")), 400)
        << file;
    EXPECT_GE(status(ask("POST /api/asset", "{\"path\":\"rules/a.cga\",\"to\":" + name + "}")),
              400);
  }
  // Rules that read files keep to the project, too.
  for (const char* rule : {"Lot --> i(\"../secret.obj\")", "Lot --> i(\"/etc/passwd\")",
                           "Lot --> print(readTextFile(\"../secret.obj\")) X."}) {
    EXPECT_EQ(derived("rules/a.cga", std::string("@StartRule\n") + rule).find("31415"),
              std::string::npos)
        << rule;
  }
  EXPECT_NE(derived("rules/a.cga", "import s : \"../secret.obj\"\n@StartRule\nLot --> X.")
                .find("import-not-found"),
            std::string::npos);
}

TEST_F(Stranger, foreignOriginsReachNoAddress) {
  for (const char* line : {"GET /api/project", "GET /api/ops", "GET /api/file?path=rules%2Fa.cga",
                           "PUT /api/file?path=b.cga", "DELETE /api/recovery?path=a.cga",
                           "POST /api/derive", "POST /api/asset", "GET /api/examples", "GET /"}) {
    for (const char* origin : {"https://evil.example", "null", "http://127.0.0.1"}) {
      const std::string answer =
          ask(line, "{}", std::string("X-Gable-Token: right\r\nOrigin: ") + origin + "\r\n");
      EXPECT_EQ(status(answer), 403) << line << " from " << origin;
      // Nothing tells a browser to let a foreign page read it.
      EXPECT_EQ(answer.find("Access-Control-Allow"), std::string::npos);
    }
  }
  EXPECT_GE(status(ask("OPTIONS /api/derive", "", "Origin: https://evil.example\r\n")), 400);
  EXPECT_FALSE(fs::exists(root_ + "/project/b.cga"));
}

TEST_F(Stranger, grammarsOfEachNotationThatNeverEndAreEnded) {
  const std::pair<const char*, const char*> endless[] = {
      {"a.cga", "@StartRule\nLot --> t(1, 0, 0) Lot"},
      {"f.cga", "f(x) = f(x + 1)\n@StartRule\nLot --> extrude(f(0)) X."},
      {"w.cga", "@StartRule\nLot --> split(x) { 0.0000001 : Lot }*"},
      {"i.cga", "import i : \"i.cga\"\n@StartRule\nLot --> X."},
      {"g.gbbg", "axiom START size (9, 9, 9)\nSTART -> Scope(T(1, 0, 0)) {START}\n"},
      {"p.grammar", "A -> T ( 1 0 0 ) I ( Cube 0 ) A\n"},
      {"r.grammar", "A 1000000000 -> I ( Cube 0 )\n"},
      {"k.park", "Region -> Peel(OUTER) { 0.001: Region | Region }\n"},
  };
  for (const auto& [file, text] : endless) {
    const auto begin = Clock::now();
    const std::string answer = derived(file, text);
    EXPECT_TRUE(status(answer) == 200 || status(answer) == 422) << file << answer.substr(0, 300);
    EXPECT_LT(Clock::now() - begin, std::chrono::seconds(60)) << file;
    EXPECT_EQ(status(ask("GET /api/project")), 200) << file;
  }
}

}  // namespace
}  // namespace gable::studio
