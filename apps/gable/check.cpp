// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <algorithm>
#include <set>
#include <string>

#include "answer.h"
#include "commands.h"
#include "progress.h"

int runCheck(const CheckArguments& arguments) {
  gable::DiagnosticList all;
  std::set<std::string> told;
  bool missing = false;
  std::string programs;
  gable::JsonWriter json(programs);
  json.beginArray();
  for (const std::string& path : arguments.rules) {
    gable::LoadSettings settings{arguments.project, arguments.dialect, {}, arguments.search};
    settings.limits = fileLimits(arguments.limits);
    const gable::Rules rules = gable::Rules::load(path, settings);
    missing = missing || !rules.found();
    if (arguments.disassemble) {
      put(rules.disassembly());
      json.beginObject().key("file").value(path);
      json.key("text").value(rules.disassembly()).endObject();
    }
    // What several files import is told once.
    for (const gable::Diagnostic& d : rules.diagnostics()) {
      if (told.insert(d.rendered).second) all.push_back(d);
    }
  }
  json.endArray();
  if (arguments.disassemble) answer().member("disassembly", programs);
  const auto errors = static_cast<size_t>(
      std::count_if(all.begin(), all.end(), [](const auto& d) { return d.isError(); }));
  print(all, stdout);
  const size_t others = all.size() - errors;
  if (!all.empty()) {
    tell(std::to_string(errors) + (errors == 1 ? " error, " : " errors, ") +
         std::to_string(others) + (others == 1 ? " warning\n" : " warnings\n"));
  }
  if (all.empty() && !arguments.disassemble && Progress::isShown()) {
    const bool one = arguments.rules.size() == 1;
    note(one ? arguments.rules[0] + ": no mistakes"
             : std::to_string(arguments.rules.size()) + " files: no mistakes");
  }
  if (missing) return kExitFile;
  return statusOf(all, errors > 0 || (arguments.strict && hasWarned()) ? kExitWrong : kExitDone);
}
