// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/importers/base64.h"

#include <cstdint>

#include "base/work.h"

namespace gable {
namespace {

int valueOf(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  return c == '/' || c == '_' ? 63 : -1;
}

}  // namespace

bool readDataUri(std::string_view uri, std::string& mime, std::string& bytes) {
  constexpr std::string_view kHead = "data:", kMark = ";base64,";
  if (uri.substr(0, kHead.size()) != kHead) return false;
  const size_t mark = uri.find(kMark);
  if (mark == std::string_view::npos) return false;
  mime = uri.substr(kHead.size(), mark - kHead.size());
  std::string_view text = uri.substr(mark + kMark.size());
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  work(text.size());
  bytes.clear();
  reserveWork(bytes, static_cast<double>(text.size() / 4 * 3 + 3));
  uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int v = valueOf(c);
    if (v < 0) return false;
    bits = bits << 6 | static_cast<uint32_t>(v);
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes += static_cast<char>(bits >> count & 0xff);
    }
  }
  return true;
}

}  // namespace gable
