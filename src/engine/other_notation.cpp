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

size_t errorsIn(const Diagnostics& diagnostics) {
  const auto& all = diagnostics.all();
  return static_cast<size_t>(std::count_if(
      all.begin(), all.end(), [](const auto& d) { return d.severity == Severity::Error; }));
}

// How many errors a text has as the notation, null for CGA; none where it holds nothing of it.
std::optional<size_t> errorsAs(const Dialect* notation, const Sources& sources, uint32_t file,
                               lang::FileLoader& loader) {
  Diagnostics own;
  const lang::Tree tree = notation
                              ? notation->parse({sources, file, builtinCatalogue(), &loader}, own)
                              : lang::parse(sources, file, own);
  const bool holds = tree.root() != lang::kNoNode && !tree.children(tree.root()).empty();
  return holds ? std::optional(errorsIn(own)) : std::nullopt;
}

}  // namespace

std::optional<Error> asOtherNotation(const std::string& path, const Dialect* read,
                                     const Sources& sources, uint32_t file,
                                     lang::FileLoader& loader, const Diagnostics& found) {
  // So many times fewer mistakes make it another notation.
  constexpr size_t kFewer = 4, kManyForItsName = 8;
  const size_t errors = errorsIn(found);
  if (errors == 0) return std::nullopt;
  // A name that says the notation is believed for longer.
  const bool named = path.ends_with(".cga") || dialectOfPath(path);
  std::vector<const Dialect*> others(dialects().begin(), dialects().end());
  others.push_back(nullptr);
  const Dialect* nearest = read;
  size_t least = (errors + kFewer - 1) / kFewer;
  for (const Dialect* d : others) {
    if (d == read) continue;
    const std::optional<size_t> its = errorsAs(d, sources, file, loader);
    // A grammar's few signs are slips of CGA as well; what is CGA without a mistake is no grammar.
    const bool believed = named && errors < kManyForItsName && (!read || (its && *its > 0));
    if (!its || *its >= least || believed) continue;
    nearest = d;
    least = *its;
  }
  if (nearest == read) return std::nullopt;
  const auto title = [](const Dialect* d) { return std::string(d ? d->title : "CGA"); };
  return Error{"rules-notation",
               "'" + path + "' is read as " + title(read) + ", and looks like " + title(nearest),
               std::string("write --dialect ") + (nearest ? nearest->name : "cga") +
                   ", or call the file *" + (nearest ? nearest->extensions[0] : ".cga")};
}

}  // namespace gable
