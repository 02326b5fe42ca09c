// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Line by line, word by word through the text of OBJ and MTL files.
#pragma once

#include <string>
#include <string_view>

#include "base/number.h"

namespace gable {

/// The rest of a line as words.
struct LineWords {
  const char* p = nullptr;
  const char* end = nullptr;
  /// Which line of the text it is, from 1; of a line that goes on, the last.
  uint64_t line = 0;

  static bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\r'; }
  void skip() {
    while (p < end && isSpace(*p)) ++p;
  }
  bool atEnd() {
    skip();
    return p == end;
  }
  std::string_view word() {
    skip();
    const char* start = p;
    while (p < end && !isSpace(*p)) ++p;
    return {start, static_cast<size_t>(p - start)};
  }
  /// A finite number that is a word of its own.
  bool number(double& v) {
    skip();
    double read = 0;
    const char* after = readNumber(p, end, read);
    if (after == p || (after < end && !isSpace(*after)) || !(read - read == 0)) return false;
    p = after;
    v = read;
    return true;
  }
  /// Everything up to the end, without the spaces around it.
  std::string_view rest() {
    skip();
    const char* last = end;
    while (last > p && isSpace(last[-1])) --last;
    const std::string_view all{p, static_cast<size_t>(last - p)};
    p = end;
    return all;
  }
};

/// Calls `visit(LineWords)` for each line that is neither empty nor a comment. A line that ends in
/// a backslash goes on in the next one; such lines are copied.
template <class Visit>
void forEachLine(std::string_view text, Visit&& visit) {
  const char* p = text.data();
  const char* const end = p + text.size();
  std::string joined;
  uint64_t number = 0;
  while (p < end) {
    ++number;
    const char* stop = p;
    while (stop < end && *stop != '\n') ++stop;
    const char* last = stop;
    if (last > p && last[-1] == '\r') --last;
    const bool goesOn = last > p && last[-1] == '\\';
    if (goesOn || !joined.empty()) {
      joined.append(p, static_cast<size_t>(last - p) - (goesOn ? 1 : 0));
      joined += ' ';
    }
    LineWords line{p, last, number};
    p = stop < end ? stop + 1 : end;
    if (goesOn && p < end) continue;
    if (!joined.empty()) line = {joined.data(), joined.data() + joined.size(), number};
    if (!line.atEnd() && *line.p != '#') visit(line);
    joined.clear();
  }
}

}  // namespace gable
