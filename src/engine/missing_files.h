// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A file that is missing is told once a run.
#pragma once

#include <set>
#include <string>

#include "gable/gable.h"

namespace gable {

/// The files that messages have told as missing: each is told once, by the first of the analysis,
/// the derivation and the writer that misses it.
class MissingFiles {
 public:
  void add(const DiagnosticList& told);
  /// Whether a message, such as that of a writer, is about a file that was told.
  bool has(const Diagnostic& made) const;
  DiagnosticList without(DiagnosticList made) const;

 private:
  std::set<std::string> paths_;
};

}  // namespace gable
