// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "language/forms.h"

#include <algorithm>

#include "program/value.h"

namespace gable::language {

namespace {

const char* blockText(const Callable& c) {
  switch (c.block) {
    case BlockKind::None: return "";
    case BlockKind::Split:
      return c.parts.empty() ? " { size : operations | ... }"
                             : " { size : depth : operations | ... } { remainder : operations }";
    case BlockKind::Selectors: return " { selector : operations | ... }";
    case BlockKind::Operations: return " { operations }";
    case BlockKind::Operands: break;
  }
  return " { A | B }";
}

// The text that stands in a place to fill in, with its colon; nothing where any text will do.
std::string sampleText(const ParamSpec& p) {
  for (const char* text : {"", "text", "#ffffff"}) {
    if (!p.form || p.form->holds(text)) return *text ? std::string(":") + text : std::string();
  }
  return "";
}

// A value that the parameter takes, so that the call is no mistake while it is being filled in.
std::string sample(const ParamSpec& p, int place) {
  const std::string n = std::to_string(place);
  if (p.words) {
    std::string choices;
    for (const std::string_view w : listed(p.words)) {
      choices += (choices.empty() ? "" : ",") + std::string(w);
    }
    return "${" + n + "|" + choices + "|}";
  }
  switch (p.type) {
    case ParamType::Bool: return "${" + n + ":true}";
    case ParamType::Selection:
      for (const TermSpec& t : p.terms) {
        if (t.paramCount == 0) return "${" + n + ":" + t.name + "}";
      }
      break;
    case ParamType::String: return "\"${" + n + sampleText(p) + "}\"";
    case ParamType::Selector: return "${" + n + ":all}";
    case ParamType::FloatArray: return "${" + n + ":[1, 2]}";
    case ParamType::BoolArray: return "${" + n + ":[true, false]}";
    case ParamType::StringArray: return "${" + n + ":[\"a\", \"b\"]}";
    default: break;
  }
  const bool isAngle = std::string_view(p.name).find("ngle") != std::string_view::npos;
  // As few as there may be, of what has a least number.
  const double value = isAngle ? 30.0 : p.range.holds(1) ? 1.0 : p.range.least;
  return "${" + n + ":" + numberText(value) + "}";
}

std::string blockSample(const Callable& c, int place) {
  const auto at = [&](int i, const char* text) {
    return "${" + std::to_string(place + i) + ":" + text + "}";
  };
  switch (c.block) {
    case BlockKind::None: return "";
    case BlockKind::Split:
      if (c.parts.empty()) return " { " + at(0, "~1") + " : " + at(1, "NIL") + " }";
      return " { " + at(0, "~1") + " : " + at(1, "1") + " : " + at(2, "NIL") + " }";
    case BlockKind::Selectors: {
      const std::string word = c.parts.empty() ? "all" : c.parts[0].name;
      return " { " + at(0, word.c_str()) + " : " + at(1, "NIL") + " }";
    }
    case BlockKind::Operations: return " { " + at(0, "NIL") + " }";
    case BlockKind::Operands: break;
  }
  return " { " + at(0, "NIL") + " | " + at(1, "NIL") + " }";
}

}  // namespace

std::optional<Callable> callableOf(const Catalogue& catalogue, std::string_view name,
                                   bool successor) {
  const OpSpec* op = catalogue.operation(name);
  const FunctionSpec* f = catalogue.function(name);
  if (op && (successor || !f)) {
    return Callable{op->name, op->summary, op->signatures, op->block, op->blockOptional, op->parts};
  }
  if (f) return Callable{f->name, f->summary, f->signatures, BlockKind::None, false, {}};
  return std::nullopt;
}

std::string label(std::string_view name, const Signature& signature,
                  std::vector<SignatureHelp::Parameter>* parameters) {
  std::string out = std::string(name) + "(";
  for (size_t i = 0; i < signature.params.size(); ++i) {
    const ParamSpec& p = signature.params[i];
    if (i > 0) out += ", ";
    if (p.defaultText) out += "[";
    const auto begin = static_cast<uint32_t>(out.size());
    out += p.name;
    if (parameters) {
      std::string doc = docText(p);
      if (p.words) doc += " One of: " + std::string(p.words) + ".";
      if (p.defaultText) doc += " Default: " + std::string(p.defaultText) + ".";
      parameters->push_back(
          {begin, static_cast<uint32_t>(out.size()), std::string(typeText(p.type)) + ". " + doc});
    }
    if (p.defaultText) out += "]";
  }
  return out + (signature.variadic ? ", ...)" : ")");
}

std::string label(const Callable& callable) {
  if (callable.signatures.empty()) return std::string(callable.name) + blockText(callable);
  return label(callable.name, callable.signatures[0]) + blockText(callable);
}

const ParamSpec* parameterAt(const Signature& signature, uint32_t argument,
                             std::string_view named) {
  if (!named.empty()) {
    for (const ParamSpec& p : signature.params) {
      if (p.name == named) return &p;
    }
    return nullptr;
  }
  return signature.paramAt(argument);
}

std::vector<const ParamSpec*> parametersAt(const Callable& callable, const Call& call) {
  std::vector<const ParamSpec*> out;
  for (const Signature& s : callable.signatures) {
    if (const ParamSpec* p = parameterAt(s, call.argument, call.named)) out.push_back(p);
  }
  return out;
}

uint32_t signatureFor(const Callable& callable, const Call& call) {
  for (size_t i = 0; i < callable.signatures.size(); ++i) {
    if (parameterAt(callable.signatures[i], call.argument, call.named)) {
      return static_cast<uint32_t>(i);
    }
  }
  return 0;
}

std::string example(const Callable& callable) {
  // Their first argument is no value, but the name of an attribute or of a rule.
  const std::string_view name = callable.name;
  if (name == "set") return "set(${1:material.color.r}, ${2:1})";
  if (name == "do") return "do(${1:Rule})";
  std::string out = callable.name;
  int place = 1;
  if (!callable.signatures.empty()) {
    // The signature that asks for the least.
    const Signature& s = *std::min_element(callable.signatures.begin(), callable.signatures.end(),
                                           [](const Signature& a, const Signature& b) {
                                             return a.requiredCount() < b.requiredCount();
                                           });
    out += "(";
    const size_t required = s.requiredCount();
    for (size_t i = 0; i < required; ++i) {
      out += (i > 0 ? ", " : "") + sample(s.params[i], place++);
    }
    // Needed where the selection before has not the one term that makes up for it.
    for (size_t i = required; i < s.params.size(); ++i) {
      const ParamSpec& p = s.params[i];
      if (p.unlessTerm) out += std::string(", ") + p.name + " = " + sample(p, place++);
    }
    out += ")";
  }
  return callable.blockOptional ? out : out + blockSample(callable, place);
}

std::vector<std::string_view> listed(const char* words) {
  std::vector<std::string_view> out;
  std::string_view rest = words ? words : "";
  while (!rest.empty()) {
    const size_t end = std::min(rest.find(' '), rest.size());
    if (end > 0) out.push_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return out;
}

}  // namespace gable::language
