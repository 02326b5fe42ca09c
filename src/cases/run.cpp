// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rules that a case writes itself stand in its test file's project, so that they can import what is
// to be tested. A case with `file` sections becomes a small project in a folder of its own instead,
// so that imports and assets work as they do for users.

#include "cases/run.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "base/allowance.h"
#include "base/files.h"
#include "base/number.h"
#include "base/temporary_folder.h"
#include "cases/plan.h"
#include "cases/start_shape.h"
#include "cases/values.h"
#include "engine/guard.h"
#include "engine/impl.h"
#include "geom/region/boolean.h"
#include "scene/dump.h"

namespace gable::cases {
namespace {

namespace fs = std::filesystem;

constexpr const char* kShapeForms =
    "the shape is not understood; expected: lot 20x10, polygon X,Y X,Y .., face 12x9, "
    "face X,Y,Z .. or load FILE";

/// The rule that `values` sections are evaluated in.
constexpr const char* kValuesRule = "CaseValues";

std::string ruleText(const Case& c) {
  std::string text(c.textOf("rule"));
  if (const Section* values = c.find("values")) {
    text += std::string("\n") + kValuesRule + " -->\n";
    for (const ValueLine& v : valueLines(*values)) text += "  print(" + v.expression + ")\n";
  }
  return text;
}

/// The first line of a section that holds one word; empty where there is none.
std::string wordOf(const Case& c, std::string_view section) {
  const auto lines = linesOf(c.textOf(section));
  return lines.empty() ? std::string() : std::string(trimmed(lines.front()));
}

bool readLimit(const Statement& s, Limits& limits) {
  double n = 0;
  if (s.words.size() != 2 || !parseNumber(s.words[1], n) || !(n >= 0) || n > 1e15) return false;
  const auto small = static_cast<uint32_t>(std::min(n, 4294967295.0));
  const auto large = static_cast<uint64_t>(n);
  const std::string& word = s.words[0];
  if (word == "depth") return limits.depth = small, true;
  if (word == "width") return limits.width = small, true;
  if (word == "shapes") return limits.shapes = large, true;
  if (word == "vertices") return limits.vertices = large, true;
  if (word == "steps") return limits.steps = large, true;
  if (word == "seconds") return limits.seconds = n, true;
  return false;
}

/// Writes the project of a case with files of its own; empty when all is written.
std::string writeProject(const Case& c, const std::string& folder) {
  for (const Section& s : c.sections) {
    if (s.name != "file") continue;
    const fs::path path = (fs::path(folder) / s.argument).lexically_normal();
    const std::string below = path.lexically_relative(folder).string();
    if (s.argument.empty() || below.empty() || below.starts_with("..")) {
      return "'file' names a file below the case's own folder, not '" + s.argument + "'";
    }
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    const Result<uint64_t> written = writeFile(path.string(), s.text);
    if (!written.ok()) return written.error().message;
  }
  return {};
}

/// `7`, or whole numbers as `0..19`; empty where it is neither.
std::vector<double> seedsOf(const std::string& text) {
  constexpr double kMost = 10'000;
  const size_t dots = text.find("..");
  double first = 0, last = 0;
  if (!parseNumber(text.substr(0, dots), first)) return {};
  if (dots == std::string::npos) return {first};
  if (!parseNumber(text.substr(dots + 2), last) || first != std::floor(first) ||
      last != std::floor(last) || last < first || last - first >= kMost) {
    return {};
  }
  std::vector<double> seeds;
  for (double seed = first; seed <= last; ++seed) seeds.push_back(seed);
  return seeds;
}

/// What a file can hold of one model only.
bool isOfOneModel(const Statement& s) {
  return s.words[0] == "dump" || s.words[0] == "scene" || s.words[0] == "picture";
}

void add(DiagnosticList& all, const DiagnosticList& more) {
  all.insert(all.end(), more.begin(), more.end());
}

Region lotOf(const Shapes& shapes) {
  Region lot;
  for (const ShapeFootprint& f : shapes.impl().footprints) {
    lot = unite(lot, planOf(transformed(f.mesh, {1, 1, 1}, f.origin)));
  }
  return lot;
}

double groundOf(const Shapes& shapes) {
  Box3 box;
  for (const ShapeFootprint& f : shapes.impl().footprints) {
    box.include(transformed(f.mesh, {1, 1, 1}, f.origin).bounds());
  }
  return box.empty() ? 0 : box.min.y;
}

}  // namespace

CaseRun::CaseRun(const Case& c, const std::string& file, const CaseSettings& settings)
    : case_(c),
      settings_(settings),
      folder_(fs::path(file).parent_path().string()),
      golden_(folder_, settings.update, settings.limits) {
  result_.name = c.name;
  result_.line = static_cast<uint32_t>(c.line);
}

void CaseRun::fail(size_t line, const std::string& message) {
  result_.failures.push_back({static_cast<uint32_t>(line ? line : case_.line), message});
}

void CaseRun::failAt(const char* section, const std::string& message) {
  const Section* s = case_.find(section);
  fail(!s ? 0 : trimmed(s->text).empty() ? s->line : s->textLine, message);
}

bool CaseRun::stopped() const { return settings_.cancel && settings_.cancel->load(); }

CaseResult CaseRun::run() {
  const double begin = now();
  if (!case_.errors.empty()) {
    result_.failures = case_.errors;
    return std::move(result_);
  }
  try {
    // Derivations and files have limits of their own; all else hears the wish to stop.
    Allowance allowance({{}, {}, settings_.cancel});
    const WorkScope scope(allowance);
    if (!stopped()) runCase();
  } catch (...) {
    fail(0, diagnosticOfException().message);
  }
  if (stopped()) {
    // Half a model says nothing.
    result_.failures.clear();
    updates_.clear();
    fail(0, "stopped before its end");
  }
  result_.seconds = now() - begin;
  return std::move(result_);
}

Rules CaseRun::loadRules() {
  LoadSettings load;
  load.project = settings_.project;
  load.search = settings_.search;
  if (case_.find("file")) load.project = folder_;
  load.limits = settings_.limits;
  if (const std::string style = wordOf(case_, "style"); !style.empty()) load.style = style;
  if (const std::string named = wordOf(case_, "rules"); !named.empty()) {
    return Rules::load((fs::path(folder_) / named).string(), load);
  }
  return Rules::parse(ruleText(case_), (fs::path(folder_) / "case.cga").string(), load);
}

bool CaseRun::readAttributes(DeriveSettings& derive) {
  const Section* set = case_.find("set");
  size_t number = set ? set->textLine : 0;
  for (std::string_view line : linesOf(case_.textOf("set"))) {
    const size_t here = number++;
    const size_t at = line.find('=');
    if (trimmed(line).empty()) continue;
    if (at == std::string_view::npos) {
      fail(here, "expected name = value, not '" + std::string(trimmed(line)) + "'");
      return false;
    }
    derive.attributes.emplace_back(trimmed(line.substr(0, at)), trimmed(line.substr(at + 1)));
    setLines_.emplace_back("'" + derive.attributes.back().first + "'", here);
  }
  return true;
}

bool CaseRun::readSettings(DeriveSettings& derive) {
  derive.jobs = 1;
  derive.limits.bytes = settings_.limits.bytes;
  derive.limits.seconds = settings_.limits.seconds;
  derive.cancel = settings_.cancel;
  if (const std::string start = wordOf(case_, "start"); !start.empty()) derive.startRule = start;
  if (case_.find("values")) derive.startRule = kValuesRule;
  if (const Section* limits = case_.find("limits")) {
    for (const Statement& s : statements(*limits)) {
      const std::string stray = strayLines(s);
      if (stray.empty() && readLimit(s, derive.limits)) continue;
      fail(s.line, stray.empty() ? "the limit is not understood" : stray);
      return false;
    }
  }
  return readAttributes(derive);
}

std::optional<std::vector<double>> CaseRun::readSeeds() {
  const std::string text = wordOf(case_, "seed");
  if (text.empty()) return std::vector<double>{DeriveSettings().seed};
  std::vector<double> seeds = seedsOf(text);
  if (seeds.empty()) {
    failAt("seed", "'" + text + "' is neither a number nor a range such as 0..19");
    return std::nullopt;
  }
  const Section* expect = case_.find("expect");
  if (seeds.size() == 1 || !expect) return seeds;
  for (const Statement& s : statements(*expect)) {
    if (!isOfOneModel(s)) continue;
    fail(s.line, s.words[0] + " is of one model, so the case needs a single seed");
    return std::nullopt;
  }
  return seeds;
}

void CaseRun::runCase() {
  const bool rules = case_.find("rule") || case_.find("rules");
  if ((!rules || !case_.find("expect")) && !case_.find("values")) {
    fail(0, "a case has 'rule' or 'rules' with 'expect', or 'values'");
    return;
  }
  const Section* expect = case_.find("expect");
  if (expect && statements(*expect).empty()) return failAt("expect", "it expects nothing");
  if (case_.find("rules") && (case_.find("rule") || case_.find("values") || case_.find("file"))) {
    failAt("rules", "'rules' names a rule file, so 'rule', 'values' and 'file' have no place");
    return;
  }
  std::optional<TemporaryFolder> own;
  if (case_.find("file")) {
    own.emplace();
    folder_ = own->path();
    const std::string why =
        folder_.empty() ? "there is no folder for temporary files" : writeProject(case_, folder_);
    if (!why.empty()) return failAt("file", why);
  }
  const std::optional<Shapes> shapes = startShape(case_, folder_, settings_.limits);
  if (!shapes) return failAt("shape", kShapeForms);
  DeriveSettings derived;
  if (!readSettings(derived)) return;
  const std::optional<std::vector<double>> seeds = readSeeds();
  if (!seeds) return;
  const Rules rulesOfCase = loadRules();
  Outcome outcome;
  outcome.diagnostics = rulesOfCase.diagnostics();
  add(outcome.diagnostics, shapes->diagnostics());
  const Scene nothing;
  outcome.scene = &nothing;
  outcome.golden = &golden_;
  if (!rulesOfCase.ok() || !shapes->ok()) return judge(outcome);
  outcome.lot = lotOf(*shapes);
  outcome.ground = groundOf(*shapes);
  runSeeds(rulesOfCase, *shapes, derived, *seeds, outcome);
}

void CaseRun::runSeeds(const Rules& rules, const Shapes& shapes, DeriveSettings derived,
                       const std::vector<double>& seeds, const Outcome& loaded) {
  derived.seed = seeds[0];
  if (seeds.size() == 1) return runSeed(rules, shapes, derived, loaded);
  // By line: how a statement failed first, and with how many seeds.
  struct Told {
    CaseFailure failure;
    double seed = 0;
    size_t seeds = 0;
  };
  std::map<uint32_t, Told> told;
  for (const double seed : seeds) {
    derived.seed = seed;
    runSeed(rules, shapes, derived, loaded);
    if (stopped()) return;
    std::set<uint32_t> lines;
    for (CaseFailure& f : result_.failures) {
      if (!lines.insert(f.line).second) continue;
      Told& t = told.try_emplace(f.line, Told{f, seed, 0}).first->second;
      ++t.seeds;
    }
    result_.failures.clear();
  }
  for (const auto& [line, t] : told) {
    const std::string others = t.seeds > 1 ? " and " + std::to_string(t.seeds - 1) + " more" : "";
    result_.failures.push_back(
        {line, "with seed " + shortestText(t.seed) + others + ": " + t.failure.message});
  }
}

void CaseRun::runSeed(const Rules& rules, const Shapes& shapes, DeriveSettings derived,
                      Outcome outcome) {
  const Model model = derive(rules, shapes, derived);
  add(outcome.diagnostics, model.diagnostics());
  outcome.model = &model;
  outcome.scene = &model.impl().result.scene;
  outcome.dump = dumpText(*outcome.scene);
  derived.sharing = false;
  const Model alone = derive(rules, shapes, derived);
  if (dumpText(alone.impl().result.scene) != outcome.dump) {
    fail(0, "the model differs when sharing is off");
  }
  checkValues(outcome.scene->prints);
  if (!stopped()) judge(outcome);
}

void CaseRun::checkValues(const std::vector<std::string>& prints) {
  const Section* section = case_.find("values");
  if (!section) return;
  const std::vector<ValueLine> lines = valueLines(*section);
  if (prints.size() != lines.size()) {
    fail(section->line, std::to_string(lines.size()) + " expressions gave " +
                            std::to_string(prints.size()) + " values");
    return;
  }
  for (size_t i = 0; i < lines.size(); ++i) {
    if (sameValue(prints[i], lines[i].wanted)) continue;
    fail(lines[i].line,
         lines[i].expression + ": found " + prints[i] + ", expected " + lines[i].wanted);
  }
}

// Where a message without a place has its cause: what the case sets, or the rule that it starts
// with.
size_t CaseRun::lineOf(const CaseFailure& f) const {
  const auto has = [&](std::string_view text) { return f.message.find(text) != std::string::npos; };
  if (f.line > 0) return f.line;
  const Section* start = case_.find("start");
  if (start && has("[unknown-start-rule]")) return start->textLine;
  if (!has("[unknown-attribute]") && !has("[attribute-value]") && !has("[not-settable]")) return 0;
  // The hint may name another.
  size_t line = 0, least = std::string::npos;
  for (const auto& [name, at] : setLines_) {
    const size_t place = f.message.find(name);
    if (place >= least) continue;
    least = place;
    line = at;
  }
  return line;
}

void CaseRun::judge(const Outcome& outcome) {
  const Section* expect = case_.find("expect");
  const std::vector<Statement> expected = expect ? statements(*expect) : std::vector<Statement>{};
  if (settings_.update) noteUpdates(expected, outcome.dump);
  for (const CaseFailure& f : failures(expected, outcome)) {
    if (settings_.update && f.message.starts_with("dump:")) continue;
    fail(lineOf(f), f.message);
  }
}

/// Dumps are indented four columns: two for the section, two for the statement.
void CaseRun::noteUpdates(const std::vector<Statement>& expected, const std::string& dump) {
  for (const Statement& s : expected) {
    if (s.words[0] != "dump") continue;
    std::string text;
    for (std::string_view line : linesOf(dump)) text += "    " + std::string(line) + "\n";
    updates_.push_back({s.line, linesOf(s.block).size(), text});
  }
}

}  // namespace gable::cases
