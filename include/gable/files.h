// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Files as Gable opens and writes them, for programs around it: only regular files are read, up to
// a size; a file is written beside its place and renamed when it is complete, so that a full disk
// or a signal leaves the old one as it was.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "gable/gable.h"

namespace gable {

struct RuleText {
  bool ok = false;
  std::string text;
  DiagnosticList diagnostics;
};
/// The text of a rule file, of at most 256 MiB.
RuleText readRuleText(const std::string& path);

/// Replaces a file whole.
WriteResult writeTextFile(const std::string& path, const std::string& text);
/// The same with a text that is made piece by piece: `write` hands the pieces to the sink.
using TextSink = std::function<void(std::string_view)>;
WriteResult writeTextFile(const std::string& path,
                          const std::function<void(const TextSink& sink)>& write);

/// The extensions of the models that Model::write makes, without the first dot: "glb", "city.json".
const std::vector<std::string>& modelExtensions();

/// Removes what is half written. May be called by a signal handler, just before the process ends.
void removeUnfinishedFiles();

}  // namespace gable
