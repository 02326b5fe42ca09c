// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Tags: names on faces and edges of a mesh (roof.eave, extrude.top, a user's own). A mesh carries
// the id of an interned set; the table gives the names. Id 0 is the empty set. Any thread may call.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "program/value.h"

namespace gable {

using TagSetId = uint32_t;

class TagTable {
 public:
  explicit TagTable(ValuePool& pool);
  ~TagTable();
  /// Sorted by name, without repetitions.
  const std::vector<StringId>& names(TagSetId set) const;
  TagSetId intern(std::vector<StringId> names);
  TagSetId of(std::string_view name);
  TagSetId with(TagSetId set, std::string_view name);
  bool has(TagSetId set, std::string_view name) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gable
