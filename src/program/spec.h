// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Specs: the one declaration of each operation, function, attribute and selector of the language.
// The same spec feeds the analysis (names, arity, types, "did you mean"), the virtual machine (what
// to call), the reference pages, `gable ops --json` and completion in editors.
//
// Specs are constants in the .cpp file of what they describe; a Catalogue is the list of all.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "base/status.h"
#include "program/value.h"

namespace gable {

struct AttributeSpec;
struct LightPart;  // shape/part.h
class OpCall;
struct Gathered;     // shape/op_call.h
class FunctionCall;  // shape/op_call.h

/// The type of a parameter. A size takes the prefixes ' and ~ besides a plain number.
enum class ParamType : uint8_t {
  Float,
  Bool,
  String,
  Selector,
  FloatArray,
  BoolArray,
  StringArray,
  /// Float with ' allowed.
  Size,
  /// Float with ' and ~ allowed.
  FloatingSize,
  /// Any single value or array.
  Any,
  /// A number that the operation works out anew for each piece: an expression with an address of
  /// its own (OpCall::draw). rand(a, b) is drawn evenly from the address itself.
  Drawn,
  /// One of them or a list of them; those in a list may be shares of the rest: [2, ~1].
  DrawnList,
  /// What the terms of the parameter say: words and calls, with && || ! - and brackets between
  /// them. A number or a list that no term stands for is taken as it is.
  Selection,
};

/// The numbers that a parameter takes.
struct NumberRange {
  static constexpr double kInfinite = std::numeric_limits<double>::infinity();
  double least = -kInfinite, most = kInfinite;
  /// `least` or `most` itself is not taken.
  bool above = false, below = false;

  bool any() const { return least == -kInfinite && most == kInfinite; }
  /// What is no number is in no range but that of all.
  bool holds(double v) const {
    return any() || ((above ? v > least : v >= least) && (below ? v < most : v <= most));
  }
};

/// What the texts of a parameter must be.
struct TextForm {
  /// Behind "is not": "a colour".
  const char* name;
  bool (*holds)(std::string_view text);
  const char* hint;
};

struct ParamSpec;

/// A word or a call in a selection: outer, side(west), edge(2, 0.5, 1).
struct TermSpec {
  const char* name;
  const char* doc;
  const ParamSpec* params = nullptr;
  size_t paramCount = 0;

  template <size_t N>
  static constexpr TermSpec call(const char* name, const char* doc, const ParamSpec (&params)[N]) {
    return {name, doc, params, N};
  }
};

struct ParamSpec {
  const char* name;
  ParamType type;
  const char* doc;
  /// The default as it is written in CGA; null when the argument is required.
  const char* defaultText = nullptr;
  /// For selectors and texts: the words allowed, separated by blanks ("x y z"); null when open.
  const char* words = nullptr;
  /// Puts an argument into its field of the callee's struct of arguments; false when the value is
  /// of another type. Made by param() of program/arguments.h.
  bool (*store)(void* arguments, const Value& v, const ValuePool& pool) = nullptr;
  /// Without the argument the field is empty, and defaultText is words for people.
  bool mayBeMissing = false;
  /// Of a Selection: what it is made of.
  std::span<const TermSpec> terms = {};
  /// Of a Selection: one term stands alone, there is nothing to combine.
  bool single = false;
  /// What it takes of all numbers, and of all texts (null for any). Of a list, each in it. What is
  /// written out is checked with the rule file, all else when it comes to the call.
  NumberRange range = {};
  const TextForm* form = nullptr;
  /// It may be left out only where a selection of the call has the term of that name.
  const char* unlessTerm = nullptr;

  constexpr ParamSpec atLeast(double v) const {
    ParamSpec p = *this;
    p.range.least = v;
    return p;
  }
  constexpr ParamSpec above(double v) const {
    ParamSpec p = atLeast(v);
    p.range.above = true;
    return p;
  }
  constexpr ParamSpec atMost(double v) const {
    ParamSpec p = *this;
    p.range.most = v;
    return p;
  }
  constexpr ParamSpec below(double v) const {
    ParamSpec p = atMost(v);
    p.range.below = true;
    return p;
  }
  constexpr ParamSpec between(double least, double most) const {
    return atLeast(least).atMost(most);
  }
  constexpr ParamSpec unless(const char* term) const {
    ParamSpec p = *this;
    p.unlessTerm = term;
    return p;
  }
  constexpr ParamSpec of(const TextForm& f) const {
    ParamSpec p = *this;
    p.form = &f;
    return p;
  }
};

/// "above 0", "zero or more", "1 to 16"; empty where the range is that of all numbers.
std::string rangeText(const NumberRange& range);
/// What the parameter is: its doc, with its range.
std::string docText(const ParamSpec& param);

/// One way to call: its parameters in order. Those with defaults may be left out; the compiler
/// fills them in.
struct Signature {
  std::span<const ParamSpec> params;
  /// What a function returns; Null for operations, and for functions whose result follows the
  /// argument (min, max).
  ValueType result = ValueType::Null;
  /// The last parameter may repeat any number of times.
  bool variadic = false;

