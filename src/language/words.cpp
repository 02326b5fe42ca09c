// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "language/words.h"

#include <algorithm>

namespace gable::language {

namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80;
}

size_t lineEnd(std::string_view text, size_t at) {
  return std::min(text.find_first_of("\r\n", at), text.size());
}

size_t stringEnd(std::string_view text, size_t at) {
  for (++at; at < text.size() && text[at] != '\n'; ++at) {
    if (text[at] == '"') return at + 1;
    if (text[at] == '\\' && at + 1 < text.size() && text[at + 1] != '\n') ++at;
  }
  return at;
}

size_t nameEnd(std::string_view text, size_t at) {
  // "a.b" is one name, the dot of "X." is not part of it.
  const auto dotInside = [&] {
    return at + 1 < text.size() && text[at] == '.' && isLetter(text[at + 1]);
  };
  while (at < text.size() && (isLetter(text[at]) || isDigit(text[at]) || dotInside())) ++at;
  return at;
}

size_t numberEnd(std::string_view text, size_t at) {
  while (at < text.size() && (isDigit(text[at]) || text[at] == '.')) ++at;
  if (at + 1 < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    const size_t sign = text[at + 1] == '-' || text[at + 1] == '+' ? 1 : 0;
    if (at + 1 + sign < text.size() && isDigit(text[at + 1 + sign])) {
      at += 1 + sign;
      while (at < text.size() && isDigit(text[at])) ++at;
    }
  }
  return at;
}

}  // namespace

std::vector<Word> wordsOf(std::string_view text) {
  std::vector<Word> out;
  const auto put = [&](size_t begin, size_t end, WordKind kind) {
    out.push_back({static_cast<uint32_t>(begin), static_cast<uint32_t>(end), kind});
    return end;
  };
  for (size_t at = 0; at < text.size();) {
    const char c = text[at];
    const char next = at + 1 < text.size() ? text[at + 1] : '\0';
    if (c == ' ' || c == '\t' || c == '\r' || c == '\n') {
      ++at;
    } else if (c == '#' || (c == '/' && next == '/')) {
      at = put(at, lineEnd(text, at), WordKind::Comment);
    } else if (c == '/' && next == '*') {
      const size_t end = text.find("*/", at + 2);
      at = put(at, end == std::string_view::npos ? text.size() : end + 2, WordKind::Comment);
    } else if (c == '"') {
      at = put(at, stringEnd(text, at), WordKind::String);
    } else if (isLetter(c)) {
      at = put(at, nameEnd(text, at), WordKind::Name);
    } else if (isDigit(c) || (c == '.' && isDigit(next))) {
      at = put(at, numberEnd(text, at), WordKind::Number);
    } else {
      at = put(at, at + 1, WordKind::Mark);
    }
  }
  return out;
}

}  // namespace gable::language
