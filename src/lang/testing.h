// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the tests of this layer share: a text parsed with its sources and diagnostics.
#pragma once

#include <string>
#include <string_view>

#include "base/diagnostic.h"
#include "lang/dump.h"
#include "lang/parser.h"

namespace gable::lang {

struct Parsed {
  Sources sources;
  Diagnostics diagnostics;
  Tree tree;

  explicit Parsed(std::string text) {
    const uint32_t file = sources.add("test.cga", std::move(text));
    tree = parse(sources, file, diagnostics);
  }

  /// "line:column code" for each diagnostic, in the order of the text.
  std::string problems() {
    diagnostics.sortByPlace();
    std::string out;
    for (const Diagnostics::Entry& d : diagnostics.all()) {
      const LineColumn at = sources.locate(d.span.file, d.span.begin);
      out += std::to_string(at.line) + ":" + std::to_string(at.column) + " " + d.code;
      if (d.severity == Severity::Warning) out += " (warning)";
      out += "\n";
    }
    return out;
  }

  std::string messages() const {
    std::string out;
    for (const Diagnostics::Entry& d : diagnostics.all()) out += format(d, sources);
    return out;
  }
};

}  // namespace gable::lang
