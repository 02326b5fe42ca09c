// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <algorithm>
#include <filesystem>

#include "answer.h"
#include "commands.h"
#include "gable/cases.h"
#include "progress.h"
#include "watch.h"

namespace {

namespace fs = std::filesystem;
using gable::CaseFailure;
using gable::CaseFileResult;
using gable::CaseResult;
using Results = std::vector<CaseFileResult>;

struct Tally {
  size_t passed = 0, failed = 0;
  bool missing = false;
};

Tally tallyOf(const Results& results) {
  Tally t;
  for (const CaseFileResult& file : results) {
    t.missing = t.missing || !file.found;
    t.failed += file.errors.empty() ? 0 : 1;
    for (const CaseResult& c : file.cases) ++(c.failures.empty() ? t.passed : t.failed);
  }
  return t;
}

/// What fails, a line each with its place, and `N passed, N failed` at the end.
std::string plainText(const Results& results) {
  std::string out;
  const auto line = [&](const std::string& file, const std::string& name, const CaseFailure& f) {
    out += file + (f.line ? ":" + std::to_string(f.line) : "") + ": " +
           (name.empty() ? "" : name + ": ") + f.message + "\n";
  };
  for (const CaseFileResult& file : results) {
    for (const CaseFailure& f : file.errors) line(file.file, "", f);
    for (const CaseResult& c : file.cases) {
      for (const CaseFailure& f : c.failures) line(file.file, c.name, f);
    }
    for (const std::string& written : file.written) out += "wrote " + written + "\n";
  }
  const Tally t = tallyOf(results);
  return out + std::to_string(t.passed) + " passed, " + std::to_string(t.failed) + " failed\n";
}

std::string reportText(const Results& results, const std::string& format) {
  if (format == "tap") return gable::tapText(results);
  if (format == "junit") return gable::junitText(results);
  return plainText(results);
}

void addFailures(gable::JsonWriter& json, const std::vector<CaseFailure>& failures) {
  json.key("failures").beginArray();
  for (const CaseFailure& f : failures) {
    json.beginObject().field("line", f.line).field("message", f.message).endObject();
  }
  json.endArray();
}

/// "passed", "failed", and "cases" with their file, line, seconds and what failed.
void addMembers(const Results& results, const Tally& tally) {
  std::string out;
  gable::JsonWriter json(out);
  json.beginArray();
  for (const CaseFileResult& file : results) {
    if (!file.errors.empty()) {
      json.beginObject().field("file", file.file);
      addFailures(json, file.errors);
      json.endObject();
    }
    for (const CaseResult& c : file.cases) {
      json.beginObject().field("file", file.file).field("name", c.name).field("line", c.line);
      json.field("seconds", c.seconds);
      addFailures(json, c.failures);
      json.endObject();
    }
    for (const std::string& written : file.written) answer().wrote(written);
  }
  json.endArray();
  answer().member("passed", std::to_string(tally.passed));
  answer().member("failed", std::to_string(tally.failed));
  answer().member("cases", out);
}

std::vector<std::string> filesOf(const TestArguments& arguments) {
  std::vector<std::string> files;
  for (const std::string& path : arguments.paths) {
    for (std::string& file : gable::caseFiles(path)) {
      if (std::find(files.begin(), files.end(), file) == files.end()) {
        files.push_back(std::move(file));
      }
    }
  }
  return files;
}

int runOnce(const TestArguments& arguments, Results& results) {
  gable::CaseSettings settings;
  settings.filter = arguments.filter;
  settings.project = arguments.project;
  settings.search = arguments.search;
  settings.update = arguments.update;
  settings.jobs = arguments.jobs;
  settings.limits = fileLimits(arguments.limits);
  settings.cancel = cancelFlag();
  const std::vector<std::string> files = filesOf(arguments);
  if (files.empty()) {
    return fail(kExitUsage, "there is no .test file here; name a file or a folder");
  }
  {
    Progress progress("testing", "files");
    const auto show = progress.callback();
    for (const std::string& file : files) {
      if (!*cancelFlag()) results.push_back(gable::runCases(file, settings));
      if (show) show(results.size(), files.size());
    }
  }
  const Tally t = tallyOf(results);
  addMembers(results, t);
  if (!terminal().json || arguments.output != "-") {
    if (const int status = writeText(arguments.output, reportText(results, arguments.format))) {
      return status;
    }
  }
  if (*cancelFlag()) return kExitLimit;
  if (t.missing) return kExitFile;
  if (t.passed + t.failed == 0) {
    return fail(kExitUsage, "no case has '" + arguments.filter + "' in its name");
  }
  return t.failed == 0 ? kExitDone : kExitWrong;
}

// ------------------------------------------------------------------------------------- watching

/// What is looked at: folders as they are named, and those that files lie in. Rules lie beside a
/// folder `tests` as a rule, so its parent counts.
std::vector<fs::path> watchedFolders(const TestArguments& arguments) {
  std::vector<fs::path> folders;
  if (arguments.project) folders.push_back(placeOf(*arguments.project));
  for (const std::string& path : arguments.paths) {
    std::error_code error;
    fs::path folder = placeOf(path);
    if (!fs::is_directory(folder, error) || !folder.has_filename()) folder = folder.parent_path();
    folders.push_back(folder.filename() == "tests" ? folder.parent_path() : folder);
  }
  return folders;
}

/// Pictures that a run leaves beside those that it expected are no edits.
FileTimes timesOf(const std::vector<fs::path>& folders) {
  FileTimes times;
  for (const fs::path& folder : folders) {
    std::error_code error;
    fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied,
                                        error);
    for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
      std::error_code one;
      const std::string name = at->path().filename().string();
      if (name.starts_with('.') || name.ends_with(".found.png")) {
        if (at->is_directory(one)) at.disable_recursion_pending();
      } else if (at->is_regular_file(one)) {
        times[at->path().string()] = at->last_write_time(one);
      }
    }
  }
  return times;
}

/// What the run itself has written is no edit either.
void forget(FileTimes& before, const FileTimes& after, const TestArguments& arguments,
            const Results& results) {
  const auto written = [&](const std::string& file) {
    const auto found = after.find(placeOf(file).string());
    if (found != after.end()) before[found->first] = found->second;
  };
  if (!arguments.output.empty()) written(arguments.output);
  for (const CaseFileResult& result : results) {
    for (const std::string& file : result.written) written(file);
  }
}

int watchTests(const TestArguments& arguments) {
  const std::vector<fs::path> folders = watchedFolders(arguments);
  Results results;
  return watch({[&] { return timesOf(folders); },
                [&] {
                  results.clear();
                  return runOnce(arguments, results);
                },
                [&](FileTimes& before, const FileTimes& after) {
                  forget(before, after, arguments, results);
                }});
}

}  // namespace

int runTest(const TestArguments& arguments) {
  Results results;
  return arguments.watch ? watchTests(arguments) : runOnce(arguments, results);
}
