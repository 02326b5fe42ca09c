// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the analysis hands to the compiler: trees whose every name is resolved.
//
// A unit is a parsed file. A module is one use of a unit: the main file, or an import of it under a
// name, with its style and its overrides. One file imported twice is one unit and two modules,
// since its attributes may differ. Rules, functions and attributes belong to modules and are
// numbered through the whole program. What a node of a tree means is found by (module, node).
//
// How to walk it: compile each rule of `rules` and each function of `functions` by walking its body
// in the tree of its module's unit, asking `module.at(node)` for each Name, Call, Apply,
// ImportApply and ImportCall node. Attributes are evaluated in `initOrder` before the start rule.
//
// Promises, when no error was reported:
//  0. Rules and functions that are not `reached` may have no resolutions: no rule of the main
//     file comes to them.
//  1. Every Name, Call, Apply, ImportApply and ImportCall in a body has a resolution other than
//  None;
//     names that are no expression (parameters, protected names, annotations) have none.
//  2. Rule, Function, Attribute and Slot resolutions index valid entries, and the number of
//     arguments fits.
//  3. A Builtin resolution has a spec, and the signature chosen by count and type, unless the
//     operation takes any arguments.
//  4. initOrder holds every attribute and constant of static modules once, after those it reads,
//     but for circles.
// With errors reported the program must not be compiled.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/diagnostic.h"
#include "lang/sema/annotations.h"
#include "lang/tree.h"
#include "program/spec.h"
#include "program/value.h"

namespace gable::lang {

using ModuleId = uint32_t;
using RuleId = uint32_t;
using FunctionId = uint32_t;
using AttributeId = uint32_t;
inline constexpr uint32_t kNone = 0xffffffff;

enum class RefKind : uint8_t {
  None,
  /// index: RuleId.
  Rule,
  /// A shape without a rule: `X.`, or an undefined name. The node's text is its name.
  Leaf,
  /// spec.operation, signature.
  Operation,
  /// index: FunctionId.
  Function,
  /// spec.function, signature. For `comp(..) {..}` too, which is an operation: spec is null there.
  BuiltinFunction,
  /// index: AttributeId, of an attr or const. As the first argument of `set`: what is set.
  Attribute,
  /// spec.attribute; as the first argument of `set`: what is set.
  ShapeAttribute,
  /// A parameter or local variable: index is its place in the frame, parameters first.
  Slot,
  /// A word: x, world.up, front. The node's text is the word.
  Selector,
};

struct Resolution {
  RefKind kind = RefKind::None;
  /// Index of the signature in the spec; 0xffff when there is none to choose.
  uint16_t signature = 0xffff;
  /// Several signatures are left, and the types that are known do not tell them apart: the values
  /// decide when the rules run.
  bool open = false;
  uint32_t index = kNone;
  union {
    const OpSpec* operation;
    const FunctionSpec* function;
    const AttributeSpec* attribute;
    /// Of a Selector in a selection.
    const TermSpec* term;
  } spec = {nullptr};
};

/// A parsed file.
struct Unit {
  std::string path;
  uint32_t file = Span::kNoFile;
  TreeRef tree;
};

/// One use of a unit.
struct Module {
  ModuleId id = 0;
  uint32_t unit = 0;
  /// Prefix of its names as the main file writes it: "" or "imp" or "imp.sub". Modules of dynamic
  /// imports have the prefix of their static import.
  std::string path;
  /// The style whose declarations count; "Default" without one.
  std::string style;
  /// kNone for the main file.
  ModuleId importer = kNone;
  /// The Import node, or for a dynamic import the ImportApply or ImportCall node, in the importer.
  NodeId importNode = kNoNode;
  bool dynamic = false;
  /// The first module of its file and style, with the same in its imports, whose types and
  /// constants are those of this one; itself where rules are put in the place of its own, or of an
  /// import's.
  ModuleId original = 0;
  /// Its declarations, numbered in a row; an original and its copies have as many.
  RuleId firstRule = 0;
  FunctionId firstFunction = 0;
  AttributeId firstAttribute = 0;
  uint32_t ruleCount = 0, functionCount = 0, attributeCount = 0;
  /// By node id; nodes without meaning have RefKind::None.
  std::vector<Resolution> resolutions;
  /// By node id: the type of an expression; Null when it is known only at run time.
  std::vector<ValueType> types;
  /// By node id: the value of a constant expression (number, bool or string); Null if it is none.
  /// Copies have those of the original.
  std::shared_ptr<std::vector<Value>> constants;
  /// Of calls with named arguments and of the terms of selections, by node id: for each parameter
  /// of the signature its argument; kNoNode where the default counts.
  std::unordered_map<NodeId, std::vector<NodeId>> namedArguments;

