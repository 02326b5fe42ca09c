// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Completion for zsh: a function for each command, which gives its options to _arguments.

#include "completion.h"

namespace {

/// "_gable_tiles_plan" of "gable tiles plan".
std::string functionOf(const std::string& name) {
  std::string out = "_" + name;
  for (char& c : out) {
    if (c == ' ' || c == '-') c = '_';
  }
  return out;
}

/// For the description within [..] or between colons of _arguments.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

/// ":what:action" of _arguments.
std::string action(const OptionDescription& option) {
  std::string list;
  switch (option.kind) {
    case ValueKind::None: return "";
    case ValueKind::Word:
      for (const std::string& word : option.words) list += (list.empty() ? "" : " ") + word;
      return ":word:(" + list + ")";
    case ValueKind::Folder: return ":folder:_files -/";
    case ValueKind::File:
      for (const std::string& ending : option.endings) list += (list.empty() ? "" : "|") + ending;
      return ":file:_files" + (list.empty() ? "" : " -g \"*.(" + list + ")\"");
    default: return ":" + option.value + ": ";
  }
}

std::string optionSpec(const OptionDescription& option) {
  std::string all;
  for (const std::string& name : option.names) all += (all.empty() ? "" : " ") + name;
  std::string out;
  for (const std::string& name : option.names) {
    // Names that stand for one option exclude each other; one that may be repeated excludes none.
    const std::string before = option.repeated ? "*" : "(" + all + ")";
    const bool takes = option.kind != ValueKind::None;
    out += " \\\n    " + shellQuoted(before + name +
                                     (!takes                   ? ""
                                      : name.starts_with("--") ? "="
                                                               : "+") +
                                     "[" + escaped(option.text) + "]" + action(option));
  }
  return out;
}

std::string functionText(const CommandDescription& command) {
  const std::string name = functionOf(command.name);
  std::string out;
  for (const CommandDescription& below : command.commands) out += functionText(below);
  out += name + "() {\n";
  if (!command.commands.empty()) out += "  local curcontext=$curcontext state line ret=1\n";
  out += "  _arguments -s -S";
  if (!command.commands.empty()) out += " -C";
  for (const OptionDescription& option : command.options) out += optionSpec(option);
  if (command.commands.empty()) {
    for (const OptionDescription& positional : command.positionals) {
      out += " \\\n    " + shellQuoted((positional.repeated ? "*" : "") + action(positional));
    }
    return out + "\n}\n";
  }
  out +=
      " \\\n    '1: :->command' '*:: :->rest' && ret=0\n  case $state in\n  command)\n    local -a "
      "below=(";
  for (const CommandDescription& below : command.commands) {
    const std::string word = below.name.substr(below.name.rfind(' ') + 1);
    out += "\n      " + shellQuoted(word + ":" + escaped(below.text));
  }
  out += "\n    )\n    _describe command below && ret=0\n";
  for (const OptionDescription& positional : command.positionals) {
    const std::string files = action(positional);
    const size_t at = files.rfind(":_files");
    if (at != std::string::npos) out += "    " + files.substr(at + 1) + " && ret=0\n";
  }
  out += "    ;;\n  rest)\n    case $words[1] in\n";
  for (const CommandDescription& below : command.commands) {
    out += "    " + below.name.substr(below.name.rfind(' ') + 1) + ") " + functionOf(below.name) +
           " && ret=0 ;;\n";
  }
  return out + "    esac ;;\n  esac\n  return ret\n}\n";
}

}  // namespace

std::string zshText(const CommandDescription& program) {
  return "#compdef gable\n# Completes gable in zsh; written by `gable completion zsh`.\n" +
         functionText(program) +
         "if [[ $funcstack[1] == _gable ]]; then _gable \"$@\"; else compdef _gable gable; fi\n";
}
