// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "lsp/framing.h"

#include <algorithm>

#include "base/text.h"

namespace gable::lsp {

namespace {

// The number of a Content-Length line in a head; none where there is none, or no number.
std::optional<uint64_t> lengthOf(std::string_view head) {
  const std::string low = lowerCase(head);
  constexpr std::string_view kName = "content-length:";
  size_t at = low.find(kName);
  while (at != std::string::npos && at > 0 && low[at - 1] != '\n') at = low.find(kName, at + 1);
  if (at == std::string::npos) return std::nullopt;
  at += kName.size();
  while (at < low.size() && (low[at] == ' ' || low[at] == '\t')) ++at;
  uint64_t value = 0;
  bool any = false;
  for (; at < low.size() && low[at] >= '0' && low[at] <= '9'; ++at) {
    any = true;
    if (value > (uint64_t{1} << 50)) return std::nullopt;
    value = value * 10 + static_cast<uint64_t>(low[at] - '0');
  }
  return any ? std::optional<uint64_t>(value) : std::nullopt;
}

}  // namespace

std::optional<Framing::Frame> Framing::next() {
  if (at_ > 0 && (at_ == buffer_.size() || at_ > (1u << 20))) {
    buffer_.erase(0, at_);
    at_ = 0;
  }
  if (skip_ > 0) {
    const uint64_t passed = std::min<uint64_t>(skip_, buffer_.size() - at_);
    at_ += passed;
    skip_ -= passed;
    if (skip_ > 0) return std::nullopt;
  }
  const std::string_view rest = std::string_view(buffer_).substr(at_);
  const size_t end = rest.find("\r\n\r\n");
  if (end == std::string_view::npos) {
    if (rest.size() <= kLargestHead) return std::nullopt;
    // No head is this long: what stands there is lost.
    buffer_.clear();
    at_ = 0;
    return Frame{{}, "the head of a message has no end"};
  }
  const std::optional<uint64_t> length = lengthOf(rest.substr(0, end));
  if (!length) {
    at_ += end + 4;
    return Frame{{}, "the head of a message has no Content-Length"};
  }
  if (*length > kLargestMessage) {
    at_ += end + 4;
    skip_ = *length;
    return Frame{{}, "the message is larger than " + std::to_string(kLargestMessage) + " bytes"};
  }
  if (rest.size() < end + 4 + *length) return std::nullopt;
  Frame out{std::string(rest.substr(end + 4, *length)), {}};
  at_ += end + 4 + *length;
  return out;
}

std::string framed(std::string_view body) {
  return "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + std::string(body);
}

}  // namespace gable::lsp
