// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a stranger may try: paths that lead out, foreign pages, bodies that are huge or slow,
// thousands of requests, rules that never end.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "base/json.h"
#include "gable/studio.h"
#include "studio/export.h"
#include "studio/gallery.h"
#include "studio/guard.h"
#include "studio/project_files.h"
#include "studio/session.h"
#include "studio/testing/stranger.h"

namespace gable::studio {
namespace {

namespace fs = std::filesystem;
using namespace studio::testing;
using Clock = std::chrono::steady_clock;

class Folder : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = ::testing::TempDir() + "gable-studio-" +
            ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(root_);
    fs::create_directories(root_ + "/project/rules");
    put("project/rules/a.cga", "@StartRule\nLot --> extrude(3) Body\n");
    put("secret.txt", "secret");
  }
  void TearDown() override { fs::remove_all(root_); }
  void put(const std::string& path, const std::string& text) {
    std::ofstream(root_ + "/" + path) << text;
  }
  std::string project() const { return root_ + "/project"; }
  std::string root_;
};

using Files = Folder;

TEST_F(Files, namesThatLeadOutAreRefused) {
  ProjectFiles files(project());
  for (const char* path :
       {"../secret.txt", "rules/../../secret.txt", "/etc/passwd", "", ".", "..", "rules//a.cga",
        "rules/.hidden", ".gable/previous/x", "a\\b", "c:x", "rules/", "a\nb", "./rules/a.cga"}) {
    EXPECT_FALSE(files.read(path).ok()) << path;
    EXPECT_FALSE(files.write(path, "x", "").ok()) << path;
    EXPECT_FALSE(files.keepRecovery(path, "x").ok()) << path;
  }
  EXPECT_EQ(files.read("rules/a.cga").value().substr(0, 10), "@StartRule");
}

TEST_F(Files, linksThatLeadOutAreRefused) {
  fs::create_symlink(root_ + "/secret.txt", project() + "/link.txt");
  fs::create_directory_symlink(root_, project() + "/up");
  ProjectFiles files(project());
  EXPECT_EQ(files.read("link.txt").error().code, "path-outside");
  EXPECT_EQ(files.read("up/secret.txt").error().code, "path-outside");
  EXPECT_EQ(files.write("up/new.txt", "x", "").error().code, "path-outside");
  EXPECT_FALSE(fs::exists(root_ + "/new.txt"));
}

TEST_F(Files, theStudiosOwnFolderCannotBeALinkOut) {
  fs::create_directories(root_ + "/else");
  fs::create_directory_symlink(root_ + "/else", project() + "/.gable");
  ProjectFiles files(project());
  EXPECT_FALSE(files.keepRecovery("a.cga", "x").ok());
  EXPECT_FALSE(files.write("rules/a.cga", "y", "").ok());
  EXPECT_TRUE(fs::is_empty(root_ + "/else"));
}

TEST_F(Files, writingKeepsTheVersionBefore) {
  ProjectFiles files(project());
  const std::string before = files.read("rules/a.cga").value();
  const std::string version = files.version("rules/a.cga");
  const auto written = files.write("rules/a.cga", "new", version);
  ASSERT_TRUE(written.ok());
  EXPECT_EQ(files.read("rules/a.cga").value(), "new");
  EXPECT_EQ(files.previous("rules/a.cga").value(), before);
  EXPECT_EQ(written.value(), files.version("rules/a.cga"));
}

TEST_F(Files, theSecondOfTwoWritersIsTold) {
  ProjectFiles files(project());
  const std::string version = files.version("rules/a.cga");
  ASSERT_TRUE(files.write("rules/a.cga", "first", version).ok());
  EXPECT_EQ(files.write("rules/a.cga", "second", version).error().code, "version-differs");
  EXPECT_EQ(files.read("rules/a.cga").value(), "first");
  EXPECT_EQ(files.write("rules/a.cga", "third", "none").error().code, "version-differs");
  EXPECT_TRUE(files.write("rules/b.cga", "new", "none").ok());
}

