// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "io/importers/other_tags.h"

#include <algorithm>
#include <optional>

#include "base/work.h"

namespace gable {

namespace {

constexpr std::string_view kArrow = "=>";

void skipBlanks(std::string_view& rest) {
  rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r\n"), rest.size()));
}

bool skip(std::string_view& rest, std::string_view what) {
  skipBlanks(rest);
  if (!rest.starts_with(what)) return false;
  rest.remove_prefix(what.size());
  return true;
}

// A text in quotes.
std::optional<std::string> quoted(std::string_view& rest) {
  if (!skip(rest, "\"")) return {};
  std::string out;
  for (size_t i = 0; i < rest.size(); ++i) {
    work();
    if (rest[i] == '"') {
      rest.remove_prefix(i + 1);
      return out;
    }
    if (rest[i] == '\\' && i + 1 < rest.size()) ++i;
    out += rest[i];
  }
  return {};
}

}  // namespace

std::vector<std::pair<std::string, std::string>> otherTags(std::string_view text) {
  std::vector<std::pair<std::string, std::string>> out;
  do {
    std::optional<std::string> key = quoted(text);
    if (!key || !skip(text, kArrow)) break;
    if (skip(text, "NULL")) continue;
    std::optional<std::string> value = quoted(text);
    if (!value) break;
    if (!value->empty()) out.emplace_back(std::move(*key), std::move(*value));
  } while (skip(text, ","));
  return out;
}

}  // namespace gable
