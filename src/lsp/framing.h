// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Messages out of a stream of bytes: a head with Content-Length, an empty line, so many bytes. What
// is longer than the limit is passed over and counted as broken; after a head that cannot be read
// the next one is looked for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gable::lsp {

class Framing {
 public:
  /// A rule file of the largest size, with what JSON makes of its signs.
  static constexpr uint64_t kLargestMessage = 128u << 20;
  static constexpr size_t kLargestHead = 16 << 10;

  struct Frame {
    /// Empty for a broken one.
    std::string body;
    std::string trouble;
  };

  void feed(std::string_view bytes) { buffer_ += bytes; }
  /// The next message; none until more bytes come.
  std::optional<Frame> next();

 private:
  std::string buffer_;
  size_t at_ = 0;
  uint64_t skip_ = 0;
};

std::string framed(std::string_view body);

}  // namespace gable::lsp
