// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A ProGen3d grammar as a neutral tree:
//
//   variable        attr Name = rand(min, max)
//   head            local(Name = rand(min, max), ...) { ... } around the rule's body
//   sections        start, repeat(n) { body }, end
//   probability     a choice in percent
//   rule call       do(Name): its transforms stay; a plain call where brackets end them anyway
//   S T A D DS DT   affineScale, affineMove, affineTurn, affineTaper, affineFront, affineTop
//   I               affineBox, affineSphere, affineCylinder
//   named texture   texture(path), color, opacity and roughness around the body, in brackets
//   Name_count      an attribute that each turn of the rule binds
//
// Names that the language uses otherwise get a '_' behind them.
#pragma once

#include <functional>
#include <string>

#include "base/diagnostic.h"
#include "dialects/progen3d/grammar.h"
#include "lang/tree.h"
#include "program/spec.h"

namespace gable::progen3d {

/// Whether the project has such a file; may be empty, then there is none.
using FileExists = std::function<bool(const std::string& path)>;

lang::Tree lower(const Grammar& grammar, uint32_t file, const Catalogue& catalogue,
                 const FileExists& exists, Diagnostics& diagnostics);

}  // namespace gable::progen3d
