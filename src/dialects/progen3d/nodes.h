// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Nodes of the neutral tree in few words, each with the span of the text that it stands for.
#pragma once

#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "lang/tree.h"

namespace gable::progen3d {

using lang::BinaryOp;
using lang::kNoNode;
using lang::Node;
using lang::NodeId;
using lang::NodeKind;
using Nodes = std::vector<NodeId>;

class Builder {
 public:
  explicit Builder(uint32_t file) : tree_(file) {}

  NodeId add(NodeKind kind, Span at, const Nodes& children = {}, std::string_view text = {}) {
    Node n;
    n.kind = kind;
    n.begin = at.begin;
    n.end = at.end;
    if (!text.empty()) n.text = tree_.intern(text);
    return tree_.add(n, children);
  }
  NodeId list(Span at, const Nodes& items) { return add(NodeKind::List, at, items); }
  NodeId name(std::string_view text, Span at) { return add(NodeKind::Name, at, {}, text); }
  NodeId number(double v, Span at) {
    Node n;
    n.kind = NodeKind::Number;
    n.begin = at.begin;
    n.end = at.end;
    n.number = std::fabs(v);
    const NodeId id = tree_.add(n);
    return v < 0 ? unary(lang::UnaryOp::Minus, id, at) : id;
  }
  NodeId unary(lang::UnaryOp op, NodeId operand, Span at) {
    Node n;
    n.kind = NodeKind::Unary;
    n.op = static_cast<uint8_t>(op);
    n.begin = at.begin;
    n.end = at.end;
    return tree_.add(n, {operand});
  }
  NodeId binary(BinaryOp op, NodeId left, NodeId right, Span at) {
    Node n;
    n.kind = NodeKind::Binary;
    n.op = static_cast<uint8_t>(op);
    n.begin = at.begin;
    n.end = at.end;
    return tree_.add(n, {left, right});
  }
  NodeId call(std::string_view function, const Nodes& arguments, Span at) {
    return add(NodeKind::Call, at, {list(at, arguments), kNoNode}, function);
  }
  NodeId apply(std::string_view operation, const Nodes& arguments, Span at) {
    return add(NodeKind::Apply, at, {list(at, arguments)}, operation);
  }
  NodeId sequence(const Nodes& parts, Span at) { return add(NodeKind::Sequence, at, parts); }
  /// operation(arguments) { parts }
  NodeId block(std::string_view operation, const Nodes& arguments, const Nodes& parts, Span at) {
    Nodes items;
    if (!parts.empty()) {
      items.push_back(add(NodeKind::Item, at, {kNoNode, kNoNode, sequence(parts, at)}));
    }
    const NodeId body = add(NodeKind::Block, at, items);
    return add(NodeKind::Apply, at, {list(at, arguments), body}, operation);
  }
  /// weight% : first else : second
  NodeId choice(NodeId weight, const Nodes& first, const Nodes& second, Span at) {
    const NodeId a = add(NodeKind::Branch, at, {weight, sequence(first, at)});
    const NodeId b = add(NodeKind::Branch, at, {kNoNode, sequence(second, at)});
    return percent({a, b}, at);
  }
  NodeId array(const Nodes& row, Span at) { return add(NodeKind::Array, at, {list(at, row)}); }
  NodeId string(std::string_view text, Span at) { return add(NodeKind::String, at, {}, text); }
  /// @Name
  NodeId note(std::string_view name, Span at) {
    return list(at, {add(NodeKind::Annotation, at, {}, name)});
  }
  NodeId params(const std::vector<std::string>& names, Span at) {
    Nodes out;
    for (const std::string& n : names) out.push_back(add(NodeKind::Param, at, {}, n));
    return list(at, out);
  }
  /// case condition : first else : second, of expressions
  NodeId either(NodeId condition, NodeId first, NodeId second, Span at) {
    const NodeId a = add(NodeKind::Branch, at, {condition, first});
    return add(NodeKind::Choice, at, {a, add(NodeKind::Branch, at, {kNoNode, second})});
  }
  NodeId function(std::string_view name, const std::vector<std::string>& parameters, NodeId value,
                  Span at) {
    return add(NodeKind::Function, at, {kNoNode, params(parameters, at), kNoNode, value}, name);
  }
  /// function(a, b) = case b == 0 : 0 else : a / b
  NodeId quotient(std::string_view function_, Span at) {
    const NodeId isZero = binary(BinaryOp::Equal, name("b", at), number(0, at), at);
    const NodeId ratio = binary(BinaryOp::Divide, name("a", at), name("b", at), at);
    return function(function_, {"a", "b"}, either(isZero, number(0, at), ratio, at), at);
  }
  /// sin, cos and tan of an angle in radians.
  NodeId ofRadians(const char* function_, NodeId angle, Span at) {
    constexpr double kDegreesInRadian = 57.29577951308232;
    return call(function_, {binary(BinaryOp::Multiply, angle, number(kDegreesInRadian, at), at)},
                at);
  }
  /// Branches with weights in percent; the last without one.
  NodeId percent(const Nodes& branches, Span at) {
    Node n;
    n.kind = NodeKind::Choice;
    n.op = static_cast<uint8_t>(lang::ChoiceKind::Percent);
    n.begin = at.begin;
    n.end = at.end;
    return tree_.add(n, branches);
  }
  lang::Tree finish(const Nodes& declarations) {
    tree_.setRoot(add(NodeKind::File, {tree_.file(), 0, 0}, declarations));
    return std::move(tree_);
  }

 private:
  lang::Tree tree_;
};

}  // namespace gable::progen3d
