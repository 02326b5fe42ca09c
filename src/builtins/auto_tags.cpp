// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/auto_tags.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "base/check.h"
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
  std::array<char, 64> tag;
  const size_t size = family_.size() + 1 + name.size();
  GABLE_CHECK_LE(size, tag.size());
  std::memcpy(tag.data(), family_.data(), family_.size());
  tag[family_.size()] = '.';
  std::memcpy(tag.data() + family_.size() + 1, name.data(), name.size());
  return services_.tags().with(without(set), {tag.data(), size});
}

TagSetId AutoTags::merged(TagSetId a, TagSetId b) const {
  if (a == 0 || a == b) return b;
  if (b == 0) return a;
  return services_.tags().merged(a, b);
}

}  // namespace gable
