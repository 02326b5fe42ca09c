// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <cstdio>

#include "commands.h"

int runCheck(const CheckArguments& arguments) {
  gable::Messages all;
  bool missing = false;
  for (const std::string& path : arguments.rules) {
    const gable::Rules rules = gable::Rules::load(path, {arguments.project, arguments.dialect});
    missing = missing || !rules.found();
    all.insert(all.end(), rules.messages().begin(), rules.messages().end());
  }
  size_t errors = 0;
  for (const gable::Message& m : all) errors += m.level == gable::Level::Error ? 1 : 0;
  if (arguments.json) {
    std::printf("%s\n", gable::messagesJson(all).c_str());
  } else {
    for (const gable::Message& m : all) std::fputs(m.pretty.c_str(), stdout);
    if (!all.empty()) {
      std::printf("%zu error%s, %zu warning%s\n", errors, errors == 1 ? "" : "s",
                  all.size() - errors, all.size() - errors == 1 ? "" : "s");
    }
  }
  if (missing) return kExitFile;
  return errors > 0 ? kExitWrong : kExitDone;
}
