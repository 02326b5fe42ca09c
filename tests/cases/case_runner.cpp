// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// test_cases [--only NAME] FILE...: runs the cases of .test files and prints what fails, a line
// each, with file, line and case. Exit status 0 when all hold. With GABLE_UPDATE=1 `dump`
// statements are written anew.
//
// A case becomes a small project in a folder of its own, so that imports and assets work as they do
// for users.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>

#include "case_file.h"
#include "engine/impl.h"
#include "expectation.h"
#include "gable/gable.h"
#include "scene/dump.h"

namespace gable::cases {
namespace {

namespace fs = std::filesystem;

/// The rule that `values` sections are evaluated in.
constexpr const char* kValuesRule = "CaseValues";

struct Update {
  size_t line = 0;
  size_t lines = 0;
  std::string text;
};

class FileRun {
 public:
  FileRun(std::string path, std::string only) : path_(std::move(path)), only_(std::move(only)) {}

  /// Runs all cases; returns the number of failures.
  size_t run();

 private:
  void fail(size_t line, const std::string& name, const std::string& message);
  void runCase(const Case& c);
  std::optional<Shapes> shapesOf(const Case& c);
  bool readSettings(const Case& c, DeriveSettings& settings);
  bool readLimit(const Statement& s, Limits& limits);
  void checkValues(const Case& c, const std::vector<std::string>& prints);
  void noteUpdates(const std::vector<Statement>& expected, const std::string& dump);
  void writeUpdates(const std::string& text);

