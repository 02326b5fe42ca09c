// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "answer.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>

#include "common.h"
#include "progress.h"
#include "terminal.h"

namespace {

/// "812 bytes", "73.4 kB", "2.9 MB".
std::string sizeText(uintmax_t bytes) {
  if (bytes < 1000) return std::to_string(bytes) + " bytes";
  constexpr double kKilo = 1e3, kMega = 1e6;
  const bool large = static_cast<double>(bytes) >= kMega;
  char text[32];
  std::snprintf(text, sizeof text, "%.1f %s", static_cast<double>(bytes) / (large ? kMega : kKilo),
                large ? "MB" : "kB");
  return text;
}

}  // namespace

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

std::string Answer::filesText() const {
  constexpr size_t kShown = 5;
  std::string out;
  for (size_t i = 0; i < std::min(files_.size(), kShown); ++i) {
    std::error_code none;
    const auto bytes = std::filesystem::is_regular_file(files_[i], none)
                           ? std::filesystem::file_size(files_[i], none)
                           : 0;
    out += files_[i] + (none || bytes == 0 ? "" : "  " + sizeText(bytes)) + "\n";
  }
  if (files_.size() > kShown) out += "and " + std::to_string(files_.size() - kShown) + " more\n";
  return out;
}

Answer& answer() {
  static Answer one;
  return one;
}

void printAnswer(int status) {
  // Also without --json, so that it does not grow with each run of --watch.
  const bool silent = !hasTold() && !terminal().json;
  if (silent && status == kExitDone && Progress::isShown()) {
    std::fputs(answer().filesText().c_str(), stderr);
  }
  const std::string text = answer().take(status);
  if (terminal().json) std::fputs(text.c_str(), stdout);
}
