// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "json/answers.h"

#include "gable/names.h"

namespace gable {

namespace {

void writeDiagnostic(JsonWriter& json, const Diagnostic& d) {
  json.beginObject();
  json.key("severity").value(severityName(d.severity));
  json.key("code").value(d.code);
  if (d.range) {
    const TextRange& r = *d.range;
    json.key("file").value(r.file).key("line").value(r.line).key("column").value(r.column);
    json.key("endLine").value(r.endLine).key("endColumn").value(r.endColumn);
  }
  json.key("message").value(d.message);
  if (!d.hint.empty()) json.key("hint").value(d.hint);
  if (d.fix) {
    const TextRange& r = d.fix->range;
    json.key("fix").beginObject().key("file").value(r.file);
    json.key("line").value(r.line).key("column").value(r.column);
    json.key("endLine").value(r.endLine).key("endColumn").value(r.endColumn);
    json.key("text").value(d.fix->text).endObject();
  }
  if (!d.shapePath.empty()) json.key("shapePath").value(d.shapePath);
  json.endObject();
}

void writeScalar(JsonWriter& json, const RuleValue::Scalar& v) {
  std::visit([&](const auto& x) { json.value(x); }, v);
}

void writeMaterial(JsonWriter& json, const MaterialInfo& m) {
  json.beginObject();
  if (!m.name.empty()) json.key("name").value(m.name);
  json.key("color").value(m.color).key("opacity").value(m.opacity);
  json.key("roughness").value(m.roughness).key("metallic").value(m.metallic);
  if (m.emissive) json.key("emissive").value(*m.emissive);
  for (const auto& [layer, path] : m.textures) json.key(layer).value(path);
  json.endObject();
}

void writeValues(JsonWriter& json, const std::vector<NamedValue>& values) {
  json.beginObject();
  for (const NamedValue& v : values) {
    json.key(v.name);
    writeValue(json, v.value);
  }
  json.endObject();
}

}  // namespace

std::string diagnosticsJson(const DiagnosticList& diagnostics) {
  std::string out;
  JsonWriter json(out);
  json.beginArray();
  for (const Diagnostic& d : diagnostics) writeDiagnostic(json, d);
  json.endArray();
  return out;
}

void writeValue(JsonWriter& json, const RuleValue& value) {
  if (!value.array) {
    if (value.items.empty())
      json.null();
    else
      writeScalar(json, value.items[0]);
    return;
  }
  const auto [rows, columns] = *value.array;
  json.beginArray();
  for (uint32_t r = 0; r < rows; ++r) {
    if (rows > 1) json.beginArray();
    for (uint32_t c = 0; c < columns; ++c) writeScalar(json, value.items[r * columns + c]);
    if (rows > 1) json.endArray();
  }
  json.endArray();
}

std::string valuesJson(const std::vector<NamedValue>& values) {
  std::string out;
  JsonWriter json(out);
  writeValues(json, values);
  return out;
}

std::string leafJson(const LeafInfo& leaf) {
  std::string out;
  JsonWriter json(out);
  json.beginObject().key("name").value(leaf.name);
  if (leaf.source) {
    json.key("rule").value(leaf.source->rule).key("file").value(leaf.source->file);
    json.key("line").value(leaf.source->line).key("column").value(leaf.source->column);
  }
  json.key("faces").value(leaf.faces).key("vertices").value(leaf.vertices);
  json.key("material");
  writeMaterial(json, leaf.material);
  json.key("attributes");
  writeValues(json, leaf.attributes);
  json.key("frame").beginArray();
  for (const double v : leaf.frame) json.value(v);
  json.endArray().key("size").beginArray();
  for (const double v : leaf.size) json.value(v);
  json.endArray().key("above").beginArray();
  for (const LeafInfo::Part& p : leaf.parts) {
    json.beginObject().key("name").value(p.name);
    json.key("from").value(p.firstLeaf).key("to").value(p.endLeaf).endObject();
  }
  json.endArray().endObject();
  return out;
}

std::string partsJson(const ModelParts& parts) {
  std::string out;
  JsonWriter json(out);
  json.beginObject().key("parts").beginArray();
  for (const ModelParts::Part& p : parts.parts) {
    json.beginArray().value(p.name).value(p.firstLeaf).value(p.endLeaf).value(p.leaf).endArray();
  }
  json.endArray().key("more").value(parts.more).endObject();
  return out;
}

}  // namespace gable
