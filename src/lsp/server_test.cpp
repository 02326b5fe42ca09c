// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A connection without pipes: messages in, messages out, a clock of the test's own.

#include <gtest/gtest.h>

#include <memory>

#include "base/json.h"
#include "gable/lsp.h"

namespace gable {
namespace {

class Connection {
 public:
  explicit Connection(bool initialize = true) : server([this] { return time; }) {
    if (!initialize) return;
    request("initialize", R"({"capabilities":{"textDocument":{"codeAction":)"
                          R"({"codeActionLiteralSupport":{}}}}})");
    notify("initialized", "{}");
  }

  void notify(const std::string& method, const std::string& params) {
    server.receive(R"({"jsonrpc":"2.0","method":")" + method + R"(","params":)" + params + "}");
  }
  void send(const std::string& id, const std::string& method, const std::string& params) {
    server.receive(R"({"jsonrpc":"2.0","id":)" + id + R"(,"method":")" + method + R"(","params":)" +
                   params + "}");
  }
  /// The answer to a request: its result, or its error.
  JsonValue request(const std::string& method, const std::string& params) {
    const std::string id = std::to_string(++last);
    send(id, method, params);
    run();
    for (const std::string& m : messages) {
      JsonValue v = std::move(parseJson(m).value());
      if (v["id"].number(0) != last) continue;
      return v.find("error") ? v["error"] : v["result"];
    }
    ADD_FAILURE() << "no answer to " << method;
    return {};
  }
  void run() {
    while (server.step()) {
    }
    for (std::string& m : server.take()) messages.push_back(std::move(m));
  }
  void open(const std::string& uri, const std::string& text) {
    std::string quoted;
    JsonWriter(quoted).value(text);
    notify("textDocument/didOpen", R"({"textDocument":{"uri":")" + uri +
                                       R"(","languageId":"cga","version":1,"text":)" + quoted +
                                       "}}");
  }
  /// What was last published of an address; -1: nothing.
  int problems(const std::string& uri) const {
    int count = -1;
    for (const std::string& m : messages) {
      const JsonValue v = std::move(parseJson(m).value());
      if (v["params"]["uri"].text() != uri) continue;
      count = static_cast<int>(v["params"]["diagnostics"].size());
    }
    return count;
  }

  double time = 100;
  LanguageServer server;
  int last = 0;
  std::vector<std::string> messages;
};

TEST(LanguageServer, wantsToBeInitialized) {
  Connection c(false);
  EXPECT_EQ(c.request("textDocument/hover", "{}")["code"].number(0), -32002);
  const JsonValue hello = c.request("initialize", "{}");
  EXPECT_EQ(hello["serverInfo"]["name"].text(), "gable");
  EXPECT_EQ(c.request("initialize", "{}")["code"].number(0), -32600);
}

TEST(LanguageServer, answersWhatItDoesNotKnow) {
  Connection c;
  EXPECT_EQ(c.request("no/such", "{}")["code"].number(0), -32601);
  c.notify("no/such", "{}");
  c.run();
  // Broken messages have an answer without an id, and the next is read.
  for (const char* broken : {"{", "[]", "3", R"({"jsonrpc":"2.0"})", ""}) c.server.receive(broken);
  c.run();
  EXPECT_TRUE(c.request("textDocument/hover", "{}").isNull());
  // Wrong types of everything.
  for (const char* params : {"null", "[]", "3", R"({"textDocument":3,"position":[]})",
                             R"({"textDocument":{"uri":5},"position":{"line":-1}})"}) {
    for (const char* method :
         {"textDocument/completion", "textDocument/rename", "textDocument/codeAction",
          "textDocument/semanticTokens/full", "workspace/symbol", "completionItem/resolve"}) {
      c.request(method, params);
    }
  }
}

TEST(LanguageServer, leavesOutWhatIsTakenBack) {
  Connection c;
  c.send("\"a\"", "workspace/symbol", R"({"query":""})");
  c.send("77", "workspace/symbol", R"({"query":""})");
  c.notify("$/cancelRequest", R"({"id":"a"})");
  c.notify("$/cancelRequest", R"({"id":12345})");
  c.run();
  int cancelled = 0, answered = 0;
  for (const std::string& m : c.messages) {
    cancelled += m.find("-32800") != std::string::npos;
    answered += m.find("\"id\":77,\"result\"") != std::string::npos;
  }
  EXPECT_EQ(cancelled, 1);
  EXPECT_EQ(answered, 1);
}

