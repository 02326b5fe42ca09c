// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "language/text.h"

#include <algorithm>

#include "base/text.h"

namespace gable::language {

namespace {

/// The units of UTF-16 that the character at `at` takes, and its bytes.
struct Step {
  uint32_t bytes = 1, units = 1;
};

Step stepAt(std::string_view text, size_t at) {
  const auto lead = static_cast<unsigned char>(text[at]);
  if (lead < 0x80) return {1, 1};
  const size_t length = utf8Length(text, at);
  if (length == 0) return {1, 1};
  return {static_cast<uint32_t>(length), length == 4 ? 2u : 1u};
}

}  // namespace

Text::Text(std::string content) : content_(std::move(content)) { findLines(); }

void Text::findLines() {
  lineStarts_.assign(1, 0);
  for (size_t at = content_.find_first_of("\r\n"); at != std::string::npos;
       at = content_.find_first_of("\r\n", at)) {
    at += content_[at] == '\r' && at + 1 < content_.size() && content_[at + 1] == '\n' ? 2 : 1;
    lineStarts_.push_back(static_cast<uint32_t>(at));
  }
}

uint32_t Text::lineOf(uint32_t offset) const {
  const auto next = std::upper_bound(lineStarts_.begin(), lineStarts_.end(), offset);
  return static_cast<uint32_t>(next - lineStarts_.begin() - 1);
}

uint32_t Text::offset(Position at) const {
  if (at.line >= lineStarts_.size()) return static_cast<uint32_t>(content_.size());
  uint32_t end = at.line + 1 < lineStarts_.size() ? lineStarts_[at.line + 1]
                                                  : static_cast<uint32_t>(content_.size());
  uint32_t offset = lineStarts_[at.line];
  while (end > offset && (content_[end - 1] == '\n' || content_[end - 1] == '\r')) --end;
  for (uint32_t units = 0; offset < end && units < at.character;) {
    const Step step = stepAt(content_, offset);
    // The middle of a pair of surrogates is its beginning.
    if (units + step.units > at.character) break;
    units += step.units;
    offset += step.bytes;
  }
  return std::min(offset, end);
}

Position Text::position(uint32_t offset) const {
  offset = std::min(offset, static_cast<uint32_t>(content_.size()));
  const uint32_t line = lineOf(offset);
  Position out{line, 0};
  for (uint32_t at = lineStarts_[line]; at < offset;) {
    const Step step = stepAt(content_, at);
    if (at + step.bytes > offset) break;
    out.character += step.units;
    at += step.bytes;
  }
  return out;
}

void Text::apply(const Change& change) {
  if (!change.range) {
    content_ = change.text;
  } else {
    const uint32_t a = offset(change.range->begin), b = offset(change.range->end);
    content_.replace(std::min(a, b), std::max(a, b) - std::min(a, b), change.text);
  }
  findLines();
}

}  // namespace gable::language