TEST_F(Files, onlyKindsOfAProjectAreWritten) {
  ProjectFiles files(project());
  for (const char* path : {"run.sh", "a.so", "Makefile", "x.desktop", "a.html"}) {
    EXPECT_EQ(files.write(path, "x", "").error().code, "kind-refused") << path;
  }
}

TEST_F(Files, theListHidesWhatIsHidden) {
  put("project/.env", "x");
  ProjectFiles files(project());
  ASSERT_TRUE(files.keepRecovery("rules/a.cga", "x").ok());
  const auto list = files.list();
  ASSERT_EQ(list.size(), 1u);
  EXPECT_EQ(list[0].path, "rules/a.cga");
  EXPECT_EQ(files.recovery("rules/a.cga").value(), "x");
  files.dropRecovery("rules/a.cga");
  EXPECT_FALSE(files.recovery("rules/a.cga").ok());
}

HttpRequest request(const char* method, const char* path, const char* host) {
  HttpRequest r;
  r.method = method;
  r.path = path;
  r.headers = {{"host", host}, {"x-gable-token", "right"}};
  return r;
}

TEST(StudioGuard, knowsItsHostOriginAndToken) {
  const Guard guard("right", {"127.0.0.1:80", "localhost:80"});
  HttpRequest r = request("GET", "/api/project", "localhost:80");
  EXPECT_EQ(guard.admit(r).status, 200);
  r.headers["origin"] = "http://localhost:80";
  EXPECT_EQ(guard.admit(r).status, 200);
  for (const char* origin : {"http://evil.example", "null", "https://localhost:80", "localhost:80",
                             "http://localhost:81"}) {
    r.headers["origin"] = origin;
    EXPECT_EQ(guard.admit(r).status, 403) << origin;
  }
  r.headers.erase("origin");
  for (const char* token : {"", "righ", "right ", "wrong"}) {
    r.headers["x-gable-token"] = token;
    EXPECT_EQ(guard.admit(r).status, 401) << token;
  }
  // A name that was made to lead here.
  EXPECT_EQ(guard.admit(request("GET", "/", "evil.example:80")).status, 403);
  EXPECT_EQ(guard.admit(request("GET", "/", "")).status, 403);
  EXPECT_EQ(guard.admit(request("POST", "/", "localhost:80")).status, 405);
  EXPECT_EQ(guard.admit(request("TRACE", "/api/project", "localhost:80")).status, 405);
}

TEST(StudioHttp, decodesAddresses) {
  std::string out;
  EXPECT_TRUE(decodePercent("a%20b%2Fc", out));
  EXPECT_EQ(out, "a b/c");
  for (const char* broken : {"%", "%4", "%zz", "%00"}) EXPECT_FALSE(decodePercent(broken, out));
}

// A server on a port of its own, asked by plain sockets.
class Server : public Folder {
 protected:
  void SetUp() override {
    Folder::SetUp();
    fs::create_directories(root_ + "/page");
    put("page/index.html", "<p>page");
    StudioSettings settings;
    settings.project = project();
    settings.page = root_ + "/page";
    settings.token = "right";
    studio_.start(settings);
  }
  void TearDown() override {
    studio_.stop();
    Folder::TearDown();
  }

  int connectTo() const { return testing::connectTo(studio_.port()); }
  std::string head(const std::string& line, size_t length) const {
    return line + " HTTP/1.1\r\nHost: localhost:" + std::to_string(studio_.port()) +
           "\r\nX-Gable-Token: right\r\nContent-Length: " + std::to_string(length) + "\r\n";
  }
  std::string ask(const std::string& line, const std::string& body = {},
                  const std::string& more = {}) const {
    const int s = connectTo();
    send(s, head(line, body.size()) + "Connection: close\r\n" + more + "\r\n" + body);
    const std::string out = receive(s);
    close(s);
    return out;
  }

  RunningStudio studio_;
};

