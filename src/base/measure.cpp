// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "base/measure.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "base/number.h"
#include "base/text.h"

namespace gable {
namespace {

constexpr double kFoot = 0.3048, kInch = 0.0254, kMile = 1609.344;

bool isDigit(char c) { return c >= '0' && c <= '9'; }

void dropSpace(std::string_view& text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
}

// Takes a number from the front. A comma is a decimal one, but for what may be a thousand.
std::optional<double> takeNumber(std::string_view& text) {
  size_t end = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
  const size_t first = end;
  const auto digits = [&] {
    const size_t begin = end;
    while (end < text.size() && isDigit(text[end])) ++end;
    return end - begin;
  };
  size_t count = digits();
  if (end < text.size() && (text[end] == '.' || text[end] == ',')) {
    const bool comma = text[end++] == ',';
    const size_t decimals = digits();
    if (comma && (decimals == 0 || decimals == 3 || count == 0)) return std::nullopt;
    count += decimals;
  }
  if (count == 0) return std::nullopt;
  std::string plain(text.substr(first, end - first));
  std::replace(plain.begin(), plain.end(), ',', '.');
  double value = 0;
  if (!parseNumber(plain, value)) return std::nullopt;
  const bool negative = text[0] == '-';
  text.remove_prefix(end);
  dropSpace(text);
  return negative ? -value : value;
}

struct Unit {
  std::string_view name;
  double metres;
};
// The signs of minutes and quotation marks are those that editors put for ' and ".
constexpr Unit kUnits[] = {{"m", 1},
                           {"metre", 1},
                           {"metres", 1},
                           {"meter", 1},
                           {"meters", 1},
                           {"cm", 0.01},
                           {"km", 1000},
                           {"mi", kMile},
                           {"mile", kMile},
                           {"miles", kMile},
                           {"ft", kFoot},
                           {"foot", kFoot},
                           {"feet", kFoot},
                           {"'", kFoot},
                           {"\xe2\x80\xb2", kFoot},
                           {"\xe2\x80\x99", kFoot},
                           {"in", kInch},
                           {"inch", kInch},
                           {"inches", kInch},
                           {"\"", kInch},
                           {"''", kInch},
                           {"\xe2\x80\xb3", kInch},
                           {"\xe2\x80\x9d", kInch}};

// Takes a unit from the front, up to the next number.
std::optional<double> takeUnit(std::string_view& text) {
  const auto end = std::find_if(text.begin(), text.end(), isDigit);
  std::string_view name = text.substr(0, static_cast<size_t>(end - text.begin()));
  text.remove_prefix(name.size());
  dropSpace(name);
  const Unit* unit = std::find_if(std::begin(kUnits), std::end(kUnits),
                                  [&](const Unit& u) { return equalButForCase(u.name, name); });
  return unit == std::end(kUnits) ? std::nullopt : std::optional(unit->metres);
}

}  // namespace

std::optional<double> writtenNumber(std::string_view text) {
  dropSpace(text);
  const std::optional<double> number = takeNumber(text);
  return text.empty() ? number : std::nullopt;
}

std::optional<double> writtenMetres(std::string_view text) {
  dropSpace(text);
  const std::optional<double> number = takeNumber(text);
  if (!number || text.empty()) return number;
  const std::optional<double> unit = takeUnit(text);
  if (!unit) return std::nullopt;
  if (text.empty()) return *number * *unit;
  // Inches behind feet, also without their sign.
  if (*unit != kFoot) return std::nullopt;
  const std::optional<double> inches = takeNumber(text);
  if (!inches || *inches < 0 || *inches >= 12) return std::nullopt;
  const std::optional<double> small = text.empty() ? std::optional(kInch) : takeUnit(text);
  if (small != kInch || !text.empty()) return std::nullopt;
  return *number * kFoot + *inches * kInch;
}

}  // namespace gable
