// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The studio's server: a page on this machine where rules are written and places are seen.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

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
};

struct StudioResult {
  bool ok = false;
  DiagnosticList diagnostics;
};

/// Serves until `stop` is true. `ready` gets the address of the page, token and all, once it can be
/// opened.
StudioResult runStudio(const StudioSettings& settings, const std::atomic<bool>& stop,
                       const std::function<void(const std::string& url)>& ready);

}  // namespace gable
