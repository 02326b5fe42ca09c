// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// How a file of built-ins offers what it defines. ops/<family>/<stem>.cpp defines
//
//   extern const OpList kOps_<stem>;
//   const OpList kOps_<stem> = kSpecs;
//
// and functions/<stem>.cpp defines kFunctions_<stem>, which lists functions and shape attributes.
// The build finds the files by name; nothing else is to be registered. Files in folders named
// `shared` hold helpers and define no list.
#pragma once

#include <span>
#include <vector>

#include "program/spec.h"

namespace gable {

using OpList = std::span<const OpSpec>;

struct FunctionList {
  std::span<const FunctionSpec> functions;
  std::span<const AttributeSpec> attributes;
};

std::vector<OpList> allOpLists();
std::vector<FunctionList> allFunctionLists();

}  // namespace gable
