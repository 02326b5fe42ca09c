// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The tags that operations give to what they make: extrude.top, roof.bottom, setback.side. An
// operation's tags stay until the operation runs again and replaces them.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "shape/services.h"
#include "shape/tags.h"

namespace gable {

class AutoTags {
 public:
  /// `family` is the first part of the names: "extrude".
  AutoTags(const Services& services, std::string_view family);

  /// The set without the family's tags.
  TagSetId without(TagSetId set);
  /// The set without the family's tags, with `family.name`: 64 letters at most.
  TagSetId with(TagSetId set, std::string_view name);
  /// All of both sets.
  TagSetId merged(TagSetId a, TagSetId b) const;

 private:
  const Services& services_;
  std::string_view family_;
  /// What without() found, since faces repeat their sets.
  std::vector<std::pair<TagSetId, TagSetId>> known_;
};

}  // namespace gable
