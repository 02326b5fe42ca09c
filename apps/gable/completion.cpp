// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// gable completion: bash and fish here, zsh in completion_zsh.cpp. The files are tables of what the
// command line declares, so they are written once and need no run of the program.

#include <functional>

#include "answer.h"
#include "common.h"
#include "completion.h"

namespace {

/// Calls `visit` with the program and all commands below it.
void walk(const CommandDescription& command,
          const std::function<void(const CommandDescription&)>& visit) {
  visit(command);
  // As deep as commands are declared: two levels.
  for (const CommandDescription& below : command.commands) walk(below, visit);
}

std::string lastWord(const std::string& name) { return name.substr(name.rfind(' ') + 1); }

std::string join(const std::vector<std::string>& words, const char* between) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : between) + word;
  return out;
}

// ------------------------------------------------------------------------------------------ bash

/// What fills COMPREPLY with the values of an option or positional.
std::string bashValues(const OptionDescription& option) {
  switch (option.kind) {
    case ValueKind::Word: return "_gable_words " + shellQuoted(join(option.words, " "));
    case ValueKind::File: return "_gable_files " + join(option.endings, " ");
    case ValueKind::Folder: return "_gable_folders";
    default: return ":";
  }
}

std::string bashCommand(const CommandDescription& command) {
  std::string options, values;
  for (const OptionDescription& option : command.options) {
    std::string patterns;
    for (const std::string& name : option.names) {
      options += (options.empty() ? "" : " ") + name;
      patterns += (patterns.empty() ? "" : "|") + name;
    }
    if (option.kind == ValueKind::None) continue;
    values += "        " + patterns + ") " + bashValues(option) + "; return ;;\n";
  }
  std::string words;
  for (const CommandDescription& below : command.commands) words += lastWord(below.name) + " ";
  std::string out = "    " + shellQuoted(command.name) + ")\n";
  if (!values.empty()) out += "      case $before in\n" + values + "      esac\n";
  out += "      if [[ $word == -* ]]; then _gable_words " + shellQuoted(options) + "; return; fi\n";
  if (!words.empty()) out += "      _gable_words " + shellQuoted(words) + "\n";
  for (const OptionDescription& positional : command.positionals) {
    out += "      " + bashValues(positional) + "\n";
  }
  return out + "      ;;\n";
}

std::string bashText(const CommandDescription& program) {
  std::string out =
      "# Completes gable in bash; written by `gable completion bash`.\n"
      "_gable_words() {\n"
      "  local each\n"
      "  while IFS= read -r each; do COMPREPLY+=(\"$each\"); done < <(compgen -W \"$1\" -- "
      "\"$word\")\n"
      "}\n"
      "_gable_folders() {\n"
      "  local each\n"
      "  compopt -o filenames 2>/dev/null\n"
      "  while IFS= read -r each; do COMPREPLY+=(\"$each\"); done < <(compgen -d -- \"$word\")\n"
      "}\n"
      "# Files with one of these endings, or all; and folders, in which they may lie.\n"
      "_gable_files() {\n"
      "  local each ending\n"
      "  _gable_folders\n"
      "  while IFS= read -r each; do\n"
      "    [[ -d $each ]] && continue\n"
      "    [[ $# -gt 0 ]] || COMPREPLY+=(\"$each\")\n"
      "    for ending; do [[ $each == *.\"$ending\" ]] && COMPREPLY+=(\"$each\"); done\n"
      "  done < <(compgen -f -- \"$word\")\n"
      "}\n"
      "_gable() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command=gable i\n"
      "  COMPREPLY=()\n"
      "  # --view=iso is three words here.\n"
      "  if [[ $word == = ]]; then word=; elif [[ $before == = ]]; then\n"
      "    before=${COMP_WORDS[COMP_CWORD-2]}\n"
      "  fi\n"
      "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
      "    case \"$command ${COMP_WORDS[i]}\" in\n      ";
  std::string known;
  walk(program, [&](const CommandDescription& c) {
    if (&c != &program) known += (known.empty() ? "" : "|") + shellQuoted(c.name);
  });
  out += known +
         ")\n        command+=\" ${COMP_WORDS[i]}\" ;;\n    esac\n  done\n  case $command in\n";
  walk(program, [&](const CommandDescription& c) { out += bashCommand(c); });
  return out + "  esac\n}\ncomplete -F _gable gable\n";
}

// ------------------------------------------------------------------------------------------ fish

/// When the words so far are this command and no command below it.
std::string fishCondition(const CommandDescription& command) {
  std::string out;
  size_t at = command.name.find(' ');
  if (at == std::string::npos) return "__fish_use_subcommand";
  while (at != std::string::npos) {
    const size_t end = std::min(command.name.find(' ', at + 1), command.name.size());
    out += (out.empty() ? "__fish_seen_subcommand_from " : "; and __fish_seen_subcommand_from ") +
           command.name.substr(at + 1, end - at - 1);
    at = end == command.name.size() ? std::string::npos : end;
  }
  std::string below;
  for (const CommandDescription& c : command.commands) below += " " + lastWord(c.name);
  return below.empty() ? out : out + "; and not __fish_seen_subcommand_from" + below;
}

/// The argument of -a, with what says whether files are offered.
std::string fishValues(const OptionDescription& option) {
  if (option.kind == ValueKind::Word) return " -x -a " + shellQuoted(join(option.words, " "));
  if (option.kind == ValueKind::Folder) return " -x -a '(__fish_complete_directories)'";
  if (option.kind != ValueKind::File) return " -x";
  if (option.endings.empty()) return " -r -F";
  std::string calls;
  for (const std::string& ending : option.endings) {
    calls += (calls.empty() ? "(" : "; ") + std::string("__fish_complete_suffix .") + ending;
  }
  return " -x -a " + shellQuoted(calls + ")");
}

std::string fishCommand(const CommandDescription& command) {
  const std::string head = "complete -c gable -n " + shellQuoted(fishCondition(command));
  std::string out;
  for (const CommandDescription& below : command.commands) {
    out += head + " -f -a " + lastWord(below.name) + " -d " + shellQuoted(below.text) + "\n";
  }
  for (const OptionDescription& positional : command.positionals) {
    const std::string values = fishValues(positional);
    // A positional takes no option's argument: -x and -r are for those.
    const size_t list = values.find(" -a ");
    if (list != std::string::npos) out += head + " -f" + values.substr(list) + "\n";
    if (positional.kind == ValueKind::File && positional.endings.empty()) out += head + " -F\n";
  }
  for (const OptionDescription& option : command.options) {
    out += head;
    for (const std::string& name : option.names) {
      out += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    }
    out += (option.kind == ValueKind::None ? "" : fishValues(option)) + " -d " +
           shellQuoted(option.text) + "\n";
  }
  return out;
}

std::string fishText(const CommandDescription& program) {
  std::string out =
      "# Completes gable in fish; written by `gable completion fish`.\ncomplete -c gable -f\n";
  walk(program, [&](const CommandDescription& c) { out += fishCommand(c); });
  return out;
}

}  // namespace

std::string shellQuoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::vector<std::string> completionShells() { return {"bash", "zsh", "fish"}; }

std::string completionText(const CommandDescription& program, const std::string& shell) {
  if (shell == "bash") return bashText(program);
  if (shell == "zsh") return zshText(program);
  if (shell == "fish") return fishText(program);
  return {};
}

int runCompletion(const CommandDescription& program, const CompletionArguments& arguments) {
  return writeText("-", completionText(program, arguments.shell));
}
