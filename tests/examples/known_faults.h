// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The faults of examples that are known and not mended, with the reason, from known_faults.txt:
//
//   # Why they stay.
//   EXAMPLE KIND COUNT RULE:LEAF [RULE:LEAF]
//
// A count may only shrink. With GABLE_UPDATE=1 counts are lowered to what is found, and lines that
// nothing is found of any more go; none is raised or added.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace gable {

/// What is wrong and between which parts: "floating up.Hoop:Hoop".
using FaultCounts = std::map<std::string, size_t>;

class KnownFaults {
 public:
  explicit KnownFaults(std::string path);

  /// What is wrong with the table itself: lines that are not understood or have no reason.
  const std::string& complaints() const { return complaints_; }
  /// What an example has more of than is known, and what it no longer has, a line each.
  std::string compare(const std::string& example, const FaultCounts& found) const;
  /// Writes the table with the counts that were found.
  void lower(const std::string& example, const FaultCounts& found);

 private:
  struct Line {
    std::string text;
    /// Empty for lines that tell no fault.
    std::string example, what;
    size_t count = 0;
  };

  std::string path_, complaints_;
  std::vector<Line> lines_;
};

}  // namespace gable