TEST_F(Server, servesItsPageWithAStrictPolicy) {
  const std::string answer = ask("GET /");
  EXPECT_EQ(status(answer), 200);
  EXPECT_NE(answer.find("<p>page"), std::string::npos);
  EXPECT_NE(answer.find("Content-Security-Policy: default-src 'none'"), std::string::npos);
  EXPECT_EQ(status(ask("GET /../secret.txt")), 403);
  EXPECT_EQ(status(ask("GET /%2e%2e/secret.txt")), 403);
  EXPECT_EQ(status(ask("GET /none.js")), 404);
}

TEST_F(Server, readsAndWritesTheProjectAlone) {
  EXPECT_EQ(status(ask("GET /api/file?path=rules%2Fa.cga")), 200);
  EXPECT_EQ(status(ask("GET /api/file?path=..%2Fsecret.txt")), 403);
  EXPECT_EQ(status(ask("PUT /api/file?path=..%2Fnew.txt", "x")), 403);
  EXPECT_EQ(status(ask("PUT /api/file?path=new.cga&expected=none", "Lot --> X")), 200);
  EXPECT_EQ(status(ask("PUT /api/file?path=new.cga&expected=none", "Lot --> Y")), 409);
  EXPECT_FALSE(fs::exists(root_ + "/new.txt"));
}

TEST_F(Server, refusesForeignPagesBeforeTheirBody) {
  const int s = connectTo();
  send(s, head("PUT /api/file?path=x.cga", 60u << 20) + "Origin: http://evil.example\r\n\r\n");
  EXPECT_EQ(status(receive(s)), 403);
  close(s);
}

TEST_F(Server, refusesBodiesThatAreTooLarge) {
  const int s = connectTo();
  send(s, head("PUT /api/file?path=x.cga", size_t{65} << 20) + "\r\n");
  EXPECT_EQ(status(receive(s)), 413);
  close(s);
  EXPECT_EQ(status(ask("GET /" + std::string(40000, 'a'))), 431);
}

TEST_F(Server, aSlowClientHoldsNobodyUp) {
  std::vector<int> slow;
  for (int i = 0; i < 60; ++i) {
    slow.push_back(connectTo());
    send(slow.back(), head("PUT /api/recovery?path=x.cga", 1000) + "\r\nx");
  }
  EXPECT_EQ(status(ask("GET /api/project")), 200);
  for (const int s : slow) close(s);
}

TEST_F(Server, answersThousandsOfRequests) {
  const int s = connectTo();
  for (int i = 0; i < 3000; ++i) {
    send(s, head("GET /api/progress?page=x", 0) + "\r\n");
    char buffer[1024];
    ASSERT_GT(recv(s, buffer, sizeof buffer, 0), 0) << i;
  }
  close(s);
  for (int i = 0; i < 500; ++i) ASSERT_EQ(status(ask("GET /api/progress?page=x")), 200) << i;
}

TEST_F(Server, noiseIsNoRequest) {
  for (const char* noise :
       {"\r\n\r\n", "GET\r\n\r\n", "\x16\x03\x01\x02", "GET / HTTP/9.9\r\n\r\n"}) {
    const int s = connectTo();
    send(s, noise);
    shutdown(s, SHUT_WR);
    const std::string answer = receive(s);
    EXPECT_TRUE(answer.empty() || status(answer) >= 400) << answer;
    close(s);
  }
  EXPECT_EQ(status(ask("POST /api/derive", "{")), 422);
  EXPECT_EQ(status(ask("POST /api/derive", "[]")), 403);
  EXPECT_EQ(status(ask("POST /api/derive", std::string(100000, '['))), 422);
  EXPECT_EQ(status(ask("GET /api/nothing")), 404);
}

// Chance keeps its parts from being shared, which would end it early.
constexpr const char* kEndless =
    R"({"file":"rules/e.cga","text":"@StartRule\nLot --> A\nA --> t(0,rand(0,1),0) split(x){'0.5:A|'0.5:A}",)"
    R"("page":"p","seed":0,"shapes":{"lot":[20,20]},"limits":{"seconds":)";

