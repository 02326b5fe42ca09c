// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <string>

#include "builtins/lists.h"
#include "shape/op_call.h"

namespace gable {

namespace {

Status applyNil(OpCall& call) {
  call.drop();
  return {};
}

Status applyLabel(OpCall& call) {
  if (call.text(0).empty()) {
    return call.fail("bad-argument", "label got an empty text", "name the shape");
  }
  call.services().label(call.arg(0).id, call.shape());
  return {};
}

Status applyPrint(OpCall& call) {
  call.services().print(call.services().pool().str(call.arg(0)));
  return {};
}

Status applyReport(OpCall& call) {
  if (call.arg(1).isArray()) {
    return call.fail("type-mismatch", "report takes no arrays", "report the elements one by one");
  }
  call.services().report(call.arg(0).id, call.arg(1));
  return {};
}

constexpr Signature kNilSignatures[] = {{}};

constexpr ParamSpec kLabelParams[] = {
    {"label", ParamType::String, "The name by which queries find the shape; not empty."},
};
constexpr Signature kLabelSignatures[] = {{kLabelParams}};

constexpr ParamSpec kPrintParams[] = {{"value", ParamType::Any, "Any value or array."}};
constexpr Signature kPrintSignatures[] = {{kPrintParams}};

constexpr ParamSpec kKey = {"key", ParamType::String,
                            "The name of the collection; dots make groups."};
constexpr ParamSpec kReportFloat[] = {kKey, {"value", ParamType::Float, "A number to sum up."}};
constexpr ParamSpec kReportBool[] = {kKey, {"value", ParamType::Bool, "A truth value to count."}};
constexpr ParamSpec kReportString[] = {kKey, {"value", ParamType::String, "A text to count."}};
constexpr Signature kReportSignatures[] = {{kReportFloat}, {kReportBool}, {kReportString}};

constexpr OpSpec kSpecs[] = {
    {"NIL", "flow", "Deletes the shape: nothing comes of it.", kNilSignatures, applyNil},
    {"label", "flow", "Leaves a named copy of the shape for context queries.", kLabelSignatures,
     applyLabel, BlockKind::None, kReadsPath},
    {"print", "flow", "Writes a value to the console.", kPrintSignatures, applyPrint,
     BlockKind::None, kReports},
    {"report", "flow", "Adds a value to a collection of statistics.", kReportSignatures,
     applyReport, BlockKind::None, kReports},
};

}  // namespace

extern const OpList kOps_flow;
const OpList kOps_flow = kSpecs;

}  // namespace gable
