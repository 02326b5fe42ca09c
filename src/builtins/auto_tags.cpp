// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/auto_tags.h"

#include <algorithm>

#include "base/small_buffer.h"
#include "builtins/selection.h"

namespace gable {

AutoTags::AutoTags(const Services& services, std::string_view family)
    : services_(services), family_(family) {}

TagSetId AutoTags::without(TagSetId set) {
  if (set == 0) return 0;
  for (const auto& [from, to] : known_) {
    if (from == set) return to;
  }
  std::vector<StringId> names = services_.tags().names(set);
  std::erase_if(names, [&](StringId n) { return tagMatches(family_, services_.pool().text(n)); });
  const TagSetId result = services_.tags().withNames(set, std::move(names));
  known_.emplace_back(set, result);
  return result;
}

TagSetId AutoTags::with(TagSetId set, std::string_view name) {
  SmallBuffer<char, 64> tag;
  for (const std::string_view part : {family_, std::string_view("."), name}) {
    for (const char c : part) tag.push_back(c);
  }
  return services_.tags().with(without(set), {tag.begin(), tag.size()});
}

TagSetId AutoTags::merged(TagSetId a, TagSetId b) const {
  if (a == 0 || a == b) return b;
  if (b == 0) return a;
  return services_.tags().merged(a, b);
}

}  // namespace gable
