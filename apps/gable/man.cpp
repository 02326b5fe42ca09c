// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// gable man: pages for man(1), in the macros of man(7). They carry a version and no date, so that
// the same program writes the same bytes.

#include <algorithm>
#include <filesystem>

#include "answer.h"
#include "common.h"
#include "describe.h"
#include "version.h"

namespace {

namespace fs = std::filesystem;

/// As text of roff: no line becomes a request, and a hyphen of an option stays one.
std::string roff(const std::string& text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool lineBegins = i == 0 || text[i - 1] == '\n';
    if (lineBegins && (text[i] == '.' || text[i] == '\'')) out += "\\&";
    if (text[i] == '\\')
      out += "\\e";
    else if (text[i] == '-')
      out += "\\-";
    else if (text[i] == '\'')
      out += "\\(aq";
    else
      out += text[i];
  }
  return out;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string fileStem(const CommandDescription& command) {
  std::string out = command.name;
  std::replace(out.begin(), out.end(), ' ', '-');
  return out;
}

std::string optionText(const OptionDescription& option) {
  std::string out = ".TP\n";
  std::string names;
  for (const std::string& name : option.names) {
    names += (names.empty() ? "" : ", ") + (name.starts_with('-') ? bold(name) : italic(name));
  }
  if (option.kind != ValueKind::None && option.names[0].starts_with('-')) {
    names += " " + italic(option.value);
  }
  return out + names + "\n" + roff(option.text) + (option.required ? " (required)" : "") + "\n";
}

std::string synopsis(const CommandDescription& command) {
  std::string out = bold(command.name);
  if (!command.options.empty()) out += " [" + italic("options") + "]";
  for (const OptionDescription& p : command.positionals) {
    const std::string name = italic(p.names[0]) + (p.repeated ? " ..." : "");
    out += p.required ? " " + name : " [" + name + "]";
  }
  if (!command.commands.empty()) out += command.positionals.empty() ? " " + italic("command") : "";
  return out + "\n";
}

/// "Exit status:" and lines "  0  done" as a list.
std::string statusList() {
  std::string out = ".SH EXIT STATUS\n";
  const std::string all = exitText();
  for (size_t at = all.find('\n'); at != std::string::npos;) {
    const size_t end = std::min(all.find('\n', at + 1), all.size());
    const std::string line = all.substr(at + 1, end - at - 1);
    out += ".TP\n" + bold(line.substr(2, 1)) + "\n" + roff(line.substr(5)) + "\n";
    at = end == all.size() ? std::string::npos : end;
  }
  return out;
}

std::string environment() {
  return ".SH ENVIRONMENT\n.TP\n" + bold("NO_COLOR") +
         "\nWhere it is set, nothing is coloured.\n.TP\n" + bold("CLICOLOR_FORCE") +
         "\nWhere it is set and not 0, text is coloured in pipes and files, too.\n.TP\n" +
         bold("CLICOLOR") + "\nWhere it is 0, nothing is coloured.\n";
}

const CommandDescription* find(const CommandDescription& at, const std::string& name) {
  if (at.name == name) return &at;
  for (const CommandDescription& below : at.commands) {
    if (const CommandDescription* found = find(below, name)) return found;
  }
  return nullptr;
}

int writePages(const CommandDescription& command, const std::string& folder) {
  if (const int status = writeText(folder + "/" + manFileName(command), manPage(command))) {
    return status;
  }
  for (const CommandDescription& below : command.commands) {
    if (const int status = writePages(below, folder)) return status;
  }
  return kExitDone;
}

}  // namespace

std::string manFileName(const CommandDescription& command) { return fileStem(command) + ".1"; }

std::string manPage(const CommandDescription& command) {
  std::string title = fileStem(command);
  std::transform(title.begin(), title.end(), title.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
  std::string out = ".\\\" Written by gable man.\n.TH " + title + " 1 \"\" \"gable " +
                    gable::version() + "\" \"User Commands\"\n.SH NAME\n" +
                    roff(fileStem(command)) + " \\- " + roff(command.text) + "\n.SH SYNOPSIS\n" +
                    synopsis(command);
  if (!command.positionals.empty()) out += ".SH ARGUMENTS\n";
  for (const OptionDescription& p : command.positionals) out += optionText(p);
  if (!command.commands.empty()) out += ".SH COMMANDS\n";
  for (const CommandDescription& below : command.commands) {
    out += ".TP\n" + bold(fileStem(below)) + "(1)\n" + roff(below.text) + "\n";
  }
  if (!command.options.empty()) out += ".SH OPTIONS\n";
  for (const OptionDescription& option : command.options) out += optionText(option);
  if (!command.examples.empty()) out += ".SH EXAMPLES\n";
  for (const std::string& line : command.examples) out += ".PP\n.nf\n" + roff(line) + "\n.fi\n";
  const bool isProgram = command.name.find(' ') == std::string::npos;
  return out + statusList() + environment() +
         (isProgram ? "" : ".SH SEE ALSO\n" + bold("gable") + "(1)\n");
}

int runMan(const CommandDescription& program, const ManArguments& arguments) {
  if (!arguments.output.empty()) {
    std::error_code error;
    fs::create_directories(arguments.output, error);
    if (error) {
      return fail(kExitFile,
                  "the folder '" + arguments.output + "' cannot be made: " + error.message(),
                  "see that the folder around it may be written");
    }
    return writePages(program, arguments.output);
  }
  std::string name = "gable";
  for (const std::string& word : arguments.command) name += " " + word;
  const CommandDescription* command = find(program, name);
  if (!command)
    return fail(kExitUsage, "there is no command '" + name + "'; 'gable --help' lists them");
  return writeText("-", manPage(*command));
}
