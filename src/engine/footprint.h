// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// An initial shape of a file as a derivation takes it.
#pragma once

#include "engine/impl.h"
#include "io/importers/asset.h"
#include "io/importers/shape_input.h"

namespace gable {

/// The attribute of a shape that names the rule it begins with, where the rules have it.
inline constexpr const char* kStartRuleAttribute = "startRule";
inline bool namesStartRule(const AttributeValue& a) {
  return a.name == kStartRuleAttribute && a.values.size() == 1;
}
/// The rule that a shape with these attributes begins with: the one that they name where the
/// program has it, else `usual`. Below 0 for none.
int32_t startRuleOf(const std::vector<AttributeValue>& attributes, const Program& program,
                    int32_t usual);

/// Whether rules of these effects ask about other shapes, which have to be derived with theirs
/// then.
inline bool asksOthers(uint32_t effects) { return (effects & (kReadsContext | kAsksForRoom)) != 0; }

/// Of files of shapes, in bytes.
constexpr uint64_t kLargestShapeFile = uint64_t{2} << 30;

/// Its frame stands, unturned, on a whole metre near the lower corner: offsets stay exact.
ShapeFootprint footprint(ShapeInput input);

/// Plan coordinates on the ground: x east, y north, which is -z; z up.
Frame groundFrame(double height = 0);

/// For readers of a file of shapes: other files are read from its own folder and below, nowhere
/// else.
AssetOptions shapeFileOptions(const std::string& path);

}  // namespace gable
