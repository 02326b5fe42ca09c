// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The public types as JSON, for the command line and for servers. The forms are promises to
// scripts: docs/reference and docs/dev/studio-protocol.md describe them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/json.h"
#include "gable/compare.h"
#include "gable/files.h"
#include "gable/gable.h"

namespace gable {

/// An array of objects.
std::string diagnosticsJson(const DiagnosticList& diagnostics);

/// What a run measured; what is absent is left out.
struct RunFigures {
  std::optional<double> parseSeconds, deriveSeconds, writeSeconds, totalSeconds;
  std::optional<int64_t> peakBytes;
  /// Of the file that was written, in place of the model's own count.
  std::optional<uint64_t> triangles;
  /// Of the file, and what sharing saves in it; see WriteResult.
  std::optional<uint64_t> fileBytes, savedBytes;
  std::optional<WriteResult::Atlas> atlas;
  /// What was told before the derivation, of the rules and the shapes, and what after it.
  DiagnosticList before, after;
};
/// Counts, bounds, reports, prints, diagnostics and figures as one object.
std::string statisticsJson(const Model& model, const RunFigures& figures = {});
/// The same without the diagnostics.
std::string statisticsMembers(const Model& model, const RunFigures& figures = {});

/// Before and after as arrays of two; what was added, removed and kept as objects.
std::string comparisonJson(const Comparison& comparison);

/// The trees of all initial shapes, nested; of a filtered trace, those of the topmost shapes shown.
/// Piece by piece: a town's tree has gigabytes.
void writeTrace(const DerivationTrace& trace, const TextSink& sink);

/// Members of an object: "startRule", "rules" and "attributes" with their annotations.
void writeRules(JsonWriter& json, const Rules& rules);
/// Members of an object: all that is known of a rule file without running it, and the values of its
/// attributes where there are some.
void writeRuleFile(JsonWriter& json, const Rules& rules, const std::vector<NamedValue>& values);

/// Reports as a table with a line for each key, or for each text that was reported under one:
/// key,value,count,sum,average,minimum,maximum.
std::string reportsCsv(const std::vector<ReportSummary>& reports);
/// The same for each initial shape, with the columns `shape` and `id` before the others.
std::string reportsCsv(const std::vector<ShapeReports>& shapes);
/// One line for each initial shape that reported something: its name, its id, and a column for each
/// key, with the sum of its numbers or with its texts.
std::string reportsTable(const std::vector<ShapeReports>& shapes);

/// A number, a text, a bool, null, or an array of them.
void writeValue(JsonWriter& json, const RuleValue& value);
/// An object of name and value.
std::string valuesJson(const std::vector<NamedValue>& values);

std::string leafJson(const LeafInfo& leaf);
std::string partsJson(const ModelParts& parts);

/// All that is built in.
std::string builtinsJson(const Builtins& builtins);
/// The entry of one name; absent when there is none.
std::optional<std::string> builtinJson(const Builtins& builtins, const std::string& name);

}  // namespace gable