  std::string path_;
  std::string only_;
  size_t failures_ = 0;
  std::vector<Update> updates_;
};

bool updating() {
  const char* value = std::getenv("GABLE_UPDATE");
  return value && *value && std::string_view(value) != "0";
}

void FileRun::fail(size_t line, const std::string& name, const std::string& message) {
  ++failures_;
  std::printf("%s:%zu: %s: %s\n", path_.c_str(), line, name.c_str(), message.c_str());
}

// ------------------------------------------------------------------------------------- values

std::string_view trimmed(std::string_view s) {
  const size_t first = s.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(" \t\r") - first + 1);
}

struct ValueLine {
  std::string expression;
  std::string wanted;
  size_t line = 0;
};

/// The lines of a `values` section; an empty expression where a line is not understood.
std::vector<ValueLine> valueLines(const Section& section) {
  std::vector<ValueLine> result;
  size_t number = section.textLine;
  for (std::string_view line : linesOf(section.text)) {
    const std::string_view whole = trimmed(line);
    const size_t at = whole.rfind(" = ");
    if (!whole.empty() && whole.front() != '#') {
      if (at == std::string_view::npos)
        result.push_back({"", "", number});
      else {
        result.push_back({std::string(trimmed(whole.substr(0, at))),
                          std::string(trimmed(whole.substr(at + 3))), number});
      }
    }
    ++number;
  }
  return result;
}

/// The elements of a printed table: its size, then a line for each row. Cells have no blanks.
std::vector<std::string> tableElements(std::string_view text) {
  std::vector<std::string> elements(1, "[");
  std::istringstream lines{std::string(text.substr(text.find('\n') + 1))};
  for (std::string line; std::getline(lines, line);) {
    if (elements.size() > 1) elements.emplace_back(";");
    std::istringstream cells(line);
    for (std::string cell; cells >> cell;) elements.push_back(cell);
  }
  return elements;
}

/// The elements of "(3)[1,2,3]" or "[1, 2; 3, 4]" without blanks and the size before the bracket;
/// the text itself when it is no array. Row ends stay as ";".
std::vector<std::string> elementsOf(std::string_view text) {
  if (text.starts_with('(') && text.find('\n') != std::string_view::npos) {
    return tableElements(text);
  }
  const size_t open = text.find('[');
  if (open == std::string_view::npos || text.back() != ']') return {std::string(text)};
  std::vector<std::string> elements(1, "[");
  elements.emplace_back();
  for (char c : text.substr(open + 1, text.size() - open - 2)) {
    if (c == ',' || c == ';') {
      if (c == ';') elements.emplace_back(";");
      elements.emplace_back();
    } else if (c != ' ' && c != '"') {
      elements.back() += c;
    }
  }
  return elements;
}

bool sameValue(std::string_view found, std::string_view wanted) {
  if (wanted.size() >= 2 && wanted.front() == '"' && wanted.back() == '"') {
    return found == wanted.substr(1, wanted.size() - 2);
  }
  const std::vector<std::string> a = elementsOf(found), b = elementsOf(wanted);
  if (a.size() != b.size()) return false;
  for (size_t i = 0; i < a.size(); ++i) {
    if (a[i] == b[i]) continue;
    char* end = nullptr;
    const double number = std::strtod(a[i].c_str(), &end);
    size_t used = 0;
    if (a[i].empty() || *end != '\0' || !meets(number, {b[i]}, 0, used)) return false;
  }
  return true;
}

void FileRun::checkValues(const Case& c, const std::vector<std::string>& prints) {
  const Section* section = c.find("values");
  if (!section) return;
  const std::vector<ValueLine> lines = valueLines(*section);
  if (prints.size() != lines.size()) {
    fail(section->line, c.name,
         std::to_string(lines.size()) + " expressions gave " + std::to_string(prints.size()) +
             " values");
    return;
  }
  for (size_t i = 0; i < lines.size(); ++i) {
    if (sameValue(prints[i], lines[i].wanted)) continue;
    fail(lines[i].line, c.name,
         lines[i].expression + ": found " + prints[i] + ", expected " + lines[i].wanted);
  }
}

// ------------------------------------------------------------------------------- what goes in

std::string ruleText(const Case& c) {
  std::string text(c.textOf("rule"));
  if (const Section* values = c.find("values")) {
    text += std::string("\n") + kValuesRule + " -->\n";
    for (const ValueLine& v : valueLines(*values)) text += "  print(" + v.expression + ")\n";
  }
  return text;
}

/// "1,2 3,4 | 5,6": rings of points with so many coordinates each; empty when it is not understood.
std::vector<std::vector<std::vector<double>>> ringsOf(std::string_view text, size_t coordinates) {
  std::vector<std::vector<std::vector<double>>> rings(1);
  const std::string copy(text);
  const char* at = copy.c_str();
  std::vector<double> point;
  while (*at) {
    if (*at == ' ' || *at == ',')
      ++at;
    else if (*at == '|') {
      rings.emplace_back();
      ++at;
    } else {
      char* end = nullptr;
      point.push_back(std::strtod(at, &end));
      if (end == at) return {};
      at = end;
      if (point.size() == coordinates) {
        rings.back().push_back(point);
        point.clear();
      }
    }
  }
  return point.empty() ? rings : std::vector<std::vector<std::vector<double>>>{};
}

Shapes polygonOf(const std::vector<std::vector<std::vector<double>>>& rings) {
  std::vector<Shapes::Ring> plan;
  for (const auto& ring : rings) {
    plan.emplace_back();
    for (const auto& p : ring) plan.back().emplace_back(p[0], p[1]);
  }
  return Shapes::polygon(plan.front(), {plan.begin() + 1, plan.end()});
}

/// A polygon in space, by way of OBJ text.
Shapes faceOf(const std::vector<std::vector<double>>& ring) {
  std::string text, face = "f";
  for (size_t i = 0; i < ring.size(); ++i) {
    for (double v : ring[i])
      text += (text.empty() || text.back() == '\n' ? "v " : " ") + std::to_string(v);
    text += '\n';
    face += " " + std::to_string(i + 1);
  }
  return Shapes::parse(text + face + "\n", "face.obj");
}

std::optional<Shapes> FileRun::shapesOf(const Case& c) {
  const std::string_view text =
      trimmed(linesOf(c.textOf("shape")).empty() ? std::string_view("lot 10x10")
                                                 : linesOf(c.textOf("shape")).front());
  const size_t blank = text.find(' ');
  const std::string_view kind = text.substr(0, blank);
  const std::string rest(blank == std::string_view::npos ? "" : trimmed(text.substr(blank)));
  double width = 0, depth = 0;
  if (kind == "lot" && std::sscanf(rest.c_str(), "%lfx%lf", &width, &depth) == 2) {
    return Shapes::lot(width, depth);
  }
  const auto rings = ringsOf(rest, kind == "face" ? 3 : 2);
  if (kind == "polygon" && !rings.empty()) return polygonOf(rings);
  if (kind == "face" && rings.size() == 1) return faceOf(rings.front());
  for (const Section& s : c.sections) {
    if (kind == "load" && s.name == "file" && s.argument == rest)
      return Shapes::parse(s.text, rest);
  }
  fail(c.find("shape")->line, c.name, "the shape is not understood");
  return std::nullopt;
}

bool FileRun::readLimit(const Statement& s, Limits& limits) {
  if (s.words.size() != 2) return false;
  const double n = std::strtod(s.words[1].c_str(), nullptr);
  if (s.words[0] == "depth")
    limits.depth = static_cast<uint32_t>(n);
  else if (s.words[0] == "width")
    limits.width = static_cast<uint32_t>(n);
  else if (s.words[0] == "shapes")
    limits.shapes = static_cast<uint64_t>(n);
  else if (s.words[0] == "vertices")
    limits.vertices = static_cast<uint64_t>(n);
  else if (s.words[0] == "steps")
    limits.steps = static_cast<uint64_t>(n);
  else if (s.words[0] == "seconds")
    limits.seconds = n;
  else
    return false;
  return true;
}

bool FileRun::readSettings(const Case& c, DeriveSettings& settings) {
  settings.jobs = 1;
  settings.seed = std::strtod(std::string(c.textOf("seed")).c_str(), nullptr);
  const auto start = linesOf(c.textOf("start"));
  if (!start.empty() && !trimmed(start.front()).empty())
    settings.startRule = trimmed(start.front());
  if (c.find("values")) settings.startRule = kValuesRule;
  for (std::string_view line : linesOf(c.textOf("set"))) {
    const size_t at = line.find('=');
    if (trimmed(line).empty()) continue;
    if (at == std::string_view::npos) {
      fail(c.find("set")->line, c.name, "expected name = value");
      return false;
    }
    settings.attributes.emplace_back(trimmed(line.substr(0, at)), trimmed(line.substr(at + 1)));
  }
  if (const Section* limits = c.find("limits")) {
    for (const Statement& s : statements(*limits)) {
      if (readLimit(s, settings.limits)) continue;
      fail(s.line, c.name, "the limit is not understood");
      return false;
    }
  }
  return true;
}

// -------------------------------------------------------------------------------- one case

/// Writes the project of a case; returns the path of its rule file.
std::string makeProject(const Case& c, const std::string& file) {
  const fs::path folder = fs::path(GABLE_CASES_DIR) / fs::path(file).stem() / c.name;
  fs::remove_all(folder);
  fs::create_directories(folder);
  for (const Section& s : c.sections) {
    if (s.name != "file") continue;
    fs::create_directories((folder / s.argument).parent_path());
    std::ofstream(folder / s.argument, std::ios::binary) << s.text;
  }
  std::ofstream(folder / "case.cga", std::ios::binary) << ruleText(c);
  return (folder / "case.cga").string();
}

void add(DiagnosticList& all, const DiagnosticList& more) {
  all.insert(all.end(), more.begin(), more.end());
}

void FileRun::runCase(const Case& c) {
  if ((!c.find("rule") || !c.find("expect")) && !c.find("values")) {
    fail(c.line, c.name, "a case has a rule and expect, or values");
    return;
  }
  const std::optional<Shapes> shapes = shapesOf(c);
  DeriveSettings settings;
  if (!shapes || !readSettings(c, settings)) return;
  const std::string ruleFile = makeProject(c, path_);
  const Rules rules = Rules::load(ruleFile, {fs::path(ruleFile).parent_path().string()});
  Outcome outcome;
  outcome.diagnostics = rules.diagnostics();
  add(outcome.diagnostics, shapes->diagnostics());
  std::optional<Model> model;
  const Scene nothing;
  outcome.scene = &nothing;
  if (rules.ok() && shapes->ok()) {
    model = derive(rules, *shapes, settings);
    add(outcome.diagnostics, model->diagnostics());
    outcome.scene = &model->impl().result.scene;
    outcome.dump = dumpText(*outcome.scene);
    settings.sharing = false;
    const Model alone = derive(rules, *shapes, settings);
    if (dumpText(alone.impl().result.scene) != outcome.dump) {
      fail(c.line, c.name, "the model differs when sharing is off");
    }
    checkValues(c, outcome.scene->prints);
  }
  const Section* expect = c.find("expect");
  const std::vector<Statement> expected = expect ? statements(*expect) : std::vector<Statement>{};
  if (updating()) noteUpdates(expected, outcome.dump);
  for (const Failure& f : failures(expected, outcome)) {
    if (updating() && f.message.starts_with("dump:")) continue;
    fail(f.line ? f.line : c.line, c.name, f.message);
  }
}

// ------------------------------------------------------------------------------- the file

/// Dumps are indented four columns: two for the section, two for the statement.
void FileRun::noteUpdates(const std::vector<Statement>& expected, const std::string& dump) {
  for (const Statement& s : expected) {
    if (s.words[0] != "dump") continue;
    std::string text;
    for (std::string_view line : linesOf(dump)) text += "    " + std::string(line) + "\n";
    updates_.push_back({s.line, linesOf(s.block).size(), text});
  }
}

void FileRun::writeUpdates(const std::string& text) {
  const std::vector<std::string_view> lines = linesOf(text);
  std::ofstream out(path_, std::ios::binary);
  size_t next = 0;
  for (size_t i = 0; i < lines.size(); ++i) {
    out << lines[i] << '\n';
    if (next < updates_.size() && updates_[next].line == i + 1) {
      out << updates_[next].text;
      i += updates_[next].lines;
      ++next;
    }
  }
}

size_t FileRun::run() {
  std::ifstream stream(path_, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const CaseFile file = parseCases(text);
  for (const std::string& error : file.errors) fail(0, "file", error);
  size_t ran = 0;
  for (const Case& c : file.cases) {
    if (!only_.empty() && c.name != only_) continue;
    runCase(c);
    ++ran;
  }
  if (!updates_.empty()) writeUpdates(text);
  std::printf("%s: %zu cases, %zu failures\n", path_.c_str(), ran, failures_);
  return failures_;
}

}  // namespace
}  // namespace gable::cases

int main(int argc, char** argv) {
  size_t failures = 0;
  std::string only;
  int first = 1;
  if (argc > 2 && std::string_view(argv[1]) == "--only") {
    only = argv[2];
    first = 3;
  }
  for (int i = first; i < argc; ++i) failures += gable::cases::FileRun(argv[i], only).run();
  if (first >= argc) std::printf("test_cases: no file was given\n");
  return failures == 0 && first < argc ? 0 : 1;
}
