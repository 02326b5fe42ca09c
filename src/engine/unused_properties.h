// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#pragma once

#include "engine/impl.h"

namespace gable {

/// A note for each property of the shapes that sets nothing and is spelt nearly as an attribute of
/// the rules that no property sets; none for words of a map. Linear in the properties of all
/// shapes. Code: unused-property.
DiagnosticList unusedProperties(const Shapes::Impl& shapes, const Rules::Impl& rules);

/// Names of properties as rules can write them: "building:levels" is building_levels.
std::string identifierOf(std::string name);

}  // namespace gable