  /// How many arguments it takes at least.
  size_t requiredCount() const;
  bool acceptsCount(size_t count) const {
    return count >= requiredCount() && (variadic || count <= params.size());
  }
  /// The parameter that the argument `index` is for; null when there are too many.
  const ParamSpec* paramAt(size_t index) const;
};

/// The type of the values that a parameter takes; Null for any.
constexpr ValueType valueType(ParamType p) {
  switch (p) {
    case ParamType::Float:
    case ParamType::Size:
    case ParamType::FloatingSize: return ValueType::Float;
    case ParamType::Bool: return ValueType::Bool;
    case ParamType::String: return ValueType::String;
    case ParamType::Selector: return ValueType::Selector;
    case ParamType::FloatArray: return ValueType::FloatArray;
    case ParamType::BoolArray: return ValueType::BoolArray;
    case ParamType::StringArray: return ValueType::StringArray;
    case ParamType::Drawn: return ValueType::Float;
    case ParamType::Any:
    case ParamType::DrawnList:
    case ParamType::Selection: break;
  }
  return ValueType::Null;
}
/// The type as the reference and editors show it: "float", "size", "selector".
const char* typeText(ParamType type);
/// Whether a value of type `got` may stand for the parameter. A text may stand for a word.
bool fits(ValueType got, ParamType wanted);

/// What stands in the braces after an operation.
enum class BlockKind : uint8_t {
  None,
  /// { size : ops | ... } with groups and *: split, splitArea.
  Split,
  /// { selector op ops | ... }: comp, setback, shapeL, innerRectangle, modify.
  Selectors,
  /// { ops }: scatter, inline.
  Operations,
  /// { A | B }: union, subtract, intersect.
  Operands,
};

/// What a result depends on besides the shape itself and the arguments, and what it does besides
/// changing the shape. Sharing and scheduling are decided from these.
enum Effect : uint32_t {
  kPure = 0,
  kReadsWorld = 1u << 0,
  /// Narrows kReadsWorld: it holds only for calls with a selector that namesWorld(), or with one
  /// that is not known before the call (rotate(rel, scope, ..) needs no world).
  kReadsWorldByWord = 1u << 16,
  kRandom = 1u << 1,
  /// Other shapes: inside, touches, minimumDistance.
  kReadsContext = 1u << 2,
  kReadsPivot = 1u << 3,
  /// Only the directions of the pivot's axes, not its place: comp, r.
  kReadsPivotAxes = 1u << 12,
  kUsesTrim = 1u << 4,
  /// Where the shape stands in the tree: getTreeKey.
  kReadsPath = 1u << 5,
  /// Registers the shape under a name, for others that ask: label.
  kLabels = 1u << 21,
  kReports = 1u << 6,
  kReadsSplit = 1u << 7,
  kReadsComp = 1u << 8,
  kReadsInitialShape = 1u << 9,
  kReadsUvProjection = 1u << 10,
  /// Where a region and its edges come from (shape/provenance.h). It lies in the geometry, which
  /// sharing compares anyhow.
  kReadsRegion = 1u << 15,
  /// The scope of the shape below on the shape stack: center.
  kReadsPrevious = 1u << 11,
  /// The operation understands a deformed shape; for all others the deformation goes into the
  /// geometry first.
  kTakesDeformed = 1u << 13,
  /// Questions about other shapes are answered with the shape as it was before the operation, and
  /// not with its leaves alone: comp, offset.
  kLeavesOccluder = 1u << 14,
  /// Asks whether there is room for the shape among others, which a first pass has found: ifFree.
  kAsksForRoom = 1u << 20,
  /// modify and inline(recompose) do not glue what comes of the operation to the shapes around it.
  kForgetsOrigins = 1u << 19,
};

/// Whether a selector asks for an edge of a roof, which has an up and a down.
inline bool namesRoofEdge(std::string_view word) {
  return word == "eave" || word == "hip" || word == "valley" || word == "ridge";
}

/// Whether a selector asks for a direction or place outside the shape: world.up, object,
/// street.side; and what looks at the world without saying so: auto of alignScopeToGeometry,
/// conform of setNormals, the edges of roofs.
inline bool namesWorld(std::string_view word) {
  return word.starts_with("world") || word.starts_with("object") || word.starts_with("street") ||
         word == "auto" || word == "conform" || word == "noStreetSide" || namesRoofEdge(word);
}

/// The effects of a call, once it is known whether one of its selectors namesWorld().
constexpr uint32_t effectsOfCall(uint32_t effects, bool worldNamed) {
  const bool narrowed = (effects & kReadsWorldByWord) != 0 && !worldNamed;
  return effects & ~(kReadsWorldByWord | (narrowed ? kReadsWorld : 0u));
}

/// An operation on light parts. Its arguments are bound once for all parts.
struct LightOp {
  /// Room for the struct of arguments.
  static constexpr size_t kRoom = 64;
  /// Makes the struct with its initialisers.
  void (*construct)(void* arguments) = nullptr;
  /// False when this call must be done the long way, and then the part is as it was.
  bool (*apply)(LightPart&, const void* arguments) = nullptr;
};

/// The same for a call with these values: whether a word or a text among them names the world.
uint32_t effectsOfValues(uint32_t effects, std::span<const Value> values, const ValuePool& pool);

/// A named part of an operation's block: { strip : .. | rest : .. }.
struct PartSpec {
  const char* name;
  /// A line on what it is.
  const char* doc;
};

inline constexpr std::span<const PartSpec> kNoParts;

struct OpSpec {
  const char* name;
  const char* family;
  /// One sentence.
  const char* summary;
  std::span<const Signature> signatures;
  Status (*apply)(OpCall&);
  BlockKind block = BlockKind::None;
  uint32_t effects = kPure;
  /// The parts that the block may name.
  std::span<const PartSpec> parts = {};
  /// The block may be left out (union Rule, inline).
  bool blockOptional = false;
  /// A name beyond the CGA reference: the author's own rule or attribute of that name wins.
  bool soft = false;
  /// The same on a light part, for operations that can do with one.
  LightOp light = {};
  /// What a vertex of the shape costs, in steps of the limit on work; see heavy().
  uint16_t stepsPerVertex = 1;
  /// For operations that wait for what comes of their children (OpCall::gather): the leaves, of
  /// which it takes those that it marks out of the result. Null for others.
  Status (*gathered)(OpCall&, std::span<Gathered>) = nullptr;
  /// A figure: what a block begins with may be one, and then it is the operation's to make.
  bool figure = false;
  /// Words of the block whose operations may begin with a figure; "" for the plain operations of a
  /// block, null for none. Where there are several figures to choose from, the attribute says on
  /// what comes out which one it is, from 1.
  const char* figureWords = nullptr;
  const AttributeSpec* figureChoice = nullptr;
  /// Beside its parts the block takes the general selectors: front, world.up. Operations without
  /// parts of their own always do.
  bool selectsFaces = false;

