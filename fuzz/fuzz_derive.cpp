// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Any bytes as a rule file, derived on a lot within small limits: it ends in a model or in
// messages, the model has finite bounds, and sharing changes nothing.

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/check.h"
#include "gable/gable.h"

namespace {

gable::Model derived(const gable::Rules& rules, bool sharing) {
  gable::DeriveSettings settings;
  settings.jobs = 1;
  settings.sharing = sharing;
  settings.budget.depth = 64;
  settings.budget.width = 1000;
  settings.budget.shapes = 2000;
  settings.budget.vertices = 100000;
  settings.budget.steps = 100000;
  // Some operations take long for a step; checks and sanitizers add to it.
  settings.budget.seconds = 2;
  return gable::derive(rules, gable::Shapes::lot(9, 7), settings);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const gable::Rules rules = gable::Rules::parse(text, "fuzz.cga");
  for (const gable::Message& m : rules.messages()) {
    GABLE_CHECK(!m.code.empty() && !m.text.empty());
  }
  if (!rules.ok()) return 0;
  const gable::Model shared = derived(rules, true);
  const gable::Model alone = derived(rules, false);
  // Where a limit ends the work depends on how it is done.
  if (shared.end() == gable::End::Done && alone.end() == gable::End::Done) {
    GABLE_CHECK_EQ(shared.dump(), alone.dump());
  }
  return 0;
}
