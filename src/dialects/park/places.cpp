// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "dialects/park/places.h"

#include <algorithm>
#include <cctype>

#include "base/text.h"

namespace gable::park {

namespace {

bool inWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

bool sameLetter(char a, char b) { return lowerCase(a) == lowerCase(b); }

}  // namespace

Span placeOf(std::string_view source, Span span, std::string_view text) {
  if (!span.valid() || text.empty() || span.end > source.size()) return span;
  const auto begin = source.begin() + span.begin, end = source.begin() + span.end;
  for (auto at = begin; at != end; ++at) {
    at = std::search(at, end, text.begin(), text.end(), sameLetter);
    if (at == end) return span;
    const auto after = at + static_cast<std::ptrdiff_t>(text.size());
    const bool begins = at == begin || !inWord(*(at - 1)) || !inWord(text.front());
    const bool ends = after == end || !inWord(*after) || !inWord(text.back());
    if (!begins || !ends) continue;
    const auto first = static_cast<uint32_t>(at - source.begin());
    return {span.file, first, first + static_cast<uint32_t>(text.size())};
  }
  return span;
}

}  // namespace gable::park
