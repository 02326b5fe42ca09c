// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <cstdio>

#include "commands.h"

int runConvert(const ConvertArguments& arguments) {
  std::string text;
  if (!readText(arguments.rules, text)) return kExitFile;
  const gable::Converted converted =
      gable::convert(text, arguments.rules, {arguments.project, arguments.dialect});
  print(converted.diagnostics);
  if (gable::hasErrors(converted.diagnostics)) return kExitWrong;
  return writeText(arguments.output, converted.text);
}
