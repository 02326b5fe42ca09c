// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// UnitCompiler: the code of one rule, function or attribute's initialiser, and what it depends on.
#pragma once

#include <array>
#include <set>
#include <span>
#include <vector>

#include "lang/compile/emitter.h"
#include "lang/sema/resolved.h"
#include "program/arguments.h"

namespace gable::lang {

/// What a unit uses directly; closed over calls by dependence.cpp.
struct Uses {
  uint32_t effects = 0;
  std::set<uint32_t> attributes, rules, functions;
  /// Attributes whose values are worked out anew, on the shape at hand.
  std::set<uint32_t> initialisers;
  /// It makes shapes in several parts: a block or a rule call.
  bool branches = false;
};

class UnitCompiler {
 public:
  UnitCompiler(const ResolvedProgram& resolved, ModuleId module, Emitter& emitter, Uses& uses,
               const OpSpec* componentOperation)
      : r_(resolved),
        m_(resolved.modules[module]),
        t_(resolved.tree(module)),
        e_(emitter),
        uses_(uses),
        componentOperation_(componentOperation) {}

  /// Pushes the `with` variables of a declaration; they follow the parameters in the frame.
  void locals(NodeId list);
  void expression(NodeId node);
  /// A rule's body: the successor, then the slots of its blocks.
  void body(NodeId sequence, Span end);

 private:
  struct PendingSlot {
    uint32_t block;
    uint32_t slot;
    NodeId sequence;
    /// The operations behind the figure that they begin with; null where there is none.
    const AttributeSpec* figureChoice = nullptr;
  };

  // Successors.
  void sequence(NodeId node);
  void successor(NodeId node);
  void apply(NodeId node);
  void importApply(NodeId node);
  void callRule(NodeId node, uint32_t rule, NodeId arguments);
  void operation(NodeId node, const OpSpec& spec, NodeId arguments);
  bool setStatement(NodeId node, NodeId arguments);
  /// do, repeat and local; false for any other operation.
  bool inPlace(NodeId node, const OpSpec& spec, NodeId arguments);
  void blockInPlace(NodeId node);
  void choice(NodeId node, bool inExpression);
  void caseChoice(NodeId node, bool inExpression);
  void percentChoice(NodeId node, bool inExpression);
  void branchBody(NodeId branch, bool inExpression);
  void enterDynamicImport(NodeId node);

  /// The arguments of a call of a built-in: one for each parameter where the signature is known.
  struct BuiltinArguments {
    const Signature* form = nullptr;
    /// An expression, or kNoNode and a default.
    struct Argument {
      NodeId node = kNoNode;
      Value fixed;
    };
    std::vector<Argument> list;
  };

  // Blocks.
  uint32_t newBlock(NodeId node, const OpSpec& spec);
  void blockItems(NodeId node, uint32_t block);
  void remainderItem(NodeId node, uint32_t block);
  void depthOfItem(NodeId depth, uint32_t block, uint32_t slot);
  void selectorTerms(NodeId node, uint32_t block);
  void taggedTerm(NodeId node, BlockCode& code);
  void pushBlockValues(uint32_t block, const BuiltinArguments& given);
  /// The preferred size of the shape that most likely comes of a sequence; null when there is none.
  const std::array<double, 3>* preferredSizeOf(NodeId sequence) const;
  NodeId likeliestBranch(NodeId choice) const;

  // Expressions.
  void value(NodeId node);
  void name(NodeId node);
  void call(NodeId node, NodeId arguments);
  void unary(NodeId node);
  void binary(NodeId node);
  void array(NodeId node);
  void index(NodeId node);
  void range(NodeId node);
  void componentValues(NodeId node);
  void valuePerEdge(NodeId node, bool condition = false);
  /// An array with the value on each component that comp, with its arguments on the stack, makes.
  void valuePerComponent(NodeId node, const Signature* form, size_t arguments, bool condition);
  bool isPerComponent(NodeId node) const;
  bool readsShape(NodeId node) const;
  /// The value of an expression that needs no evaluation, with its unit.
  bool constantOf(NodeId node, Value& out) const;
  BuiltinArguments builtinArguments(NodeId call, std::span<const Signature> signatures,
                                    NodeId list);
  /// All values of the arguments, where none needs evaluation.
  bool constantsOf(const BuiltinArguments& arguments, std::vector<Value>& out) const;
  void push(const BuiltinArguments::Argument& argument, Span span);
  void pushArguments(const BuiltinArguments& arguments, Span span);

  // Arguments that the operation works out itself (arguments.cpp).
  bool isCode(const ParamSpec& param) const;
  Value codeOf(NodeId node, const ParamSpec& param);
  ValueCode valueCode(NodeId node);
  void drawn(NodeId node, std::vector<ArgumentTerm>& out);
  void selection(NodeId node, const ParamSpec& param, std::vector<ArgumentTerm>& out);
  void term(NodeId node, const TermSpec& spec, const ParamSpec& param,
            std::vector<ArgumentTerm>& out);
  bool namesWorldIn(NodeId node) const;

  // Figures that a block begins with (figures.cpp).
  /// What a sequence begins with, if it is a figure or a choice among figures; kNoNode else.
  NodeId figureHead(NodeId sequence) const;
  bool isFigure(NodeId successor) const;
  bool hasFigure(NodeId successor) const;
  uint32_t figure(NodeId successor, uint32_t& ordinals);
  uint32_t figureOfBranch(NodeId sequence, uint32_t& ordinals);
  const AttributeSpec* figureOfItem(NodeId item, uint32_t block, uint32_t slot);
  bool names(NodeId head, const char* words) const;
  uint32_t figuresIn(NodeId sequence) const;
  void behindFigure(NodeId sequence, const AttributeSpec& choice, uint32_t& ordinals);
  void figureChoice(NodeId choiceNode, const AttributeSpec& choice, uint32_t& ordinals);
  uint32_t effectsOf(uint32_t effects, std::span<const Signature> signatures,
                     NodeId arguments) const;
  void operationEffects(const OpSpec& spec, NodeId arguments);
  void functionEffects(const FunctionSpec& spec, NodeId arguments);
  size_t pushArguments(NodeId arguments);

  const ResolvedProgram& r_;
  const Module& m_;
  const Tree& t_;
  Emitter& e_;
  Uses& uses_;
  std::vector<PendingSlot> pending_;
  /// The sizes and indices of the block at hand.
  std::vector<NodeId> blockValues_;
  /// Of that block.
  const OpSpec* blockSpec_ = nullptr;
  /// What the function form of comp runs.
  const OpSpec* componentOperation_;
};

}  // namespace gable::lang
