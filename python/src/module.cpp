// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "bindings.h"

PYBIND11_MODULE(_gable, m) {
  using namespace gable::python;
  m.doc() = "The engine. Import gable instead.";
  m.attr("version") = gable::version();
  bindRules(m);
  bindShapes(m);
  bindModel(m);
  bindDerive(m);
  bindDataset(m);
}
