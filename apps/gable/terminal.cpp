// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "answer.h"
#include "common.h"
#include "progress.h"

namespace {

constexpr const char* kPlain = "\033[0m";
constexpr const char* kBold = "\033[1m";
constexpr const char* kRed = "\033[1;31m";
constexpr const char* kYellow = "\033[1;33m";
constexpr const char* kCyan = "\033[36m";
constexpr const char* kGreen = "\033[32m";

std::string valueOf(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

std::string inked(const char* ink, std::string_view text) {
  return ink + std::string(text) + kPlain;
}

/// "house.cga:3:7: error: .." with a bold place and a coloured word; empty where it is no such
/// line.
std::string paintedHead(std::string_view line) {
  const std::pair<std::string_view, const char*> kinds[] = {
      {"error: ", kRed}, {"warning: ", kYellow}, {"note: ", kCyan}};
  size_t best = std::string_view::npos;
  std::string out;
  for (const auto& [word, ink] : kinds) {
    const size_t at = line.find(word);
    // At the beginning, or behind "place: ".
    if (at >= best || (at > 0 && (at < 2 || line.substr(at - 2, 2) != ": "))) continue;
    best = at;
    out = (at > 0 ? inked(kBold, line.substr(0, at)) : "") +
          inked(ink, line.substr(at, word.size())) + std::string(line.substr(at + word.size()));
  }
  return out;
}

std::string paintedLine(std::string_view line) {
  constexpr std::string_view kHint = "  hint: ";
  if (line.starts_with(kHint)) {
    return inked(kCyan, kHint) + std::string(line.substr(kHint.size()));
  }
  if (!line.starts_with(' ')) {
    if (std::string head = paintedHead(line); !head.empty()) return head;
  }
  const bool caret = line.find('^') != std::string_view::npos &&
                     line.find_first_not_of(" ^~|\t") == std::string_view::npos;
  return caret ? inked(kGreen, line) : std::string(line);
}

// Of tell() and put(), on the main thread alone.
bool told = false;
// Of print(), likewise.
bool warned = false;

}  // namespace

TerminalOptions& terminal() {
  static TerminalOptions options;
  return options;
}

bool isScreen(std::FILE* stream) {
  return isatty(fileno(stream)) != 0 && valueOf("TERM") != "dumb";
}

bool hasColors(std::FILE* stream) {
  if (terminal().color != "auto") return terminal().color == "always";
  if (!valueOf("NO_COLOR").empty()) return false;
  const std::string force = valueOf("CLICOLOR_FORCE");
  if (!force.empty() && force != "0") return true;
  return isScreen(stream) && valueOf("CLICOLOR") != "0";
}

int terminalColumns() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

std::string painted(const std::string& diagnostics, std::FILE* stream) {
  if (!hasColors(stream)) return diagnostics;
  std::string out;
  for (size_t begin = 0; begin < diagnostics.size();) {
    const size_t end = std::min(diagnostics.find('\n', begin), diagnostics.size() - 1);
    const std::string_view line(diagnostics.data() + begin, end + 1 - begin);
    const bool ended = line.ends_with('\n');
    out += paintedLine(line.substr(0, line.size() - (ended ? 1 : 0))) + (ended ? "\n" : "");
    begin = end + 1;
  }
  return out;
}

void print(const gable::DiagnosticList& diagnostics, std::FILE* stream) {
  warned = warned || std::any_of(diagnostics.begin(), diagnostics.end(), [](const auto& d) {
             return d.severity == gable::Diagnostic::Severity::Warning;
           });
  if (terminal().json) {
    answer().add(diagnostics);
    return;
  }
  gable::DiagnosticList shown = diagnostics;
  if (terminal().quiet) std::erase_if(shown, [](const auto& d) { return !d.isError(); });
  if (shown.empty()) return;
  const Progress::Pause pause;
  std::fputs(painted(gable::render(shown), stream).c_str(), stream);
}

void tell(const std::string& text) {
  if (terminal().json || terminal().quiet) return;
  told = true;
  const Progress::Pause pause;
  std::fputs(text.c_str(), stdout);
}

void put(const std::string& text) {
  if (terminal().json) return;
  told = true;
  const Progress::Pause pause;
  std::fputs(text.c_str(), stdout);
}

bool hasWarned() { return std::exchange(warned, false); }

int strictStatus(int status, bool strict) {
  return status == kExitDone && strict && hasWarned() ? kExitWrong : status;
}

bool hasTold() { return std::exchange(told, false); }

void note(const std::string& text) {
  if (terminal().json || terminal().quiet) return;
  const Progress::Pause pause;
  std::fprintf(stderr, "%s\n", text.c_str());
}

void printLines(const std::vector<std::string>& lines, std::FILE* stream) {
  if (lines.empty()) return;
  const Progress::Pause pause;
  for (const std::string& line : lines) std::fprintf(stream, "%s\n", line.c_str());
}

int fail(int status, const std::string& message, const std::string& hint) {
  if (terminal().json) {
    gable::Diagnostic d;
    d.code = status == kExitUsage ? "command-line" : "command";
    d.message = message;
    d.hint = hint;
    answer().add({d});
    return status;
  }
  const Progress::Pause pause;
  const std::string name = "gable: ";
  std::fputs((hasColors(stderr) ? inked(kRed, name) : name).c_str(), stderr);
  std::fprintf(stderr, "%s\n", message.c_str());
  if (!hint.empty()) std::fputs(painted("  hint: " + hint + "\n", stderr).c_str(), stderr);
  return status;
}
