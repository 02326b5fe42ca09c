// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The language server protocol (3.17) over gable/language.h: what editors speak with `gable lsp`.
//
//   gable::LanguageServer server;
//   server.receive(message);                       // one JSON text, without its Content-Length
//   while (server.step()) send(server.take());
//
// The server reads files of the projects that are open in the editor, and writes none. It never
// throws; whatever comes in is answered or left out as the protocol wants.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gable/search.h"

namespace gable {

class LanguageServer {
 public:
  /// `clock` gives seconds; empty: a steady clock. `project`: the folder outside of which nothing
  /// is read; empty: any that the client names. `search`: where else rules may read from.
  explicit LanguageServer(std::function<double()> clock = {}, const std::string& project = {},
                          const SearchSettings& search = {});
  ~LanguageServer();
  LanguageServer(LanguageServer&&) noexcept;
  LanguageServer& operator=(LanguageServer&&) noexcept;

  /// Takes a message in. Nothing is answered yet; a request that is cancelled before its turn is
  /// never worked on.
  void receive(std::string_view message);
  /// A message that could not be read: larger than the limit, or broken off.
  void receiveBroken(const std::string& why);
  /// Answers the next message, or says what is wrong with one text when the pause after an edit is
  /// over. False when there is nothing to do now.
  bool step();
  /// What is to be sent, in order.
  std::vector<std::string> take();
  /// Seconds until step() has something to do by itself; none: only when a message comes.
  std::optional<double> wait() const;
  /// The client has said `exit`; the status that the protocol asks for.
  bool ended() const;
  int exitStatus() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Serves one client over two file descriptors until it says `exit` or the input ends; the exit
/// status of the process.
int runLanguageServer(int in, int out, const SearchSettings& search = {});

}  // namespace gable
