// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <algorithm>
#include <cstdio>

#include "commands.h"
#include "json/answers.h"

int runCheck(const CheckArguments& arguments) {
  gable::DiagnosticList all;
  bool missing = false;
  for (const std::string& path : arguments.rules) {
    gable::LoadSettings settings{arguments.project, arguments.dialect, {}, arguments.search};
    settings.limits = fileLimits(arguments.limits);
    const gable::Rules rules = gable::Rules::load(path, settings);
    missing = missing || !rules.found();
    if (arguments.disassemble) std::fputs(rules.disassembly().c_str(), stdout);
    all.insert(all.end(), rules.diagnostics().begin(), rules.diagnostics().end());
  }
  const auto errors = static_cast<size_t>(
      std::count_if(all.begin(), all.end(), [](const auto& d) { return d.isError(); }));
  if (arguments.json) {
    std::printf("%s\n", gable::diagnosticsJson(all).c_str());
  } else {
    std::fputs(gable::render(all).c_str(), stdout);
    if (!all.empty()) {
      std::printf("%zu error%s, %zu warning%s\n", errors, errors == 1 ? "" : "s",
                  all.size() - errors, all.size() - errors == 1 ? "" : "s");
    }
  }
  if (missing) return kExitFile;
  return statusOf(all, errors > 0 ? kExitWrong : kExitDone);
}
