// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Requests to questions of the workspace, and its answers to JSON.

#include <algorithm>
#include <iterator>

#include "base/json_copy.h"
#include "lsp/server.h"
#include "lsp/uri.h"

namespace gable {

using language::Completion;
using language::Highlight;
using language::NameKind;
using language::Position;
using language::Range;

namespace lsp {

// Names that themes know, in the order of Highlight::Kind.
const char* const kTokenTypes[] = {"comment",   "keyword",    "string",    "number",   "operator",
                                   "class",     "struct",     "method",    "function", "property",
                                   "parameter", "enumMember", "decorator", "namespace"};
const size_t kTokenTypeCount = std::size(kTokenTypes);

}  // namespace lsp

namespace {

int completionKind(NameKind k) {
  switch (k) {
    case NameKind::Rule: return 7;
    case NameKind::Leaf: return 22;
    case NameKind::Attribute: return 10;
    case NameKind::Constant: return 21;
    case NameKind::Function:
    case NameKind::BuiltinFunction: return 3;
    case NameKind::Parameter: return 6;
    case NameKind::Import:
    case NameKind::Style: return 9;
    case NameKind::Operation: return 2;
    case NameKind::ShapeAttribute: return 5;
    case NameKind::Selector: return 20;
    case NameKind::Annotation:
    case NameKind::Keyword: return 14;
    case NameKind::File: return 17;
    case NameKind::Color: return 16;
    case NameKind::Value: break;
  }
  return 12;
}

int symbolKind(NameKind k) {
  switch (k) {
    case NameKind::Attribute: return 7;
    case NameKind::Constant: return 14;
    case NameKind::Function: return 12;
    case NameKind::Import: return 2;
    case NameKind::Style: return 3;
    default: break;
  }
  return 5;
}

// "${1:angle}" to "angle", for clients without snippets.
std::string withoutPlaces(const std::string& text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '$' || i + 1 >= text.size() || text[i + 1] != '{') {
      out += text[i];
      continue;
    }
    const size_t end = text.find('}', i);
    if (end == std::string::npos) break;
    std::string inner = text.substr(i + 2, end - i - 2);
    const size_t sign = inner.find_first_of(":|");
    const bool choice = sign != std::string::npos && inner[sign] == '|';
    inner.erase(0, sign == std::string::npos ? inner.size() : sign + 1);
    out += choice ? inner.substr(0, inner.find_first_of(",|")) : inner;
    i = end;
  }
  return out;
}

bool before(Position a, Position b) {
  return a.line < b.line || (a.line == b.line && a.character < b.character);
}

void writeEdit(JsonWriter& json, const language::Edit& e) {
  json.beginObject().key("range");
  lsp::write(json, e.range);
  json.key("newText").value(e.text).endObject();
}

void writeTokens(JsonWriter& json, const std::vector<Highlight>& marks, const Range* within) {
  json.beginObject().key("data").beginArray();
  Position last;
  for (const Highlight& h : marks) {
    const Position at = h.range.begin;
    // A token stays on its line; comments over several are coloured by the editor's grammar.
    if (h.range.end.line != at.line || h.range.end.character <= at.character) continue;
    if (within && (before(h.range.end, within->begin) || before(within->end, at))) continue;
    const uint32_t lines = at.line - last.line;
    json.value(lines).value(lines == 0 ? at.character - last.character : at.character);
    json.value(h.range.end.character - at.character).value(static_cast<int>(h.kind));
    json.value((h.declaration ? 1 : 0) + (h.constant ? 2 : 0) + (h.builtIn ? 4 : 0));
    last = at;
  }
  json.endArray().endObject();
}

}  // namespace

// --- While one types ---

