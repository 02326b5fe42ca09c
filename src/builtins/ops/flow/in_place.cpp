// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What runs on the present shape itself. The compiler makes code of these three (see
// lang/compile/successors.cpp); the specs tell the analysis and the reference what they are.

#include "builtins/lists.h"
#include "shape/op_call.h"

namespace gable {

namespace {

Status compiledAway(OpCall&) { return {}; }

constexpr ParamSpec kDoParams[] = {
    {"rule", ParamType::Any, "A rule, with its arguments: do(Wall(3))."}};
constexpr Signature kDoSignatures[] = {{kDoParams}};

constexpr ParamSpec kRepeatParams[] = {
    {"count", ParamType::Float, "How many turns; truncated, none below 1."}};
constexpr Signature kRepeatSignatures[] = {{kRepeatParams}};

constexpr ParamSpec kLocalParams[] = {
    {"value", ParamType::Any, "attribute = value, any number of them."}};
constexpr Signature kLocalSignatures[] = {{kLocalParams, ValueType::Null, true}};

constexpr OpSpec kSpecs[] = {
    {"do", "flow", "Runs a rule on the present shape; what it changes stays.", kDoSignatures,
     compiledAway, BlockKind::None, kPure, kNoParts, false, true},
    {"repeat", "flow", "Runs operations several times on the present shape, one after the other.",
     kRepeatSignatures, compiledAway, BlockKind::Operations, kPure, kNoParts, false, true},
    {"local", "flow",
     "Gives attributes other values within a block, for all rules that are called from it.",
     kLocalSignatures, compiledAway, BlockKind::Operations, kPure, kNoParts, false, true},
};

}  // namespace

extern const OpList kOps_in_place;
const OpList kOps_in_place = kSpecs;

}  // namespace gable
