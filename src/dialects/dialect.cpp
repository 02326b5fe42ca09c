// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/dialect.h"

#include <algorithm>
#include <string>

#include "base/text.h"
#include "dialects/gbbg/gbbg.h"
#include "dialects/park/park.h"
#include "dialects/progen3d/progen3d.h"

namespace gable {

std::span<const Dialect* const> dialects() {
  // One line a dialect, by name.
  static const Dialect* const kAll[] = {&kGbbgDialect, &kParkDialect, &kProgen3d};
  return kAll;
}

const Dialect* dialectNamed(std::string_view name) {
  for (const Dialect* d : dialects()) {
    if (name == d->name) return d;
  }
  return nullptr;
}

const Dialect* dialectOfPath(std::string_view path) {
  const std::string lower = lowerCase(path);
  for (const Dialect* d : dialects()) {
    for (const char* extension : d->extensions) {
      if (lower.ends_with(extension)) return d;
    }
  }
  return nullptr;
}

Diagnostics inWordsOf(const Dialect* dialect, const Diagnostics& diagnostics) {
  if (!dialect) return diagnostics;
  Diagnostics out;
  for (Diagnostics::Entry d : diagnostics.all()) {
    for (const Remedy& r : dialect->remedies) {
      if (r.code == d.code) d.hint = r.hint;
    }
    out.add(std::move(d));
  }
  return out;
}

}  // namespace gable