void LanguageServer::Impl::completion(const JsonValue& params, JsonWriter& json) {
  const language::Completions found =
      workspace_.complete(pathOf(params["textDocument"]), lsp::positionOf(params["position"]));
  json.beginObject().key("isIncomplete").value(true).key("items").beginArray();
  for (const Completion& c : found.items) {
    json.beginObject().key("label").value(c.label).key("kind").value(completionKind(c.kind));
    if (!c.detail.empty()) json.key("detail").value(c.detail);
    if (!c.summary.empty()) json.key("documentation").value(c.summary);
    std::string order = std::to_string(c.order);
    order.insert(0, order.size() < 4 ? 4 - order.size() : 0, '0');
    json.key("sortText").value(order + c.label);
    if (!c.filter.empty()) json.key("filterText").value(c.filter);
    if (c.preselect) json.key("preselect").value(true);
    const bool snippet = c.snippet && client_.snippets;
    json.key("insertTextFormat").value(snippet ? 2 : 1);
    json.key("textEdit").beginObject().key("range");
    lsp::write(json, c.range);
    json.key("newText").value(c.snippet && !snippet ? withoutPlaces(c.text) : c.text).endObject();
    if (c.kind == NameKind::Operation || c.kind == NameKind::BuiltinFunction ||
        c.kind == NameKind::ShapeAttribute) {
      json.key("data").value(c.label);
    } else if (!c.picture.empty()) {
      json.key("data").beginObject().key("picture").value(lsp::uriOfPath(c.picture)).endObject();
    }
    json.endObject();
  }
  json.endArray().endObject();
}

// The page of the reference or the picture, asked for when an item is looked at.
void LanguageServer::Impl::completionResolve(const JsonValue& params, JsonWriter& json) {
  const JsonValue& data = params["data"];
  const std::string picture = data["picture"].text();
  const std::string page =
      picture.empty() ? language::referencePage(data.text()) : "![](" + picture + ")";
  json.beginObject();
  for (const auto& [name, value] : params.members()) {
    if (name == "documentation" && !page.empty()) continue;
    json.key(name);
    copy(json, value);
  }
  if (!page.empty()) {
    json.key("documentation").beginObject().key("kind").value("markdown");
    json.key("value").value(page).endObject();
  }
  json.endObject();
}

void LanguageServer::Impl::signatureHelp(const JsonValue& params, JsonWriter& json) {
  const language::SignatureHelp help =
      workspace_.signatureHelp(pathOf(params["textDocument"]), lsp::positionOf(params["position"]));
  if (help.signatures.empty()) {
    json.null();
    return;
  }
  json.beginObject().key("signatures").beginArray();
  for (const auto& s : help.signatures) {
    json.beginObject().key("label").value(s.label).key("documentation").value(s.doc);
    json.key("parameters").beginArray();
    for (const auto& p : s.parameters) {
      json.beginObject().key("label").value(s.label.substr(p.begin, p.end - p.begin));
      json.key("documentation").value(p.doc).endObject();
    }
    json.endArray().endObject();
  }
  json.endArray().key("activeSignature").value(help.activeSignature);
  json.key("activeParameter").value(help.activeParameter).endObject();
}

// --- What a word means ---

void LanguageServer::Impl::hover(const JsonValue& params, JsonWriter& json) {
  const auto found =
      workspace_.hover(pathOf(params["textDocument"]), lsp::positionOf(params["position"]));
  if (!found) {
    json.null();
    return;
  }
  json.beginObject().key("contents").beginObject();
  json.key("kind").value(client_.markdown ? "markdown" : "plaintext");
  json.key("value").value(found->text).endObject().key("range");
  lsp::write(json, found->range);
  json.endObject();
}

void LanguageServer::Impl::writePlaces(JsonWriter& json,
                                       const std::vector<language::Place>& places) {
  json.beginArray();
  for (const language::Place& p : places) {
    json.beginObject().key("uri").value(uriOf(p.path)).key("range");
    lsp::write(json, p.range);
    json.endObject();
  }
  json.endArray();
}

void LanguageServer::Impl::definition(const JsonValue& params, JsonWriter& json) {
  writePlaces(json, workspace_.definition(pathOf(params["textDocument"]),
                                          lsp::positionOf(params["position"])));
}

void LanguageServer::Impl::references(const JsonValue& params, JsonWriter& json) {
  writePlaces(json, workspace_.references(pathOf(params["textDocument"]),
                                          lsp::positionOf(params["position"]),
                                          params["context"]["includeDeclaration"].boolean(false)));
}

