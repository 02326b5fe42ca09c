// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/remarks.h"

#include <algorithm>
#include <string>

namespace gable {

namespace {

// A remark stands on lines of its own; blanks before and behind it go.
std::string written(std::string_view body, bool hash) {
  while (!body.empty() && (body.back() == '\r' || body.back() == ' ' || body.back() == '\t')) {
    body.remove_suffix(1);
  }
  if (hash) {
    body.remove_prefix(std::min(body.find_first_not_of('#'), body.size()));
    return "//" + std::string(body);
  }
  return std::string(body);
}

bool isFirstOfLine(std::string_view text, size_t at) {
  const std::string_view head = text.substr(0, at);
  const size_t before = head.find_last_not_of(" \t\r");
  return before == head.npos || head[before] == '\n';
}

}  // namespace

std::vector<lang::Remark> remarksOf(std::string_view text) {
  std::vector<lang::Remark> out;
  for (size_t at = 0; at < text.size();) {
    const char c = text[at], next = at + 1 < text.size() ? text[at + 1] : '\0';
    if (c == '"') {
      const size_t end = text.find_first_of("\"\n", at + 1);
      at = end == text.npos ? text.size() : end + 1;
      continue;
    }
    const bool hash = c == '#';
    const bool line = hash || (c == '/' && next == '/');
    if (!line && !(c == '/' && next == '*')) {
      ++at;
      continue;
    }
    size_t end = line ? text.find('\n', at) : text.find("*/", at + 2);
    end = end == text.npos ? text.size() : line ? end : end + 2;
    const std::string_view body = text.substr(at, end - at);
    // One that is never closed is a mistake, and has been reported.
    if (line || body.ends_with("*/")) {
      out.push_back({static_cast<uint32_t>(at), written(body, hash), !isFirstOfLine(text, at)});
    }
    at = end;
  }
  return out;
}

}  // namespace gable
