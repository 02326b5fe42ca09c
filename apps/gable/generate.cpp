// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// gable generate: the map of the program. Rules are read, initial shapes are read, the rules are
// derived on the shapes, the model is written.

#include <cstdio>

#include "commands.h"
#include "gable/files.h"

namespace {

gable::Model deriveModel(Inputs& inputs) {
  ProgressLine progress("deriving");
  inputs.settings.progress = progress.callback();
  return gable::derive(inputs.rules, inputs.shapes, inputs.settings);
}

gable::WriteResult writeModel(const gable::Model& model, const GenerateArguments& arguments) {
  const ProgressLine progress("writing");
  return model.write(arguments.output, {arguments.gpuInstancing});
}

}  // namespace

int runGenerate(const GenerateArguments& arguments) {
  const double begin = secondsNow();
  std::vector<std::string> formats = gable::modelExtensions();
  formats.emplace_back("png");
  if (const int status = checkExtension(arguments.output, formats)) return status;
  Inputs inputs;
  if (const int status = readInputs(arguments.derive, inputs)) return status;
  const gable::Model model = deriveModel(inputs);
  printMessages(model.messages());
  for (const std::string& line : model.prints()) std::printf("%s\n", line.c_str());
  if (gable::hasErrors(model.messages())) return statusOf(model);

  const double writeBegin = secondsNow();
  const gable::WriteResult written = writeModel(model, arguments);
  printMessages(written.messages);
  if (!written.ok) return kExitFile;

  if (!arguments.stats.empty()) {
    gable::Model::Times times;
    times.parse = inputs.rules.parseSeconds();
    times.derive = model.deriveSeconds();
    times.write = secondsNow() - writeBegin;
    times.total = secondsNow() - begin;
    times.peakBytes = peakBytes();
    times.triangles = written.triangles;
    if (const int status = writeText(arguments.stats, model.statsJson(times))) return status;
  }
  return statusOf(model);
}
