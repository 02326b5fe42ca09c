// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A file's cases run side by side, each on one thread; their results stand in the file's order.

#include "gable/cases.h"

#include <algorithm>
#include <filesystem>
#include <memory>

#include "base/files.h"
#include "base/parallel.h"
#include "cases/case_file.h"
#include "cases/run.h"
#include "engine/guard.h"

namespace gable {
namespace {

namespace fs = std::filesystem;
using cases::Case;
using cases::CaseRun;
using cases::DumpUpdate;

/// The text of a test file with its dumps written anew.
std::string withDumps(const std::string& text, const std::vector<DumpUpdate>& updates) {
  const std::vector<std::string_view> lines = cases::linesOf(text);
  std::string out;
  size_t next = 0;
  for (size_t i = 0; i < lines.size(); ++i) {
    out += std::string(lines[i]) + "\n";
    if (next < updates.size() && updates[next].line == i + 1) {
      out += updates[next].text;
      i += updates[next].lines;
      ++next;
    }
  }
  return out;
}

void writeUpdates(const std::string& text, const std::vector<DumpUpdate>& updates,
                  CaseFileResult& result) {
  const std::string updated = withDumps(text, updates);
  if (updates.empty() || updated == text) return;
  const Result<uint64_t> done = writeFile(result.file, updated);
  if (done.ok())
    result.written.push_back(result.file);
  else
    result.errors.push_back({0, done.error().message});
}

void runFile(const CaseSettings& settings, CaseFileResult& result) {
  const std::string& file = result.file;
  const Result<std::string> text = readFile(file, uint64_t{64} << 20);
  if (!text.ok()) {
    result.found = false;
    result.errors.push_back({0, text.error().message});
    return;
  }
  const cases::CaseFile parsed = cases::parseCases(text.value());
  result.errors = parsed.errors;
  std::vector<std::unique_ptr<CaseRun>> runs;
  for (const Case& c : parsed.cases) {
    if (c.name.find(settings.filter) == std::string::npos) continue;
    runs.push_back(std::make_unique<CaseRun>(c, file, settings));
  }
  result.cases.resize(runs.size());
  const unsigned jobs =
      settings.jobs ? static_cast<unsigned>(std::max(1, *settings.jobs)) : defaultJobs();
  parallelFor(runs.size(), jobs, [&](size_t i, unsigned) { result.cases[i] = runs[i]->run(); });
  std::vector<DumpUpdate> updates;
  for (const auto& run : runs) {
    updates.insert(updates.end(), run->updates().begin(), run->updates().end());
    result.written.insert(result.written.end(), run->written().begin(), run->written().end());
  }
  writeUpdates(text.value(), updates, result);
}

}  // namespace

CaseFileResult runCases(const std::string& file, const CaseSettings& settings) {
  CaseFileResult result;
  result.file = file;
  try {
    runFile(settings, result);
  } catch (...) {
    result.errors.push_back({0, diagnosticOfException().message});
  }
  return result;
}

std::vector<std::string> caseFiles(const std::string& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return {path};
  std::vector<std::string> files;
  fs::recursive_directory_iterator at(path, fs::directory_options::skip_permission_denied, error);
  for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
    if (at->path().filename().string().starts_with('.')) {
      if (at->is_directory(error)) at.disable_recursion_pending();
    } else if (at->path().extension() == ".test" && at->is_regular_file(error)) {
      files.push_back(at->path().lexically_normal().string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace gable
