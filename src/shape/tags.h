// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Tags: names on faces and edges of a mesh (roof.eave, extrude.top, a user's own), where a face or
// an edge of a region comes from, and how wide the street of a line is. A mesh carries the id of an
// interned set; the table gives what is in it. Id 0 is the empty set. Any thread may call.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "program/value.h"
#include "shape/provenance.h"

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

  /// The same provenance with other names, and all names of both: where both have a provenance, it
  /// is that of `b`.
  TagSetId withNames(TagSetId set, std::vector<StringId> names);
  TagSetId merged(TagSetId a, TagSetId b);
  /// The same names with a provenance, and without one.
  TagSetId marked(TagSetId set, const RegionProvenance& region);
  TagSetId marked(TagSetId set, const EdgeProvenance& edge);
  TagSetId plain(TagSetId set);
  /// The same with the width of the street that the line of a face is the middle of, in metres.
  TagSetId withStreetWidth(TagSetId set, double width);
  /// 0 where nobody has told one.
  double streetWidth(TagSetId set) const;
  /// Null where there is none. Operations ask their services, which check the effects.
  const RegionProvenance* region(TagSetId set) const;
  const EdgeProvenance* edge(TagSetId set) const;

 private:
  struct Set;
  TagSetId intern(Set set);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gable
