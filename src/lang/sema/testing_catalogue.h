// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A small catalogue for the tests of the analysis: this layer does not know the built-ins.
// Operations and functions here only have signatures.
#pragma once

#include "program/spec.h"

namespace gable::lang {

inline const Catalogue& testCatalogue() {
  using P = ParamType;
  static constexpr ParamSpec kThree[] = {
      {"x", P::Size, ""}, {"y", P::Size, ""}, {"z", P::Size, ""}};
  static constexpr Signature kSizes[] = {{kThree}};
  static constexpr ParamSpec kHeight[] = {{"distance", P::Float, "How far."}};
  static constexpr ParamSpec kDirected[] = {
      {"direction", P::Selector, "Where to.", nullptr, "world.up world.y x y z"},
      {"distance", P::Float, "How far."}};
  static constexpr Signature kExtrude[] = {{kHeight}, {kDirected}};
  static constexpr ParamSpec kAxis[] = {{"axis", P::Selector, "", nullptr, "x y z"},
                                        {"mode", P::Selector, "", "adjust", "adjust noAdjust"}};
  static constexpr ParamSpec kUv[] = {{"direction", P::Selector, "", nullptr, "u v"},
                                      {"space", P::Selector, "", nullptr, "uvSpace unitSpace"},
                                      {"uvSet", P::Float, ""}};
  static constexpr Signature kSplit[] = {{kAxis}, {kUv}};
  static constexpr ParamSpec kComponent[] = {{"component", P::Selector, "", nullptr, "f e fe v"},
                                             {"alignment", P::Selector, "", "zUp", "zUp noAlign"}};
  static constexpr Signature kComp[] = {{kComponent}};
  static constexpr ParamSpec kAny[] = {{"value", P::Any, ""}};
  static constexpr Signature kPrint[] = {{kAny}};
  static constexpr Signature kNothing[] = {{}};
  static constexpr ParamSpec kPath[] = {{"path", P::String, "", nullptr}};
  static constexpr Signature kInsert[] = {{kPath}};
  static constexpr ParamSpec kColor3[] = {
      {"r", P::Float, ""}, {"g", P::Float, ""}, {"b", P::Float, ""}};
  static constexpr ParamSpec kHex[] = {{"hex", P::String, ""}};
  static constexpr Signature kColor[] = {{kHex}, {kColor3}};
  static constexpr ParamSpec kSet[] = {{"attribute", P::Selector, ""}, {"value", P::Any, ""}};
  static constexpr Signature kSetSignature[] = {{kSet}};
  static constexpr ParamSpec kPoints[] = {{"domain", P::Selector, "", nullptr, "surface scope"},
                                          {"n", P::Float, ""}};
  static constexpr Signature kScatter[] = {{kPoints}};
  static constexpr ParamSpec kDistance[] = {{"distance", P::Float, ""}};
  static constexpr ParamSpec kDistances[] = {{"distances", P::FloatArray, ""}};
  static constexpr Signature kSetback[] = {{kDistance}, {kDistances}};
  static constexpr ParamSpec kMode[] = {{"strategy", P::Selector, "", "append", "append unify"}};
  static constexpr Signature kInline[] = {{kMode}};
  static constexpr ParamSpec kCount[] = {{"n", P::Float, ""}};
  static constexpr Signature kRepeat[] = {{kCount}};
  static constexpr ParamSpec kGridParams[] = {{"columns", P::Float, ""},
                                              {"rows", P::Float, "", "1"}};
  static constexpr Signature kGrid[] = {{kGridParams}};

  static constexpr BlockKind kSel = BlockKind::Selectors;
  static constexpr OpSpec kOps[] = {
      {"NIL", "", "", kNothing, nullptr},
      {"color", "", "", kColor, nullptr},
      {"comp", "", "", kComp, nullptr, kSel},
      {"do", "", "", kPrint, nullptr, BlockKind::None, kPure, nullptr, false, true},
      {"extrude", "", "", kExtrude, nullptr},
      {"grid", "", "", kGrid, nullptr, kSel, kPure, "region path", false, true},
      {"i", "", "", kInsert, nullptr},
      {"inline", "", "", kInline, nullptr, BlockKind::Operations},
      {"local", "", "", kPrint, nullptr, BlockKind::Operations, kPure, nullptr, false, true},
      {"print", "", "", kPrint, nullptr},
      {"repeat", "", "", kRepeat, nullptr, BlockKind::Operations, kPure, nullptr, false, true},
      {"s", "", "", kSizes, nullptr},
      {"scatter", "", "", kScatter, nullptr, BlockKind::Operations},
      {"set", "", "", kSetSignature, nullptr},
      {"setback", "", "", kSetback, nullptr, kSel, kPure, "remainder"},
      {"split", "", "", kSplit, nullptr, BlockKind::Split},
      {"t", "", "", kSizes, nullptr},
      {"union", "", "", kNothing, nullptr, BlockKind::Operands},
  };

  static constexpr ParamSpec kRange1[] = {{"max", P::Float, ""}};
  static constexpr ParamSpec kRange2[] = {{"min", P::Float, ""}, {"max", P::Float, ""}};
  static constexpr Signature kRand[] = {
      {{}, ValueType::Float}, {kRange1, ValueType::Float}, {kRange2, ValueType::Float}};
  static constexpr Signature kStr[] = {{kAny, ValueType::String}};
  static constexpr Signature kFloat[] = {{kHex, ValueType::Float}};
  static constexpr ParamSpec kSide[] = {{"side", P::Selector, "", nullptr, "front side top"}};
  static constexpr Signature kOriented[] = {{kSide, ValueType::Bool}};
  static constexpr ParamSpec kTag[] = {{"query", P::String, ""},
                                       {"of", P::Selector, "", "f", "e v f"}};
  static constexpr Signature kTagged[] = {{kTag, ValueType::Bool}};
  static constexpr Signature kArea[] = {{{}, ValueType::Float}};
  static constexpr Signature kEmptyFloats[] = {{{}, ValueType::FloatArray}};
  static constexpr ParamSpec kNumbers[] = {{"values", P::Any, ""}};
  static constexpr Signature kMin[] = {{kNumbers, ValueType::Null, true}};
  static constexpr Signature kSize[] = {{kAny, ValueType::Float}};
  static constexpr Signature kCompValues[] = {{kComponent, ValueType::Null}};
  static constexpr FunctionSpec kFunctions[] = {
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

  static constexpr AttributeSpec kAttributes[] = {
      {"comp.index", ValueType::Float, "", nullptr},
      {"material.color.r", ValueType::Float, "", nullptr,
       [](OpCall&, const Value&) { return Status(); }},
      {"material.colormap", ValueType::String, "", nullptr,
       [](OpCall&, const Value&) { return Status(); }},
      {"scope.sx", ValueType::Float, "", nullptr},
      {"split.index", ValueType::Float, "", nullptr},
  };

  static constexpr SelectorSpec kSelectors[] = {{"all", ""},    {"back", ""}, {"front", ""},
                                                {"inside", ""}, {"left", ""}, {"side", ""},
                                                {"top", ""}};

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