  const PartSpec* part(std::string_view word) const;
  /// Whether the parts are all that the block takes.
  bool isOnlyParts() const {
    return block == BlockKind::Selectors && !parts.empty() && !selectsFaces;
  }
};

constexpr OpSpec asFigure(OpSpec spec) {
  spec.figure = true;
  return spec;
}

constexpr OpSpec withFigures(OpSpec spec, const char* words, const AttributeSpec& choice) {
  spec.figureWords = words;
  spec.figureChoice = &choice;
  return spec;
}

constexpr OpSpec withFaces(OpSpec spec) {
  spec.selectsFaces = true;
  return spec;
}

constexpr OpSpec withLight(OpSpec spec, LightOp light) {
  spec.light = light;
  return spec;
}

/// For operations that do more than run over a mesh: skeletons, offsets, booleans. They take tens
/// of microseconds for a vertex where others take a tenth of one.
constexpr OpSpec heavy(OpSpec spec) {
  spec.stepsPerVertex = 100;
  return spec;
}

struct FunctionSpec {
  const char* name;
  const char* family;
  const char* summary;
  std::span<const Signature> signatures;
  Value (*call)(FunctionCall&);
  uint32_t effects = kPure;
  /// May be written without brackets: geometry.nVertices.
  bool bare = false;
  bool soft = false;
};

/// A named property of the current shape: scope.sx, split.index, material.colormap.
struct AttributeSpec {
  const char* name;
  ValueType type;
  const char* doc;
  Value (*get)(FunctionCall&);
  /// Null when it can only be read.
  Status (*set)(OpCall&, const Value&) = nullptr;
  uint32_t effects = kPure;
};

/// A word that comp, setback or an argument takes: front, world.south, eave.
struct SelectorSpec {
  const char* name;
  const char* doc;
  /// What a selection by the word depends on besides the shape, on top of the operation's own
  /// effects.
  uint32_t effects = kPure;
};

/// All that the language offers. Lists are sorted by name; look-ups are O(log n).
struct Catalogue {
  std::span<const OpSpec* const> operations;
  std::span<const FunctionSpec* const> functions;
  std::span<const AttributeSpec* const> attributes;
  std::span<const SelectorSpec> selectors;

  const OpSpec* operation(std::string_view name) const;
  const FunctionSpec* function(std::string_view name) const;
  const AttributeSpec* attribute(std::string_view name) const;
  bool isSelector(std::string_view name) const;
};

}  // namespace gable
