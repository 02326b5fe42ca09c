// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <algorithm>
#include <cstdio>

#include "answer.h"
#include "commands.h"
#include "derive_settings.h"
#include "gable/files.h"

namespace {

// "Lot/House/Roof" as the names of rules.
std::vector<std::string> namesOf(const std::string& path) {
  std::vector<std::string> names;
  for (size_t begin = 0; begin < path.size();) {
    const size_t end = std::min(path.find('/', begin), path.size());
    if (end > begin) names.push_back(path.substr(begin, end - begin));
    begin = end + 1;
  }
  return names;
}

int write(const gable::DerivationTrace& trace, const std::string& path) {
  if (path == "-" && terminal().json) {
    std::string text;
    gable::writeTrace(trace, [&](std::string_view more) { text += more; });
    answer().member("trees", text);
    return kExitDone;
  }
  if (path == "-") {
    gable::writeTrace(
        trace, [](std::string_view text) { std::fwrite(text.data(), 1, text.size(), stdout); });
    return kExitDone;
  }
  const gable::WriteResult written = gable::writeTextFile(
      path, [&](const gable::TextSink& sink) { gable::writeTrace(trace, sink); });
  print(written.diagnostics);
  if (written.ok) answer().wrote(path);
  return written.ok ? kExitDone : kExitFile;
}

}  // namespace

int runTrace(const TraceArguments& arguments) {
  Inputs inputs;
  if (const int status = readInputs(arguments.derive, inputs)) return status;
  inputs.settings.trace = true;
  inputs.settings.traceFilter = {arguments.rule, namesOf(arguments.path), arguments.depth};
  const gable::Model model = deriveModel(inputs.rules, inputs.shapes, inputs.settings, stderr);
  if (gable::hasErrors(model.diagnostics())) return statusOf(model);
  if (const int status = write(model.trace(), arguments.output)) return status;
  return statusOf(model);
}
