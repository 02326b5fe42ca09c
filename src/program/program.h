// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Program: compiled rules, the waist of the engine. Above it there is syntax, below it shapes.
//
// Code is one array of instructions for a stack machine; a rule, a function and an attribute's
// initialiser are entry points into it. Expressions push Values; operations take their arguments
// from the top of the stack, or straight from the constant pool when all of them are constant.
//
// A Program is immutable and may be derived by any number of threads at once.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "program/spec.h"
#include "program/value.h"

namespace gable {

enum class Code : uint8_t {
  // Expressions. `a` is the operand unless said otherwise.
  Constant,          // push constants[a]
  Parameter,         // push parameter a of the rule or function
  RuleAttribute,     // push attributes[a] as it stands for the shape
  BuiltinAttribute,  // push builtinAttributes[a]
  Function,          // call functions[a] with x arguments
  BuiltinFunction,   // call builtinFunctions[a] with x arguments
  Negate,
  Not,
  Binary,     // x: a BinaryOperator
  MakeArray,  // a rows of y columns from the stack, row by row
  MakeRange,  // start, (step,) end from the stack: [start:step:end]; x: 1 with a step
  Index,      // x index values (1 or 2) and an array
  WithUnit,   // marks the top with Unit x
  ToBool,
  // Flow inside a rule or function.
  Jump,             // to a
  JumpIfFalse,      // pops; to a
  JumpIfFalseKeep,  // && : leaves false on the stack and jumps, else pops
  JumpIfTrueKeep,   // || : leaves true on the stack and jumps, else pops
  Choose,           // pops y probabilities (shares of 1), draws, pushes the chosen index (y = none)
  JumpTable,        // pops an index; to jumpTables[a][index]
  Return,           // from a function or initialiser, with the top as the value
  ComponentValues,  // comp(...) { sel expr } as a function: blocks[a]; the values become an array
  // Shapes.
  Operation,          // operations[a], x arguments; y: block index + 1
  OperationConstant,  // the same with the x arguments at constants[a of the next instruction]
  Operand,            // carries a, and in y the number + 1 of the constant call, 0 for none
  CallRule,           // rules[a] with x arguments
  RunRule,            // rules[a] with x arguments, on the present shape itself
  BeginTurns,         // pops a number of turns; to a when there is none
  EndTurn,            // to a for the next turn, on when there is none
  BeginLocals,        // opens a block of attribute values that end with it
  Bind,               // pops a value for rule attribute a until the block ends
  EndLocals,
  Leaf,          // a shape named constants[a] that has no rule
  SetAttribute,  // pops a value into rule attribute a; x: another follows at once
  Initialise,    // push the value of attribute a, evaluated anew on the present shape
  SetBuiltin,    // pops a value into builtinAttributes[a]
  PushShape,
  PopShape,
  Drop,  // NIL
  End,   // of a rule's successor or a block slot
};

enum class BinaryOperator : uint8_t {
  Add,
  Subtract,
  Multiply,
  Divide,
  Modulo,
  Equal,
  NotEqual,
  Less,
  LessEqual,
  Greater,
  GreaterEqual,
  // Element by element (.+ .== ...); the order repeats the one above.
  EachAdd,
  EachSubtract,
  EachMultiply,
  EachDivide,
  EachModulo,
  EachEqual,
  EachNotEqual,
  EachLess,
  EachLessEqual,
  EachGreater,
  EachGreaterEqual,
  EachAnd,
  EachOr,
  EachNot,
};

struct Instruction {
  Code code = Code::End;
  uint8_t x = 0;
  uint16_t y = 0;
  uint32_t a = 0;
};
static_assert(sizeof(Instruction) == 8);

/// An item of a block as compiled. Sizes and index expressions are values on the stack, one for
/// each item (or term) that needs one, in order of writing; or constants when `constant` is set.
struct BlockItem {
  // Split.
  bool group = false;
  bool repeat = false;
  uint32_t length = 0;
  // Selectors.
  uint8_t selectOperator = 0;
  uint32_t firstTerm = 0, termCount = 0;
  /// Entry of the slot in the code.
  uint32_t slot = 0;
  uint32_t entry = 0;
};

/// Kinds of BlockTerm, in the order of the selector terms that operations see.
enum class SelectTermKind : uint8_t { Word, Index, Boolean, Tagged, Not, And, Or };

struct BlockTerm {
  uint8_t kind = 0;
  StringId word = 0;
  /// The value on the stack that the term takes, counted from the block's first; -1 for none.
  int32_t value = -1;
  double number = 0;
};

/// A number or another value that an operation works out when it needs it: a constant, or code that
/// ends with Return and works on the parameters of the rule around.
struct ValueCode {
  static constexpr uint32_t kConstant = 0xffffffff;
  Value constant;
  uint32_t entry = kConstant;
  bool isConstant() const { return entry == kConstant; }
};

/// A part of an argument. Selections stand in postfix order.
struct ArgumentTerm {
  enum class Kind : uint8_t { Value, Range, Term, Not, And, Or, Minus } kind = Kind::Value;
  /// Of a Value or Range.
  Unit unit = Unit::Absolute;
  /// Term: the selections among its arguments, which stand before it.
  uint32_t operands = 0;
  const TermSpec* spec = nullptr;
  /// Value: one. Range: from and to. Term: its other arguments, defaults filled in.
  std::vector<ValueCode> values;
};

/// An argument that the operation evaluates itself; its Value has the type Code.
struct ArgumentCode {
  /// Written as a list.
  bool list = false;
  std::vector<ArgumentTerm> terms;
};

/// What a block begins with: a figure, or a choice among figures. The children are numbers of
/// Program::figures.
struct FigureCode {
  enum class Kind : uint8_t { None, Figure, Case, Percent } kind = Kind::None;
  const OpSpec* spec = nullptr;
  const Signature* form = nullptr;
  /// Figure: its arguments. Case and Percent: a condition or weight for each child but one that
  /// stands under else.
  std::vector<ValueCode> values;
  std::vector<uint32_t> children;
  /// The figures of a block are counted from 1, and so is what stands where there is none.
  uint32_t ordinal = 0;
};

struct BlockCode {
  BlockKind kind = BlockKind::None;
  bool repeat = false;
  /// Of ComponentValues: its one value is a selector's condition, asked of each component.
  bool condition = false;
  std::vector<BlockItem> items;
  std::vector<BlockTerm> terms;
  /// Entry points by slot.
  std::vector<uint32_t> slots;
  /// How many values of the stack belong to the block (they lie above the arguments).
  uint32_t valueCount = 0;
  /// By slot: the preferred size of what most likely comes of it (@PreferredSize); empty when no
  /// slot has one.
  std::vector<std::array<double, 3>> preferredSizes;
  /// All sizes are constants: they are here, with their units, one a non-group item.
  std::vector<Value> constantSizes;
  /// By slot: the number of its figure in Program::figures, plus 1; 0 for none. May be shorter.
  std::vector<uint32_t> figures;
};

struct ParameterInfo {
  StringId name = 0;
  ValueType type = ValueType::Null;
};

/// What the result of a rule or function depends on, itself and all that it reaches.
struct Dependence {
  uint32_t effects = 0;
  /// Sorted indices of Program::attributes that are read.
  std::vector<uint32_t> attributes;
};

struct RuleCode {
  /// As leaves and nodes are called: the name without modules.
  StringId name = 0;
  /// With modules; what randomness and traces use.
  std::string qualifiedName;
  std::vector<ParameterInfo> parameters;
  uint32_t entry = 0;
  uint32_t file = 0;
  Span span;
  Dependence reads;
  /// The rule's shapes get a local frame of their own, and equal ones are derived once.
  bool shared = false;
  /// Some operation of its own code looks at the shape below on the stack.
  bool needsPrevious = false;
  bool startRule = false;
  bool hidden = false;
  /// False: it has no code, as no rule of the main file comes to it. Who names it from outside
  /// needs a program with all rules; see Rules::Impl::whole.
  bool reached = true;
};

struct FunctionCode {
  StringId name = 0;
  uint32_t parameterCount = 0;
  uint32_t entry = 0;
  uint32_t file = 0;
  Span span;
};

/// A parsed annotation, for inspectors: @Range(min=0, max=10).
struct AnnotationInfo {
  std::string name;
  struct Argument {
    std::string key;
    Value value;
  };
  std::vector<Argument> arguments;
};

struct AttributeCode {
  /// With its module ("imp.height"); the name alone in the main file.
  std::string name;
  ValueType type = ValueType::Null;
  uint32_t entry = 0;
  bool constant = false;
  bool hidden = false;
  /// Attributes of an imported file that take the value of this one, when it is set from outside.
  int32_t propagatesFrom = -1;
  std::vector<AnnotationInfo> annotations;
  Span span;
  uint64_t site = 0;
};

/// A built-in as it is called at some places: with the signature that the analysis chose, or null
/// where only the values decide between signatures. With a signature there is a value for each of
/// its parameters; the defaults are among them.
template <class Spec>
struct Choice {
  const Spec* spec = nullptr;
  const Signature* form = nullptr;
  const Spec& operator*() const { return *spec; }
  const Spec* operator->() const { return spec; }
};

struct Program {
  std::shared_ptr<ValuePool> pool;
  std::vector<Instruction> code;
  /// By instruction: where it stands in the text, and its address for randomness.
  std::vector<Span> spans;
  std::vector<uint64_t> sites;
  std::vector<Value> constants;
  /// Calls of operations with constant arguments that are numbered, so that these are bound once.
  uint32_t constantCalls = 0;
  std::vector<BlockCode> blocks;
  /// By the ids of values of the type Code.
  std::vector<ArgumentCode> arguments;
  std::vector<FigureCode> figures;
  std::vector<std::vector<uint32_t>> jumpTables;
  std::vector<RuleCode> rules;
  std::vector<FunctionCode> functions;
  std::vector<AttributeCode> attributes;
  std::vector<Choice<OpSpec>> operations;
  std::vector<Choice<FunctionSpec>> builtinFunctions;
  std::vector<const AttributeSpec*> builtinAttributes;
  /// Project paths of the rule files, by file id of the spans.
  std::vector<std::string> files;
  /// Of all operations, functions and attributes that its files name, in rules without code as
  /// well.
  uint32_t effects = 0;
  /// The rule to start with unless the user names one; -1 when the file has none.
  int32_t startRule = -1;

  /// Makes the index of names; once, when all rules and attributes are there.
  void indexNames();
  /// The rule of that qualified name that takes no parameters, else the first of rulesAlike; -1 for
  /// none. O(log rules), as is findAttribute.
  int32_t findRule(std::string_view name) const;
  /// The rules without parameters that are called so behind the names of imports, in their order.
  std::vector<uint32_t> rulesAlike(std::string_view name) const;
  int32_t findAttribute(std::string_view name) const;
  /// The rule to whose code an instruction belongs; -1 for none. Rules lie in the code in their
  /// order, each from its entry to the next one's. O(log rules).
  int32_t ruleAt(uint32_t instruction) const;

 private:
  struct NamedRules {
    int32_t qualified = -1;
    std::vector<uint32_t> alike;
  };
  std::map<std::string, NamedRules, std::less<>> rulesByName_;
  std::map<std::string, uint32_t, std::less<>> attributesByName_;
};

/// A readable listing, for goldens and for people.
std::string disassemble(const Program& p);

}  // namespace gable
