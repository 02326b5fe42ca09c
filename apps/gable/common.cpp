// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "common.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <mutex>
#include <random>
#include <sstream>

#include "answer.h"
#include "derive_settings.h"
#include "gable/files.h"
#include "gable/writing.h"
#include "progress.h"

bool parseSeed(const std::string& text, double& seed) {
  if (text == "random") {
    seed = static_cast<int32_t>(std::random_device{}());
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.0f", seed);
    answer().member("seed", digits);
    note(std::string("seed ") + digits);
    return true;
  }
  return parseNumber(text, {}, seed);
}

int wrongOption(const char* option, const std::string& form, const std::string& text) {
  return fail(kExitUsage, std::string(option) + " takes " + form + ", not '" + text + "'");
}

std::string extensionOf(const std::string& path) {
  const size_t dot = path.rfind('.');
  return dot == std::string::npos ? std::string() : path.substr(dot + 1);
}

int checkExtension(const std::string& path, const std::vector<std::string>& extensions) {
  std::string lower = path;
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  std::string known;
  for (const std::string& e : extensions) {
    if (lower.ends_with("." + e)) return kExitDone;
    known += (known.empty() ? "." : " .") + e;
  }
  return wrongOption("--output", "a file name with an ending that says its format (" + known + ")",
                     path);
}

gable::FileLimits fileLimits(const LimitArguments& arguments) {
  gable::FileLimits limits;
  if (arguments.maxSeconds) limits.seconds = arguments.maxSeconds;
  if (arguments.maxSeconds == 0.0) limits.seconds.reset();
  limits.bytes.reset();
  if (arguments.maxMegabytes > 0) limits.bytes = arguments.maxMegabytes << 20;
  limits.cancel = cancelFlag();
  return limits;
}

int deriveSettings(const DeriveArguments& arguments, gable::DeriveSettings& s) {
  s.startRule = arguments.start;
  if (!parseSeed(arguments.seed, s.seed)) {
    return wrongOption("--seed", "a number or the word random", arguments.seed);
  }
  s.sharing = !arguments.noSharing;
  s.jobs = arguments.jobs;
  if (arguments.limits.maxSeconds > 0.0) s.limits.seconds = arguments.limits.maxSeconds;
  s.limits.shapes = arguments.maxShapes;
  s.limits.vertices = arguments.maxVertices;
  s.limits.width = arguments.maxWidth;
  s.limits.depth = arguments.maxDepth;
  s.limits.steps = arguments.maxSteps;
  s.limits.bytes = fileLimits(arguments.limits).bytes;
  s.cancel = cancelFlag();
  for (const std::string& pair : arguments.set) {
    const size_t equals = pair.find('=');
    if (equals == std::string::npos || equals == 0) {
      return wrongOption("--set", "NAME=VALUE", pair);
    }
    s.attributes.emplace_back(pair.substr(0, equals), pair.substr(equals + 1));
  }
  return kExitDone;
}

gable::FeatureSelection selectionOf(const DeriveArguments& arguments) {
  const size_t equals = arguments.only.find('=');
  gable::FeatureSelection selection{arguments.layer, arguments.only.substr(0, equals), {}};
  if (equals != std::string::npos) selection.value = arguments.only.substr(equals + 1);
  return selection;
}

int readRules(const DeriveArguments& arguments, gable::Rules& rules) {
  gable::LoadSettings load{arguments.project, arguments.dialect, arguments.style, arguments.search};
  load.limits = fileLimits(arguments.limits);
  {
    const Progress progress("reading " + arguments.rules);
    rules = gable::Rules::load(arguments.rules, load);
  }
  print(rules.diagnostics());
  if (!rules.found()) return kExitFile;
  return rules.ok() ? kExitDone : statusOf(rules.diagnostics(), kExitWrong);
}

namespace {

// Rules of a folder may be made for a lot that generate.args beside them tells.
void tellUsualLot(const std::string& rules) {
  const size_t slash = rules.find_last_of('/');
  const std::string path =
      (slash == std::string::npos ? "" : rules.substr(0, slash + 1)) + "generate.args";
  const gable::RuleText told = gable::readRuleText(path);
  std::istringstream words(told.ok ? told.text : std::string());
  for (std::string word, lot; words >> word;) {
    if (word != "--lot" || !(words >> lot)) continue;
    gable::Diagnostic d;
    d.severity = gable::Diagnostic::Severity::Note;
    d.code = "usual-lot";
    d.message = "without --lot the lot is 20x20 m; " + path + " has --lot " + lot;
    d.rendered = "note: " + d.message + " [" + d.code + "]\n";
    print({d});
    return;
  }
}

}  // namespace

