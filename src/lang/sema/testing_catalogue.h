// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A small catalogue for the tests of the analysis: this layer does not know the built-ins.
// Operations and functions here only have signatures.
#pragma once

#include "program/spec.h"

namespace gable::lang {

namespace test_specs {
using P = ParamType;
inline constexpr ParamSpec kThree[] = {{"x", P::Size, ""}, {"y", P::Size, ""}, {"z", P::Size, ""}};
inline constexpr Signature kSizes[] = {{kThree}};
inline constexpr ParamSpec kHeight[] = {{"distance", P::Float, "How far."}};
inline constexpr ParamSpec kDirected[] = {
    {"direction", P::Selector, "Where to.", nullptr, "world.up world.y x y z"},
    {"distance", P::Float, "How far."}};
inline constexpr Signature kExtrude[] = {{kHeight}, {kDirected}};
inline constexpr ParamSpec kAxis[] = {{"axis", P::Selector, "", nullptr, "x y z"},
                                      {"mode", P::Selector, "", "adjust", "adjust noAdjust"}};
inline constexpr ParamSpec kUv[] = {{"direction", P::Selector, "", nullptr, "u v"},
                                    {"space", P::Selector, "", nullptr, "uvSpace unitSpace"},
                                    {"uvSet", P::Float, ""}};
inline constexpr Signature kSplit[] = {{kAxis}, {kUv}};
inline constexpr ParamSpec kComponent[] = {{"component", P::Selector, "", nullptr, "f e fe v"},
                                           {"alignment", P::Selector, "", "zUp", "zUp noAlign"}};
inline constexpr Signature kComp[] = {{kComponent}};
inline constexpr ParamSpec kAny[] = {{"value", P::Any, ""}};
inline constexpr Signature kPrint[] = {{kAny}};
inline constexpr Signature kNothing[] = {{}};
inline constexpr ParamSpec kPath[] = {{"path", P::String, "", nullptr}};
inline constexpr Signature kInsert[] = {{kPath}};
inline constexpr ParamSpec kColor3[] = {
    {"r", P::Float, ""}, {"g", P::Float, ""}, {"b", P::Float, ""}};
inline constexpr ParamSpec kHex[] = {{"hex", P::String, ""}};
inline constexpr Signature kColor[] = {{kHex}, {kColor3}};
inline constexpr ParamSpec kSet[] = {{"attribute", P::Selector, ""}, {"value", P::Any, ""}};
inline constexpr Signature kSetSignature[] = {{kSet}};
inline constexpr ParamSpec kPoints[] = {{"domain", P::Selector, "", nullptr, "surface scope"},
                                        {"n", P::Float, ""}};
inline constexpr Signature kScatter[] = {{kPoints}};
inline constexpr ParamSpec kDistance[] = {{"distance", P::Float, ""}};
inline constexpr ParamSpec kDistances[] = {{"distances", P::FloatArray, ""}};
inline constexpr Signature kSetback[] = {{kDistance}, {kDistances}};
inline constexpr ParamSpec kMode[] = {{"strategy", P::Selector, "", "append", "append unify"}};
inline constexpr Signature kInline[] = {{kMode}};
inline constexpr ParamSpec kCount[] = {{"n", P::Float, ""}};
inline constexpr Signature kRepeat[] = {{kCount}};
inline constexpr ParamSpec kGridParams[] = {{"columns", P::Float, ""}, {"rows", P::Float, "", "1"}};
inline constexpr Signature kGrid[] = {{kGridParams}};

inline constexpr BlockKind kSel = BlockKind::Selectors;
inline constexpr PartSpec kGridParts[] = {{"region", "A cell."}, {"path", "A path."}};
inline constexpr PartSpec kRemainder[] = {{"remainder", "What is left."}};
inline constexpr OpSpec kOps[] = {
    {"NIL", "", "", kNothing, nullptr},
    {"color", "", "", kColor, nullptr},
    {"comp", "", "", kComp, nullptr, kSel},
    {"do", "", "", kPrint, nullptr, BlockKind::None, kPure, kNoParts, false, true},
    {"extrude", "", "", kExtrude, nullptr},
    {"grid", "", "", kGrid, nullptr, kSel, kPure, kGridParts, false, true},
    {"i", "", "", kInsert, nullptr},
    {"inline", "", "", kInline, nullptr, BlockKind::Operations},
    {"local", "", "", kPrint, nullptr, BlockKind::Operations, kPure, kNoParts, false, true},
    {"print", "", "", kPrint, nullptr},
    {"repeat", "", "", kRepeat, nullptr, BlockKind::Operations, kPure, kNoParts, false, true},
    {"s", "", "", kSizes, nullptr},
    {"scatter", "", "", kScatter, nullptr, BlockKind::Operations},
    {"set", "", "", kSetSignature, nullptr},
    withFaces({"setback", "", "", kSetback, nullptr, kSel, kPure, kRemainder}),
    {"split", "", "", kSplit, nullptr, BlockKind::Split},
    {"t", "", "", kSizes, nullptr},
    {"union", "", "", kNothing, nullptr, BlockKind::Operands},
};

inline constexpr ParamSpec kRange1[] = {{"max", P::Float, ""}};
inline constexpr ParamSpec kRange2[] = {{"min", P::Float, ""}, {"max", P::Float, ""}};
inline constexpr Signature kRand[] = {
    {{}, ValueType::Float}, {kRange1, ValueType::Float}, {kRange2, ValueType::Float}};
inline constexpr Signature kStr[] = {{kAny, ValueType::String}};
inline constexpr Signature kFloat[] = {{kHex, ValueType::Float}};
inline constexpr ParamSpec kSide[] = {{"side", P::Selector, "", nullptr, "front side top"}};
inline constexpr Signature kOriented[] = {{kSide, ValueType::Bool}};
inline constexpr ParamSpec kTag[] = {{"query", P::String, ""},
                                     {"of", P::Selector, "", "f", "e v f"}};
inline constexpr Signature kTagged[] = {{kTag, ValueType::Bool}};
inline constexpr Signature kArea[] = {{{}, ValueType::Float}};
inline constexpr Signature kEmptyFloats[] = {{{}, ValueType::FloatArray}};
inline constexpr ParamSpec kNumbers[] = {{"values", P::Any, ""}};
inline constexpr Signature kMin[] = {{kNumbers, ValueType::Null, true}};
inline constexpr Signature kSize[] = {{kAny, ValueType::Float}};
inline constexpr Signature kCompValues[] = {{kComponent, ValueType::Null}};
inline constexpr FunctionSpec kFunctions[] = {
    {"comp", "", "", kCompValues, nullptr},
    {"float", "", "", kFloat, nullptr},
    {"floatArray", "", "", kEmptyFloats, nullptr, kPure, true},
    {"geometry.area", "", "", kArea, nullptr, kPure, true},
    {"geometry.isOriented", "", "", kOriented, nullptr},
    {"isTagged", "", "", kTagged, nullptr},
    {"min", "", "", kMin, nullptr},
    {"rand", "", "", kRand, nullptr, kRandom, true},
    {"size", "", "", kSize, nullptr},
    {"str", "", "", kStr, nullptr},
};

inline constexpr AttributeSpec kAttributes[] = {
    {"comp.index", ValueType::Float, "", nullptr},
    {"material.color.r", ValueType::Float, "", nullptr,
     [](OpCall&, const Value&) { return Status(); }},
    {"material.colormap", ValueType::String, "", nullptr,
     [](OpCall&, const Value&) { return Status(); }},
    {"scope.sx", ValueType::Float, "", nullptr},
    {"split.index", ValueType::Float, "", nullptr},
};

inline constexpr SelectorSpec kSelectors[] = {{"all", ""},    {"back", ""}, {"front", ""},
                                              {"inside", ""}, {"left", ""}, {"side", ""},
                                              {"top", ""}};
}  // namespace test_specs

inline const Catalogue& testCatalogue() {
  using namespace test_specs;
  struct Lists {
    std::vector<const OpSpec*> ops;
    std::vector<const FunctionSpec*> functions;
    std::vector<const AttributeSpec*> attributes;
    Catalogue catalogue;
    Lists() {
      for (const OpSpec& o : kOps) ops.push_back(&o);
      for (const FunctionSpec& f : kFunctions) functions.push_back(&f);
      for (const AttributeSpec& a : kAttributes) attributes.push_back(&a);
      catalogue = {ops, functions, attributes, kSelectors};
    }
  };
  static const Lists lists;
  return lists.catalogue;
}

}  // namespace gable::lang
