// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What a value is follows from how its option is described: "Footprints: .geojson .osm" is a file
// with one of these endings, "The folder that .." a folder. So no second table can go out of step.

#include "cli_tree.h"

#include <algorithm>
#include <string_view>

#include "terminal.h"

namespace {

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); }

std::string oneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// "glb", "city.json" of ".glb .city.json".
std::vector<std::string> endingsIn(const std::string& text) {
  std::vector<std::string> out;
  for (size_t at = 0; (at = text.find('.', at)) != std::string::npos;) {
    const bool begins = at == 0 || text[at - 1] == ' ' || text[at - 1] == '(';
    size_t end = ++at;
    while (end < text.size() && (isLetter(text[end]) || text[end] == '.')) ++end;
    std::string word = text.substr(at, end - at);
    while (word.ends_with('.')) word.pop_back();
    if (begins && !word.empty()) out.push_back(word);
    at = end;
  }
  return out;
}

bool beginsWithOneOf(std::string_view text, std::initializer_list<std::string_view> words) {
  for (const std::string_view article : {"", "A ", "The ", "Another "}) {
    if (!text.starts_with(article)) continue;
    for (const std::string_view word : words) {
      if (text.substr(article.size()).starts_with(word)) return true;
    }
  }
  return false;
}

/// "iso", "top" of "TEXT:{iso,top}".
std::vector<std::string> wordsIn(const std::string& type) {
  std::vector<std::string> out;
  const size_t open = type.find('{');
  if (open == std::string::npos) return out;
  for (size_t at = open + 1; at < type.size() && type[at] != '}';) {
    const size_t end = std::min(type.find_first_of(",}", at), type.size());
    out.push_back(type.substr(at, end - at));
    at = type[std::min(end, type.size() - 1)] == ',' ? end + 1 : end;
  }
  return out;
}

ValueKind kindOf(const CLI::Option& option, OptionDescription& out) {
  const std::string type = option.get_type_name();
  if (option.get_items_expected_max() == 0) return ValueKind::None;
  for (const char* number : {"FLOAT", "INT", "UINT", "NUMBER"}) {
    if (type.starts_with(number)) return ValueKind::Number;
  }
  out.words = wordsIn(type);
  if (!out.words.empty()) return ValueKind::Word;
  out.endings = endingsIn(out.text);
  if (!out.endings.empty()) return ValueKind::File;
  const std::string name = option.get_name();
  const std::string_view text = out.text;
  if (name == "folder" || beginsWithOneOf(text, {"folder", "Folders", "further project"})) {
    return ValueKind::Folder;
  }
  if (beginsWithOneOf(text, {"rule file", "Rule file", "grammar"})) {
    out.endings = {"cga", "park", "gbbg", "grammar", "pg3d", "rpk", "zip"};
    return ValueKind::File;
  }
  if (beginsWithOneOf(text, {"Test files"})) out.endings = {"test"};
  const bool file = !out.endings.empty() || name == "--output" || name == "-o,--output" ||
                    beginsWithOneOf(text, {"file"}) || text.find("to a file") != text.npos;
  return file ? ValueKind::File : ValueKind::Text;
}

const char* nameOf(ValueKind kind) {
  switch (kind) {
    case ValueKind::Number: return "NUMBER";
    case ValueKind::File: return "FILE";
    case ValueKind::Folder: return "FOLDER";
    default: return "TEXT";
  }
}

OptionDescription described(const CLI::Option& option) {
  OptionDescription out;
  if (option.nonpositional()) {
    for (const std::string& name : option.get_snames()) out.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) out.names.push_back("--" + name);
  } else {
    out.names.push_back(option.get_name());
  }
  out.text = oneLine(option.get_description());
  out.kind = kindOf(option, out);
  out.required = option.get_required();
  out.repeated = option.get_items_expected_max() > 1 ||
                 option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
  if (out.kind == ValueKind::Word) {
    for (const std::string& word : out.words) out.value += (out.value.empty() ? "{" : ",") + word;
    out.value += "}";
  } else if (out.kind != ValueKind::None) {
    out.value = nameOf(out.kind);
  }
  return out;
}

/// "tiles plan" of the command, which is "gable tiles plan" in full.
std::string pathOf(const CLI::App& command) {
  std::string path;
  for (const CLI::App* at = &command; at->get_parent(); at = at->get_parent()) {
    path = at->get_name() + (path.empty() ? "" : " ") + path;
  }
  return path;
}

/// Servers answer in a form of their own, and texts for other programs are as those want them.
bool answersInJson(const std::string& path) {
  return path != "lsp" && path != "studio" && path != "completion" && path != "man";
}

void addTerminal(CLI::App& command) {
  constexpr const char* kGroup = "What it says";
  TerminalOptions& options = terminal();
  auto* quiet =
      command.add_flag("-q,--quiet", options.quiet, "Errors alone: no warnings and no progress");
  command.add_flag("-v,--verbose", options.verbose, "Each step with the time that it took")
      ->excludes(quiet)
      ->group(kGroup);
  quiet->group(kGroup);
  if (answersInJson(pathOf(command)) && !command.get_option_no_throw("--json")) {
    command.add_flag("--json", options.json, "One object in place of text, also of what is wrong")
        ->group(kGroup);
  }
  command
      .add_option("--color", options.color,
                  "Colours: auto (on a terminal, unless NO_COLOR is set), always, never")
      ->check(CLI::IsMember({"auto", "always", "never"}))
      ->group(kGroup);
}

void addTo(CLI::App& command) {
  addTerminal(command);
  for (CLI::Option* option : command.get_options()) {
    const OptionDescription d = described(*option);
    if (d.kind != ValueKind::None && d.kind != ValueKind::Word) option->type_name(d.value);
  }
  std::string footer;
  for (const std::string& line : examplesOf(pathOf(command))) {
    footer += (footer.empty() ? "Examples:\n  " : "\n  ") + line;
  }
  if (!footer.empty()) command.footer(footer);
  for (CLI::App* below : command.get_subcommands({})) addTo(*below);
}

}  // namespace

void addCommon(CLI::App& program) {
  for (CLI::App* command : program.get_subcommands({})) addTo(*command);
}

CommandDescription describe(const CLI::App& command) {
  CommandDescription out;
  const std::string path = pathOf(command);
  out.name = path.empty() ? command.get_name() : "gable " + path;
  out.text = oneLine(command.get_description());
  for (const CLI::Option* option : command.get_options()) {
    (option->nonpositional() ? out.options : out.positionals).push_back(described(*option));
  }
  out.examples = examplesOf(path);
  for (const CLI::App* below : command.get_subcommands({}))
    out.commands.push_back(describe(*below));
  return out;
}

const CLI::App& chosenApp(const CLI::App& program) {
  const CLI::App* at = &program;
  while (!at->get_subcommands().empty()) at = at->get_subcommands().front();
  return *at;
}

std::string chosenCommand(const CLI::App& program) { return pathOf(chosenApp(program)); }
