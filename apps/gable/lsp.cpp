// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// gable lsp: the language server, over stdin and stdout.

#include "gable/lsp.h"

#include <unistd.h>

#include <csignal>

#include "commands.h"

int runLsp(const LspArguments& arguments) {
  // An editor that has gone is told by the write that fails.
  std::signal(SIGPIPE, SIG_IGN);
  return gable::runLanguageServer(STDIN_FILENO, STDOUT_FILENO, arguments.search);
}
