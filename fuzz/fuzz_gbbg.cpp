// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Any bytes as a GBBG grammar: it is read, formatted and derived within small limits. The canonical
// form is a fixed point, and what is lowered is what the analysis takes.

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/check.h"
#include "gable/gable.h"
#include "small_settings.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const gable::Formatted once = gable::format(text, "fuzz.gbbg");
  if (!gable::hasErrors(once.diagnostics)) {
    const gable::Formatted twice = gable::format(once.text, "fuzz.gbbg");
    GABLE_CHECK(!gable::hasErrors(twice.diagnostics));
    GABLE_CHECK_EQ(once.text, twice.text);
  }
  gable::LoadSettings options;
  options.project = "/nonexistent";
  const gable::Rules rules = gable::Rules::parse(text, "fuzz.gbbg", options);
  for (const gable::Diagnostic& m : rules.diagnostics()) {
    GABLE_CHECK(!m.code.empty() && !m.message.empty());
  }
  if (!rules.ok()) return 0;
  gable::DeriveSettings settings = smallSettings(2000, 100000);
  const gable::Model shared = gable::derive(rules, gable::Shapes::lot(9, 7), settings);
  settings.sharing = false;
  const gable::Model alone = gable::derive(rules, gable::Shapes::lot(9, 7), settings);
  // Where a limit ends the work depends on how it is done.
  if (shared.end() == gable::End::Done && alone.end() == gable::End::Done) {
    GABLE_CHECK_EQ(shared.dump(), alone.dump());
  }
  return 0;
}
