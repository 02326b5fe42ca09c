// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The syntax tree that every notation is parsed to. Nodes live in one vector and name each other by
// index, so a tree is moved, walked and destroyed without recursion; kNoNode (0) stands for an
// optional part that is missing. The tree knows nothing of operations: it says what is written,
// lang/sema says what it means, and attaches it by node id.
//
// Promises: children come in source order; every node has a span; a child is older than its parent
// (its id is smaller); no path down is longer than kMaxTreeDepth + 1, so walks may recurse. The
// span of a declaration, parameter, call or named argument starts at its name (see nameSpan);
// keywords and annotations stand before it. The span of an expression in brackets includes them.
//
// The children of each kind ("-" = may be kNoNode; "..." = any number):
//
//   File            declarations and stray annotations...
//   Version         text = "2025.1"
//   Import          text = id          annotations -, path String -, styles List -, overrides List
//   -
//                                      overrides: Name (protect), NamedArg (override), Rule
//                                      (extension override); an empty list protects everything
//   Style           text = id          annotations -, base Name -
//   Attr Const Function  text = name   annotations -, params List -, locals List -, value
//   expression Rule            text = name        annotations -, params List -, locals List -, body
//   Sequence
//                                      flags Start, Extension
//   Annotation      text = name        arguments (expression, NamedArg, BraceList)...
//   Param           text = name
//   Local           text = name        value expression
//   List            items...
//
//   Sequence        successors (Apply, ImportApply, Push, Choice)...
//   Apply           text = name        arguments List -, Block...
//                                      flags Terminal (`X.`), Operand (`inline X`: the block is
//                                      made from the one successor behind the word)
//   ImportApply     text = rule name   import Name, overrides List, arguments List -
//   Push            body Sequence
//   Choice          op = ChoiceKind    Branch...
//   Branch          condition or weight in percent - (missing: else), body Sequence or expression
//   Block           flags Repeat       Item or nested Block...
//   Item            op = ItemKind      head expression -, second head expression -,
//                                      body Sequence or expression
//
//   Number          number
//   String          text = value
//   Bool            number = 0 or 1
//   Name            text = dotted name
//   Call            text = name        arguments List -, Block - (function form of comp: bodies are
//                                      expressions)
//   ImportCall      as ImportApply, in an expression
//   Unary           op = UnaryOp       operand; flag Elementwise
//   Binary          op = BinaryOp      left, right; flag Elementwise
//   Index           base, row index, column index -
//   Array           rows (List)...
//   Range           from, step -, to
//   Relative        operand            'e
//   Floating        operand            ~e
//   NamedArg        text = name        value
//   BraceList       items...           {a, b} in annotations
//   Missing         stands where a mistake was reported; may take any place
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/diagnostic.h"

namespace gable::lang {

using NodeId = uint32_t;
inline constexpr NodeId kNoNode = 0;

/// Longest path down a tree. The parser reports `nesting-too-deep` beyond it; builders of other
/// notations ask Tree::depth.
inline constexpr uint32_t kMaxTreeDepth = 1000;

enum class NodeKind : uint8_t {
  None,
  File,
  Version,
  Import,
  Style,
  Attr,
  Const,
  Function,
  Rule,
  Annotation,
  Param,
  Local,
  List,
  Sequence,
  Apply,
  ImportApply,
  Push,
  Choice,
  Branch,
  Block,
  Item,
  Number,
  String,
  Bool,
  Name,
  Call,
  ImportCall,
  Unary,
  Binary,
  Index,
  Array,
  Range,
  Relative,
  Floating,
  NamedArg,
  BraceList,
  Missing,
};

enum class UnaryOp : uint8_t { Plus, Minus, Not };

enum class BinaryOp : uint8_t {
  Or,
  And,
  Equal,
  NotEqual,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  Add,
  Subtract,
  Multiply,
  Divide,
  Modulo,
};

enum class ChoiceKind : uint8_t { Case, Percent };

/// What stands between the head of an item and its body. Plain items have no head; `:` is Each.
enum class ItemKind : uint8_t { Plain, Each, Combine, Connect };

/// Bits of Node::flags; which kinds they belong to is in the table above.
enum NodeFlag : uint16_t {
  kFlagStart = 1,
  kFlagExtension = 2,
  kFlagTerminal = 4,
  kFlagOperand = 8,
  kFlagRepeat = 16,
  kFlagElementwise = 32,
  /// An annotation whose arguments could not be read.
  kFlagBroken = 64,
};

struct Node {
  NodeKind kind = NodeKind::None;
  uint8_t op = 0;
  uint16_t flags = 0;
  uint32_t text = 0;
  uint32_t begin = 0;
  uint32_t end = 0;
  uint32_t firstChild = 0;
  uint32_t childCount = 0;
  double number = 0;
};

class Tree {
 public:
  explicit Tree(uint32_t file = Span::kNoFile);
  // Moving keeps all texts in place, so views of them stay valid.
  Tree(Tree&&) noexcept = default;
  Tree& operator=(Tree&&) noexcept = default;
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;
  /// The same tree, whose spans are of another file.
  Tree copy(uint32_t file) const;