TEST_F(Server, rulesThatNeverEndAreEnded) {
  const auto begin = Clock::now();
  const std::string answer = ask("POST /api/derive", std::string(kEndless) + "0.5}}");
  EXPECT_EQ(status(answer), 200);
  EXPECT_NE(answer.find("GBS1"), std::string::npos);
  EXPECT_LT(Clock::now() - begin, std::chrono::seconds(10));
}

TEST_F(Server, aPageThatIsClosedStopsItsWork) {
  const std::string body = std::string(kEndless) + "500,\"shapes\":50000000}}";
  const auto begin = Clock::now();
  const int s = connectTo();
  send(s, head("POST /api/derive", body.size()) + "\r\n" + body);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  close(s);
  // The server ends only when its work has ended.
  studio_.stop();
  EXPECT_LT(Clock::now() - begin, std::chrono::seconds(10));
}

TEST_F(Server, aNewRequestOfAPageEndsTheOneBefore) {
  const std::string body = std::string(kEndless) + "500,\"shapes\":50000000}}";
  const int s = connectTo();
  send(s, head("POST /api/derive", body.size()) + "Connection: close\r\n\r\n" + body);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(status(ask("POST /api/derive", std::string(kEndless) + "0.01}}")), 200);
  const std::string first = receive(s);
  close(s);
  EXPECT_EQ(status(first), 200);
  EXPECT_NE(first.find(R"("end":"cancelled")"), std::string::npos);
}

// One operation that takes more than half a minute.
std::string oneLongOperation(const std::string& page) {
  return R"({"file":"rules/e.cga","text":"@StartRule\nLot --> grid(150, 150, 0.1) { region : X. }",)"
         R"("page":")" +
         page + R"(","seed":0,"shapes":{"lot":[1000,1000]},"limits":{"seconds":60}})";
}

TEST_F(Server, aNewRequestOfAPageEndsTheOperationAtWork) {
  const std::string body = oneLongOperation("p");
  const int s = connectTo();
  send(s, head("POST /api/derive", body.size()) + "Connection: close\r\n\r\n" + body);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const auto begin = Clock::now();
  const int next = connectTo();
  const std::string edited = std::string(kEndless) + "0.01}}";
  send(next, head("POST /api/derive", edited.size()) + "Connection: close\r\n\r\n" + edited);
  const std::string first = receive(s);
  // A tenth of a second, and room for a machine that is busy with other things.
  EXPECT_LT(Clock::now() - begin, std::chrono::milliseconds(2000));
  EXPECT_NE(first.find(R"("end":"cancelled")"), std::string::npos);
  EXPECT_EQ(status(receive(next)), 200);
  close(s);
  close(next);
}

