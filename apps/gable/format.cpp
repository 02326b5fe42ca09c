// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <algorithm>
#include <cstdio>

#include "commands.h"

int runFormat(const FormatArguments& arguments) {
  int status = kExitDone;
  for (const std::string& path : arguments.files) {
    std::string text;
    if (!readText(path, text)) {
      status = kExitFile;
      continue;
    }
    const gable::Formatted formatted = gable::format(text, path, fileLimits(arguments.limits));
    print(formatted.diagnostics);
    if (gable::hasErrors(formatted.diagnostics)) {
      status = std::max<int>(status, statusOf(formatted.diagnostics, kExitWrong));
      continue;
    }
    if (arguments.toStdout) {
      std::fwrite(formatted.text.data(), 1, formatted.text.size(), stdout);
    } else if (formatted.text != text) {
      if (!arguments.check) {
        if (const int written = writeText(path, formatted.text)) return written;
      } else {
        status = std::max<int>(status, kExitWrong);
      }
      std::printf("%s%s\n", path.c_str(), arguments.check ? " would change" : "");
    }
  }
  return status;
}