int readInputs(const DeriveArguments& arguments, Inputs& inputs) {
  const gable::FileLimits limits = fileLimits(arguments.limits);
  if (const int status = readRules(arguments, inputs.rules)) return status;
  if (!arguments.shapes.empty()) {
    const Progress progress("reading " + arguments.shapes);
    inputs.shapes = gable::Shapes::load(arguments.shapes, limits, selectionOf(arguments));
  } else {
    const bool isFace = !arguments.face.empty();
    const std::string& given = isFace ? arguments.face : arguments.lot;
    double sides[2] = {20, 20};
    if (!given.empty() && !parseExtent(given, {1e-300, kMetres.most}, sides)) {
      return isFace
                 ? wrongOption("--face", "width x height in metres, such as 12x9", given)
                 : wrongOption("--lot",
                               "width x depth in metres, such as 30x40, or one number for a square",
                               given);
    }
    if (given.empty()) tellUsualLot(arguments.rules);
    inputs.shapes =
        isFace ? gable::Shapes::face(sides[0], sides[1]) : gable::Shapes::lot(sides[0], sides[1]);
  }
  print(inputs.shapes.diagnostics());
  if (arguments.cutNested && inputs.shapes.size() > 0) {
    inputs.shapes = inputs.shapes.withNestedCut(limits);
    if (inputs.shapes.size() == 0) print(inputs.shapes.diagnostics());
  }
  if (!inputs.shapes.found()) return kExitFile;
  if (!inputs.shapes.ok() && inputs.shapes.size() == 0) {
    return statusOf(inputs.shapes.diagnostics(), kExitWrong);
  }
  return deriveSettings(arguments, inputs.settings);
}

void tellOfFace(const gable::DiagnosticList& diagnostics, const DeriveArguments& arguments) {
  if (!arguments.shapes.empty() || !arguments.face.empty()) return;
  const bool flat = std::any_of(diagnostics.begin(), diagnostics.end(), [](const auto& d) {
    return d.code == "split-flat" && d.message.find(" in y") != std::string::npos;
  });
  if (!flat) return;
  gable::Diagnostic d;
  d.severity = gable::Diagnostic::Severity::Note;
  d.code = "usual-lot";
  d.message = "the rules begin with a flat lot; --face 12x9 gives a wall in its place";
  d.rendered = "note: " + d.message + " [" + d.code + "]\n";
  print({d});
}

gable::Model& heldModel() {
  static gable::Model& model = *new gable::Model(nullptr);
  return model;
}

void deriveHeld(const gable::Rules& rules, const gable::Shapes& shapes,
                gable::DeriveSettings settings) {
  heldModel() = gable::Model(nullptr);
  Progress progress("deriving", "shapes");
  settings.progress = progress.callback();
  heldModel() = gable::derive(rules, shapes, settings);
}

gable::Model deriveModel(const gable::Rules& rules, const gable::Shapes& shapes,
                         const gable::DeriveSettings& settings, std::FILE* prints) {
  deriveHeld(rules, shapes, settings);
  const gable::Model& held = heldModel();
  print(held.diagnostics());
  printLines(held.prints(), prints);
  return held;
}

int writeSettings(const WriteArguments& arguments, const std::string& path,
                  const LimitArguments& limits, gable::WriteSettings& settings) {
  const std::string extension = extensionOf(path);
  if (!arguments.profile.empty() && extension != "glb" && extension != "gltf") {
    return fail(kExitUsage,
                "'--for " + arguments.profile + "' is for .glb and .gltf, not for '" + path + "'");
  }
  gable::WriteChoices choices;
  for (const auto& [name, value] : arguments.options) {
    if (!value.empty()) choices.emplace_back(name, value);
  }
  const gable::ChosenWriting chosen = gable::chosenWriting(arguments.profile, choices);
  print(chosen.diagnostics);
  if (!chosen.ok) return kExitUsage;
  const gable::DiagnosticList unfit = gable::unfitChoices(path, choices);
  print(unfit);
  if (gable::hasErrors(unfit)) return kExitUsage;
  const gable::DiagnosticList clashes = gable::writeClashes(path, chosen.settings);
  print(clashes);
  if (gable::hasErrors(clashes)) return kExitUsage;
  settings = chosen.settings;
  settings.limits = fileLimits(limits);
  return kExitDone;
}

namespace {

// An artist who asks for one atlas is told what is not in it.
void tellAtlas(const gable::WriteResult::Atlas& a) {
  const uint32_t left = a.repeating + a.special + a.large;
  if (left == 0) return;
  std::string why;
  const auto add = [&](uint32_t count, const char* what) {
    if (count > 0) why += (why.empty() ? "" : ", ") + std::to_string(count) + what;
  };
  add(a.repeating, " that repeat their pictures");
  add(a.special, " with maps of their own");
  add(a.large, " that have no room in it");
  note("the atlas joins " + std::to_string(a.merged) + " materials to " + std::to_string(a.into) +
       "; outside of it stay " + why);
}

}  // namespace

