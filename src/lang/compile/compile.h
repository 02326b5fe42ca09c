// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Resolved trees to a Program. The analysis must have reported no error; compiling cannot fail
// then. Linear in the trees.
#pragma once

#include <memory>
#include <vector>

#include "base/diagnostic.h"
#include "lang/sema/resolved.h"
#include "program/program.h"

namespace gable::lang {

/// Annotations one by one, as they are told to programs around.
std::vector<AnnotationInfo> listed(const Annotations& annotations, ValuePool& pool);

/// Rules that are too large for the machine are told; the program is then not for use.
Program compile(const ResolvedProgram& resolved, const Catalogue& catalogue,
                std::shared_ptr<ValuePool> pool, const Sources& sources, Diagnostics& diagnostics);

}  // namespace gable::lang
