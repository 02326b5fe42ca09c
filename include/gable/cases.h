// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rule tests: .test files with cases beside the rules, each a start shape, attributes and what must
// hold of the result. docs/guide/rule-tests.md describes the format.
//
//   gable::CaseFileResult result = gable::runCases("tests/tower.test");
//   for (const gable::CaseResult& c : result.cases)
//     if (!c.failures.empty()) ...
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gable/limits.h"
#include "gable/search.h"

namespace gable {

struct CaseSettings {
  /// Only cases with this text in their name. Empty: all.
  std::string filter;
  /// The folder that the rules may read from. Absent: as LoadSettings::project has it, seen from
  /// the test file.
  std::optional<std::string> project;
  SearchSettings search;
  /// Dumps, scenes and pictures that differ are written anew instead of compared.
  bool update = false;
  /// Threads; absent: one a processor.
  std::optional<int> jobs;
  /// For reading and drawing, and the seconds of a derivation where a case sets none.
  FileLimits limits;
  /// Ends derivations, and with them the run, soon after it becomes true: cases that have not ended
  /// fail, and what they would have updated stays. May be null.
  std::atomic<bool>* cancel = nullptr;
};

/// What does not hold, as one sentence with what was found.
struct CaseFailure {
  /// The line of the statement in the test file, from 1.
  uint32_t line = 0;
  std::string message;
};

struct CaseResult {
  std::string name;
  uint32_t line = 0;
  double seconds = 0;
  std::vector<CaseFailure> failures;
};

struct CaseFileResult {
  std::string file;
  /// False when the file could not be read.
  bool found = true;
  /// Mistakes in the file itself; with these none of its cases has run.
  std::vector<CaseFailure> errors;
  /// In the order of the file.
  std::vector<CaseResult> cases;
  /// The test file, scenes and pictures that `update` has written.
  std::vector<std::string> written;
};

/// Runs the cases of a file. Each is derived twice, with and without sharing.
CaseFileResult runCases(const std::string& file, const CaseSettings& settings = {});

/// The .test files below a folder, sorted, hidden folders left out; a file names itself.
std::vector<std::string> caseFiles(const std::string& path);

/// Version 13 of the Test Anything Protocol: a line for each case, what failed as comments.
std::string tapText(const std::vector<CaseFileResult>& results);
/// The XML that build servers read: a suite for each file.
std::string junitText(const std::vector<CaseFileResult>& results);

}  // namespace gable
