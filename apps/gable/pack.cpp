// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <string>

#include "answer.h"
#include "commands.h"

int runPack(const PackArguments& arguments) {
  if (const int status = checkExtension(arguments.output, {"rpk", "7z", "zip"})) return status;
  gable::LoadSettings settings{arguments.project, arguments.dialect, {}, arguments.search};
  settings.limits = fileLimits(arguments.limits);
  const gable::Rules rules = gable::Rules::load(arguments.rules, settings);
  print(rules.diagnostics());
  if (!rules.found()) return kExitFile;
  if (!rules.ok()) return statusOf(rules.diagnostics(), kExitWrong);
  const gable::Packed packed = gable::pack(rules, arguments.output, settings.limits);
  print(packed.diagnostics);
  if (!packed.ok) return statusOf(packed.diagnostics, kExitFile);
  answer().wrote(arguments.output);
  answer().member("count", std::to_string(packed.files));
  answer().member("bytes", std::to_string(packed.bytes));
  tell(arguments.output + ": " + std::to_string(packed.files) + " files, " +
       std::to_string(packed.bytes) + " bytes\n");
  return kExitDone;
}
