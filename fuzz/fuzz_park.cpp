// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Any bytes as a park grammar: it is read, written in Gable's language and derived within small
// limits, on a square, with and without sharing.

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/check.h"
#include "gable/gable.h"
#include "small_settings.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const gable::Converted converted = gable::convert(text, "fuzz.park");
  gable::LoadSettings options;
  options.project = "/nonexistent";
  const gable::Rules rules = gable::Rules::parse(text, "fuzz.park", options);
  for (const gable::Diagnostic& m : rules.diagnostics()) {
    GABLE_CHECK(!m.code.empty() && !m.message.empty());
  }
  if (!rules.ok()) return 0;
  // What is lowered without a mistake can be read again.
  GABLE_CHECK(!gable::hasErrors(converted.diagnostics));
  const gable::Rules again = gable::Rules::parse(converted.text, "fuzz.cga", options);
  for (const gable::Diagnostic& m : again.diagnostics()) {
    GABLE_CHECK(m.code.find("unexpected") == std::string::npos);
  }
  gable::DeriveSettings settings = smallSettings(1000, 50000);
  const gable::Model shared = gable::derive(rules, gable::Shapes::lot(20, 20), settings);
  settings.sharing = false;
  const gable::Model alone = gable::derive(rules, gable::Shapes::lot(20, 20), settings);
  // Where a limit ends the work depends on how it is done.
  if (shared.end() == gable::End::Done && alone.end() == gable::End::Done) {
    GABLE_CHECK_EQ(shared.dump(), alone.dump());
  }
  return 0;
}
