// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "builtins/shared/arrays.h"

#include <algorithm>
#include <cctype>
#include <limits>

#include "base/number.h"
#include "base/text.h"

namespace gable {

Value stringArray(const std::vector<std::string>& items, ValuePool& pool) {
  Array a;
  a.element = ValueType::String;
  a.rows = items.empty() ? 0 : 1;
  a.columns = static_cast<uint32_t>(items.size());
  for (const std::string& s : items) a.strings.push_back(pool.intern(s));
  return pool.intern(std::move(a));
}

std::vector<std::string> stringsOf(const Array& a, const ValuePool& pool) {
  std::vector<std::string> out;
  out.reserve(a.strings.size());
  for (const StringId s : a.strings) out.emplace_back(pool.text(s));
  return out;
}

std::vector<std::string_view> itemsOf(std::string_view list) {
  std::vector<std::string_view> items;
  while (!list.empty()) {
    const size_t end = std::min(list.find(';'), list.size());
    items.push_back(list.substr(0, end));
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return items;
}

namespace {

template <class Text>
std::string listed(const std::vector<Text>& items) {
  std::string out;
  for (const Text& s : items) {
    out.append(s).push_back(';');
    if (out.size() > kMaxTextLength) break;
  }
  return out;
}

}  // namespace

std::string listOf(const std::vector<std::string>& items) { return listed(items); }
std::string listOf(const std::vector<std::string_view>& items) { return listed(items); }

namespace {

int compareNumbers(double a, double b) { return a < b ? -1 : b < a ? 1 : 0; }

int compareElements(const Array& a, size_t i, const Array& b, size_t j, const ValuePool& pool) {
  if (a.element == ValueType::String) {
    return pool.text(a.strings[i]).compare(pool.text(b.strings[j]));
  }
  return compareNumbers(a.numbers[i], b.numbers[j]);
}

}  // namespace

int orderOf(const Value& a, const Value& b, const ValuePool& pool) {
  if (!a.isArray()) {
    if (a.type == ValueType::String) return pool.text(a.id).compare(pool.text(b.id));
    return compareNumbers(a.number, b.number);
  }
  const Array& x = pool.array(a);
  const Array& y = pool.array(b);
  for (uint32_t r = 0; r < std::min(x.rows, y.rows); ++r) {
    for (uint32_t c = 0; c < std::min(x.columns, y.columns); ++c) {
      const int order =
          compareElements(x, size_t{r} * x.columns + c, y, size_t{r} * y.columns + c, pool);
      if (order != 0) return order;
    }
    if (x.columns != y.columns) return x.columns < y.columns ? -1 : 1;
  }
  return x.rows == y.rows ? 0 : x.rows < y.rows ? -1 : 1;
}

double numberOf(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) {
    text.remove_prefix(1);
  }
  double v = 0;
  const char* begin = text.data();
  if (text.empty() || readNumber(begin, begin + text.size(), v) == begin) {
    if (text == "inf" || text == "+inf") return std::numeric_limits<double>::infinity();
    if (text == "-inf") return -std::numeric_limits<double>::infinity();
    return std::numeric_limits<double>::quiet_NaN();
  }
  return v;
}

bool truthOf(std::string_view text) {
  const std::string lower = lowerCase(text);
  double v = 1;
  return !(lower == "f" || lower == "false" || (parseNumber(lower, v) && v == 0));
}

}  // namespace gable
