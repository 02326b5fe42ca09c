// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A grammar whose file is called grammar.txt is read as CGA, and CGA in a file *.park as a park,
// with a mistake in each line: the texts of the notations are so different that the number of
// mistakes tells them apart.

#include "engine/other_notation.h"

#include <algorithm>
#include <vector>

#include "builtins/catalogue.h"
#include "dialects/dialect.h"
#include "lang/parser.h"

namespace gable {

namespace {

size_t countOf(const Diagnostics& diagnostics, Severity severity) {
  const auto& all = diagnostics.all();
  return static_cast<size_t>(
      std::count_if(all.begin(), all.end(), [&](const auto& d) { return d.severity == severity; }));
}

struct Mistakes {
  size_t errors = 0, warnings = 0;
};

// What is wrong with a text as the notation, null for CGA; nothing where it holds nothing of it.
std::optional<Mistakes> mistakesAs(const Dialect* notation, const Sources& sources, uint32_t file,
                                   lang::FileLoader& loader) {
  Diagnostics own;
  const lang::Tree tree = notation
                              ? notation->parse({sources, file, builtinCatalogue(), &loader}, own)
                              : lang::parse(sources, file, own);
  const bool holds = tree.root() != lang::kNoNode && !tree.children(tree.root()).empty();
  if (!holds) return std::nullopt;
  return Mistakes{countOf(own, Severity::Error), countOf(own, Severity::Warning)};
}

}  // namespace

std::optional<Error> asOtherNotation(const std::string& path, const Dialect* read,
                                     const Sources& sources, uint32_t file,
                                     lang::FileLoader& loader, const Diagnostics& found) {
  // So many times fewer mistakes make it another notation.
  constexpr size_t kFewer = 4, kManyForItsName = 8;
  const size_t errors = countOf(found, Severity::Error);
  if (errors == 0) return std::nullopt;
  // A name that says the notation is believed for longer: that of a grammar unless the text is
  // another one without a mistake, since some notations forgive much; .cga where the mistakes are
  // few, since a grammar's few signs are slips of CGA as well.
  const bool isGrammar = read && dialectOfPath(path);
  if (!read && path.ends_with(".cga") && errors < kManyForItsName) return std::nullopt;
  std::vector<const Dialect*> others(dialects().begin(), dialects().end());
  others.push_back(nullptr);
  const Dialect* nearest = read;
  size_t least = (errors + kFewer - 1) / kFewer;
  for (const Dialect* d : others) {
    if (d == read) continue;
    const std::optional<Mistakes> its = mistakesAs(d, sources, file, loader);
    if (!its || its->errors >= least) continue;
    if (isGrammar && its->errors + its->warnings > 0) continue;
    nearest = d;
    least = its->errors;
  }
  if (nearest == read) return std::nullopt;
  const auto title = [](const Dialect* d) { return std::string(d ? d->title : "CGA"); };
  return Error{"rules-notation",
               "'" + path + "' is read as " + title(read) + ", and looks like " + title(nearest),
               std::string("write --dialect ") + (nearest ? nearest->name : "cga") +
                   ", or call the file *" + (nearest ? nearest->extensions[0] : ".cga")};
}

}  // namespace gable
