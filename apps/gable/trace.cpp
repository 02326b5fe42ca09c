// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "commands.h"
#include "json/answers.h"

int runTrace(const TraceArguments& arguments) {
  Inputs inputs;
  if (const int status = readInputs(arguments.derive, inputs)) return status;
  inputs.settings.trace = true;
  const gable::Model model = gable::derive(inputs.rules, inputs.shapes, inputs.settings);
  print(model.diagnostics());
  if (gable::hasErrors(model.diagnostics())) return statusOf(model);
  if (const int status = writeText(arguments.output, gable::traceJson(model.trace())))
    return status;
  return statusOf(model);
}