TEST(LanguageServer, saysWhatIsWrongAfterAPause) {
  Connection c;
  c.open("file:///nowhere/a.cga", "A --> extrud(3) B.");
  c.run();
  EXPECT_EQ(c.problems("file:///nowhere/a.cga"), 1);
  c.messages.clear();
  c.notify("textDocument/didChange",
           R"({"textDocument":{"uri":"file:///nowhere/a.cga","version":2},"contentChanges":)"
           R"([{"range":{"start":{"line":0,"character":12},"end":{"line":0,"character":12}},)"
           R"("text":"e"}]})");
  c.run();
  EXPECT_EQ(c.problems("file:///nowhere/a.cga"), -1) << "not while one types";
  ASSERT_TRUE(c.server.wait());
  EXPECT_GT(*c.server.wait(), 0);
  c.time += 1;
  c.run();
  EXPECT_EQ(c.problems("file:///nowhere/a.cga"), 0);
  EXPECT_FALSE(c.server.wait());
  c.notify("textDocument/didClose", R"({"textDocument":{"uri":"file:///nowhere/a.cga"}})");
  c.run();
  EXPECT_EQ(c.problems("file:///nowhere/a.cga"), 0);
}

TEST(LanguageServer, knowsTextsWithoutFiles) {
  Connection c;
  c.open("untitled:Untitled-1", "A --> extrude(1) B.\nC --> A");
  const JsonValue symbols =
      c.request("textDocument/documentSymbol", R"({"textDocument":{"uri":"untitled:Untitled-1"}})");
  ASSERT_EQ(symbols.size(), 2u);
  EXPECT_EQ(symbols.at(1)["name"].text(), "C");
  EXPECT_EQ(c.problems("untitled:Untitled-1"), 0);
}

TEST(LanguageServer, offersRemedies) {
  Connection c;
  c.open("file:///nowhere/a.cga", "A --> splitt(x) { ~1 : B. }");
  c.run();
  const JsonValue actions =
      c.request("textDocument/codeAction",
                R"({"textDocument":{"uri":"file:///nowhere/a.cga"},"context":{"diagnostics":[]},)"
                R"("range":{"start":{"line":0,"character":0},"end":{"line":0,"character":27}}})");
  ASSERT_GE(actions.size(), 1u);
  const JsonValue& edit = actions.at(0)["edit"]["changes"]["file:///nowhere/a.cga"].at(0);
  EXPECT_EQ(edit["newText"].text(), "split");
  EXPECT_EQ(edit["range"]["start"]["character"].number(0), 6);
  EXPECT_EQ(edit["range"]["end"]["character"].number(0), 12);
}

TEST(LanguageServer, offersNoRuleForWhatIsCalled) {
  Connection c;
  c.open("file:///nowhere/a.cga", "A --> if (true) B");
  c.run();
  const JsonValue actions =
      c.request("textDocument/codeAction",
                R"({"textDocument":{"uri":"file:///nowhere/a.cga"},"context":{"diagnostics":[]},)"
                R"("range":{"start":{"line":0,"character":0},"end":{"line":0,"character":17}}})");
  std::string titles;
  for (const JsonValue& action : actions.items()) titles += action["title"].text() + "; ";
  EXPECT_EQ(titles.find("rule if"), std::string::npos) << titles;
  EXPECT_NE(titles.find("rule B"), std::string::npos) << titles;
}

TEST(LanguageServer, endsAsTheProtocolWants) {
  Connection c;
  EXPECT_TRUE(c.request("shutdown", "null").isNull());
  EXPECT_EQ(c.request("textDocument/hover", "{}")["code"].number(0), -32600);
  c.notify("exit", "null");
  c.run();
  EXPECT_TRUE(c.server.ended());
  EXPECT_EQ(c.server.exitStatus(), 0);
  Connection rude;
  rude.notify("exit", "null");
  rude.run();
  EXPECT_EQ(rude.server.exitStatus(), 1);
}

}  // namespace
}  // namespace gable
