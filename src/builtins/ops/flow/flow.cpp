// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <string>

#include "builtins/lists.h"
#include "builtins/shared/text_forms.h"
#include "program/tag_effects.h"
#include "shape/op_call.h"

namespace gable {

namespace {

Status applyNil(OpCall& call) {
  call.drop();
  return {};
}

struct Label {
  Text label;
};

Status applyLabel(OpCall& call, const Label& args) {
  call.services().label(args.label.id, call.shape());
  return {};
}

struct Print {
  Value value;
};

Status applyPrint(OpCall& call, const Print& args) {
  call.services().print(call.services().pool().str(args.value));
  return {};
}

struct Report {
  Text key;
  Value value;
};

Status applyReport(OpCall& call, const Report& args) {
  call.services().report(args.key.id, args.value);
  return {};
}

constexpr Signature kNilSignatures[] = {{}};

constexpr ParamSpec kLabelParams[] = {
    param<&Label::label>("label", "The name by which queries find the shape; not empty.")
        .of(kNotEmptyText),
};
constexpr Signature kLabelSignatures[] = {{kLabelParams}};

constexpr ParamSpec kPrintParams[] = {param<&Print::value>("value", "Any value or array.")};
constexpr Signature kPrintSignatures[] = {{kPrintParams}};

constexpr ParamSpec kKey =
    param<&Report::key>("key", "The name of the collection; dots make groups.");
constexpr ParamSpec kReportFloat[] = {
    kKey, param<&Report::value, ParamType::Float>("value", "A number to sum up.")};
constexpr ParamSpec kReportBool[] = {
    kKey, param<&Report::value, ParamType::Bool>("value", "A truth value to count.")};
constexpr ParamSpec kReportString[] = {
    kKey, param<&Report::value, ParamType::String>("value", "A text to count.")};
constexpr Signature kReportSignatures[] = {{kReportFloat}, {kReportBool}, {kReportString}};

constexpr OpSpec kSpecs[] = {
    {"NIL", "flow", "Deletes the shape: nothing comes of it.", kNilSignatures, applyNil,
     BlockKind::None, kIgnoresTags},
    {"label", "flow", "Leaves a named copy of the shape for context queries.", kLabelSignatures,
     typed<applyLabel>, BlockKind::None, kLabels},
    {"print", "flow", "Writes a value to the console.", kPrintSignatures, typed<applyPrint>,
     BlockKind::None, kReports | kIgnoresTags},
    {"report", "flow", "Adds a value to a collection of statistics.", kReportSignatures,
     typed<applyReport>, BlockKind::None, kReports | kIgnoresTags},
};

}  // namespace

extern const OpList kOps_flow;
const OpList kOps_flow = kSpecs;

}  // namespace gable
