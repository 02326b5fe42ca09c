// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The studio: a page where rules are written and places are seen, and the server that gives it out.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gable/gable.h"

namespace gable {

struct StudioSettings {
  /// The only folder that can be written, and read but for what rules find elsewhere.
  std::string project = ".";
  SearchSettings search;
  /// Holds the built page: index.html and what it names.
  std::string page;
  /// Holds examples, a folder each.
  std::optional<std::string> examples;
  /// Where to listen: this machine alone, unless others are meant to come in.
  std::string address = "127.0.0.1";
  /// 0: that of this project's last studio where it is free, else any.
  uint16_t port = 0;
  /// The secret that requests must have, as the address of the page has it; absent: that of this
  /// project's last studio, else drawn.
  std::optional<std::string> token;
  /// Derivations are numbered from the one after it. A page that goes on with another desk takes
  /// no number of one for one of the other where these lie far apart.
  uint64_t derivationsBefore = 0;
};

struct StudioResult {
  bool ok = false;
  DiagnosticList diagnostics;
};

/// Serves until `stop` is true. `ready` gets the address of the page, token and all, once it can be
/// opened.
StudioResult runStudio(const StudioSettings& settings, const std::atomic<bool>& stop,
                       const std::function<void(const std::string& url)>& ready);

/// What a page asks, as docs/dev/studio-protocol.md has it: "POST", "/api/derive".
struct StudioRequest {
  std::string method, path;
  /// Decoded.
  std::map<std::string, std::string> query;
  std::string body;
};

/// Its answer. Types and statuses are those of HTTP.
struct StudioAnswer {
  int status = 200;
  std::string type, body;
  std::vector<std::pair<std::string, std::string>> headers;
};

/// The studio without its server, for a page that has the engine in itself, as the playground has:
/// each request is answered before the call returns. Of the settings, those of addresses are not
/// used. Any thread may call.
class StudioDesk {
 public:
  explicit StudioDesk(const StudioSettings& settings);
  ~StudioDesk();

  /// Whether the folder of the project is there.
  bool ok() const;
  StudioAnswer answer(StudioRequest request);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gable