void LanguageServer::Impl::documentHighlight(const JsonValue& params, JsonWriter& json) {
  json.beginArray();
  for (const Range& r : workspace_.occurrences(pathOf(params["textDocument"]),
                                               lsp::positionOf(params["position"]))) {
    json.beginObject().key("range");
    lsp::write(json, r);
    json.endObject();
  }
  json.endArray();
}

void LanguageServer::Impl::prepareRename(const JsonValue& params, JsonWriter& json) {
  const auto place =
      workspace_.renamable(pathOf(params["textDocument"]), lsp::positionOf(params["position"]));
  if (!place) {
    json.null();
  } else {
    lsp::write(json, place->range);
  }
}

void LanguageServer::Impl::writeEdits(JsonWriter& json,
                                      const std::vector<language::FileEdits>& edits) {
  json.beginObject().key("changes").beginObject();
  for (const language::FileEdits& f : edits) {
    json.key(uriOf(f.path)).beginArray();
    for (const language::Edit& e : f.edits) writeEdit(json, e);
    json.endArray();
  }
  json.endObject().endObject();
}

void LanguageServer::Impl::rename(const JsonValue& params, JsonWriter& json) {
  const language::Renaming r =
      workspace_.rename(pathOf(params["textDocument"]), lsp::positionOf(params["position"]),
                        params["newName"].text());
  if (!r.ok) trouble_ = r.trouble.empty() ? "there is no such text" : r.trouble;
  writeEdits(json, r.edits);
}

void LanguageServer::Impl::codeAction(const JsonValue& params, JsonWriter& json) {
  json.beginArray();
  const JsonValue& only = params["context"]["only"];
  const bool wanted = !only.isArray() ||
                      std::any_of(only.items().begin(), only.items().end(), [](const JsonValue& k) {
                        return k.text() == "quickfix" || k.text().empty();
                      });
  if (wanted && client_.actionLiterals) {
    for (const language::Action& a :
         workspace_.actions(pathOf(params["textDocument"]), lsp::rangeOf(params["range"]))) {
      json.beginObject().key("title").value(a.title).key("kind").value("quickfix");
      if (a.preferred) json.key("isPreferred").value(true);
      json.key("diagnostics").beginArray();
      // The client's own form of the mistake, so that it knows which one this mends.
      for (const JsonValue& d : params["context"]["diagnostics"].items()) {
        if (d["code"].text() == a.code && lsp::rangeOf(d["range"]) == a.range) copy(json, d);
      }
      json.endArray().key("edit");
      writeEdits(json, a.edits);
      json.endObject();
    }
  }
  json.endArray();
}

// --- The whole text ---

void LanguageServer::Impl::documentSymbol(const JsonValue& params, JsonWriter& json) {
  const std::string path = pathOf(params["textDocument"]);
  json.beginArray();
  for (const language::Symbol& s : workspace_.symbols(path)) {
    json.beginObject().key("name").value(s.name).key("kind").value(symbolKind(s.kind));
    if (client_.symbolTree) {
      if (!s.detail.empty()) json.key("detail").value(s.detail);
      json.key("range");
      lsp::write(json, s.range);
      json.key("selectionRange");
      lsp::write(json, s.nameRange);
    } else {
      json.key("location").beginObject().key("uri").value(uriOf(path)).key("range");
      lsp::write(json, s.range);
      json.endObject();
    }
    json.endObject();
  }
  json.endArray();
}

void LanguageServer::Impl::workspaceSymbol(const JsonValue& params, JsonWriter& json) {
  json.beginArray();
  for (const language::Symbol& s : workspace_.projectSymbols(params["query"].text())) {
    json.beginObject().key("name").value(s.name).key("kind").value(symbolKind(s.kind));
    json.key("location").beginObject().key("uri").value(uriOf(s.path)).key("range");
    lsp::write(json, s.nameRange);
    json.endObject().endObject();
  }
  json.endArray();
}

void LanguageServer::Impl::formatting(const JsonValue& params, JsonWriter& json) {
  json.beginArray();
  for (const language::Edit& e : workspace_.format(pathOf(params["textDocument"]))) {
    writeEdit(json, e);
  }
  json.endArray();
}

