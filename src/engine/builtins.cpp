// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The catalogue as plain data.

#include "base/text.h"
#include "builtins/catalogue.h"
#include "dialects/dialect.h"
#include "engine/guard.h"
#include "gable/gable.h"

namespace gable {

namespace {

const char* blockName(const OpSpec& op) {
  switch (op.block) {
    case BlockKind::None: return "";
    case BlockKind::Split:
      return op.parts.empty() ? "{ size : operations | ... }"
                              : "{ size : depth : operations | ... } { remainder : operations }";
    case BlockKind::Selectors: return "{ selector : operations | ... }";
    case BlockKind::Operations:
      return !op.parts.empty() ? "{ operations | otherwise : operations }" : "{ operations }";
    case BlockKind::Operands: break;
  }
  return "{ A | B }";
}

BuiltinParameter parameterOf(const ParamSpec& p) {
  BuiltinParameter out;
  out.name = p.name;
  out.type = typeText(p.type);
  out.doc = p.doc;
  if (p.defaultText) out.defaultText = p.defaultText;
  if (p.words) out.words = p.words;
  if (!p.range.any()) {
    out.range = rangeText(p.range);
    out.least = p.range.least;
    out.most = p.range.most;
  }
  return out;
}

void addTerms(BuiltinParameter& out, const ParamSpec& param) {
  out.single = !param.terms.empty() && param.single;
  for (const TermSpec& t : param.terms) {
    BuiltinTerm term{t.name, t.doc, {}};
    for (size_t i = 0; i < t.paramCount; ++i) {
      const ParamSpec& p = t.params[i];
      BuiltinParameter inner = parameterOf(p);
      if (p.terms.data() != param.terms.data()) addTerms(inner, p);
      term.parameters.push_back(std::move(inner));
    }
    out.terms.push_back(std::move(term));
  }
}

std::vector<BuiltinSignature> signaturesOf(std::span<const Signature> signatures, bool results) {
  std::vector<BuiltinSignature> out;
  for (const Signature& s : signatures) {
    BuiltinSignature signature;
    for (const ParamSpec& p : s.params) {
      BuiltinParameter parameter = parameterOf(p);
      addTerms(parameter, p);
      signature.parameters.push_back(std::move(parameter));
    }
    signature.variadic = s.variadic;
    if (results) signature.result = typeName(s.result);
    out.push_back(std::move(signature));
  }
  return out;
}

Builtins allBuiltins() {
  const Catalogue& c = builtinCatalogue();
  Builtins out;
  for (const OpSpec* op : c.operations) {
    BuiltinCall call;
    call.name = op->name;
    call.family = op->family;
    call.summary = op->summary;
    call.block = blockName(*op);
    for (const PartSpec& p : op->parts) call.parts.push_back({p.name, p.doc});
    call.selectors = op->block == BlockKind::Selectors && !op->isOnlyParts();
    call.signatures = signaturesOf(op->signatures, false);
    out.operations.push_back(std::move(call));
  }
  for (const FunctionSpec* f : c.functions) {
    BuiltinCall call;
    call.name = f->name;
    call.family = f->family;
    call.summary = f->summary;
    call.bare = f->bare;
    call.signatures = signaturesOf(f->signatures, true);
    out.functions.push_back(std::move(call));
  }
  for (const AttributeSpec* a : c.attributes) {
    out.attributes.push_back({a->name, typeName(a->type), a->doc, a->set != nullptr});
  }
  for (const SelectorSpec& s : c.selectors) out.selectors.push_back({s.name, s.doc});
  return out;
}

}  // namespace

std::vector<NotationWord> notationWords() {
  return guardedValue<std::vector<NotationWord>>([] {
    std::vector<NotationWord> out;
    for (const Dialect* d : dialects()) {
      if (!d->words) continue;
      const std::string guide = std::string("docs/guide/") + d->name + ".md";
      for (const DialectWord& w : d->words()) {
        out.push_back({w.name, d->title, d->extensions[0], guide, w.call, w.text});
      }
    }
    return out;
  });
}

Builtins builtins() { return guardedValue<Builtins>(allBuiltins); }

std::string suggestion(const std::string& name, const std::vector<std::string>& known) {
  return didYouMean(name, {known.begin(), known.end()});
}

}  // namespace gable
