// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// How calls are written, read from specifications: labels, parameters, blocks, an example call. All
// that the language service knows of signatures goes through here.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gable/language.h"
#include "language/cursor.h"
#include "program/spec.h"

namespace gable::language {

/// Something with signatures: an operation, or a function.
struct Callable {
  const char* name = nullptr;
  const char* summary = nullptr;
  std::span<const Signature> signatures;
  BlockKind block = BlockKind::None;
  bool blockOptional = false;
  std::span<const PartSpec> parts = {};
};

std::optional<Callable> callableOf(const Catalogue& catalogue, std::string_view name,
                                   bool successor);

/// "extrude(type, distance)"; with `parameters` the place of each in it.
std::string label(std::string_view name, const Signature& signature,
                  std::vector<SignatureHelp::Parameter>* parameters = nullptr);
std::string label(const Callable& callable);
/// The parameter that an argument is for; null when there are too many.
const ParamSpec* parameterAt(const Signature& signature, uint32_t argument, std::string_view named);
/// The parameters that an argument may be for, by all signatures.
std::vector<const ParamSpec*> parametersAt(const Callable& callable, const Call& call);
/// The signature that a call with so many arguments is of, as far as their number tells.
uint32_t signatureFor(const Callable& callable, const Call& call);
/// "extrude(${1:1})": a call that is right at once, with places to fill in.
std::string example(const Callable& callable);
/// The words of a list that are separated by blanks.
std::vector<std::string_view> listed(const char* words);

}  // namespace gable::language