void LanguageServer::Impl::rangeFormatting(const JsonValue& params, JsonWriter& json) {
  const Range range = lsp::rangeOf(params["range"]);
  json.beginArray();
  for (const language::Edit& e : workspace_.format(pathOf(params["textDocument"]))) {
    if (before(e.range.begin, range.begin) || before(range.end, e.range.end)) continue;
    writeEdit(json, e);
  }
  json.endArray();
}

void LanguageServer::Impl::documentColor(const JsonValue& params, JsonWriter& json) {
  json.beginArray();
  for (const language::Color& c : workspace_.colors(pathOf(params["textDocument"]))) {
    json.beginObject().key("range");
    lsp::write(json, c.range);
    json.key("color").beginObject().key("red").value(c.red).key("green").value(c.green);
    json.key("blue").value(c.blue).key("alpha").value(c.alpha).endObject().endObject();
  }
  json.endArray();
}

void LanguageServer::Impl::colorPresentation(const JsonValue& params, JsonWriter& json) {
  const JsonValue& c = params["color"];
  const language::Color color{lsp::rangeOf(params["range"]), c["red"].number(0),
                              c["green"].number(0), c["blue"].number(0), c["alpha"].number(1)};
  json.beginArray();
  for (const std::string& t : workspace_.colorTexts(pathOf(params["textDocument"]), color)) {
    json.beginObject().key("label").value(t).endObject();
  }
  json.endArray();
}

void LanguageServer::Impl::foldingRange(const JsonValue& params, JsonWriter& json) {
  json.beginArray();
  for (const language::Fold& f : workspace_.folds(pathOf(params["textDocument"]))) {
    json.beginObject().key("startLine").value(f.beginLine).key("endLine").value(f.endLine);
    if (f.kind == language::Fold::Kind::Comment) json.key("kind").value("comment");
    if (f.kind == language::Fold::Kind::Imports) json.key("kind").value("imports");
    json.endObject();
  }
  json.endArray();
}

void LanguageServer::Impl::inlayHint(const JsonValue& params, JsonWriter& json) {
  json.beginArray();
  for (const language::InlayHint& h :
       workspace_.inlayHints(pathOf(params["textDocument"]), lsp::rangeOf(params["range"]))) {
    json.beginObject().key("position");
    lsp::write(json, h.at);
    json.key("label").value(h.label).key("kind").value(h.value ? 1 : 2);
    json.key(h.value ? "paddingLeft" : "paddingRight").value(true).endObject();
  }
  json.endArray();
}

void LanguageServer::Impl::semanticTokens(const JsonValue& params, JsonWriter& json) {
  writeTokens(json, workspace_.highlights(pathOf(params["textDocument"])), nullptr);
}

void LanguageServer::Impl::semanticTokensRange(const JsonValue& params, JsonWriter& json) {
  const Range range = lsp::rangeOf(params["range"]);
  writeTokens(json, workspace_.highlights(pathOf(params["textDocument"])), &range);
}

// --- Beyond the protocol ---

void LanguageServer::Impl::setValues(const JsonValue& params) {
  std::map<std::string, std::string> values;
  for (const auto& [name, value] : params["values"].members()) values[name] = value.text();
  workspace_.setValues(pathOf(params["textDocument"]), std::move(values));
}

void LanguageServer::Impl::attribute(const JsonValue& params, JsonWriter& json) {
  const auto place =
      workspace_.attributeValue(pathOf(params["textDocument"]), params["name"].text());
  if (!place) {
    json.null();
    return;
  }
  json.beginObject().key("uri").value(uriOf(place->path)).key("range");
  lsp::write(json, place->range);
  json.endObject();
}

void LanguageServer::Impl::search(const JsonValue& params, JsonWriter& json) {
  json.beginArray();
  for (const language::Entry& e : language::search(params["query"].text())) {
    json.beginObject().key("name").value(e.name).key("summary").value(e.summary).endObject();
  }
  json.endArray();
}

void LanguageServer::Impl::referencePage(const JsonValue& params, JsonWriter& json) {
  json.value(language::referencePage(params["name"].text()));
}

}  // namespace gable
