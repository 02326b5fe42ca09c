// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Node 0 and text 0 are the empty ones, so that kNoNode can be read like any node.

#include "lang/tree.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/work.h"

namespace gable::lang {

Tree::Tree(uint32_t file) : file_(file), nodes_(1), depths_(1, 0) {
  texts_.push_back(std::make_unique<std::string>());
}

Tree Tree::copy(uint32_t file) const {
  Tree out(file);
  out.root_ = root_;
  out.nodes_ = nodes_;
  out.depths_ = depths_;
  out.children_ = children_;
  out.texts_.reserve(texts_.size());
  for (size_t i = 1; i < texts_.size(); ++i) out.intern(*texts_[i]);
  return out;
}

NodeId Tree::add(Node n, std::span<const NodeId> children) {
  work(1 + children.size());
  n.firstChild = static_cast<uint32_t>(children_.size());
  n.childCount = static_cast<uint32_t>(children.size());
  uint32_t below = 0;
  for (const NodeId c : children) below = std::max<uint32_t>(below, depths_[c]);
  children_.insert(children_.end(), children.begin(), children.end());
  nodes_.push_back(n);
  depths_.push_back(static_cast<uint16_t>(std::min<uint32_t>(below + 1, 0xffff)));
  return static_cast<NodeId>(nodes_.size() - 1);
}

uint32_t Tree::intern(std::string_view text) {
  if (text.empty()) return 0;
  work();
  const auto found = textIds_.find(text);
  if (found != textIds_.end()) return found->second;
  texts_.push_back(std::make_unique<std::string>(text));
  const auto id = static_cast<uint32_t>(texts_.size() - 1);
  textIds_.emplace(*texts_.back(), id);
  return id;
}

namespace {

bool sameNode(const Tree& a, NodeId x, const Tree& b, NodeId y) {
  const Node& m = a[x];
  const Node& n = b[y];
  const bool sameNumber = m.number == n.number || (std::isnan(m.number) && std::isnan(n.number));
  if (m.kind != n.kind || m.op != n.op || m.flags != n.flags || !sameNumber ||
      m.childCount != n.childCount || a.text(x) != b.text(y)) {
    return false;
  }
  for (size_t i = 0; i < m.childCount; ++i) {
    if (!sameNode(a, a.child(x, i), b, b.child(y, i))) return false;
  }
  return true;
}

}  // namespace

bool sameTree(const Tree& a, const Tree& b) { return sameNode(a, a.root(), b, b.root()); }

const char* nodeKindName(NodeKind kind) {
  static constexpr std::array<const char*, 37> kNames = {
      "none",      "file",        "version",    "import", "style",    "attr",       "const",
      "function",  "rule",        "annotation", "param",  "local",    "list",       "sequence",
      "apply",     "importApply", "push",       "choice", "branch",   "block",      "item",
      "number",    "string",      "bool",       "name",   "call",     "importCall", "unary",
      "binary",    "index",       "array",      "range",  "relative", "floating",   "namedArg",
      "braceList", "missing"};
  return kNames[static_cast<size_t>(kind)];
}

const char* operatorText(UnaryOp op) {
  static constexpr std::array<const char*, 3> kNames = {"+", "-", "!"};
  return kNames[static_cast<size_t>(op)];
}

const char* operatorText(BinaryOp op) {
  static constexpr std::array<const char*, 13> kNames = {"||", "&&", "==", "!=", "<", "<=", ">",
                                                         ">=", "+",  "-",  "*",  "/", "%"};
  return kNames[static_cast<size_t>(op)];
}

}  // namespace gable::lang
