// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#pragma once

#include "engine/impl.h"

namespace gable {

/// How the rules for a place fit the shapes of its plan, which name the rules that they begin with;
/// nothing for other shapes. Codes: city-rule, where a rule is nearly called as one that the plan
/// asks for; city-rules, for shapes that begin with the start rule as theirs is missing;
/// unused-rule, for rules of the file itself that nothing calls; city-attribute, for attributes of
/// the file that no shape sets and that are spelt nearly as a property of some. Linear in shapes
/// and code, and in the properties for each attribute.
DiagnosticList cityRuleNotes(const Shapes::Impl& shapes, const Rules::Impl& rules);

}  // namespace gable
