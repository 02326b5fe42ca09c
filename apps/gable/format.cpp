// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <algorithm>

#include "answer.h"
#include "commands.h"

int runFormat(const FormatArguments& arguments) {
  int status = kExitDone;
  std::string names, all;
  gable::JsonWriter texts(all);
  texts.beginArray();
  gable::JsonWriter changed(names);
  changed.beginArray();
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
      put(formatted.text);
      texts.beginObject().key("file").value(path);
      texts.key("text").value(formatted.text).endObject();
    } else if (formatted.text != text) {
      if (!arguments.check) {
        if (const int written = writeText(path, formatted.text)) return written;
      } else {
        status = std::max<int>(status, kExitWrong);
      }
      changed.value(path);
      tell(path + (arguments.check ? " would change\n" : "\n"));
    }
  }
  texts.endArray();
  if (arguments.toStdout) answer().member("texts", all);
  changed.endArray();
  answer().member("changed", names);
  return status;
}