  const Resolution& at(NodeId node) const { return resolutions[node]; }
  const Value& constantAt(NodeId node) const { return (*constants)[node]; }
};

struct RuleInfo {
  RuleId id = 0;
  /// The module whose tree holds the body and whose names it sees. For an override written in an
  /// import or a redefinition `imp.R -->` this is the importer.
  ModuleId module = 0;
  /// The Rule node.
  NodeId node = kNoNode;
  /// As called within its module: "Lot"; a redefinition has the name with its prefix: "imp.Lot".
  std::string name;
  /// With the module's path: "imp.Lot". Names shapes and addresses random draws; overloads share
  /// it.
  std::string qualifiedName;
  uint32_t paramCount = 0;
  /// Types of the parameters as far as their use tells; Null otherwise.
  std::vector<ValueType> paramTypes;
  /// Parameters and local variables: the size of the frame.
  uint32_t slotCount = 0;
  bool start = false;
  bool extension = false;
  /// Whether a rule of the main file comes to it.
  bool reached = false;
  Annotations annotations;
};

struct FunctionInfo {
  FunctionId id = 0;
  ModuleId module = 0;
  /// The Function node.
  NodeId node = kNoNode;
  std::string name;
  std::string qualifiedName;
  uint32_t paramCount = 0;
  std::vector<ValueType> paramTypes;
  uint32_t slotCount = 0;
  ValueType result = ValueType::Null;
  /// As for a rule.
  bool reached = false;
};

/// Where the value of an attribute comes from when no shape brings its own.
enum class ValueSource : uint8_t {
  /// Its own expression, in its module.
  Own,
  /// An expression in the import statement: valueNode in valueModule.
  Override,
  /// The attribute `from` of the importer, which has the same name.
  Propagated,
  /// A dynamic import hands it over.
  Given,
};

/// attr and const; both are evaluated once per initial shape.
struct AttributeInfo {
  AttributeId id = 0;
  ModuleId module = 0;
  /// The Attr or Const node.
  NodeId node = kNoNode;
  std::string name;
  /// "imp.height": what object attributes and --set bind to.
  std::string qualifiedName;
  ValueType type = ValueType::Null;
  bool constant = false;
  /// Local variables of `with` need a frame of this size.
  uint32_t slotCount = 0;
  /// attr streetWidth(edge): a map along the edges of the initial shape.
  bool edgeMap = false;
  ValueSource source = ValueSource::Own;
  ModuleId valueModule = 0;
  NodeId valueNode = kNoNode;
  AttributeId from = kNone;
  Annotations annotations;
};

/// A call `imp(a = e).Rule`: evaluate the overrides in the caller's frame, give them to the
/// attributes, evaluate the rest of initOrder, then apply the rule, found at the ImportApply or
/// ImportCall node.
struct DynamicImport {
  /// Where the call stands.
  ModuleId module = 0;
  NodeId node = kNoNode;
  /// The module made for it.
  ModuleId target = 0;
  struct Given {
    AttributeId attribute;
    NodeId value;
  };
  std::vector<Given> given;
  /// Attributes and constants of the target and of its imports, without the given ones.
  std::vector<AttributeId> initOrder;
};

struct StyleInfo {
  std::string name;
  std::string base;
  std::string description;
};

/// Owns all trees. Movable; specs point into the catalogue, which must outlive it.
struct ResolvedProgram {
  std::vector<Unit> units;
  std::vector<Module> modules;
  std::vector<RuleInfo> rules;
  std::vector<FunctionInfo> functions;
  std::vector<AttributeInfo> attributes;
  std::vector<AttributeId> initOrder;
  std::vector<DynamicImport> dynamicImports;
  /// Styles of the main file, "Default" first.
  std::vector<StyleInfo> styles;
  /// The rule to start with when none is asked for; kNone if the main file has no fit one.
  RuleId startRule = kNone;
  std::string description;

  const Tree& tree(ModuleId module) const { return *units[modules[module].unit].tree; }
  /// The dynamic import at a node; null if there is none.
  const DynamicImport* dynamicImport(ModuleId module, NodeId node) const;
  /// The rule of the main file, or of an import by its qualified name, with that many parameters;
  /// kNone if there is none. "start" alone is not looked up here.
  RuleId findRule(std::string_view name, uint32_t paramCount = 0) const;
  /// By qualified name; kNone if there is none.
  AttributeId findAttribute(std::string_view name) const;
};

}  // namespace gable::lang
