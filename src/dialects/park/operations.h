// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The operations of the notation by their names, which do not mind capitals.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace gable::park {

enum class Operation {
  None,
  Choose,
  Colour,
  Contract,
  Distribute,
  Extrude,
  Figure,
  Grid,
  InnerRect,
  Insert,
  Joined,
  Model,
  NoHoles,
  Parametrise,
  Peel,
  Place,
  QuadMap,
  Rays,
  Scatter,
  Select,
  Sweep,
  Voronoi,
};

struct OperationName {
  const char* name;
  Operation operation;
};

/// How park grammars write what an operation of CGA does; null where the name is none of those.
const char* wordForCga(std::string_view name);

/// All names, as the notation spells them.
std::span<const OperationName> operationNames();
/// None for what is no operation.
Operation operationNamed(std::string_view name);
/// The name that another is a slip of; empty for none.
std::string nearestOperation(std::string_view name);

}  // namespace gable::park
