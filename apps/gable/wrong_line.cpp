// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "wrong_line.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "answer.h"
#include "commands.h"
#include "gable/builtins.h"
#include "terminal.h"

namespace {

// What to say where the first word is no command; else nothing.
std::string unknownCommand(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return {};
  const std::string word = argv[1];
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), word) != names.end()) return {};
  std::string hint = gable::suggestion(word, names);
  if (hint.empty()) {
    for (const std::string& name : names) hint += (hint.empty() ? "there are " : ", ") + name;
  }
  return "there is no command '" + word + "'; " + hint;
}

// What to say of the first "--word" that the command does not have; else nothing.
std::string unknownOption(const CLI::App& app, int argc, char** argv) {
  std::vector<std::string> names;
  for (const CLI::Option* option : chosenApp(app).get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--") break;
    if (!argument.starts_with("--")) continue;
    const std::string word(argument.substr(0, argument.find('=')));
    if (std::find(names.begin(), names.end(), word) != names.end()) continue;
    const std::string hint = gable::suggestion(word, names), called = chosenCommand(app),
                      program = called.empty() ? "gable" : "gable " + called;
    return "'" + program + "' has no option '" + word + "'; " +
           (hint.empty() ? "'" + program + " --help' tells those that it has" : hint);
  }
  return {};
}

// What to say of the first word that an option does not take; else nothing.
std::string unknownWord(const CLI::App& app, int argc, char** argv) {
  for (const OptionDescription& option : describe(chosenApp(app)).options) {
    if (option.words.empty()) continue;
    for (int i = 1; i < argc; ++i) {
      const std::string argument = argv[i], name = argument.substr(0, argument.find('='));
      const auto& names = option.names;
      if (std::find(names.begin(), names.end(), name) == names.end()) continue;
      const bool follows = name == argument;
      if (follows && i + 1 == argc) continue;
      const std::string word = follows ? argv[i + 1] : argument.substr(name.size() + 1);
      const auto& words = option.words;
      if (std::find(words.begin(), words.end(), word) != words.end()) continue;
      std::string hint = gable::suggestion(word, words);
      if (hint.empty()) {
        for (const std::string& w : words) hint += (hint.empty() ? "there are " : ", ") + w;
      }
      return "'" + name + "' does not take '" + word + "'; " + hint;
    }
  }
  return {};
}

// What to say of the first option that stands there more often than it may; else nothing.
std::string repeatedOption(const CLI::App& app, int argc, char** argv) {
  for (const CLI::Option* option : chosenApp(app).get_options()) {
    if (option->get_expected_max() != 1) continue;
    int times = 0;
    std::string written;
    for (int i = 1; i < argc; ++i) {
      const std::string argument = argv[i], name = argument.substr(0, argument.find('='));
      if (argument.starts_with('-') && option->check_name(name)) written = name, ++times;
    }
    if (times > 1) return "'" + written + "' is given twice; leave one of them out";
  }
  return {};
}

}  // namespace

int wrongLine(const CLI::App& app, const CLI::ParseError& e, int argc, char** argv) {
  if (e.get_exit_code() == 0) {
    terminal().json = false;
    return app.exit(e) == 0 ? kExitDone : kExitUsage;
  }
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--json") terminal().json = true;
  }
  answer().begin(chosenCommand(app));
  for (const auto& unknown : {unknownCommand, unknownOption, unknownWord, repeatedOption}) {
    const std::string mistake = unknown(app, argc, argv);
    if (!mistake.empty()) return fail(kExitUsage, mistake);
  }
  if (terminal().json) return fail(kExitUsage, e.what());
  app.exit(e);
  return kExitUsage;
}
