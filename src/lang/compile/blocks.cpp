// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Blocks: the braces after an operation, flattened into items. Each item has a slot of code; sizes
// and index expressions are pushed after the operation's arguments, in order of writing.

#include <algorithm>
#include <utility>

#include "lang/compile/unit_compiler.h"
#include "program/tag_effects.h"

namespace gable::lang {

namespace {

/// The size of a part of a split that has none: ~1.
constexpr Value kMissingSize = {ValueType::Float, gable::Unit::Floating, 0, 1};

}  // namespace

uint32_t UnitCompiler::newBlock(NodeId node, const OpSpec& spec) {
  const auto number = static_cast<uint32_t>(e_.program().blocks.size());
  e_.program().blocks.emplace_back();
  e_.program().blocks[number].kind = spec.block;
  uses_.branches = true;
  blockValues_.clear();
  blockSpec_ = &spec;
  const auto parts = t_.children(node);
  for (size_t i = 1; i < parts.size(); ++i) {
    if (i > 1 && spec.block == BlockKind::Split) {
      remainderItem(parts[i], number);
      continue;
    }
    e_.program().blocks[number].repeat |= t_.has(parts[i], kFlagRepeat);
    blockItems(parts[i], number);
  }
  return number;
}

// { remainder : operations }, behind the parts of a split: a slot without a size.
void UnitCompiler::remainderItem(NodeId node, uint32_t number) {
  for (NodeId part : t_.children(node)) {
    BlockCode& code = e_.program().blocks[number];
    const auto slot = static_cast<uint32_t>(code.slots.size());
    code.slots.push_back(0);
    pending_.push_back({number, slot, t_.child(part, 2)});
  }
}

// The depth of a section is worked out for each section, as a figure is for each piece: it is kept
// as the only value of one.
void UnitCompiler::depthOfItem(NodeId depth, uint32_t number, uint32_t slot) {
  FigureCode code;
  code.values.push_back(valueCode(depth));
  e_.program().figures.push_back(std::move(code));
  std::vector<uint32_t>& figures = e_.program().blocks[number].figures;
  figures.resize(slot + size_t{1});
  figures[slot] = static_cast<uint32_t>(e_.program().figures.size());
}

void UnitCompiler::blockItems(NodeId node, uint32_t number) {
  for (NodeId part : t_.children(node)) {
    BlockItem item;
    if (t_.kind(part) == NodeKind::Block) {
      item.group = true;
      item.repeat = t_.has(part, kFlagRepeat);
      const size_t at = e_.program().blocks[number].items.size();
      e_.program().blocks[number].items.push_back(item);
      blockItems(part, number);
      BlockCode& code = e_.program().blocks[number];
      code.items[at].length = static_cast<uint32_t>(code.items.size() - at - 1);
      continue;
    }
    BlockCode& code = e_.program().blocks[number];
    const NodeId head = t_.child(part, 0), second = t_.child(part, 1);
    item.slot = static_cast<uint32_t>(code.slots.size());
    item.firstTerm = static_cast<uint32_t>(code.terms.size());
    const ItemKind kind = t_.itemKind(part);
    item.selectOperator = kind == ItemKind::Plain ? 0 : static_cast<uint8_t>(kind) - 1;
    if (head != kNoNode) {
      if (code.kind == BlockKind::Selectors || code.kind == BlockKind::Operations)
        selectorTerms(head, number);
      else
        blockValues_.push_back(head);
    } else if (code.kind == BlockKind::Split) {
      blockValues_.push_back(kNoNode);
    }
    item.termCount = static_cast<uint32_t>(code.terms.size()) - item.firstTerm;
    code.items.push_back(item);
    code.slots.push_back(0);
    if (second != kNoNode) depthOfItem(second, number, item.slot);
    if (const auto* preferred = preferredSizeOf(t_.child(part, 2))) {
      BlockCode& now = e_.program().blocks[number];
      now.preferredSizes.resize(now.slots.size());
      now.preferredSizes.back() = *preferred;
    }
    const AttributeSpec* choice = figureOfItem(part, number, item.slot);
    pending_.push_back({number, item.slot, t_.child(part, 2), choice});
  }
}

// Whether a head is one of the words, or has it among others: path || junction.
bool UnitCompiler::names(NodeId head, const char* words) const {
  if (t_.kind(head) == NodeKind::Name) return wordIndex(words, t_.text(head)) >= 0;
  return t_.kind(head) == NodeKind::Binary && t_.binaryOp(head) == BinaryOp::Or &&
         (names(t_.child(head, 0), words) || names(t_.child(head, 1), words));
}

// Notes the figure that an item begins with where the operation makes figures.
const AttributeSpec* UnitCompiler::figureOfItem(NodeId item, uint32_t number, uint32_t slot) {
  if (!blockSpec_ || !blockSpec_->figureWords) return nullptr;
  const NodeId head = t_.child(item, 0), sequence = t_.child(item, 2);
  const char* const words = blockSpec_->figureWords;
  const bool takes = head == kNoNode ? *words == 0 : names(head, words);
  if (!takes || figureHead(sequence) == kNoNode) return nullptr;
  const AttributeSpec* choice = blockSpec_->figureChoice;
  uint32_t ordinals = 0;
  const uint32_t made = figure(figureHead(sequence), ordinals);
  std::vector<uint32_t>& figures = e_.program().blocks[number].figures;
  figures.resize(slot + 1);
  figures[slot] = made + 1;
  return choice;
}

// The branch with the largest weight that is a number; the first of equals, and of unknown ones.
NodeId UnitCompiler::likeliestBranch(NodeId choice) const {
  NodeId best = kNoNode;
  double most = -1, sum = 0;
  for (NodeId branch : t_.children(choice)) {
    const NodeId weight = t_.child(branch, 0);
    Value v;
    double share = 0;
    if (weight == kNoNode) {
      share = 100 - sum;
    } else if (constantOf(weight, v) && v.type == ValueType::Float) {
      share = v.number;
    }
    sum += share;
    if (share > most) {
      most = share;
      best = branch;
    }
  }
  return best;
}

const std::array<double, 3>* UnitCompiler::preferredSizeOf(NodeId sequence) const {
  for (NodeId part : t_.children(sequence)) {
    if (t_.kind(part) == NodeKind::Choice) {
      const NodeId branch = likeliestBranch(part);
      return branch == kNoNode ? nullptr : preferredSizeOf(t_.child(branch, 1));
    }
    if (t_.kind(part) == NodeKind::Push) {
      if (const auto* size = preferredSizeOf(t_.child(part, 0))) return size;
    }
    if (t_.kind(part) != NodeKind::Apply && t_.kind(part) != NodeKind::ImportApply) continue;
    const Resolution& ref = m_.at(part);
    if (ref.kind == RefKind::Leaf) return nullptr;
    if (ref.kind != RefKind::Rule) continue;
    const auto& size = r_.rules[ref.index].annotations.preferredSize;
    return size ? &*size : nullptr;
  }
  return nullptr;
}

// A selector expression in postfix order. What is no word is a value: an index or a truth value.
void UnitCompiler::selectorTerms(NodeId node, uint32_t number) {
  using Kind = SelectTermKind;
  BlockCode& code = e_.program().blocks[number];
  const auto add = [&](Kind kind, StringId word, int32_t value) {
    BlockTerm term;
    term.kind = static_cast<uint8_t>(kind);
    term.word = word;
    term.value = value;
    code.terms.push_back(term);
  };
  ValuePool& pool = *e_.program().pool;
  const NodeKind kind = t_.kind(node);
  if (kind == NodeKind::Name && m_.at(node).kind == RefKind::Selector) {
    add(Kind::Word, pool.intern(t_.text(node)), -1);
    if (namesWorld(t_.text(node))) uses_.effects |= kReadsWorld | kReadsInitialShape;
    if (asksForStreets(t_.text(node))) uses_.effects |= kReadsInitialShape;
    if (asksForTags(t_.text(node))) uses_.effects |= kReadsTags;
  } else if (kind == NodeKind::Call && t_.text(node) == "isTagged") {
    taggedTerm(node, code);
  } else if (kind == NodeKind::Unary && t_.unaryOp(node) == UnaryOp::Not) {
    selectorTerms(t_.child(node, 0), number);
    add(Kind::Not, 0, -1);
  } else if (kind == NodeKind::Binary &&
             (t_.binaryOp(node) == BinaryOp::And || t_.binaryOp(node) == BinaryOp::Or)) {
    selectorTerms(t_.child(node, 0), number);
    selectorTerms(t_.child(node, 1), number);
    add(t_.binaryOp(node) == BinaryOp::And ? Kind::And : Kind::Or, 0, -1);
  } else {
    add(Kind::Index, 0, static_cast<int32_t>(blockValues_.size()));
    blockValues_.push_back(node);
  }
}

// isTagged("query" [, e | v]).
void UnitCompiler::taggedTerm(NodeId node, BlockCode& code) {
  uses_.effects |= kReadsTags;
  const NodeId arguments = t_.child(node, 0);
  BlockTerm term;
  term.kind = static_cast<uint8_t>(SelectTermKind::Tagged);
  const NodeId component = t_.child(arguments, 1);
  if (component != kNoNode) term.number = t_.text(component) == "e" ? 1 : 2;
  Value query;
  const NodeId text = t_.child(arguments, 0);
  if (constantOf(text, query)) {
    term.word = query.id;
  } else {
    term.value = static_cast<int32_t>(blockValues_.size());
    blockValues_.push_back(text);
  }
  code.terms.push_back(term);
}

// Sizes that are all constant stay in the block; otherwise every value goes over the stack.
void UnitCompiler::pushBlockValues(uint32_t number, const BuiltinArguments& given) {
  const std::vector<NodeId> values = std::move(blockValues_);
  blockValues_.clear();
  if (e_.program().blocks[number].kind == BlockKind::Split) {
    std::vector<Value> fixed(values.size());
    bool all = !values.empty();
    for (size_t i = 0; i < values.size(); ++i) {
      if (values[i] == kNoNode)
        fixed[i] = kMissingSize;
      else
        all = all && constantOf(values[i], fixed[i]);
    }
    if (all) {
      e_.program().blocks[number].constantSizes = std::move(fixed);
      return;
    }
  }
  const bool selects = e_.program().blocks[number].kind == BlockKind::Selectors;
  const bool isComp = blockSpec_ == nullptr || blockSpec_ == componentOperation_;
  for (NodeId v : values) {
    if (v == kNoNode) {
      e_.emit(Code::Constant, {}, e_.constant(kMissingSize));
    } else if (!selects || !componentOperation_ || !isPerComponent(v)) {
      expression(v);
    } else if (isComp) {
      pushArguments(given, t_.span(v));
      valuePerComponent(v, given.form, given.list.size(), true);
    } else {
      valuePerEdge(v, true);
    }
  }
  e_.program().blocks[number].valueCount = static_cast<uint32_t>(values.size());
}

// comp(f) { front : expr | ... } as an expression: an array of the values of all components.
void UnitCompiler::componentValues(NodeId node) {
  const OpSpec* operation = componentOperation_;
  if (!operation) return;
  const NodeId arguments = t_.child(node, 0);
  operationEffects(*operation, arguments);
  const auto number = static_cast<uint32_t>(e_.program().blocks.size());
  e_.program().blocks.emplace_back();
  e_.program().blocks[number].kind = BlockKind::Selectors;
  std::vector<NodeId> outer = std::move(blockValues_);
  std::vector<PendingSlot> outerSlots = std::move(pending_);
  const OpSpec* outerSpec = std::exchange(blockSpec_, nullptr);
  blockValues_.clear();
  pending_.clear();
  blockItems(t_.child(node, 1), number);
  const std::vector<PendingSlot> slots = std::move(pending_);
  pending_ = std::move(outerSlots);
  const BuiltinArguments given = builtinArguments(node, operation->signatures, arguments);
  pushArguments(given, t_.span(node));
  pushBlockValues(number, given);
  blockSpec_ = outerSpec;
  blockValues_ = std::move(outer);
  e_.emit(Code::ComponentValues, t_.span(node), e_.operation(operation, given.form),
          given.list.size(), number + size_t{1}, e_.site("comp"));
  // The bodies stand behind, jumped over.
  const uint32_t over = e_.jump(Code::Jump, t_.span(node));
  for (const PendingSlot& s : slots) {
    e_.program().blocks[number].slots[s.slot] = e_.here();
    const size_t depth = e_.depth();
    expression(s.sequence);
    e_.emit(Code::Return, t_.span(s.sequence));
    e_.settle(depth);
  }
  e_.land(over);
}

// Whether a selector's condition may differ from component to component. Numbers are indices, and
// conditions on attributes and parameters are the same for all.
bool UnitCompiler::isPerComponent(NodeId node) const {
  return m_.types[node] == ValueType::Bool && readsShape(node);
}

bool UnitCompiler::readsShape(NodeId node) const {
  if (node == kNoNode) return false;
  const RefKind kind = m_.at(node).kind;
  if (kind == RefKind::ShapeAttribute || kind == RefKind::BuiltinFunction ||
      kind == RefKind::Function) {
    return true;
  }
  const auto parts = t_.children(node);
  return std::any_of(parts.begin(), parts.end(), [&](NodeId n) { return readsShape(n); });
}

// What setbackPerEdge(expr) means: comp(fe) { all : expr }.
void UnitCompiler::valuePerEdge(NodeId node, bool condition) {
  if (!componentOperation_) return expression(node);
  ValuePool& pool = *e_.program().pool;
  e_.emit(Code::Constant, t_.span(node), e_.constant(pool.selector("fe")));
  valuePerComponent(node, nullptr, 1, condition);
}

// comp(..) { all : expr }
void UnitCompiler::valuePerComponent(NodeId node, const Signature* form, size_t arguments,
                                     bool condition) {
  uses_.effects |= effectsOfCall(componentOperation_->effects, false);
  ValuePool& pool = *e_.program().pool;
  const auto number = static_cast<uint32_t>(e_.program().blocks.size());
  BlockCode block;
  block.kind = BlockKind::Selectors;
  block.condition = condition;
  BlockTerm all;
  all.kind = static_cast<uint8_t>(SelectTermKind::Word);
  all.word = pool.intern("all");
  all.value = -1;
  block.terms.push_back(all);
  BlockItem item;
  item.termCount = 1;
  block.items.push_back(item);
  block.slots.push_back(0);
  e_.program().blocks.push_back(std::move(block));
  e_.emit(Code::ComponentValues, t_.span(node), e_.operation(componentOperation_, form), arguments,
          number + size_t{1}, e_.site("comp"));
  const uint32_t over = e_.jump(Code::Jump, t_.span(node));
  e_.program().blocks[number].slots[0] = e_.here();
  expression(node);
  e_.emit(Code::Return, t_.span(node));
  e_.land(over);
}

}  // namespace gable::lang
