// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A text as an editor sees it: lines, and characters counted in units of UTF-16. Places outside of
// the text are moved to the nearest inside, so any number that an editor sends is safe. Bytes that
// are no UTF-8 count one unit each. Line ends are \n, \r\n and \r, as the protocol has it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "gable/language.h"

namespace gable::language {

class Text {
 public:
  Text() : Text(std::string()) {}
  explicit Text(std::string content);

  const std::string& content() const { return content_; }
  size_t lineCount() const { return lineStarts_.size(); }
  uint32_t lineStart(uint32_t line) const { return lineStarts_[line]; }
  /// Linear in the length of the line.
  uint32_t offset(Position at) const;
  Position position(uint32_t offset) const;
  Range range(uint32_t begin, uint32_t end) const { return {position(begin), position(end)}; }
  uint32_t lineOf(uint32_t offset) const;

  void apply(const Change& change);

 private:
  void findLines();

  std::string content_;
  std::vector<uint32_t> lineStarts_;
};

}  // namespace gable::language
