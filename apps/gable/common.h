// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the commands share: exit statuses, options that several take, diagnostics and progress.
#pragma once

#include <atomic>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gable/gable.h"
#include "numbers.h"
#include "terminal.h"

/// The exit statuses that scripts rely on.
enum ExitStatus : int {
  kExitDone = 0,
  /// The rules or the inputs are wrong.
  kExitWrong = 1,
  /// The command line is wrong.
  kExitUsage = 2,
  /// A file could not be read or written.
  kExitFile = 3,
  /// A limit or a cancel ended it; what was made is written.
  kExitLimit = 4,
};

/// The options of commands that work on files of others.
struct LimitArguments {
  /// Absent: what the library thinks right for files, and no limit for what a derivation or a
  /// picture takes. 0: no limit.
  std::optional<double> maxSeconds;
  /// 0: no limit.
  uint64_t maxMegabytes = 4096;
};

/// How a model file is written: a profile, and values of gable::writeOptions() by name; empty where
/// they are not given.
struct WriteArguments {
  std::string profile;
  std::map<std::string, std::string> options;
};
/// Those for reading, analysing, converting and writing. Ctrl-C cancels.
gable::FileLimits fileLimits(const LimitArguments& arguments);

/// The options of commands that derive rules.
struct DeriveArguments {
  std::string rules;
  std::string shapes;
  /// Which features of --shapes: a layer, and a property or PROPERTY=VALUE.
  std::string layer, only;
  std::string lot;
  /// An upright face in its place.
  std::string face;
  bool cutNested = false;
  std::optional<std::string> start;
  std::vector<std::string> set;
  /// A number, or "random".
  std::string seed = "0";
  std::optional<std::string> project, dialect, style;
  gable::SearchSettings search;
  std::optional<int> jobs;
  bool noSharing = false;
  LimitArguments limits;
  uint64_t maxShapes = 50'000'000;
  uint64_t maxVertices = 200'000'000;
  uint32_t maxWidth = 100'000;
  uint32_t maxDepth = 1024;
  uint64_t maxSteps = 4'000'000'000;
};

/// Coordinates and sizes in metres.
constexpr NumberRange kMetres{-1e7, 1e7};
constexpr NumberRange kDegrees{-3600, 3600};
/// What --box takes.
constexpr const char* kBoxForm = "west,south,east,north, such as 7.41,43.72,7.44,43.75";

/// A number; or "random", which draws a signed integer of 32 bits and says which.
bool parseSeed(const std::string& text, double& seed);

/// Says that an option takes something else than `text`; gives kExitUsage.
int wrongOption(const char* option, const std::string& form, const std::string& text);

/// "glb" of "town.glb"; empty where the name has none.
std::string extensionOf(const std::string& path);

/// kExitDone where the extension of an output is among those; else says which there are and gives
/// kExitUsage.
int checkExtension(const std::string& path, const std::vector<std::string>& extensions);

/// Rules and shapes as the arguments name them; an exit status other than kExitDone when they are
/// not usable (the reason has been printed then).
struct Inputs {
  gable::Rules rules = gable::Rules(nullptr);
  gable::Shapes shapes = gable::Shapes(nullptr);
  gable::DeriveSettings settings;
};
int readInputs(const DeriveArguments& arguments, Inputs& inputs);

/// A rule for a wall that begins with the flat lot: says which option gives a wall.
void tellOfFace(const gable::DiagnosticList& diagnostics, const DeriveArguments& arguments);

/// The exit status that a derivation asks for.
int statusOf(const gable::Model& model);
/// kExitUsage where the command line is to blame for these diagnostics, kExitLimit where a limit or
/// a cancel ended what has them, else `otherwise`.
int statusOf(const gable::DiagnosticList& diagnostics, int otherwise);

/// Largest resident memory so far, in bytes.
int64_t peakBytes();
double secondsNow();

/// Reads a whole file; false, with a message, when that fails.
bool readText(const std::string& path, std::string& text);

/// Writes to a file, or to stdout for "-", which is the answer's `member` with --json; an exit
/// status.
int writeText(const std::string& path, const std::string& text, const char* member = "text");
/// Tables of what the rules reported, to the files that are named; an exit status.
struct ReportArguments {
  std::string all, byShape, rows;
  bool any() const { return !all.empty() || !byShape.empty() || !rows.empty(); }
};
int writeReportTables(const gable::Model& model, const ReportArguments& arguments);
/// The same for --stats: nothing without a path, nor for "-" with --json, whose answer has the
/// counts as members.
int writeCounts(const std::string& path, const std::string& text);

/// `status`, or kExitFile with a message when what was printed has not arrived: a full disk.
int finishOutput(int status);

/// Ctrl-C cancels instead of killing: what was made is still written. A second one, or the signal
/// to end, ends the program at once; what is half written is removed then.
std::atomic<bool>* cancelFlag();