TEST_F(Server, savingWaitsForNoDerivation) {
  // More pages than there are threads for what takes long.
  std::vector<int> pages;
  for (int i = 0; i < 8; ++i) {
    const std::string body = oneLongOperation("p" + std::to_string(i));
    pages.push_back(connectTo());
    send(pages.back(), head("POST /api/derive", body.size()) + "\r\n" + body);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const auto begin = Clock::now();
  EXPECT_EQ(status(ask("PUT /api/file?path=rules/a.cga", "Lot --> X.")), 200);
  EXPECT_EQ(status(ask("GET /api/progress?page=p0")), 200);
  EXPECT_LT(Clock::now() - begin, std::chrono::seconds(5));
  EXPECT_EQ(ProjectFiles(project()).read("rules/a.cga").value(), "Lot --> X.");
  // An edit of a page whose derivation waits for a thread ends it as well.
  const std::string edited = oneLongOperation("p7");
  const int again = connectTo();
  send(again, head("POST /api/derive", edited.size()) + "\r\n" + edited);
  for (const int s : pages) close(s);
  close(again);
  studio_.stop();
  EXPECT_LT(Clock::now() - begin, std::chrono::seconds(10));
}

TEST_F(Server, derivesDrawsAndWrites) {
  const std::string body =
      R"({"file":"rules/a.cga","text":"attr h = 3\n@StartRule\nLot --> extrude(h) B","page":"p",)"
      R"("attributes":{"h":"5","gone":"1"},"shapes":{"lot":[4,2]}})";
  const std::string answer = ask("POST /api/derive", body);
  EXPECT_EQ(status(answer), 200);
  EXPECT_NE(answer.find(R"("end":"done")"), std::string::npos);
  EXPECT_NE(answer.find(R"("values":{"h":5})"), std::string::npos);
  EXPECT_NE(answer.find("GBL1"), std::string::npos);
  EXPECT_NE(ask("POST /api/tree", body).find("GBT1"), std::string::npos);
  const std::string leaf = ask("GET /api/leaf?derivation=1&leaf=0");
  EXPECT_EQ(status(leaf), 200);
  EXPECT_NE(leaf.find(R"("name":"B")"), std::string::npos);
  EXPECT_NE(leaf.find(R"("color":"#ffffff")"), std::string::npos);
  EXPECT_NE(leaf.find(R"("size":[4,)"), std::string::npos) << leaf;
  EXPECT_NE(leaf.find(R"("above":[{"name":"lot","from":0,"to":1})"), std::string::npos) << leaf;
  EXPECT_EQ(status(ask("GET /api/leaf?derivation=1&leaf=1")), 404);
  // The tree by level: the initial shape, the leaf in it, and nothing below.
  const std::string roots = ask("GET /api/parts?derivation=1&leaf=0&level=0");
  EXPECT_NE(roots.find(R"({"parts":[["lot",0,1,false]],"more":0})"), std::string::npos) << roots;
  const std::string below = ask("GET /api/parts?derivation=1&leaf=0&level=1");
  EXPECT_NE(below.find(R"({"parts":[["B",0,1,true]],"more":0})"), std::string::npos) << below;
  const std::string nothing = ask("GET /api/parts?derivation=1&leaf=0&level=2");
  EXPECT_NE(nothing.find(R"({"parts":[],"more":0})"), std::string::npos) << nothing;
  EXPECT_EQ(status(ask("GET /api/parts?derivation=9&leaf=0&level=0")), 404);
  const std::string glb = ask("GET /api/export?derivation=1&format=glb");
  EXPECT_NE(glb.find("glTF"), std::string::npos);
  EXPECT_EQ(status(ask("GET /api/export?derivation=1&format=sh")), 422);
  EXPECT_EQ(status(ask("GET /api/export?derivation=9&format=glb")), 404);
}

TEST_F(Server, stylesAndChoicesAreTold) {
  const auto answer = [&](const std::string& style) {
    return ask("POST /api/derive",
               R"({"file":"rules/a.cga","page":"p","shapes":{"lot":[4,2]},"style":")" + style +
                   R"(","text":"@Enum(valuesAttr=kinds) attr h = 3\n@Hidden attr kinds = [3, 5]\n)"
                   R"(@Hidden attr other = 1\nLot --> extrude(h) B.\nstyle Tall\nattr h = 5"})");
  };
  const std::string usual = answer("");
  EXPECT_NE(usual.find(R"("styles":["Default","Tall"])"), std::string::npos) << usual;
  // Hidden attributes are told where the choices of others are theirs.
  EXPECT_NE(usual.find(R"("values":{"h":3,"kinds":[3,5]})"), std::string::npos) << usual;
  // The style keeps the choices.
  const std::string tall = answer("Tall");
  EXPECT_NE(tall.find(R"("values":{"kinds":[3,5],"h":5})"), std::string::npos) << tall;
}

// The lot is replaced by a box, the box by six faces, and these stay.
TEST_F(Server, stepsHoldEachShapeAsItsRuleGotIt) {
  const std::string body =
      R"({"file":"rules/a.cga","page":"p","steps":true,"shapes":{"lot":[4,2]},)"
      R"("text":"@StartRule\nLot --> extrude(3) Box\nBox --> comp(f) { all : Face. }"})";
  const std::string answer = ask("POST /api/tree", body);
  EXPECT_EQ(status(answer), 200);
  EXPECT_NE(answer.find(R"("count":8)"), std::string::npos);
  // Lot and Box as they were, and six faces.
  EXPECT_NE(answer.find(R"("leaves":8)"), std::string::npos);
  const std::string plain = ask("POST /api/derive", body);
  EXPECT_NE(plain.find(R"("leaves":6)"), std::string::npos);
}

TEST_F(Server, stepsTellWhatTheyDrewAndSaw) {
  const std::string answer =
      ask("POST /api/tree",
          R"({"file":"rules/a.cga","page":"p","steps":true,"shapes":{"lot":[4,2]},)"
          R"("text":"attr h = 3\n@StartRule\nLot --> 100% : extrude(h) Box else: NIL"})");
  EXPECT_NE(answer.find(R"("notes":[[0,0,"",null,0,3,)"), std::string::npos) << answer;
  EXPECT_NE(answer.find(R"([0,2,"h",3,0,0])"), std::string::npos) << answer;
}

TEST_F(Server, rulesWithErrorsHaveNoTree) {
  const std::string answer =
      ask("POST /api/tree", R"({"file":"rules/a.cga","page":"p","text":"Lot --> extrude("})");
  EXPECT_EQ(status(answer), 200);
  EXPECT_NE(answer.find(R"("end":"wrong")"), std::string::npos);
}

TEST_F(Folder, importsComeFromUnsavedText) {
  put("project/rules/b.cga", "W --> extrude(1) Low\n");
  ProjectFiles files(project());
  Session session(files);
  const auto ask = [&](const std::string& overlay) {
    const std::string json =
        R"({"file":"rules/a.cga","text":"import b : \"rules/b.cga\"\n@StartRule\nLot --> b.W",)"
        R"("shapes":{"lot":[4,2]},"overlay":{)" +
        overlay + "}}";
    const auto request = parseJson(json);
    std::string out =
        session.derive(request.value(), std::make_shared<std::atomic<bool>>(false)).value().head;
    std::erase_if(out, [](char c) { return c == ' ' || c == '\n'; });
    return out;
  };
  EXPECT_NE(ask("").find("\"max\":[4,1,"), std::string::npos) << ask("").substr(0, 2000);
  EXPECT_NE(ask(R"("rules/b.cga":"W --> extrude(7) High\n")").find("\"max\":[4,7,"),
            std::string::npos);
}

TEST_F(Folder, anEditTakesOverWhatItLeavesAsItWas) {
  const ProjectFiles files(project());
  Session session(files);
  const auto derived = [&](const std::string& page, const std::string& height) {
    const std::string rules =
        "Lot --> split(x) { ~30 : extrude(20) Block | ~30 : extrude(" + height +
        ") Block }\\n"
        "Block --> split(y) { ~1 : split(x) { ~rand(1, 2) : Tile | 1 : Tile }* }*\\n"
        "Tile --> primitiveCube()";
    const auto request = parseJson(R"({"page": ")" + page + R"(", "file": "rules/a.cga", )" +
                                   R"("shapes": {"lot": [60, 20]}, "text": ")" + rules + "\"}");
    EXPECT_TRUE(request.ok());
    return session.derive(request.value(), std::make_shared<std::atomic<bool>>(false)).value().head;
  };
  const auto recalled = [](const std::string& answer) {
    return answer.find("\"recalled\"") != std::string::npos;
  };
  EXPECT_FALSE(recalled(derived("one", "20")));
  EXPECT_TRUE(recalled(derived("one", "22")));
  EXPECT_FALSE(recalled(derived("other", "22"))) << "a page has seen nothing of another";
  session.forget();
  EXPECT_FALSE(recalled(derived("one", "22"))) << "files may have changed";
}

