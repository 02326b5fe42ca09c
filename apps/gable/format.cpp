// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <cstdio>

#include "commands.h"

int runFormat(const FormatArguments& arguments) {
  int status = kExitDone;
  for (const std::string& path : arguments.files) {
    std::string text;
    if (!readText(path, text)) return kExitFile;
    const gable::Formatted formatted = gable::format(text, path);
    if (gable::hasErrors(formatted.messages)) {
      printMessages(formatted.messages);
      status = kExitWrong;
      continue;
    }
    if (arguments.toStdout) {
      std::fwrite(formatted.text.data(), 1, formatted.text.size(), stdout);
    } else if (formatted.text != text) {
      std::printf("%s%s\n", path.c_str(), arguments.check ? " would change" : "");
      if (arguments.check)
        status = kExitWrong;
      else if (const int written = writeText(path, formatted.text))
        return written;
    }
  }
  return status;
}
