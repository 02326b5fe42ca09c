// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/shared/text_files.h"

#include <algorithm>
#include <cstdint>

#include "base/text.h"

namespace gable {

namespace {

std::string fromUtf16(std::string_view bytes, bool bigEndian) {
  std::string out;
  const auto unit = [&](size_t at) {
    const auto a = static_cast<unsigned char>(bytes[at]);
    const auto b = static_cast<unsigned char>(bytes[at + 1]);
    return bigEndian ? uint32_t{a} << 8 | b : uint32_t{b} << 8 | a;
  };
  for (size_t at = 2; at + 1 < bytes.size(); at += 2) {
    uint32_t c = unit(at);
    if (c >= 0xd800 && c < 0xdc00 && at + 3 < bytes.size()) {
      const uint32_t low = unit(at + 2);
      if (low >= 0xdc00 && low < 0xe000) {
        c = 0x10000 + ((c - 0xd800) << 10) + (low - 0xdc00);
        at += 2;
      }
    }
    appendUtf8(out, c);
  }
  return out;
}

// One line of cells; `at` moves behind its end.
std::vector<std::string> readRow(std::string_view text, size_t& at, char delimiter) {
  std::vector<std::string> row(1);
  bool quoted = false;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (quoted) {
      if (c != '"') {
        row.back() += c;
      } else if (at + 1 < text.size() && text[at + 1] == '"') {
        row.back() += text[++at];
      } else {
        quoted = false;
      }
    } else if (c == '"' && row.back().empty()) {
      quoted = true;
    } else if (c == delimiter) {
      row.emplace_back();
    } else if (c == '\n') {
      ++at;
      break;
    } else {
      row.back() += c;
    }
  }
  return row;
}

// The delimiter that occurs most often in the first line; one that occurs equally often in each of
// the first lines goes before others.
char delimiterOf(std::string_view text) {
  char best = ',';
  size_t most = 0;
  for (const char candidate : {',', ';', '\t', ' '}) {
    size_t at = 0, columns = 0;
    bool agree = true;
    for (int line = 0; line < 5 && at < text.size(); ++line) {
      const size_t n = readRow(text, at, candidate).size();
      if (line == 0) columns = n;
      agree = agree && n == columns;
    }
    if (columns < 2) continue;
    const size_t score = agree ? columns << 32 : columns;
    if (score > most) {
      most = score;
      best = candidate;
    }
  }
  return best;
}

}  // namespace

std::string decodedText(std::string_view bytes) {
  std::string text;
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) {
    text = fromUtf16(bytes, bytes[0] == '\xfe');
  } else {
    text = bytes.starts_with("\xef\xbb\xbf") ? bytes.substr(3) : bytes;
  }
  std::string out;
  out.reserve(text.size());
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\r') {
      if (i + 1 == text.size() || text[i + 1] != '\n') out += '\n';
    } else {
      const bool control = static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t';
      out += control || c == 0x7f ? '?' : c;
    }
  }
  return out;
}

TextTable parseTable(std::string_view text) {
  TextTable table;
  const char delimiter = delimiterOf(text);
  std::vector<std::vector<std::string>> rows;
  for (size_t at = 0; at < text.size();) rows.push_back(readRow(text, at, delimiter));
  for (const auto& row : rows) table.columns = std::max(table.columns, row.size());
  table.rows = rows.size();
  for (auto& row : rows) {
    row.resize(table.columns);
    std::move(row.begin(), row.end(), std::back_inserter(table.cells));
  }
  return table;
}

}  // namespace gable
