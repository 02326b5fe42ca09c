// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The words of two texts are held against each other by their longest common subsequence; what is
// not in it is replaced, run by run. A comment within a run is not touched.

#include <algorithm>

#include "language/rule_form.h"
#include "language/words.h"

namespace gable::language {

namespace {

/// A rule has some dozen words; above this the runs between equal ends are replaced as a whole.
constexpr size_t kMostWords = 1500;

struct Side {
  std::string_view text;
  std::vector<Word> words, comments;

  explicit Side(std::string_view t) : text(t) {
    for (const Word& w : wordsOf(t)) (w.kind == WordKind::Comment ? comments : words).push_back(w);
  }
  std::string_view word(size_t i) const {
    return text.substr(words[i].begin, words[i].end - words[i].begin);
  }
};

// For each word of `a` the one of `b` that it is, or -1; both grow.
std::vector<ptrdiff_t> matched(const Side& a, const Side& b) {
  const size_t n = a.words.size(), m = b.words.size();
  std::vector<ptrdiff_t> out(n, -1);
  size_t head = 0, tail = 0;
  while (head < std::min(n, m) && a.word(head) == b.word(head)) {
    out[head] = static_cast<ptrdiff_t>(head);
    ++head;
  }
  while (tail < std::min(n, m) - head && a.word(n - 1 - tail) == b.word(m - 1 - tail)) {
    out[n - 1 - tail] = static_cast<ptrdiff_t>(m - 1 - tail);
    ++tail;
  }
  const size_t rows = n - head - tail, columns = m - head - tail;
  if (rows > kMostWords || columns > kMostWords) return out;
  std::vector<uint16_t> best((rows + 1) * (columns + 1), 0);
  const auto at = [&](size_t i, size_t j) -> uint16_t& { return best[i * (columns + 1) + j]; };
  for (size_t i = rows; i-- > 0;) {
    for (size_t j = columns; j-- > 0;) {
      const bool same = a.word(head + i) == b.word(head + j);
      at(i, j) =
          same ? static_cast<uint16_t>(at(i + 1, j + 1) + 1) : std::max(at(i + 1, j), at(i, j + 1));
    }
  }
  for (size_t i = 0, j = 0; i < rows && j < columns;) {
    if (a.word(head + i) == b.word(head + j)) {
      out[head + i++] = static_cast<ptrdiff_t>(head + j++);
    } else if (at(i + 1, j) >= at(i, j + 1)) {
      ++i;
    } else {
      ++j;
    }
  }
  return out;
}

}  // namespace

std::vector<Edit> wordEdits(const Text& text, uint32_t begin, uint32_t end,
                            std::string_view after) {
  const Side a(std::string_view(text.content()).substr(begin, end - begin)), b(after);
  const std::vector<ptrdiff_t> match = matched(a, b);
  std::vector<Edit> out;
  const auto put = [&](uint32_t from, uint32_t to, std::string_view with) {
    out.push_back({text.range(begin + from, begin + to), std::string(with)});
  };
  const auto commented = [&](uint32_t from, uint32_t to) {
    return std::any_of(a.comments.begin(), a.comments.end(),
                       [&](const Word& c) { return c.begin >= from && c.end <= to; });
  };
  size_t j = 0;
  for (size_t i = 0; i <= a.words.size();) {
    size_t next = i;
    while (next < a.words.size() && match[next] < 0) ++next;
    const size_t to = next < a.words.size() ? static_cast<size_t>(match[next]) : b.words.size();
    const uint32_t before = i > 0 ? a.words[i - 1].end : 0;
    const uint32_t beforeNew = j > 0 ? b.words[j - 1].end : 0;
    if (next == i && to > j) {
      put(before, before, after.substr(beforeNew, b.words[to - 1].end - beforeNew));
    } else if (next > i && to == j) {
      const uint32_t last = a.words[next - 1].end;
      if (!commented(before, last)) {
        put(before, last, "");
      } else {
        for (size_t k = i; k < next; ++k) put(a.words[k].begin, a.words[k].end, "");
      }
    } else if (next > i) {
      const std::string_view with =
          after.substr(b.words[j].begin, b.words[to - 1].end - b.words[j].begin);
      const uint32_t first = a.words[i].begin, last = a.words[next - 1].end;
      if (!commented(first, last)) {
        put(first, last, with);
      } else {
        put(first, a.words[i].end, with);
        for (size_t k = i + 1; k < next; ++k) put(a.words[k].begin, a.words[k].end, "");
      }
    }
    if (next == a.words.size()) break;
    i = next + 1;
    j = to + 1;
  }
  return out;
}

}  // namespace gable::language
