// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A table prints as its size and a line for each row, an array of one dimension as "(3)[1,2,3]".

#include "cases/values.h"

#include <cstdlib>
#include <sstream>

#include "cases/expectation.h"

namespace gable::cases {
namespace {

/// The elements of a printed table: its size, then a line for each row. Cells have no blanks.
std::vector<std::string> tableElements(std::string_view text) {
  std::vector<std::string> elements(1, "[");
  std::istringstream lines{std::string(text.substr(text.find('\n') + 1))};
  for (std::string line; std::getline(lines, line);) {
    if (elements.size() > 1) elements.emplace_back(";");
    std::istringstream cells(line);
    for (std::string cell; cells >> cell;) elements.push_back(cell);
  }
  return elements;
}

/// The elements of "(3)[1,2,3]" or "[1, 2; 3, 4]" without blanks and the size before the bracket;
/// the text itself when it is no array. Row ends stay as ";".
std::vector<std::string> elementsOf(std::string_view text) {
  if (text.starts_with('(') && text.find('\n') != std::string_view::npos) {
    return tableElements(text);
  }
  const size_t open = text.find('[');
  if (open == std::string_view::npos || text.back() != ']') return {std::string(text)};
  std::vector<std::string> elements(1, "[");
  elements.emplace_back();
  for (char c : text.substr(open + 1, text.size() - open - 2)) {
    if (c == ',' || c == ';') {
      if (c == ';') elements.emplace_back(";");
      elements.emplace_back();
    } else if (c != ' ' && c != '"') {
      elements.back() += c;
    }
  }
  return elements;
}

}  // namespace

std::vector<ValueLine> valueLines(const Section& section) {
  std::vector<ValueLine> result;
  size_t number = section.textLine;
  for (std::string_view line : linesOf(section.text)) {
    const std::string_view whole = trimmed(line);
    const size_t at = whole.rfind(" = ");
    if (!whole.empty() && whole.front() != '#') {
      if (at == std::string_view::npos)
        result.push_back({"", "", number});
      else {
        result.push_back({std::string(trimmed(whole.substr(0, at))),
                          std::string(trimmed(whole.substr(at + 3))), number});
      }
    }
    ++number;
  }
  return result;
}

bool sameValue(std::string_view found, std::string_view wanted) {
  if (wanted.size() >= 2 && wanted.front() == '"' && wanted.back() == '"') {
    return found == wanted.substr(1, wanted.size() - 2);
  }
  const std::vector<std::string> a = elementsOf(found), b = elementsOf(wanted);
  if (a.size() != b.size()) return false;
  for (size_t i = 0; i < a.size(); ++i) {
    if (a[i] == b[i]) continue;
    char* end = nullptr;
    const double number = std::strtod(a[i].c_str(), &end);
    size_t used = 0;
    if (a[i].empty() || *end != '\0' || !meets(number, {b[i]}, 0, used)) return false;
  }
  return true;
}

}  // namespace gable::cases
