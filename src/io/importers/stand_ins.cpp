// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/stand_ins.h"

#include <algorithm>

namespace gable {
namespace {

constexpr std::string_view kLevel = "_LOD";

bool isDigit(char c) { return c >= '0' && c <= '9'; }

// Wall of Wall.001, which is what Blender calls the second of a name.
std::string_view withoutCopy(std::string_view name) {
  const size_t end = name.find_last_not_of("0123456789");
  const bool isCopy = end != std::string_view::npos && end + 1 < name.size() && name[end] == '.';
  return isCopy ? name.substr(0, end) : name;
}

// Into Wall and 1 of Wall_LOD1; the level is empty of other names.
struct Levelled {
  std::string_view name, level;
};

Levelled levelled(std::string_view name) {
  name = withoutCopy(name);
  const size_t at = name.rfind(kLevel);
  if (at == std::string_view::npos || at == 0) return {name, {}};
  const std::string_view level = name.substr(at + kLevel.size());
  if (!std::all_of(level.begin(), level.end(), isDigit)) return {name, {}};
  return {name.substr(0, at), level};
}

}  // namespace

bool isCollisionName(std::string_view name) {
  for (const std::string_view mark : {"UCX_", "UBX_", "USP_", "UCP_"}) {
    if (name.starts_with(mark)) return true;
  }
  const size_t end = name.find_last_not_of("0123456789. ");
  name = name.substr(0, end == std::string_view::npos ? 0 : end + 1);
  if (name.ends_with("_collision")) return true;
  for (const std::string_view mark : {"colonly", "convcolonly"}) {
    if (!name.ends_with(mark) || name.size() == mark.size()) continue;
    const char before = name[name.size() - mark.size() - 1];
    if (before == '-' || before == '_' || before == '$') return true;
  }
  return false;
}

StandIns::StandIns(const std::vector<std::string_view>& names) {
  for (const std::string_view name : names) {
    const Levelled l = levelled(name);
    if (l.level == "0") levelled_.emplace(l.name);
  }
}

bool StandIns::isCoarse(std::string_view name) const {
  const Levelled l = levelled(name);
  return !l.level.empty() && l.level != "0" && levelled_.contains(l.name);
}

}  // namespace gable
