// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Values that are written out and that their parameter does not take: path = -1, color("blue").
// They are known once constants are folded, so this is a pass of its own over the resolved calls.

#include <algorithm>

#include "base/number.h"
#include "lang/sema/analysis.h"
#include "lang/sema/fractions.h"

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

constexpr double kParts = 255;

// Whole numbers from 0 to 255 as "#rrggbb"; empty where they are none, or could be a slip near 1.
std::string colourOfParts(std::span<const double> numbers) {
  constexpr char kDigits[] = "0123456789abcdef";
  constexpr double kLeastOfParts = 10;
  if (numbers.size() < 3) return {};
  const std::span<const double> rgb = numbers.first(3);
  if (*std::max_element(rgb.begin(), rgb.end()) < kLeastOfParts) return {};
  std::string out = "#";
  for (const double v : rgb) {
    if (!(v >= 0 && v <= kParts)) return {};
    const auto whole = static_cast<size_t>(v);
    if (static_cast<double>(whole) != v) return {};
    out += kDigits[whole / 16];
    out += kDigits[whole % 16];
  }
  return out;
}

// What was meant by a number that is to lie between 0 and 1.
std::string hintOfFraction(double v) {
  constexpr double kPercent = 100;
  if (v > 1 && v <= kPercent && v == static_cast<int>(v)) {
    return "write 0 to 1: " + shortestText(v / kPercent) + " for " + shortestText(v) + " %";
  }
  return v > kPercent && v <= kParts ? "write 0 to 1; of 255 parts, divide by 255" : "write 0 to 1";
}

}  // namespace

// What is written, with its prefix; null where it is not constant.
Value Analysis::writtenValue(NodeId node) {
  const NodeKind kind = tree().kind(node);
  const bool prefixed = kind == NodeKind::Relative || kind == NodeKind::Floating;
  Value v = module().constantAt(prefixed ? tree().child(node, 0) : node);
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

// A part of '50 is fifty times the shape: nobody writes so much by intent.
void Analysis::checkShare(NodeId size, double share) {
  constexpr double kLeast = 10, kPercent = 100;
  if (!(share >= kLeast)) return;
  const std::string number = shortestText(share);
  warning("bad-argument", tree().span(size),
          "a part of '" + number + " is " + number + " times as long as the shape",
          share <= kPercent ? "write '" + shortestText(share / kPercent) + " for " + number + " %"
                            : "write " + number + " for metres");
}

// A size below nothing makes no part: computed ones do so where there is no room.
void Analysis::checkWrittenSizes(NodeId block, const OpSpec& op) {
  for (const NodeId item : tree().children(block)) {
    if (tree().kind(item) == NodeKind::Block) {
      checkWrittenSizes(item, op);
    } else if (tree().kind(item) == NodeKind::Item && tree().child(item, 0) != kNoNode) {
      const NodeId size = tree().child(item, 0);
      const Value v = writtenValue(size);
      if (v.type == ValueType::Float && v.unit == gable::Unit::Relative) checkShare(size, v.number);
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

// The number that a node holds, where it is known and plain.
std::optional<double> Analysis::writtenNumber(NodeId node) {
  if (node == kNoNode) return std::nullopt;
  const Value v = writtenValue(node);
  return v.type == ValueType::Float ? std::optional(v.number) : std::nullopt;
}

void Analysis::warnOfFraction(NodeId node, const std::string& what, double number,
                              std::string hint) {
  warning("bad-argument", tree().span(node),
          what + " goes from 0 to 1, and " + shortestText(number) + " lies beyond",
          std::move(hint));
}

// One warning a call, at the first number beyond.
void Analysis::checkFractions(std::string_view callee, const Signature& signature,
                              std::span<const NodeId> args) {
  std::vector<double> numbers;
  NodeId beyond = kNoNode;
  double number = 0;
  std::string which;
  for (size_t i = 0; i < args.size(); ++i) {
    const ParamSpec& param = *signature.paramAt(i);
    const std::optional<double> v =
        isFraction(callee, param.name) ? writtenNumber(args[i]) : std::nullopt;
    if (!v) continue;
    numbers.push_back(*v);
    if (beyond != kNoNode || (*v >= 0 && *v <= 1)) continue;
    beyond = args[i];
    number = *v;
    which = quote(param.name) + " of " + quote(callee);
  }
  if (beyond == kNoNode) return;
  // Of hue, saturation and value the first is none.
  const bool rgb = isFraction(callee, signature.paramAt(0)->name);
  const std::string colour = rgb ? colourOfParts(numbers) : "";
  warnOfFraction(beyond, which, number,
                 colour.empty() ? hintOfFraction(number)
                                : "divide parts of 255 by 255; the colour is \"" + colour + "\"");
}

// set(material.opacity, 50)
void Analysis::checkSetFraction(std::span<const NodeId> args) {
  if (args.size() != 2) return;
  const Resolution& place = module().at(args[0]);
  if (place.kind != RefKind::ShapeAttribute) return;
  if (!isFraction("set", place.spec.attribute->name)) return;
  const std::optional<double> v = writtenNumber(args[1]);
  if (!v || (*v >= 0 && *v <= 1)) return;
  warnOfFraction(args[1], quote(place.spec.attribute->name), *v, hintOfFraction(*v));
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
  checkFractions(callee, signature, order);
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
    if (program_.modules[m].original != m) continue;
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
      } else if (r.kind == RefKind::Operation) {
        const auto named = module().namedArguments.find(node);
        checkSetFraction(named == module().namedArguments.end() ? args : named->second);
      } else if (r.kind == RefKind::BuiltinFunction && r.spec.function) {
        const FunctionSpec& f = *r.spec.function;
        checkWrittenCall(node, f.name, f.signatures[r.signature], args);
      }
    }
  }
}

}  // namespace gable::lang
