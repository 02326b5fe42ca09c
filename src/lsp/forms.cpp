// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rules as forms, to JSON and back.

#include "lsp/server.h"

namespace gable {

using language::BoxRule;
using language::Insertion;
using language::Piece;

namespace {

void write(JsonWriter& json, const Insertion& i) {
  json.beginObject().key("at");
  lsp::write(json, i.at);
  json.field("before", i.before).field("after", i.after).endObject();
}

void writeNames(JsonWriter& json, std::string_view key, const std::vector<std::string>& names) {
  json.key(key).beginArray();
  for (const std::string& n : names) json.value(n);
  json.endArray();
}

const char* kindName(Piece::Kind k) {
  switch (k) {
    case Piece::Kind::Body: return "body";
    case Piece::Kind::Plain: return "plain";
    case Piece::Kind::Case: return "case";
    case Piece::Kind::Chance: return "chance";
    case Piece::Kind::Else: return "else";
    case Piece::Kind::Call: return "call";
    case Piece::Kind::Argument: return "argument";
    case Piece::Kind::Block: return "block";
    case Piece::Kind::Part: return "part";
    case Piece::Kind::Head: return "head";
    case Piece::Kind::Scoped: break;
  }
  return "scoped";
}

// A body is as deep as the tree that it is of.
void write(JsonWriter& json, const Piece& p) {
  json.beginObject().field("kind", kindName(p.kind)).key("range");
  lsp::write(json, p.range);
  if (!p.text.empty()) json.field("text", p.text);
  if (p.repeated) json.field("repeated", true);
  if (!p.removal.empty()) {
    json.key("removal").beginArray();
    for (const language::Range& r : p.removal) lsp::write(json, r);
    json.endArray();
  }
  if (p.insertion) {
    json.key("insertion");
    write(json, *p.insertion);
  }
  json.key("parts").beginArray();
  for (const Piece& part : p.parts) write(json, part);
  json.endArray().endObject();
}

void write(JsonWriter& json, std::string_view key, const std::optional<BoxRule::Change>& c) {
  json.key(key);
  if (!c) {
    json.null();
    return;
  }
  json.beginObject().key("value").beginArray();
  for (const double v : c->value) json.value(v);
  json.endArray().field("set", c->set).field("other", c->other).field("on", c->on).endObject();
}

void write(JsonWriter& json, const BoxRule& b) {
  json.beginObject().field("title", b.title).field("predecessor", b.predecessor);
  json.field("operator", b.op).field("axis", b.axis);
  write(json, "translate", b.translate);
  write(json, "rotate", b.rotate);
  write(json, "scale", b.scale);
  json.key("points").beginArray();
  for (const double p : b.points) json.value(p);
  json.endArray().field("toRoot", b.toRoot).field("margin", b.margin);
  json.field("relative", b.relative).field("orientation", b.orientation);
  json.field("center", b.center).field("faces", b.faces).key("slots").beginArray();
  for (const auto& slot : b.slots) {
    json.beginArray();
    for (const BoxRule::Possibility& p : slot) {
      json.beginObject().field("symbol", p.symbol).key("chance");
      p.chance ? json.value(*p.chance) : json.null();
      json.endObject();
    }
    json.endArray();
  }
  json.endArray();
  writeNames(json, "slotNames", b.slotNames);
  json.field("weight", b.weight).endObject();
}

void write(JsonWriter& json, const language::RuleForm& r) {
  json.beginObject().field("name", r.name).key("range");
  lsp::write(json, r.range);
  json.key("nameRange");
  lsp::write(json, r.nameRange);
  json.key("parametersRange");
  lsp::write(json, r.parametersRange);
  json.key("removal");
  lsp::write(json, r.removal);
  if (r.body) {
    json.key("body");
    write(json, *r.body);
  }
  if (r.box) {
    json.key("box");
    write(json, *r.box);
  }
  json.field("trouble", r.trouble).endObject();
}

std::optional<BoxRule::Change> changeOf(const JsonValue& v) {
  if (!v.isObject()) return std::nullopt;
  BoxRule::Change out;
  for (size_t i = 0; i < out.value.size(); ++i) out.value[i] = v["value"].at(i).number(0);
  out.set = v["set"].boolean(false);
  out.other = v["other"].boolean(false);
  out.on = v["on"].boolean(true);
  return out;
}

// What is not said is as in a new rule.
BoxRule boxOf(const JsonValue& v) {
  BoxRule out;
  const auto text = [&](const char* key, std::string& to) {
    if (v[key].isText()) to = v[key].text();
  };
  text("title", out.title);
  text("predecessor", out.predecessor);
  text("operator", out.op);
  text("axis", out.axis);
  text("orientation", out.orientation);
  text("faces", out.faces);
  out.translate = changeOf(v["translate"]);
  out.rotate = changeOf(v["rotate"]);
  out.scale = changeOf(v["scale"]);
  if (v["points"].isArray()) {
    out.points.clear();
    for (const JsonValue& p : v["points"].items()) out.points.push_back(p.number(0));
  }
  out.toRoot = v["toRoot"].boolean(false);
  out.margin = v["margin"].number(out.margin);
  out.relative = v["relative"].boolean(false);
  out.center = v["center"].boolean(true);
  for (const JsonValue& slot : v["slots"].items()) {
    auto& list = out.slots.emplace_back();
    for (const JsonValue& p : slot.items()) {
      BoxRule::Possibility one{p["symbol"].text(), std::nullopt};
      if (p["chance"].isNumber()) one.chance = p["chance"].number(1);
      list.push_back(std::move(one));
    }
    if (list.empty()) list.push_back({"EMPTY", std::nullopt});
  }
  out.weight = v["weight"].number(1);
  return out;
}

}  // namespace

void LanguageServer::Impl::form(const JsonValue& params, JsonWriter& json) {
  const language::TextForm f =
      workspace_.form(pathOf(params["textDocument"]), params["rule"].text());
  json.beginObject().key("rules").beginArray();
  for (const language::FormRow& r : f.rules) {
    json.beginObject().field("name", r.name);
    writeNames(json, "parameters", r.parameters);
    json.field("type", r.type).key("range");
    lsp::write(json, r.range);
    json.endObject();
  }
  json.endArray();
  writeNames(json, "symbols", f.symbols);
  writeNames(json, "taken", f.taken);
  json.key("rule");
  if (f.rule) {
    write(json, *f.rule);
  } else {
    json.null();
  }
  json.key("newRule");
  write(json, f.newRule);
  if (f.newSymbol) {
    json.key("newSymbol");
    write(json, *f.newSymbol);
  }
  if (f.newAsset) {
    json.key("newAsset");
    write(json, *f.newAsset);
  }
  json.key("assets").beginArray();
  for (const language::AssetRow& a : f.assets) {
    json.beginObject().field("symbol", a.symbol).field("path", a.path).key("pathRange");
    lsp::write(json, a.pathRange);
    json.key("removal");
    lsp::write(json, a.removal);
    json.endObject();
  }
  json.endArray().endObject();
}

void LanguageServer::Impl::formEdits(const JsonValue& params, JsonWriter& json) {
  const auto edits = workspace_.formEdits(pathOf(params["textDocument"]), params["rule"].text(),
                                          boxOf(params["box"]));
  if (!edits) trouble_ = "there is no rule of that name that can be read";
  json.beginArray();
  for (const language::Edit& e : edits.value_or(std::vector<language::Edit>())) {
    json.beginObject().key("range");
    lsp::write(json, e.range);
    json.field("newText", e.text).endObject();
  }
  json.endArray();
}

void LanguageServer::Impl::ruleText(const JsonValue& params, JsonWriter& json) {
  json.value(language::boxRuleText(boxOf(params["box"])));
}

}  // namespace gable
