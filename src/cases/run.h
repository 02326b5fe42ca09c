// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// One case: its project, its derivations, its verdict.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cases/case_file.h"
#include "cases/expectation.h"
#include "cases/golden.h"
#include "gable/gable.h"

namespace gable::cases {

/// A dump that an update writes into the test file: the lines below `line` are replaced.
struct DumpUpdate {
  size_t line = 0;
  size_t lines = 0;
  std::string text;
};

class CaseRun {
 public:
  /// `file` is the test file. All must outlive the run.
  CaseRun(const Case& c, const std::string& file, const CaseSettings& settings);

  /// Derives with and without sharing, and holds the result against the expectations; of several
  /// seeds with each, telling of each statement the first that it does not hold with.
  CaseResult run();

  const std::vector<DumpUpdate>& updates() const { return updates_; }
  const std::vector<std::string>& written() const { return golden_.written(); }

 private:
  /// Somebody has stopped the run: nothing is judged or written any more.
  bool stopped() const;
  void fail(size_t line, const std::string& message);
  void failAt(const char* section, const std::string& message);
  void runCase();
  /// `outcome` has what loading said; the rest of it is of the seed.
  void runSeeds(const Rules& rules, const Shapes& shapes, DeriveSettings derived,
                const std::vector<double>& seeds, const Outcome& loaded);
  void runSeed(const Rules& rules, const Shapes& shapes, DeriveSettings derived, Outcome outcome);
  Rules loadRules();
  std::optional<std::vector<double>> readSeeds();
  bool readSettings(DeriveSettings& derive);
  bool readAttributes(DeriveSettings& derive);
  void checkValues(const std::vector<std::string>& prints);
  void judge(const Outcome& outcome);
  size_t lineOf(const CaseFailure& failure) const;
  void noteUpdates(const std::vector<Statement>& expected, const std::string& dump);

  const Case& case_;
  const CaseSettings& settings_;
  std::string folder_;
  GoldenFiles golden_;
  CaseResult result_;
  std::vector<DumpUpdate> updates_;
  /// The lines of the section `set`, by the attribute's name in quotes.
  std::vector<std::pair<std::string, size_t>> setLines_;
};

}  // namespace gable::cases
