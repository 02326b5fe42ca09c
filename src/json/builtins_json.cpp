// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <cmath>

#include "gable/writing.h"
#include "json/answers.h"

namespace gable {

namespace {

void writeParameter(JsonWriter& json, const BuiltinParameter& p);

void writeTerms(JsonWriter& json, const BuiltinParameter& p) {
  json.key("terms").beginArray();
  for (const BuiltinTerm& t : p.terms) {
    json.beginObject().key("name").value(t.name).key("doc").value(t.doc);
    json.key("params").beginArray();
    for (const BuiltinParameter& inner : t.parameters) writeParameter(json, inner);
    json.endArray().endObject();
  }
  json.endArray();
  if (p.single) json.key("single").value(true);
}

void writeParameter(JsonWriter& json, const BuiltinParameter& p) {
  json.beginObject();
  json.key("name").value(p.name).key("type").value(p.type);
  json.key("doc").value(p.doc);
  if (p.defaultText) json.key("default").value(*p.defaultText);
  if (p.words) json.key("words").value(*p.words);
  if (!p.range.empty()) {
    json.key("range").value(p.range);
    if (std::isfinite(p.least)) json.key("least").value(p.least);
    if (std::isfinite(p.most)) json.key("most").value(p.most);
  }
  if (!p.terms.empty()) writeTerms(json, p);
  json.endObject();
}

void writeSignatures(JsonWriter& json, const std::vector<BuiltinSignature>& signatures) {
  json.key("overloads").beginArray();
  for (const BuiltinSignature& s : signatures) {
    json.beginObject().key("params").beginArray();
    for (const BuiltinParameter& p : s.parameters) writeParameter(json, p);
    json.endArray();
    if (s.variadic) json.key("variadic").value(true);
    if (!s.result.empty()) json.key("result").value(s.result);
    json.endObject();
  }
  json.endArray();
}

void write(JsonWriter& json, const BuiltinCall& c) {
  json.beginObject();
  json.key("name").value(c.name).key("family").value(c.family);
  json.key("summary").value(c.summary);
  if (!c.block.empty()) json.key("block").value(c.block);
  if (!c.parts.empty()) {
    json.key("parts").beginArray();
    for (const BuiltinPart& p : c.parts) {
      json.beginObject().key("name").value(p.name).key("doc").value(p.doc).endObject();
    }
    json.endArray();
  }
  if (c.selectors) json.key("selectors").value(true);
  if (c.bare) json.key("bare").value(true);
  writeSignatures(json, c.signatures);
  json.endObject();
}

void write(JsonWriter& json, const BuiltinAttribute& a) {
  json.beginObject();
  json.key("name").value(a.name).key("type").value(a.type);
  json.key("doc").value(a.doc).key("writable").value(a.writable);
  json.endObject();
}

void write(JsonWriter& json, const BuiltinSelector& s) {
  json.beginObject().key("name").value(s.name).key("doc").value(s.doc).endObject();
}

void write(JsonWriter& json, const WriteOption& o) {
  json.beginObject().key("name").value(o.name).key("help").value(o.help);
  if (o.words.empty()) json.key("most").value(o.most);
  json.key("words").beginArray();
  for (const std::string& word : o.words) json.value(word);
  json.endArray().endObject();
}

void write(JsonWriter& json, const WriteProfile& p) {
  json.beginObject().key("name").value(p.name).key("title").value(p.title);
  json.key("choices").beginObject();
  for (const auto& [option, value] : p.choices) json.key(option).value(value);
  json.endObject().endObject();
}

template <class Entry>
void writeList(JsonWriter& json, const char* key, const std::vector<Entry>& entries) {
  json.key(key).beginArray();
  for (const Entry& e : entries) write(json, e);
  json.endArray();
}

}  // namespace

std::string builtinsJson(const Builtins& builtins) {
  std::string out;
  JsonWriter json(out, 1);
  json.beginObject();
  writeList(json, "operations", builtins.operations);
  writeList(json, "functions", builtins.functions);
  writeList(json, "attributes", builtins.attributes);
  writeList(json, "selectors", builtins.selectors);
  writeList(json, "writeOptions", writeOptions());
  writeList(json, "writeProfiles", writeProfiles());
  json.endObject();
  return out + "\n";
}

std::optional<std::string> builtinJson(const Builtins& builtins, const std::string& name) {
  std::string out;
  JsonWriter json(out, 1);
  const auto found = [&](const auto& entries) {
    for (const auto& e : entries) {
      if (e.name != name) continue;
      write(json, e);
      return true;
    }
    return false;
  };
  const bool any = found(builtins.operations) || found(builtins.functions) ||
                   found(builtins.attributes) || found(builtins.selectors);
  return any ? std::optional<std::string>(out) : std::nullopt;
}

}  // namespace gable
