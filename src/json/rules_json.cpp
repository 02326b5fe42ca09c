// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "json/answers.h"

namespace gable {

namespace {

void writeAnnotations(JsonWriter& json, const std::vector<AttributeInfo::Annotation>& annotations) {
  json.key("annotations").beginArray();
  for (const AttributeInfo::Annotation& n : annotations) {
    json.beginObject().key("name").value(n.name).key("arguments").beginArray();
    for (const auto& [key, value] : n.arguments) {
      json.beginArray().value(key).value(value).endArray();
    }
    json.endArray().endObject();
  }
  json.endArray();
}

}  // namespace

void writeRules(JsonWriter& json, const Rules& rules) {
  json.key("styles").beginArray();
  for (const std::string& style : rules.styles()) json.value(style);
  json.endArray();
  json.key("startRule").value(rules.startRule().value_or(std::string())).key("rules").beginArray();
  for (const RuleInfo& r : rules.rules()) {
    json.beginObject().key("name").value(r.name);
    json.key("parameters").value(static_cast<uint64_t>(r.parameters)).key("start").value(r.start);
    json.key("file").value(r.file).key("line").value(r.line).key("hidden").value(r.hidden);
    writeAnnotations(json, r.annotations);
    json.endObject();
  }
  json.endArray().key("attributes").beginArray();
  for (const AttributeInfo& a : rules.attributes()) {
    json.beginObject().key("name").value(a.name).key("type").value(a.type);
    json.key("hidden").value(a.hidden);
    writeAnnotations(json, a.annotations);
    json.endObject();
  }
  json.endArray();
}

void writeRuleFile(JsonWriter& json, const Rules& rules, const std::vector<NamedValue>& values) {
  json.key("description").value(rules.description());
  writeRules(json, rules);
  json.key("values").raw(valuesJson(values)).key("imports").beginArray();
  for (const ImportInfo& i : rules.imports()) {
    json.beginObject().key("name").value(i.name).key("path").value(i.path);
    json.key("file").value(i.file).key("found").value(!i.file.empty()).endObject();
  }
  json.endArray().key("assets").beginArray();
  for (const AssetUse& a : rules.assets()) {
    json.beginObject().key("path").value(a.path).key("from").value(a.from);
    json.key("file").value(a.file).key("found").value(!a.file.empty()).endObject();
  }
  json.endArray();
}

}  // namespace gable
