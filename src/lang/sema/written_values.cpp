// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Values that are written out and that their parameter does not take: path = -1, color("blue").
// They are known once constants are folded, so this is a pass of its own over the resolved calls.

#include <algorithm>

#include "base/number.h"
#include "lang/sema/analysis.h"

namespace gable::lang {

namespace {

// A colour without the sign before it, or with one digit for two (#f80, #f80c), as its parameter
// takes it; empty where that is not what is wrong.
std::string mendedText(const ParamSpec& param, std::string_view text) {
  std::string full = text.starts_with('#') ? "" : "#" + std::string(text);
  if (text.starts_with('#') && (text.size() == 4 || text.size() == 5)) {
    for (const char c : text) full.append(c == '#' ? 1 : 2, c);
  }
  return !full.empty() && param.form->holds(full) ? full : std::string();
}

}  // namespace

// What is written, with its prefix; null where it is not constant.
Value Analysis::writtenValue(NodeId node) {
  const NodeKind kind = tree().kind(node);
  const bool prefixed = kind == NodeKind::Relative || kind == NodeKind::Floating;
  Value v = module().constants[prefixed ? tree().child(node, 0) : node];
  if (prefixed) v.unit = kind == NodeKind::Relative ? gable::Unit::Relative : gable::Unit::Floating;
  return v;
}

// The value of an argument, or each of a list, where it is constant.
void Analysis::checkWrittenValue(NodeId node, const ParamSpec& param, std::string_view callee) {
  const Tree& t = tree();
  if (param.range.any() && !param.form) return;
  if (t.kind(node) == NodeKind::Array) {
    // Of a selection a list gives coordinates.
    if (param.type == ParamType::Selection) return;
    for (const NodeId row : t.children(node)) {
      for (const NodeId item : t.children(row)) checkWrittenValue(item, param, callee);
    }
    return;
  }
  const Value v = writtenValue(node);
  if (v.type == ValueType::Null || isTaken(param, v, values_)) return;
  if (v.type == ValueType::String) {
    const std::string_view text = values_.text(v.id);
    const std::string mended = mendedText(param, text);
    if (!mended.empty() && t.kind(node) == NodeKind::String) meant_ = {text, mended};
    errorAt("bad-argument", node, refusalText(param, callee, v, values_),
            mended.empty() ? refusalHint(param) : "write \"" + mended + "\"");
    return;
  }
  errorAt("bad-argument", node, refusalText(param, callee, v, values_), refusalHint(param));
}

// A size below nothing makes no part: computed ones do so where there is no room.
void Analysis::checkWrittenSizes(NodeId block, const OpSpec& op) {
  for (const NodeId item : tree().children(block)) {
    if (tree().kind(item) == NodeKind::Block) {
      checkWrittenSizes(item, op);
    } else if (tree().kind(item) == NodeKind::Item && tree().child(item, 0) != kNoNode) {
      const NodeId size = tree().child(item, 0);
      const Value v = writtenValue(size);
      if (v.type != ValueType::Float || !(v.number < 0)) continue;
      warning("bad-argument", tree().span(size),
              "a size of " + quote(op.name) + " below 0 makes no part: " + shortestText(v.number),
              "write 0 or more, or leave the part out");
    }
  }
}

bool Analysis::hasTerm(NodeId node, std::string_view name) const {
  if (node == kNoNode) return false;
  const Resolution& r = program_.modules[body_.module].at(node);
  if (r.kind == RefKind::Selector && r.spec.term && r.spec.term->name == name) return true;
  const std::span<const NodeId> inside = tree().children(node);
  return std::any_of(inside.begin(), inside.end(), [&](NodeId n) { return hasTerm(n, name); });
}

void Analysis::checkWrittenCall(NodeId node, std::string_view callee, const Signature& signature,
                                std::span<const NodeId> args) {
  const auto named = module().namedArguments.find(node);
  const bool byName = named != module().namedArguments.end();
  const std::vector<NodeId> order =
      byName ? named->second : std::vector<NodeId>(args.begin(), args.end());
  for (size_t i = 0; i < order.size(); ++i) {
    if (order[i] != kNoNode) checkWrittenValue(order[i], *signature.paramAt(i), callee);
  }
  for (size_t p = 0; p < signature.params.size(); ++p) {
    const ParamSpec& param = signature.params[p];
    const bool given = p < order.size() && order[p] != kNoNode;
    if (!param.unlessTerm || given) continue;
    const bool excused = std::any_of(order.begin(), order.end(),
                                     [&](NodeId n) { return hasTerm(n, param.unlessTerm); });
    if (excused) continue;
    errorAt("wrong-argument-count", node,
            quote(callee) + " needs " + quote(param.name) + " as well",
            "write " + std::string(param.name) + " = 1, or " + param.unlessTerm +
                "() in the selection: " + docText(param));
  }
}

void Analysis::checkWrittenValues(ModuleId firstModule) {
  foldConstants();
  for (ModuleId m = firstModule; m < program_.modules.size(); ++m) {
    body_ = {};
    body_.module = m;
    for (NodeId node = 1; node < tree().size(); ++node) {
      const Resolution& r = module().at(node);
      if (r.kind == RefKind::Selector && r.spec.term) {
        const auto order = module().namedArguments.find(node);
        for (size_t i = 0; order != module().namedArguments.end() && i < order->second.size();
             ++i) {
          if (order->second[i] == kNoNode) continue;
          checkWrittenValue(order->second[i], r.spec.term->params[i], r.spec.term->name);
        }
        continue;
      }
      if (r.signature == 0xffff || r.open) continue;
      const std::span<const NodeId> args = arguments(tree().child(node, 0));
      if (r.kind == RefKind::Operation && r.spec.operation->name != std::string_view("set")) {
        const OpSpec& op = *r.spec.operation;
        checkWrittenCall(node, op.name, op.signatures[r.signature], args);
        if (op.block != BlockKind::Split) continue;
        for (const NodeId block : tree().children(node).subspan(1)) checkWrittenSizes(block, op);
      } else if (r.kind == RefKind::BuiltinFunction && r.spec.function) {
        const FunctionSpec& f = *r.spec.function;
        checkWrittenCall(node, f.name, f.signatures[r.signature], args);
      }
    }
  }
}

}  // namespace gable::lang
