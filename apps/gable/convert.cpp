// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "commands.h"

int runConvert(const ConvertArguments& arguments) {
  std::string text;
  if (!readText(arguments.rules, text)) return kExitFile;
  gable::LoadSettings settings{arguments.project, arguments.dialect, {}, arguments.search};
  settings.limits = fileLimits(arguments.limits);
  const gable::Converted converted = gable::convert(text, arguments.rules, settings);
  print(converted.diagnostics);
  if (gable::hasErrors(converted.diagnostics)) {
    return statusOf(converted.diagnostics, kExitWrong);
  }
  if (!arguments.dialect && extensionOf(arguments.rules) == "cga") {
    note("'" + arguments.rules +
         "' is CGA already and is only laid out anew, as gable format does; convert makes CGA of "
         ".gbbg, .grammar and .park");
  }
  return writeText(arguments.output, converted.text);
}
