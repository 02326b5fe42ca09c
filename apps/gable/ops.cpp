// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <cstdio>

#include "commands.h"

int runOps(const OpsArguments& arguments) {
  const std::string text =
      arguments.json ? gable::builtinsJson(arguments.name) : gable::builtinsText(arguments.name);
  if (text.empty()) {
    std::fprintf(stderr, "gable: nothing built in is called '%s'; 'gable ops' lists all\n",
                 arguments.name.c_str());
    return kExitUsage;
  }
  std::fputs(text.c_str(), stdout);
  return kExitDone;
}
