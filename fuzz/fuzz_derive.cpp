// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Any bytes as a rule file, derived on a lot within small limits: it ends in a model or in
// messages, the model has finite bounds, and neither sharing nor taking parts over from the model
// of a text with a line more changes anything.

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/check.h"
#include "base/hash.h"
#include "gable/gable.h"
#include "json/answers.h"

namespace {

gable::Model derived(const gable::Rules& rules, bool sharing, const gable::Model* before = nullptr,
                     bool remember = false) {
  gable::DeriveSettings settings;
  settings.before = before;
  settings.remember = remember;
  settings.jobs = 1;
  settings.sharing = sharing;
  settings.limits.depth = 64;
  settings.limits.width = 1000;
  settings.limits.shapes = 2000;
  settings.limits.vertices = 100000;
  settings.limits.steps = 100000;
  // Some operations take long for a step; checks and sanitizers add to it.
  settings.limits.seconds = 2;
  return gable::derive(rules, gable::Shapes::lot(9, 7), settings);
}

bool done(const gable::Model& model) { return model.end() == gable::End::Done; }

// One line less, chosen by the text itself.
std::string edited(const std::string& text) {
  const size_t somewhere = gable::hashBytes(text) % (text.size() + 1);
  const size_t end = text.find('\n', somewhere);
  if (end == std::string::npos) return "// " + text;
  const size_t begin = text.rfind('\n', end - 1);
  return text.substr(0, begin == std::string::npos ? 0 : begin + 1) + text.substr(end + 1);
}

void checkRecall(const gable::Rules& rules, const std::string& text) {
  const gable::Model before = derived(rules, true, nullptr, true);
  gable::LoadSettings options;
  options.before = &rules;
  const gable::Rules after = gable::Rules::parse(edited(text), "fuzz.cga", options);
  if (!after.ok() || !done(before)) return;
  const gable::Model taken = derived(after, true, &before);
  const gable::Model fresh = derived(after, true);
  if (!done(taken) || !done(fresh)) return;
  GABLE_CHECK_EQ(taken.dump(), fresh.dump());
  GABLE_CHECK(taken.drawList() == fresh.drawList());
  GABLE_CHECK_EQ(gable::diagnosticsJson(taken.diagnostics()),
                 gable::diagnosticsJson(fresh.diagnostics()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const gable::Rules rules = gable::Rules::parse(text, "fuzz.cga");
  for (const gable::Diagnostic& m : rules.diagnostics()) {
    GABLE_CHECK(!m.code.empty() && !m.message.empty());
  }
  if (!rules.ok()) return 0;
  const gable::Model shared = derived(rules, true);
  const gable::Model alone = derived(rules, false);
  // Where a limit ends the work depends on how it is done.
  if (done(shared) && done(alone)) GABLE_CHECK_EQ(shared.dump(), alone.dump());
  checkRecall(rules, text);
  return 0;
}
