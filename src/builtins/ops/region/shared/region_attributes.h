// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The attribute that tells on what came out of a figure which of several it is.
#pragma once

#include "builtins/ops/region/shared/region_shape.h"
#include "program/spec.h"
#include "shape/op_call.h"

namespace gable {

inline Value regionChoiceOf(FunctionCall& call) {
  const CellMark cell = provenanceOf(call.services(), call.shape()).cell.value_or(CellMark{});
  return Value::of(cell.free ? 0 : static_cast<double>(cell.choice));
}

inline constexpr AttributeSpec kRegionChoice = {
    "region.choice",
    ValueType::Float,
    "Which of several figures a junction or a placed region is, from 1; 0 where there is no "
    "choice.",
    regionChoiceOf,
    nullptr,
    kReadsRegion};

}  // namespace gable