TEST_F(Folder, examplesOpenAsCopies) {
  const Gallery gallery(std::string(GABLE_SOURCE_DIR) + "/examples");
  ProjectFiles files(project());
  put("project/rules/trees.cga", "// mine\n");
  EXPECT_NE(gallery.list().find("\"name\":\"haussmann\""), std::string::npos);
  EXPECT_EQ(gallery.list().find("!["), std::string::npos);
  EXPECT_EQ(gallery.copyTo(files, "haussmann").value(), "haussmann");
  EXPECT_EQ(gallery.copyTo(files, "haussmann").value(), "haussmann-2");
  EXPECT_TRUE(fs::exists(project() + "/haussmann-2/haussmann.cga"));
  EXPECT_TRUE(fs::exists(project() + "/rules/setting.cga"));
  EXPECT_EQ(files.read("rules/trees.cga").value(), "// mine\n");
  // The town imports the castle.
  EXPECT_EQ(gallery.copyTo(files, "town").value(), "town");
  EXPECT_TRUE(fs::exists(project() + "/castle/castle.cga"));
  // Each is copied whole: rules, models and pictures, and nothing that a project does not take.
  const Result<JsonValue> all = parseJson(gallery.list(), {8, 10'000});
  ASSERT_TRUE(all.ok());
  EXPECT_GE(all.value().items().size(), 10u);
  for (const JsonValue& each : all.value().items()) {
    EXPECT_TRUE(gallery.copyTo(files, each["name"].text()).ok()) << each["name"].text();
  }
  EXPECT_TRUE(fs::exists(project() + "/gbbg/assets/Window.glb"));
  EXPECT_FALSE(fs::exists(project() + "/gbbg/make_assets.sh"));
  for (const char* name : {"..", "../src", "", "nothing", "haussmann/"}) {
    EXPECT_FALSE(gallery.copyTo(files, name).ok()) << name;
    EXPECT_FALSE(gallery.picture(name).ok()) << name;
  }
}

TEST_F(Folder, aCopyThatFailsLeavesNothing) {
  const Gallery gallery(std::string(GABLE_SOURCE_DIR) + "/examples");
  ProjectFiles files(project());
  fs::remove_all(project() + "/rules");
  put("project/rules", "no folder");
  EXPECT_FALSE(gallery.copyTo(files, "haussmann").ok());
  EXPECT_FALSE(fs::exists(project() + "/haussmann"));
}

TEST_F(Files, filesThatBelongTogetherAreMadeAllOrNone) {
  ProjectFiles files(project());
  EXPECT_TRUE(files.create({{"new/a.cga", "a"}, {"new/in/b.json", "{}"}}).ok());
  EXPECT_EQ(files.read("new/in/b.json").value(), "{}");
  put("project/plain", "no folder");
  for (const char* bad : {"../b.cga", "b.sh", "new/a.cga", "plain/b.cga"}) {
    EXPECT_FALSE(files.create({{"other/in/a.cga", "a"}, {bad, "b"}}).ok()) << bad;
    EXPECT_FALSE(fs::exists(project() + "/other")) << bad;
  }
  EXPECT_EQ(files.read("new/a.cga").value(), "a");
}

TEST(StudioExport, picturesAreTakenFromTheViewsCamera) {
  Result<PictureSettings> own = pictureOf("[1, 2, 3, 0, 0, 0.5, 40]", "[640, 480]");
  ASSERT_TRUE(own.ok());
  ASSERT_TRUE(own->camera.has_value());
  EXPECT_EQ(own->camera->eye[2], 3);
  EXPECT_EQ(own->camera->target[2], 0.5);
  EXPECT_EQ(own->fieldOfView, 40);
  EXPECT_EQ(own->width, 640);
  EXPECT_FALSE(pictureOf("", "").value().camera.has_value());
  for (const char* wrong : {"[1, 2, 3, 1, 2, 3, 40]", "[1, 2, 3, 0, 0, 0, 0]", "[1]", "nan", "{}",
                            "[1e99, 2, 3, 0, 0, 0, 40]", "[1, 2, 3, 0, 0, null, 40]"}) {
    EXPECT_FALSE(pictureOf(wrong, "").ok()) << wrong;
  }
  for (const char* wrong : {"[1, 2]", "[640]", "[1e9, 480]", "x"}) {
    EXPECT_FALSE(pictureOf("", wrong).ok()) << wrong;
  }
}

TEST(StudioExport, theSunIsThatOfTheView) {
  Result<PictureSettings> dusk = pictureOf("", "", "[-3.5, 290]");
  ASSERT_TRUE(dusk.ok() && dusk->sun);
  EXPECT_EQ(dusk->sun->elevation, -3.5);
  EXPECT_EQ(dusk->sun->azimuth, 290);
  for (const char* wrong : {"[91, 0]", "[1]", "x", "[1, 1e9]"}) {
    EXPECT_FALSE(pictureOf("", "", wrong).ok()) << wrong;
  }
}

TEST(StudioExport, theSunIsKnownByDayHourAndPlace) {
  const Model model = derive(Rules::parse("Lot --> X.", "a.cga"), Shapes::lot(1, 1));
  const Result<std::string> noon = sunJson(model, "[2024, 6, 21]", "12", "[47, 8]");
  ASSERT_TRUE(noon.ok());
  const JsonValue sun = parseJson(noon.value()).value();
  EXPECT_NEAR(sun["elevation"].number(0), 90 - 47 + 23.4, 0.5);
  EXPECT_NEAR(sun["azimuth"].number(0), 180, 2);
  // A lot without a map lies nowhere.
  EXPECT_EQ(sunJson(model, "[2024, 6, 21]", "12", "").value(), "null");
  EXPECT_EQ(sunJson(model, "[2024, 6, 21]", "25", "[47, 8]").error().code, "request-wrong");
  EXPECT_EQ(sunJson(model, "[2024, 6]", "12", "[47, 8]").error().code, "request-wrong");
  EXPECT_EQ(sunJson(model, "[2024, 6, 21]", "12", "[95, 8]").error().code, "place-unknown");
}

TEST_F(Server, remediesComeAsEdits) {
  const std::string answer =
      ask("POST /api/derive",
          R"({"page":"p","file":"rules/a.cga","text":"@StartRule\nLot --> extrud(3) Body.\n"})");
  EXPECT_NE(answer.find(R"("fix":{"file":"rules/a.cga","line":2,"column":9,"endLine":2,)"
                        R"("endColumn":15,"text":"extrude"})"),
            std::string::npos)
      << answer;
}

TEST_F(Server, aBundleIsWrittenWhole) {
  const std::string head = "[[\"s/a.cga\", 3], [\"s/b.txt\", 4]]\n";
  EXPECT_EQ(status(ask("POST /api/files", head + "abcdefg")), 200);
  ProjectFiles files(project());
  EXPECT_EQ(files.read("s/b.txt").value(), "defg");
  EXPECT_EQ(status(ask("POST /api/files", "[[\"t/a.cga\", 9]]\nabc")), 422);
  EXPECT_EQ(status(ask("POST /api/files", "[[\"t/a.cga\", 1], [\"../b.cga\", 1]]\nab")), 403);
  EXPECT_EQ(status(ask("POST /api/files", "[[\"t/a.cga\", -1]]\nab")), 422);
  EXPECT_FALSE(fs::exists(project() + "/t"));
}

TEST_F(Folder, aStudioThatIsStartedAgainIsFoundWhereItWas) {
  StudioSettings settings;
  settings.project = project();
  const auto start = [&](uint16_t port, std::string& url) {
    settings.port = port;
    std::atomic<bool> stop{true};
    EXPECT_TRUE(runStudio(settings, stop, [&](const std::string& u) { url = u; }).ok);
  };
  std::string first, second, third;
  start(0, first);
  start(0, second);
  EXPECT_EQ(first, second) << "the same port and token";
  // Another port may be asked for; the token stays.
  start(static_cast<uint16_t>(std::stoi(first.substr(first.find(':', 7) + 1)) + 1), third);
  EXPECT_NE(first, third);
  EXPECT_EQ(first.substr(first.find("token=")), third.substr(third.find("token=")));
  const ProjectFiles files(project());
  const std::string kept = project() + "/.gable/address.json";
  EXPECT_EQ(fs::status(kept).permissions() & fs::perms(077), fs::perms::none);
  // What others could have read is not taken up.
  fs::permissions(kept, fs::perms(0644));
  std::string fourth;
  start(0, fourth);
  EXPECT_NE(fourth.substr(fourth.find("token=")), first.substr(first.find("token=")));
}

}  // namespace
}  // namespace gable::studio