  uint32_t file() const { return file_; }
  /// The File node; kNoNode before setRoot.
  NodeId root() const { return root_; }
  void setRoot(NodeId id) { root_ = id; }

  /// Ids run from 1 to size() - 1.
  size_t size() const { return nodes_.size(); }
  const Node& operator[](NodeId id) const { return nodes_[id]; }
  NodeKind kind(NodeId id) const { return nodes_[id].kind; }
  UnaryOp unaryOp(NodeId id) const { return static_cast<UnaryOp>(nodes_[id].op); }
  BinaryOp binaryOp(NodeId id) const { return static_cast<BinaryOp>(nodes_[id].op); }
  ChoiceKind choiceKind(NodeId id) const { return static_cast<ChoiceKind>(nodes_[id].op); }
  ItemKind itemKind(NodeId id) const { return static_cast<ItemKind>(nodes_[id].op); }
  bool has(NodeId id, NodeFlag flag) const { return (nodes_[id].flags & flag) != 0; }
  std::string_view text(NodeId id) const { return *texts_[nodes_[id].text]; }
  double number(NodeId id) const { return nodes_[id].number; }
  Span span(NodeId id) const { return {file_, nodes_[id].begin, nodes_[id].end}; }

  /// Empty for kNoNode.
  std::span<const NodeId> children(NodeId id) const {
    const Node& n = nodes_[id];
    return {children_.data() + n.firstChild, n.childCount};
  }
  /// kNoNode where there are fewer children.
  NodeId child(NodeId id, size_t index) const {
    const Node& n = nodes_[id];
    return index < n.childCount ? children_[n.firstChild + index] : kNoNode;
  }
  /// 1 for a leaf.
  uint32_t depth(NodeId id) const { return depths_[id]; }

  /// `n.firstChild` and `n.childCount` are filled in here.
  NodeId add(Node n, std::span<const NodeId> children);
  NodeId add(Node n, std::initializer_list<NodeId> children = {}) {
    return add(n, std::span<const NodeId>(children.begin(), children.size()));
  }
  uint32_t intern(std::string_view text);
  void setSpan(NodeId id, uint32_t begin, uint32_t end) {
    nodes_[id].begin = begin;
    nodes_[id].end = end;
  }
  void addFlags(NodeId id, uint16_t flags) {
    nodes_[id].flags = static_cast<uint16_t>(nodes_[id].flags | flags);
  }

 private:
  uint32_t file_;
  NodeId root_ = kNoNode;
  std::vector<Node> nodes_;
  std::vector<uint16_t> depths_;
  std::vector<NodeId> children_;
  // The keys are views of the strings.
  std::vector<std::unique_ptr<std::string>> texts_;
  std::unordered_map<std::string_view, uint32_t> textIds_;
};

/// A tree that several analyses may hold, one after the other.
using TreeRef = std::shared_ptr<const Tree>;

// Names for the fixed children of the table above.
inline NodeId annotationsOf(const Tree& t, NodeId declaration) { return t.child(declaration, 0); }
inline NodeId paramsOf(const Tree& t, NodeId declaration) { return t.child(declaration, 1); }
inline NodeId localsOf(const Tree& t, NodeId declaration) { return t.child(declaration, 2); }
inline NodeId bodyOf(const Tree& t, NodeId declaration) { return t.child(declaration, 3); }

/// What an argument says, with a name before it or without.
inline NodeId argumentValue(const Tree& t, NodeId argument) {
  return t.kind(argument) == NodeKind::NamedArg ? t.child(argument, 0) : argument;
}

/// The name alone of a node whose span starts at its name.
inline Span nameSpan(const Tree& t, NodeId id) {
  const Span s = t.span(id);
  return {s.file, s.begin, s.begin + static_cast<uint32_t>(t.text(id).size())};
}

/// Equal in kinds, texts, numbers and shape; spans do not count.
bool sameTree(const Tree& a, const Tree& b);

const char* nodeKindName(NodeKind kind);
/// As written, without the dot of element-wise operators.
const char* operatorText(UnaryOp op);
const char* operatorText(BinaryOp op);

}  // namespace gable::lang
