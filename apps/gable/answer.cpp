// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "answer.h"

#include <cstdio>

#include "terminal.h"

void Answer::add(const gable::DiagnosticList& diagnostics) {
  diagnostics_.insert(diagnostics_.end(), diagnostics.begin(), diagnostics.end());
}

void Answer::member(std::string_view name, std::string_view json) {
  gable::JsonWriter(own_.append(",\n ")).value(name);
  own_.append(": ").append(json);
}

void Answer::text(std::string_view name, std::string_view value) {
  std::string json;
  gable::JsonWriter(json).value(value);
  member(name, json);
}

void Answer::members(std::string_view object) {
  const size_t begin = object.find('{');
  const size_t end = object.rfind('}');
  if (begin == std::string_view::npos || end == std::string_view::npos) return;
  std::string_view inner = object.substr(begin + 1, end - begin - 1);
  const size_t first = inner.find_first_not_of(" \n");
  if (first == std::string_view::npos) return;
  inner = inner.substr(first, inner.find_last_not_of(" \n") + 1 - first);
  own_.append(",\n ").append(inner);
}

std::string Answer::take(int status) {
  std::string out = "{\n \"command\": ";
  gable::JsonWriter(out).value(command_);
  out += ",\n \"status\": " + std::to_string(status) + ",\n \"files\": ";
  gable::JsonWriter files(out);
  files.beginArray();
  for (const std::string& file : files_) files.value(file);
  files.endArray();
  out += ",\n \"diagnostics\": " + gable::diagnosticsJson(diagnostics_) + own_ + "\n}\n";
  diagnostics_.clear();
  files_.clear();
  own_.clear();
  given_ = true;
  return out;
}

Answer& answer() {
  static Answer one;
  return one;
}

void printAnswer(int status) {
  // Also without --json, so that it does not grow with each run of --watch.
  const std::string text = answer().take(status);
  if (terminal().json) std::fputs(text.c_str(), stdout);
}
