// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Any bytes as a rule file: reading them gives a tree and diagnostics whose places lie in the text;
// the analysis of any tree ends, and formatting keeps its promises (same tree, nothing to change a
// second time).

#include <cstddef>
#include <cstdint>
#include <string>

#include "base/check.h"
#include "builtins/catalogue.h"
#include "lang/dump.h"
#include "lang/format.h"
#include "lang/parser.h"
#include "lang/sema/analyse.h"

namespace {

using namespace gable;

// The file may import itself.
class SelfLoader : public lang::FileLoader {
 public:
  explicit SelfLoader(const std::string& text) : text_(text) {}
  Result<File> load(const std::string& path, const std::string&) override {
    return File{"other.cga", text_};
  }

 private:
  const std::string& text_;
};

void checkFormat(const Sources& sources, uint32_t file, const lang::Tree& tree) {
  Diagnostics diagnostics;
  const std::string once = lang::format(sources, file, diagnostics);
  if (diagnostics.hasErrors()) return;
  Sources again;
  const uint32_t id = again.add("fuzz.cga", once);
  const lang::Tree second = lang::parse(again, id, diagnostics);
  GABLE_CHECK(lang::sameTree(tree, second));
  const std::string twice = lang::format(again, id, diagnostics);
  GABLE_CHECK(!diagnostics.hasErrors());
  GABLE_CHECK_EQ(once, twice);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Sources sources;
  Diagnostics diagnostics;
  const std::string text(reinterpret_cast<const char*>(data), size);
  const uint32_t file = sources.add("fuzz.cga", text);
  lang::Tree tree = lang::parse(sources, file, diagnostics);
  (void)lang::dump(tree);
  for (const Diagnostics::Entry& d : diagnostics.all()) {
    GABLE_CHECK(!d.code.empty() && !d.message.empty());
    if (!d.span.valid()) continue;
    GABLE_CHECK(d.span.begin <= d.span.end && d.span.end <= text.size());
    (void)format(d, sources);
  }
  checkFormat(sources, file, tree);
  ValuePool values;
  SelfLoader loader(text);
  lang::AnalysisInput input{std::make_shared<const lang::Tree>(std::move(tree)), "fuzz.cga", ""};
  (void)lang::analyse(std::move(input), builtinCatalogue(), values, &loader, sources, diagnostics);
  for (const Diagnostics::Entry& d : diagnostics.all()) (void)format(d, sources);
  return 0;
}
