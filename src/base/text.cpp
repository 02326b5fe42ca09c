// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Edit distance is the optimal string alignment of Damerau and Levenshtein with three rolling rows.

#include "base/text.h"

#include <algorithm>

#include "base/work.h"

namespace gable {

std::string lowerCase(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = lowerCase(c);
  return out;
}

std::string joined(const std::vector<std::string>& pieces) {
  std::string out;
  for (const std::string& piece : pieces) out += piece;
  return out;
}

bool equalButForCase(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lowerCase(x) == lowerCase(y); });
}

size_t editDistance(std::string_view a, std::string_view b, size_t limit) {
  if (a.size() > b.size()) std::swap(a, b);
  if (b.size() - a.size() > limit) return limit + 1;
  std::vector<size_t> before(a.size() + 1), last(a.size() + 1), row(a.size() + 1);
  for (size_t i = 0; i <= a.size(); ++i) last[i] = i;
  for (size_t j = 1; j <= b.size(); ++j) {
    row[0] = j;
    size_t best = row[0];
    for (size_t i = 1; i <= a.size(); ++i) {
      const size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      row[i] = std::min({row[i - 1] + 1, last[i] + 1, last[i - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[i] = std::min(row[i], before[i - 2] + 1);
      }
      best = std::min(best, row[i]);
    }
    if (best > limit) return limit + 1;
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[a.size()];
}

// Whether two names are the same words in another order: gableRoof and roofGable.
bool sameWords(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  const auto words = [](std::string_view name) {
    std::vector<std::string> all(1);
    for (const char c : name) {
      if (lowerCase(c) != c && !all.back().empty()) all.emplace_back();
      all.back() += lowerCase(c);
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  const std::vector<std::string> of = words(a);
  return of.size() > 1 && of == words(b);
}

std::string nearestName(std::string_view name, const std::vector<std::string_view>& candidates) {
  // Names longer than any in a rule file are not worth comparing.
  constexpr size_t kLongest = 64;
  if (name.size() < 2 || name.size() > kLongest) return {};
  const std::string folded = lowerCase(name);
  // Short names are near to each other by chance, unless they begin alike.
  const size_t mostUnlike = name.size() < 4 ? 0 : name.size() < 6 ? 1 : kLongest;
  size_t bestDistance = std::max<size_t>(1, (name.size() + 1) / 3) + 1;
  std::string_view best;
  for (const std::string_view candidate : candidates) {
    work(name.size());
    if (candidate.empty() || candidate == name || candidate.size() > kLongest) continue;
    const bool same = lowerCase(candidate) == folded || sameWords(name, candidate);
    const size_t distance = same ? 0 : editDistance(name, candidate, bestDistance - 1);
    if (lowerCase(candidate[0]) != folded[0] && distance > mostUnlike) continue;
    if (distance < bestDistance && distance < candidate.size()) {
      bestDistance = distance;
      best = candidate;
    }
  }
  return std::string(best);
}

std::string didYouMean(std::string_view name, const std::vector<std::string_view>& candidates) {
  const std::string nearest = nearestName(name, candidates);
  return nearest.empty() ? std::string() : "did you mean '" + nearest + "'?";
}

bool takeLine(std::string_view& rest, std::string_view& line) {
  if (rest.empty()) return false;
  const size_t end = std::min(rest.find('\n'), rest.size());
  line = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return true;
}

size_t utf8Length(std::string_view text, size_t at) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(at);
  const size_t length = lead < 0x80                   ? 1
                        : lead >= 0xc2 && lead < 0xe0 ? 2
                        : lead >= 0xe0 && lead < 0xf0 ? 3
                        : lead >= 0xf0 && lead < 0xf5 ? 4
                                                      : 0;
  if (length == 0 || at + length > text.size()) return 0;
  for (size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xc0) != 0x80) return 0;
  }
  return length;
}

void appendUtf8(std::string& out, uint32_t c) {
  if (c > 0x10ffff || (c >= 0xd800 && c < 0xe000)) c = 0xfffd;
  const auto put = [&](uint32_t byte) { out += static_cast<char>(byte); };
  if (c < 0x80) {
    put(c);
  } else if (c < 0x800) {
    put(0xc0 | c >> 6);
    put(0x80 | (c & 0x3f));
  } else if (c < 0x10000) {
    put(0xe0 | c >> 12);
    put(0x80 | (c >> 6 & 0x3f));
    put(0x80 | (c & 0x3f));
  } else {
    put(0xf0 | c >> 18);
    put(0x80 | (c >> 12 & 0x3f));
    put(0x80 | (c >> 6 & 0x3f));
    put(0x80 | (c & 0x3f));
  }
}

}  // namespace gable
