// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/progen3d/web_words.h"

namespace gable::progen3d::web {

namespace {

using Kind = Statement::Kind;

constexpr Command kCommands[] = {
    {"S", Kind::Scale, 0, 3, "S ( x y z )"},
    {"T", Kind::Move, 0, 3, "T ( x y z )"},
    {"A", Kind::Turn, 0, 2, "A ( degrees axis )"},
    {"R", Kind::Turn, 0, 2, "R ( degrees axis )"},
    {"I", Kind::Insert, 0, 1, "I ( Cube texture scale )"},
    {"DSX", Kind::SideScale, 0, 3, "DSX ( x y z )"},
    {"DSY", Kind::SideScale, 1, 3, "DSY ( x y z )"},
    {"DSZ", Kind::SideScale, 2, 3, "DSZ ( x y z )"},
    {"DTX", Kind::SideMove, 0, 3, "DTX ( x y z )"},
    {"DTY", Kind::SideMove, 1, 3, "DTY ( x y z )"},
    {"DTZ", Kind::SideMove, 2, 3, "DTZ ( x y z )"},
    {"GDSX", Kind::JointScale, 0, 3, "GDSX ( x y z )"},
    {"GDSY", Kind::JointScale, 1, 3, "GDSY ( x y z )"},
    {"GDSZ", Kind::JointScale, 2, 3, "GDSZ ( x y z )"},
    {"GDTX", Kind::JointMove, 0, 3, "GDTX ( x y z )"},
    {"GDTY", Kind::JointMove, 1, 3, "GDTY ( x y z )"},
    {"GDTZ", Kind::JointMove, 2, 3, "GDTZ ( x y z )"},
};

constexpr size_t kMany = 1000;
constexpr Function kFunctions[] = {
    {"sin", 1, 1, "sin(radians)"}, {"cos", 1, 1, "cos(radians)"}, {"tan", 1, 1, "tan(radians)"},
    {"abs", 1, 1, "abs(a)"},       {"sqrt", 1, 1, "sqrt(a)"},     {"floor", 1, 1, "floor(a)"},
    {"ceil", 1, 1, "ceil(a)"},     {"min", 1, kMany, "min(a b)"}, {"max", 1, kMany, "max(a b)"},
    {"float", 1, 1, "float(a)"},   {"int", 1, 1, "int(a)"},       {"rand", 1, 2, "rand(min max)"},
};

}  // namespace

const Command* commandNamed(std::string_view word) {
  for (const Command& c : kCommands) {
    if (c.word == word) return &c;
  }
  return nullptr;
}

const Function* functionNamed(std::string_view name) {
  for (const Function& f : kFunctions) {
    if (f.name == name) return &f;
  }
  return nullptr;
}

}  // namespace gable::progen3d::web
