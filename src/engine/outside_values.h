// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#pragma once

#include <span>

#include "engine/impl.h"
#include "runtime/derive.h"

namespace gable {

/// A warning for each attribute to which shapes bring values of another type, or of the main file
/// values that its @Enum or @Range leaves out; it names the first shape and how many more there
/// are. Linear in the attributes of all shapes. Codes: attribute-type, attribute-value,
/// attribute-outside.
DiagnosticList outsideValues(std::span<const InitialShape> shapes, const Rules::Impl& rules);

}  // namespace gable