int writeModel(const gable::Model& model, const std::string& path,
               const gable::WriteSettings& settings, gable::RunFigures& figures) {
  const double begin = secondsNow();
  const gable::WriteResult written = [&] {
    const Progress progress("writing " + path);
    return model.write(path, settings);
  }();
  print(written.diagnostics);
  if (!written.ok) return statusOf(written.diagnostics, kExitFile);
  figures.after = written.diagnostics;
  for (const std::string& file : written.models) answer().wrote(file);
  figures.deriveSeconds = model.deriveSeconds();
  figures.writeSeconds = secondsNow() - begin;
  if (written.triangles > 0) figures.triangles = written.triangles;
  figures.fileBytes = written.bytes;
  figures.savedBytes = written.savedBytes;
  figures.atlas = written.atlas;
  if (written.atlas) tellAtlas(*written.atlas);
  return kExitDone;
}

namespace {

bool hasCode(const gable::DiagnosticList& diagnostics, std::initializer_list<const char*> codes) {
  return std::any_of(diagnostics.begin(), diagnostics.end(), [&](const auto& d) {
    return std::find(codes.begin(), codes.end(), d.code) != codes.end();
  });
}

// What only the command line says, also where it is found out with the rules and the shapes.
// What a shape brings is a warning.
bool isOfCommandLine(const gable::DiagnosticList& diagnostics) {
  return std::any_of(diagnostics.begin(), diagnostics.end(), [](const auto& d) {
    return d.isError() &&
           hasCode({d}, {"attribute-value", "picture-settings", "dataset-settings", "tiles-job"});
  });
}

}  // namespace

int statusOf(const gable::Model& model) {
  if (isOfCommandLine(model.diagnostics())) return kExitUsage;
  if (gable::hasErrors(model.diagnostics())) return kExitWrong;
  return model.end() == gable::End::Done ? kExitDone : kExitLimit;
}

int statusOf(const gable::DiagnosticList& diagnostics, int otherwise) {
  if (isOfCommandLine(diagnostics)) return kExitUsage;
  const bool limited = hasCode(diagnostics, {"out-of-time", "out-of-memory", "was-cancelled"});
  return limited ? static_cast<int>(kExitLimit) : otherwise;
}

int64_t peakBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<int64_t>(usage.ru_maxrss) * 1024;
}

double secondsNow() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

bool readText(const std::string& path, std::string& text) {
  gable::RuleText read = gable::readRuleText(path);
  print(read.diagnostics);
  text = std::move(read.text);
  return read.ok;
}

int writeText(const std::string& path, const std::string& text, const char* member) {
  if (path == "-" && terminal().json) {
    answer().text(member, text);
    return kExitDone;
  }
  if (path == "-") {
    std::fwrite(text.data(), 1, text.size(), stdout);
    return kExitDone;
  }
  const gable::WriteResult written = gable::writeTextFile(path, text);
  print(written.diagnostics);
  if (written.ok) answer().wrote(path);
  return written.ok ? kExitDone : kExitFile;
}

int writeReportTables(const gable::Model& model, const ReportArguments& arguments) {
  if (!arguments.all.empty()) {
    const std::string table = gable::reportsCsv(model.statistics().reports);
    if (const int status = writeText(arguments.all, table, "table")) return status;
  }
  if (arguments.byShape.empty() && arguments.rows.empty()) return kExitDone;
  const std::vector<gable::ShapeReports> shapes = model.reportsByShape();
  if (!arguments.byShape.empty()) {
    const std::string table = gable::reportsCsv(shapes);
    if (const int status = writeText(arguments.byShape, table, "tableByShape")) return status;
  }
  if (arguments.rows.empty()) return kExitDone;
  return writeText(arguments.rows, gable::reportsTable(shapes), "tableOfRows");
}

int writeCounts(const std::string& path, const std::string& text) {
  if (path.empty() || (path == "-" && terminal().json)) return kExitDone;
  return writeText(path, text);
}

int finishOutput(int status) {
  const bool flushed = std::fflush(stdout) == 0;
  if (flushed && std::ferror(stdout) == 0) return status;
  terminal().json = false;
  return fail(kExitFile, "the output could not be written; see that there is room for it");
}

namespace {

[[noreturn]] void endAtOnce(int signal) {
  gable::removeUnfinishedFiles();
  std::_Exit(128 + signal);
}

}  // namespace

std::atomic<bool>* cancelFlag() {
  static std::atomic<bool> flag{false};
  static std::once_flag once;
  std::call_once(once, [] {
    const auto handle = [](int signal, void (*handler)(int)) {
      // What the caller has set to be ignored, as nohup does, stays so.
      if (std::signal(signal, handler) == SIG_IGN) std::signal(signal, SIG_IGN);
    };
    handle(SIGINT, [](int signal) {
      if (flag.exchange(true)) endAtOnce(signal);
    });
    handle(SIGTERM, endAtOnce);
    handle(SIGHUP, endAtOnce);
  });
  return &flag;
}
