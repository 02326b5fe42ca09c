// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The catalogue as JSON and as text. Reference pages, editors and `gable ops` all read this.

#include "base/json.h"
#include "builtins/catalogue.h"
#include "gable/gable.h"

namespace gable {

namespace {

const char* paramTypeName(ParamType t) {
  switch (t) {
    case ParamType::Float: return "float";
    case ParamType::Bool: return "bool";
    case ParamType::String: return "string";
    case ParamType::Selector: return "selector";
    case ParamType::FloatArray: return "float[]";
    case ParamType::BoolArray: return "bool[]";
    case ParamType::StringArray: return "string[]";
    case ParamType::Size: return "size";
    case ParamType::FloatingSize: return "floating size";
    case ParamType::Drawn: return "drawn";
    case ParamType::DrawnList: return "drawn[]";
    case ParamType::Selection: return "selection";
    case ParamType::Any: break;
  }
  return "any";
}

const char* blockName(const OpSpec& op) {
  switch (op.block) {
    case BlockKind::None: return "";
    case BlockKind::Split: return "{ size : operations | ... }";
    case BlockKind::Selectors: return "{ selector : operations | ... }";
    case BlockKind::Operations:
      return op.blockWords ? "{ operations | otherwise : operations }" : "{ operations }";
    case BlockKind::Operands: break;
  }
  return "{ A | B }";
}

// What a selection is made of.
void writeTerms(JsonWriter& json, const ParamSpec& param) {
  json.key("terms").beginArray();
  for (const TermSpec& t : param.terms) {
    json.beginObject().key("name").value(t.name).key("doc").value(t.doc);
    json.key("params").beginArray();
    for (size_t i = 0; i < t.paramCount; ++i) {
      const ParamSpec& p = t.params[i];
      json.beginObject().key("name").value(p.name).key("type").value(paramTypeName(p.type));
      json.key("doc").value(p.doc);
      if (p.defaultText) json.key("default").value(p.defaultText);
      if (p.words) json.key("words").value(p.words);
      if (!p.terms.empty() && p.terms.data() != param.terms.data()) writeTerms(json, p);
      json.endObject();
    }
    json.endArray().endObject();
  }
  json.endArray();
  if (param.single) json.key("single").value(true);
}

void writeSignatures(JsonWriter& json, std::span<const Signature> signatures, bool results) {
  json.key("overloads").beginArray();
  for (const Signature& s : signatures) {
    json.beginObject().key("params").beginArray();
    for (const ParamSpec& p : s.params) {
      json.beginObject();
      json.key("name").value(p.name).key("type").value(paramTypeName(p.type));
      json.key("doc").value(p.doc);
      if (p.defaultText) json.key("default").value(p.defaultText);
      if (p.words) json.key("words").value(p.words);
      if (!p.terms.empty()) writeTerms(json, p);
      json.endObject();
    }
    json.endArray();
    if (s.variadic) json.key("variadic").value(true);
    if (results) json.key("result").value(typeName(s.result));
    json.endObject();
  }
  json.endArray();
}

void writeOperation(JsonWriter& json, const OpSpec& op) {
  json.beginObject();
  json.key("name").value(op.name).key("family").value(op.family);
  json.key("summary").value(op.summary);
  if (op.block != BlockKind::None) json.key("block").value(blockName(op));
  if (op.blockWords) json.key("blockWords").value(op.blockWords);
  writeSignatures(json, op.signatures, false);
  json.endObject();
}

void writeFunction(JsonWriter& json, const FunctionSpec& f) {
  json.beginObject();
  json.key("name").value(f.name).key("family").value(f.family);
  json.key("summary").value(f.summary);
  if (f.bare) json.key("bare").value(true);
  writeSignatures(json, f.signatures, true);
  json.endObject();
}

void writeAttribute(JsonWriter& json, const AttributeSpec& a) {
  json.beginObject();
  json.key("name").value(a.name).key("type").value(typeName(a.type));
  json.key("doc").value(a.doc).key("writable").value(a.set != nullptr);
  json.endObject();
}

std::string signatureText(const char* name, const Signature& s) {
  std::string out = std::string(name) + "(";
  for (size_t i = 0; i < s.params.size(); ++i) {
    const ParamSpec& p = s.params[i];
    out += std::string(i ? ", " : "") + (p.defaultText ? "[" : "") + p.name +
           (p.defaultText ? "]" : "");
  }
  return out + (s.variadic ? ", ...)" : ")");
}

template <class Spec>
std::string callText(const Spec& spec, const char* block) {
  std::string out = std::string(spec.name) + " - " + spec.summary + "\n\n";
  for (const Signature& s : spec.signatures) {
    out += "  " + signatureText(spec.name, s) + (*block ? " " : "") + block + "\n";
    for (const ParamSpec& p : s.params) {
      out += "      " + std::string(p.name) + " (" + paramTypeName(p.type) +
             (p.words ? std::string(": ") + p.words : "") + ")  " + p.doc +
             (p.defaultText ? std::string(" Default: ") + p.defaultText + "." : "") + "\n";
    }
  }
  return out;
}

template <class Spec>
std::string listText(const char* title, std::span<const Spec* const> specs) {
  std::string out = std::string(title) + "\n";
  for (const Spec* s : specs) {
    std::string line = std::string("  ") + s->name;
    line.resize(std::max<size_t>(line.size() + 1, 28), ' ');
    out += line + s->summary + "\n";
  }
  return out + "\n";
}

}  // namespace

std::string builtinsJson(const std::string& name) {
  const Catalogue& c = builtinCatalogue();
  std::string out;
  JsonWriter json(out, 1);
  if (!name.empty()) {
    if (const OpSpec* op = c.operation(name))
      writeOperation(json, *op);
    else if (const FunctionSpec* f = c.function(name))
      writeFunction(json, *f);
    else if (const AttributeSpec* a = c.attribute(name))
      writeAttribute(json, *a);
    return out;
  }
  json.beginObject().key("operations").beginArray();
  for (const OpSpec* op : c.operations) writeOperation(json, *op);
  json.endArray().key("functions").beginArray();
  for (const FunctionSpec* f : c.functions) writeFunction(json, *f);
  json.endArray().key("attributes").beginArray();
  for (const AttributeSpec* a : c.attributes) writeAttribute(json, *a);
  json.endArray().key("selectors").beginArray();
  for (const SelectorSpec& s : c.selectors) {
    json.beginObject().key("name").value(s.name).key("doc").value(s.doc).endObject();
  }
  json.endArray().endObject();
  return out + "\n";
}

std::string builtinsText(const std::string& name) {
  const Catalogue& c = builtinCatalogue();
  if (!name.empty()) {
    if (const OpSpec* op = c.operation(name)) return callText(*op, blockName(*op));
    if (const FunctionSpec* f = c.function(name)) return callText(*f, "");
    if (const AttributeSpec* a = c.attribute(name)) {
      return std::string(a->name) + " (" + typeName(a->type) + ") - " + a->doc + "\n";
    }
    return {};
  }
  std::string out = listText("Operations", c.operations) + listText("Functions", c.functions);
  out += "Attributes of the shape\n";
  for (const AttributeSpec* a : c.attributes) {
    std::string line = std::string("  ") + a->name;
    line.resize(std::max<size_t>(line.size() + 1, 28), ' ');
    out += line + a->doc + "\n";
  }
  return out;
}

}  // namespace gable
