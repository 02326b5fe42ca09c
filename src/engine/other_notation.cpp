// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A grammar whose file is called grammar.txt is read as CGA, with a mistake in each line: the texts
// of the notations are so different that the number of mistakes tells them apart.

#include "engine/other_notation.h"

#include <algorithm>

#include "builtins/catalogue.h"
#include "dialects/dialect.h"

namespace gable {

namespace {

size_t errorsIn(const Diagnostics& diagnostics) {
  const auto& all = diagnostics.all();
  return static_cast<size_t>(std::count_if(
      all.begin(), all.end(), [](const auto& d) { return d.severity == Severity::Error; }));
}

}  // namespace

std::optional<Error> asOtherNotation(const std::string& path, const Sources& sources, uint32_t file,
                                     lang::FileLoader& loader, const Diagnostics& asCga) {
  // So many times fewer mistakes make it another notation.
  constexpr size_t kFewer = 4, kManyForCga = 8;
  const size_t errors = errorsIn(asCga);
  if (errors == 0 || dialectOfPath(path)) return std::nullopt;
  // A name that says CGA is believed for longer.
  if (path.ends_with(".cga") && errors < kManyForCga) return std::nullopt;
  const Dialect* nearest = nullptr;
  size_t least = (errors + kFewer - 1) / kFewer;
  for (const Dialect* d : dialects()) {
    Diagnostics own;
    const lang::Tree tree = d->parse({sources, file, builtinCatalogue(), &loader}, own);
    const size_t its = errorsIn(own);
    const bool holds = tree.root() != lang::kNoNode && !tree.children(tree.root()).empty();
    if (!holds || its >= least) continue;
    nearest = d;
    least = its;
  }
  if (!nearest) return std::nullopt;
  return Error{"rules-notation", "'" + path + "' is read as CGA, and looks like " + nearest->title,
               std::string("write --dialect ") + nearest->name + ", or call the file *" +
                   nearest->extensions[0]};
}

}  // namespace gable
