// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <cstdio>

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
  std::printf("%s: %llu files, %llu bytes\n", arguments.output.c_str(),
              static_cast<unsigned long long>(packed.files),
              static_cast<unsigned long long>(packed.bytes));
  return kExitDone;
}
