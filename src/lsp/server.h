// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The state of a connection: what the client can do, its open texts, messages that wait. Requests
// are answered in answers.cpp.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/json.h"
#include "gable/language.h"
#include "gable/lsp.h"

namespace gable {

class LanguageServer::Impl {
 public:
  Impl(std::function<double()> clock, const std::string& project, const SearchSettings& search);

  void receive(std::string_view message);
  void receiveBroken(const std::string& why);
  bool step();
  std::vector<std::string> take();
  std::optional<double> wait() const;

  bool ended = false;
  bool shutDown = false;

 private:
  enum Code : int {
    kParseError = -32700,
    kInvalidRequest = -32600,
    kMethodNotFound = -32601,
    kInvalidParams = -32602,
    kNotInitialized = -32002,
    kRequestFailed = -32803,
    kCancelled = -32800,
  };

  struct Waiting {
    JsonValue message;
    /// The id as JSON; empty for a notification.
    std::string id;
  };
  /// A text that the client has open.
  struct Document {
    std::string uri;
    std::optional<int64_t> version;
  };
  /// What the client can take.
  struct Client {
    bool snippets = false;
    bool symbolTree = false;
    bool actionLiterals = false;
    bool markdown = true;
  };
  using Handler = void (Impl::*)(const JsonValue& params, JsonWriter& json);

  // --- Messages (server.cpp) ---
  void handle(const Waiting& w);
  void notify(const std::string& method, const JsonValue& params);
  void request(const std::string& id, const std::string& method, const JsonValue& params);
  void respond(const std::string& id, std::string result);
  void fail(const std::string& id, int code, const std::string& message);
  static const std::map<std::string_view, Handler>& handlers();
  void initialize(const JsonValue& params, JsonWriter& json);

  // --- Texts (server.cpp) ---
  void didOpen(const JsonValue& params);
  void didChange(const JsonValue& params);
  void didClose(const JsonValue& params);
  void changeFolders(const JsonValue& params);
  void setValues(const JsonValue& params);
  void allDue(double at);
  /// The name of a text in the workspace.
  std::string pathOf(const JsonValue& textDocument) const;
  std::string uriOf(const std::string& path) const;

  // --- Mistakes (server.cpp) ---
  bool publishNext();
  void publishDue();
  void publish(const std::string& path, const std::vector<language::Diagnostic>& list);

  // --- Answers (answers.cpp; those about forms: forms.cpp) ---
  void completion(const JsonValue& params, JsonWriter& json);
  void completionResolve(const JsonValue& params, JsonWriter& json);
  void signatureHelp(const JsonValue& params, JsonWriter& json);
  void hover(const JsonValue& params, JsonWriter& json);
  void definition(const JsonValue& params, JsonWriter& json);
  void references(const JsonValue& params, JsonWriter& json);
  void documentHighlight(const JsonValue& params, JsonWriter& json);
  void prepareRename(const JsonValue& params, JsonWriter& json);
  void rename(const JsonValue& params, JsonWriter& json);
  void documentSymbol(const JsonValue& params, JsonWriter& json);
  void workspaceSymbol(const JsonValue& params, JsonWriter& json);
  void formatting(const JsonValue& params, JsonWriter& json);
  void rangeFormatting(const JsonValue& params, JsonWriter& json);
  void documentColor(const JsonValue& params, JsonWriter& json);
  void colorPresentation(const JsonValue& params, JsonWriter& json);
  void foldingRange(const JsonValue& params, JsonWriter& json);
  void inlayHint(const JsonValue& params, JsonWriter& json);
  void codeAction(const JsonValue& params, JsonWriter& json);
  void semanticTokens(const JsonValue& params, JsonWriter& json);
  void semanticTokensRange(const JsonValue& params, JsonWriter& json);
  void attribute(const JsonValue& params, JsonWriter& json);
  void form(const JsonValue& params, JsonWriter& json);
  void formEdits(const JsonValue& params, JsonWriter& json);
  void ruleText(const JsonValue& params, JsonWriter& json);
  void search(const JsonValue& params, JsonWriter& json);
  void referencePage(const JsonValue& params, JsonWriter& json);
  void writePlaces(JsonWriter& json, const std::vector<language::Place>& places);
  void writeEdits(JsonWriter& json, const std::vector<language::FileEdits>& edits);
  void shutdown(const JsonValue& params, JsonWriter& json);

  std::function<double()> clock_;
  language::Workspace workspace_;
  Client client_;
  bool initialized_ = false;
  std::deque<Waiting> queue_;
  std::set<std::string> cancelled_;
  std::vector<std::string> out_;
  /// Why the request at hand cannot be done; its answer is then an error.
  std::string trouble_;

  std::map<std::string, Document> open_;  // by path
  /// Texts that are to be looked at again, and when.
  std::map<std::string, double> due_;
  /// What each open text says of the files that it imports, and what was last published of a file.
  std::map<std::string, std::map<std::string, std::vector<language::Diagnostic>>> imported_;
  std::map<std::string, std::vector<language::Diagnostic>> published_;
};

namespace lsp {

language::Position positionOf(const JsonValue& v);
language::Range rangeOf(const JsonValue& v);
void write(JsonWriter& json, language::Position p);
void write(JsonWriter& json, const language::Range& r);
/// The legend of semantic tokens, by Highlight::Kind.
extern const char* const kTokenTypes[];
extern const size_t kTokenTypeCount;

}  // namespace lsp

}  // namespace gable
