// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the analysis, the derivation and the writer all find out is told once a run.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "gable/gable.h"

namespace gable {

/// What messages have told: a file that is missing, and a colour of the rules that does not come
/// out. Each is told once, by the first that finds it.
class ToldOnce {
 public:
  void add(const DiagnosticList& told);
  /// Whether a message, such as that of a writer, is about what was told.
  bool has(const Diagnostic& made) const;
  DiagnosticList without(DiagnosticList made) const;

 private:
  std::set<std::string> paths_;
  /// Where the rules write out a colour.
  std::vector<TextRange> colours_;
};

}  // namespace gable
