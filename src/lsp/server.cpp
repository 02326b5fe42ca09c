// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Messages in the order in which they came; mistakes are looked for when no message waits and the
// text has rested a little. One text is looked at in a step, so that a request never waits for more
// than one analysis.

#include "lsp/server.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "gable/gable.h"
#include "lsp/uri.h"

namespace gable {

using language::Position;
using language::Range;

namespace {

/// Seconds without typing after which mistakes are looked for.
constexpr double kPause = 0.15;
constexpr size_t kMostWaiting = 10000;

double steadySeconds() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

// An id as it was written: a number or a text.
std::string idOf(const JsonValue& v) {
  std::string out;
  JsonWriter json(out);
  if (v.isText()) {
    json.value(v.text());
  } else if (v.isNumber()) {
    const double n = v.number(0);
    if (n == std::floor(n) && std::fabs(n) < 9e15) {
      json.value(static_cast<int64_t>(n));
    } else {
      json.value(n);
    }
  }
  return out;
}

// As the protocol numbers them.
int numberOf(Diagnostic::Severity severity) {
  switch (severity) {
    case Diagnostic::Severity::Error: return 1;
    case Diagnostic::Severity::Warning: return 2;
    case Diagnostic::Severity::Note: break;
  }
  return 3;
}

}  // namespace

namespace lsp {

Position positionOf(const JsonValue& v) {
  const auto count = [](const JsonValue& n) {
    const double x = n.number(0);
    return x > 0 ? static_cast<uint32_t>(std::min(x, 4e9)) : 0u;
  };
  return {count(v["line"]), count(v["character"])};
}

Range rangeOf(const JsonValue& v) { return {positionOf(v["start"]), positionOf(v["end"])}; }

void write(JsonWriter& json, Position p) {
  json.beginObject().key("line").value(p.line).key("character").value(p.character).endObject();
}

void write(JsonWriter& json, const Range& r) {
  json.beginObject().key("start");
  write(json, r.begin);
  json.key("end");
  write(json, r.end);
  json.endObject();
}

}  // namespace lsp

LanguageServer::Impl::Impl(std::function<double()> clock, const std::string& project,
                           const SearchSettings& search)
    : clock_(clock ? std::move(clock) : steadySeconds), workspace_({}, project, search) {}

// --- Messages ---

void LanguageServer::Impl::receiveBroken(const std::string& why) { fail("", kParseError, why); }

void LanguageServer::Impl::receive(std::string_view message) {
  Result<JsonValue> parsed = parseJson(message);
  if (!parsed.ok()) return receiveBroken(parsed.error().message);
  JsonValue& v = parsed.value();
  const std::string id = idOf(v["id"]);
  const std::string& method = v["method"].text();
  if (!v.isObject() || (method.empty() && id.empty())) {
    return fail(id, kInvalidRequest, "a message is an object with a method");
  }
  // Answers to what the server has asked: nothing is asked.
  if (method.empty()) return;
  if (method == "$/cancelRequest") {
    const std::string which = idOf(v["params"]["id"]);
    const bool waits =
        std::any_of(queue_.begin(), queue_.end(), [&](const Waiting& w) { return w.id == which; });
    if (waits) cancelled_.insert(which);
    return;
  }
  if (queue_.size() >= kMostWaiting) {
    if (!id.empty()) fail(id, kRequestFailed, "too many requests wait");
    return;
  }
  queue_.push_back({std::move(v), id});
}

bool LanguageServer::Impl::step() {
  if (ended) return false;
  if (!queue_.empty()) {
    const Waiting w = std::move(queue_.front());
    queue_.pop_front();
    if (!w.id.empty() && cancelled_.erase(w.id) > 0) {
      fail(w.id, kCancelled, "cancelled");
    } else {
      handle(w);
    }
    return true;
  }
  return publishNext();
}

std::vector<std::string> LanguageServer::Impl::take() { return std::exchange(out_, {}); }

void LanguageServer::Impl::handle(const Waiting& w) {
  const std::string& method = w.message["method"].text();
  const JsonValue& params = w.message["params"];
  if (method == "exit") {
    ended = true;
    return;
  }
  if (w.id.empty()) return notify(method, params);
  if (shutDown) return fail(w.id, kInvalidRequest, "the server has been shut down");
  if (!initialized_ && method != "initialize") {
    return fail(w.id, kNotInitialized, "initialize comes first");
  }
  if (initialized_ && method == "initialize") {
    return fail(w.id, kInvalidRequest, "initialize comes once");
  }
  request(w.id, method, params);
}

void LanguageServer::Impl::notify(const std::string& method, const JsonValue& params) {
  if (!initialized_ || shutDown) return;
  if (method == "textDocument/didOpen") return didOpen(params);
  if (method == "textDocument/didChange") return didChange(params);
  if (method == "textDocument/didClose") return didClose(params);
  if (method == "textDocument/didSave" || method == "workspace/didChangeWatchedFiles") {
    workspace_.refresh();
    return allDue(clock_());
  }
  if (method == "workspace/didChangeWorkspaceFolders") return changeFolders(params);
  if (method == "gable/values") return setValues(params);
  // Others need no answer.
}

const std::map<std::string_view, LanguageServer::Impl::Handler>& LanguageServer::Impl::handlers() {
  using I = LanguageServer::Impl;
  static const std::map<std::string_view, Handler> kHandlers = {
      {"initialize", &I::initialize},
      {"shutdown", &I::shutdown},
      {"textDocument/completion", &I::completion},
      {"completionItem/resolve", &I::completionResolve},
      {"textDocument/signatureHelp", &I::signatureHelp},
      {"textDocument/hover", &I::hover},
      {"textDocument/definition", &I::definition},
      {"textDocument/references", &I::references},
      {"textDocument/documentHighlight", &I::documentHighlight},
      {"textDocument/prepareRename", &I::prepareRename},
      {"textDocument/rename", &I::rename},
      {"textDocument/documentSymbol", &I::documentSymbol},
      {"workspace/symbol", &I::workspaceSymbol},
      {"textDocument/formatting", &I::formatting},
      {"textDocument/rangeFormatting", &I::rangeFormatting},
      {"textDocument/documentColor", &I::documentColor},
      {"textDocument/colorPresentation", &I::colorPresentation},
      {"textDocument/foldingRange", &I::foldingRange},
      {"textDocument/inlayHint", &I::inlayHint},
      {"textDocument/codeAction", &I::codeAction},
      {"textDocument/semanticTokens/full", &I::semanticTokens},
      {"textDocument/semanticTokens/range", &I::semanticTokensRange},
      {"gable/attribute", &I::attribute},
      {"gable/form", &I::form},
      {"gable/formEdits", &I::formEdits},
      {"gable/ruleText", &I::ruleText},
      {"gable/search", &I::search},
      {"gable/reference", &I::referencePage},
  };
  return kHandlers;
}

void LanguageServer::Impl::request(const std::string& id, const std::string& method,
                                   const JsonValue& params) {
  const auto handler = handlers().find(method);
  if (handler == handlers().end()) {
    return fail(id, kMethodNotFound, "there is no request '" + method + "'");
  }
  std::string result;
  JsonWriter json(result);
  trouble_.clear();
  (this->*handler->second)(params, json);
  if (!trouble_.empty()) return fail(id, kRequestFailed, trouble_);
  respond(id, result.empty() ? "null" : std::move(result));
}

void LanguageServer::Impl::respond(const std::string& id, std::string result) {
  out_.push_back(R"({"jsonrpc":"2.0","id":)" + id + R"(,"result":)" + result + "}");
}

void LanguageServer::Impl::fail(const std::string& id, int code, const std::string& message) {
  std::string text;
  JsonWriter json(text);
  json.beginObject().key("jsonrpc").value("2.0").key("id").raw(id.empty() ? "null" : id);
  json.key("error").beginObject().key("code").value(code).key("message").value(message);
  json.endObject().endObject();
  out_.push_back(std::move(text));
}

void LanguageServer::Impl::shutdown(const JsonValue&, JsonWriter& json) {
  shutDown = true;
  json.null();
}

namespace {

void writeCapabilities(JsonWriter& json) {
  json.key("positionEncoding").value("utf-16");
  json.key("textDocumentSync").beginObject().key("openClose").value(true);
  json.key("change").value(2).key("save").value(true).endObject();
  json.key("completionProvider").beginObject().key("resolveProvider").value(true);
  json.key("triggerCharacters").beginArray().value("@").value(".").value("\"").value("#");
  json.endArray().endObject();
  json.key("signatureHelpProvider").beginObject().key("triggerCharacters").beginArray();
  json.value("(").value(",").endArray().endObject();
  for (const char* name :
       {"hoverProvider", "definitionProvider", "referencesProvider", "documentHighlightProvider",
        "documentSymbolProvider", "workspaceSymbolProvider", "documentFormattingProvider",
        "documentRangeFormattingProvider", "colorProvider", "foldingRangeProvider",
        "inlayHintProvider"}) {
    json.key(name).value(true);
  }
  json.key("renameProvider").beginObject().key("prepareProvider").value(true).endObject();
  json.key("codeActionProvider").beginObject().key("codeActionKinds").beginArray();
  json.value("quickfix").endArray().endObject();
  json.key("semanticTokensProvider").beginObject().key("legend").beginObject();
  json.key("tokenTypes").beginArray();
  for (size_t i = 0; i < lsp::kTokenTypeCount; ++i) json.value(lsp::kTokenTypes[i]);
  json.endArray().key("tokenModifiers").beginArray();
  json.value("declaration").value("readonly").value("defaultLibrary").endArray().endObject();
  json.key("full").value(true).key("range").value(true).endObject();
  json.key("workspace").beginObject().key("workspaceFolders").beginObject();
  json.key("supported").value(true).key("changeNotifications").value(true);
  json.endObject().endObject();
}

}  // namespace

void LanguageServer::Impl::initialize(const JsonValue& params, JsonWriter& json) {
  initialized_ = true;
  const JsonValue& text = params["capabilities"]["textDocument"];
  client_.snippets = text["completion"]["completionItem"]["snippetSupport"].boolean(false);
  client_.symbolTree = text["documentSymbol"]["hierarchicalDocumentSymbolSupport"].boolean(false);
  client_.actionLiterals = text["codeAction"]["codeActionLiteralSupport"].isObject();
  const JsonValue& formats = text["hover"]["contentFormat"];
  client_.markdown = !formats.isArray();
  for (const JsonValue& f : formats.items()) client_.markdown |= f.text() == "markdown";
  std::vector<std::string> folders;
  for (const JsonValue& f : params["workspaceFolders"].items()) {
    if (auto path = lsp::pathOfUri(f["uri"].text())) folders.push_back(std::move(*path));
  }
  if (folders.empty()) {
    if (auto path = lsp::pathOfUri(params["rootUri"].text())) folders.push_back(std::move(*path));
  }
  workspace_.setFolders(std::move(folders));
  json.beginObject().key("capabilities").beginObject();
  writeCapabilities(json);
  json.endObject().key("serverInfo").beginObject().key("name").value("gable");
  json.key("version").value(version()).endObject().endObject();
}

// --- Texts ---

std::string LanguageServer::Impl::pathOf(const JsonValue& textDocument) const {
  const std::string& uri = textDocument["uri"].text();
  for (const auto& [path, document] : open_) {
    if (document.uri == uri) return path;
  }
  return lsp::pathOfUri(uri).value_or(uri);
}

std::string LanguageServer::Impl::uriOf(const std::string& path) const {
  const auto at = open_.find(path);
  if (at != open_.end()) return at->second.uri;
  return path.starts_with("/") ? lsp::uriOfPath(path) : path;
}

void LanguageServer::Impl::didOpen(const JsonValue& params) {
  const JsonValue& d = params["textDocument"];
  const std::string& uri = d["uri"].text();
  if (uri.empty()) return;
  std::string path = lsp::pathOfUri(uri).value_or(uri);
  // A text without a file is read as what the editor takes it for.
  if (!path.starts_with("/")) {
    const std::string& language = d["languageId"].text();
    for (const char* name : {"gbbg", "park", "grammar", "pg3d"}) {
      if (language.find(name) != std::string::npos) path += std::string(".") + name;
    }
    if (language.find("progen3d") != std::string::npos) path += ".grammar";
  }
  Document document{uri, std::nullopt};
  if (d["version"].isNumber()) document.version = static_cast<int64_t>(d["version"].number(0));
  open_[path] = document;
  workspace_.open(path, d["text"].text());
  allDue(clock_());
}

void LanguageServer::Impl::didChange(const JsonValue& params) {
  const std::string path = pathOf(params["textDocument"]);
  const auto at = open_.find(path);
  if (at == open_.end()) return;
  const JsonValue& version = params["textDocument"]["version"];
  if (version.isNumber()) at->second.version = static_cast<int64_t>(version.number(0));
  std::vector<language::Change> changes;
  for (const JsonValue& c : params["contentChanges"].items()) {
    language::Change change{std::nullopt, c["text"].text()};
    if (c["range"].isObject()) change.range = lsp::rangeOf(c["range"]);
    changes.push_back(std::move(change));
  }
  workspace_.change(path, changes);
  allDue(clock_() + kPause);
}

void LanguageServer::Impl::didClose(const JsonValue& params) {
  const std::string path = pathOf(params["textDocument"]);
  const auto at = open_.find(path);
  if (at == open_.end()) return;
  publish(path, {});
  workspace_.close(path);
  open_.erase(at);
  due_.erase(path);
  imported_.erase(path);
  published_.erase(path);
  allDue(clock_());
  // What it alone said of other files is gone.
  if (open_.empty()) publishDue();
}

void LanguageServer::Impl::changeFolders(const JsonValue& params) {
  std::vector<std::string> folders;
  for (const JsonValue& f : params["event"]["added"].items()) {
    if (auto path = lsp::pathOfUri(f["uri"].text())) folders.push_back(std::move(*path));
  }
  for (const std::string& known : workspace_.folders()) {
    const auto& removed = params["event"]["removed"].items();
    const bool gone = std::any_of(removed.begin(), removed.end(), [&](const JsonValue& f) {
      return lsp::pathOfUri(f["uri"].text()) == known;
    });
    if (!gone) folders.push_back(known);
  }
  workspace_.setFolders(std::move(folders));
  allDue(clock_());
}

// --- Mistakes ---

// Every open text may import the one that has changed; what is not concerned costs nothing.
void LanguageServer::Impl::allDue(double at) {
  for (const auto& [path, document] : open_) due_[path] = at;
}

std::optional<double> LanguageServer::Impl::wait() const {
  if (!queue_.empty()) return 0.0;
  if (due_.empty()) return std::nullopt;
  double first = due_.begin()->second;
  for (const auto& [path, at] : due_) first = std::min(first, at);
  return std::max(0.0, first - clock_());
}

bool LanguageServer::Impl::publishNext() {
  const double now = clock_();
  const auto at = std::find_if(due_.begin(), due_.end(),
                               [&](const auto& entry) { return entry.second <= now; });
  if (at == due_.end()) return false;
  const std::string path = at->first;
  due_.erase(at);
  std::map<std::string, std::vector<language::Diagnostic>>& others = imported_[path];
  others.clear();
  for (language::FileDiagnostics& f : workspace_.diagnostics(path)) {
    if (f.path == path) {
      publish(path, f.diagnostics);
    } else {
      others[f.path] = std::move(f.diagnostics);
    }
  }
  if (due_.empty()) publishDue();
  return true;
}

// Files that are not open: what the open texts that import them say of them.
void LanguageServer::Impl::publishDue() {
  std::map<std::string, std::vector<language::Diagnostic>> all;
  for (const auto& [main, files] : imported_) {
    for (const auto& [path, diagnostics] : files) {
      if (open_.count(path) != 0) continue;
      std::vector<language::Diagnostic>& list = all[path];
      for (const language::Diagnostic& d : diagnostics) {
        if (std::find(list.begin(), list.end(), d) == list.end()) list.push_back(d);
      }
    }
  }
  std::vector<std::string> gone;
  for (const auto& [path, list] : published_) {
    if (open_.count(path) == 0 && all.count(path) == 0) gone.push_back(path);
  }
  for (const std::string& path : gone) {
    publish(path, {});
    published_.erase(path);
  }
  for (const auto& [path, list] : all) {
    const auto known = published_.find(path);
    if (known == published_.end() || known->second != list) publish(path, list);
  }
}

void LanguageServer::Impl::publish(const std::string& path,
                                   const std::vector<language::Diagnostic>& list) {
  published_[path] = list;
  std::string text;
  JsonWriter json(text);
  json.beginObject().key("jsonrpc").value("2.0");
  json.key("method").value("textDocument/publishDiagnostics");
  json.key("params").beginObject().key("uri").value(uriOf(path));
  const auto at = open_.find(path);
  if (at != open_.end() && at->second.version) json.key("version").value(*at->second.version);
  json.key("diagnostics").beginArray();
  for (const language::Diagnostic& d : list) {
    json.beginObject().key("range");
    lsp::write(json, d.range);
    json.key("severity").value(numberOf(d.severity)).key("code").value(d.code);
    json.key("source").value("gable");
    json.key("message").value(d.hint.empty() ? d.message : d.message + "\n" + d.hint);
    json.endObject();
  }
  json.endArray().endObject().endObject();
  out_.push_back(std::move(text));
}

// --- The public class ---

LanguageServer::LanguageServer(std::function<double()> clock, const std::string& project,
                               const SearchSettings& search)
    : impl_(std::make_unique<Impl>(std::move(clock), project, search)) {}
LanguageServer::~LanguageServer() = default;
LanguageServer::LanguageServer(LanguageServer&&) noexcept = default;
LanguageServer& LanguageServer::operator=(LanguageServer&&) noexcept = default;

void LanguageServer::receive(std::string_view message) { impl_->receive(message); }
void LanguageServer::receiveBroken(const std::string& why) { impl_->receiveBroken(why); }
bool LanguageServer::step() { return impl_->step(); }
std::vector<std::string> LanguageServer::take() { return impl_->take(); }
std::optional<double> LanguageServer::wait() const { return impl_->wait(); }
bool LanguageServer::ended() const { return impl_->ended; }
int LanguageServer::exitStatus() const { return impl_->ended && !impl_->shutDown ? 1 : 0; }

}  // namespace gable
