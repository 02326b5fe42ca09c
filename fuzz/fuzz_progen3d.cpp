// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Any bytes as a ProGen3d grammar: reading them gives a tree and diagnostics whose places lie in
// the text; a tree without errors prints to text of the language that parses to the same tree and
// analyses without errors; and what it draws ends within small limits, in the same boxes as the
// converted text.

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/check.h"
#include "builtins/catalogue.h"
#include "dialects/progen3d/progen3d.h"
#include "gable/gable.h"
#include "lang/parser.h"
#include "lang/print.h"
#include "lang/sema/analyse.h"

namespace {

using namespace gable;

Model derived(const Rules& rules) {
  DeriveSettings settings;
  settings.jobs = 1;
  settings.limits.depth = 64;
  settings.limits.width = 200;
  settings.limits.shapes = 300;
  settings.limits.vertices = 20000;
  return derive(rules, Shapes::lot(9, 7), settings);
}

void checkTree(const std::string& text) {
  Sources sources;
  Diagnostics diagnostics;
  const uint32_t file = sources.add("fuzz.grammar", text);
  lang::Tree tree = kProgen3d.parse({sources, file, builtinCatalogue()}, diagnostics);
  for (const Diagnostics::Entry& d : diagnostics.all()) {
    GABLE_CHECK(!d.code.empty() && !d.message.empty());
    GABLE_CHECK(d.span.begin <= d.span.end && d.span.end <= text.size());
    (void)format(d, sources);
  }
  if (diagnostics.hasErrors()) return;
  const uint32_t printed = sources.add("fuzz.cga", lang::print(tree));
  const lang::Tree again = lang::parse(sources, printed, diagnostics);
  GABLE_CHECK(!diagnostics.hasErrors());
  GABLE_CHECK(lang::sameTree(tree, again));
  ValuePool values;
  lang::AnalysisInput input{std::make_shared<const lang::Tree>(std::move(tree)), "fuzz.grammar",
                            ""};
  (void)lang::analyse(std::move(input), builtinCatalogue(), values, nullptr, sources, diagnostics);
  GABLE_CHECK(!diagnostics.hasErrors());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  checkTree(text);
  // Images are looked for in all folders of the project: here it has none.
  LoadSettings options;
  options.project = "/nonexistent";
  const Rules rules = Rules::parse(text, "fuzz.grammar", options);
  const Converted converted = convert(text, "fuzz.grammar");
  GABLE_CHECK_EQ(rules.ok(), !converted.text.empty());
  if (!rules.ok()) return 0;
  const Model model = derived(rules);
  const Model other = derived(Rules::parse(converted.text, "fuzz.cga", options));
  if (model.end() == End::Done && other.end() == End::Done) {
    GABLE_CHECK_EQ(model.dump(), other.dump());
  }
  return 0;
}
