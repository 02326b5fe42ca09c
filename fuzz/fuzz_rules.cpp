// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Any bytes as a rule file: reading them gives a tree and diagnostics whose places lie in the text.

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/check.h"
#include "lang/dump.h"
#include "lang/parser.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace gable;
  Sources sources;
  Diagnostics diagnostics;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const uint32_t file = sources.add("fuzz.cga", text);
  const lang::Tree tree = lang::parse(sources, file, diagnostics);
  (void)lang::dump(tree);
  for (const Diagnostic& d : diagnostics.all()) {
    GABLE_CHECK(!d.code.empty() && !d.message.empty());
    if (!d.span.valid()) continue;
    GABLE_CHECK(d.span.begin <= d.span.end && d.span.end <= text.size());
    (void)format(d, sources);
  }
  return 0;
}
