// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/step_text.h"

#include <cmath>

#include "base/hash.h"
#include "base/number.h"
#include "base/text.h"
#include "base/work.h"

namespace gable {
namespace {

constexpr char kHex[] = "0123456789ABCDEF";

void appendHex(std::string& out, uint32_t v, int digits) {
  for (int d = digits - 1; d >= 0; --d) out += kHex[v >> (4 * d) & 15];
}

// The code point at `at`, of the sequence of `size` bytes.
uint32_t codePoint(std::string_view text, size_t at, size_t size) {
  const auto byte = [&](size_t i) { return static_cast<uint32_t>(text[at + i]) & 0xff; };
  if (size == 1) return byte(0);
  uint32_t code = byte(0) & (0x7fu >> size);
  for (size_t i = 1; i < size; ++i) code = code << 6 | (byte(i) & 0x3f);
  return code;
}

// Of what writeShortest and writeFixed write.
void appendPointed(std::string& out, std::string_view number) {
  const size_t e = number.find('e');
  const std::string_view digits = number.substr(0, e);
  out += digits;
  if (digits.find('.') == std::string_view::npos) out += '.';
  if (e != std::string_view::npos) (out += 'E') += number.substr(e + 1);
}

}  // namespace

std::string stepText(std::string_view text, size_t most) {
  std::string out = "'";
  for (size_t at = 0, count = 0; at < text.size() && count < most; ++count) {
    work();
    const size_t size = utf8Length(text, at);
    const uint32_t code = size ? codePoint(text, at, size) : 0xfffd;
    at += size ? size : 1;
    if (code == '\'' || code == '\\') {
      out.append(2, static_cast<char>(code));
    } else if (code >= 0x20 && code < 0x7f) {
      out += static_cast<char>(code);
    } else if (code > 0xffff) {
      out += "\\X4\\";
      appendHex(out, code, 8);
      out += "\\X0\\";
    } else {
      out += "\\X2\\";
      appendHex(out, code, 4);
      out += "\\X0\\";
    }
  }
  return out + "'";
}

std::string stepReal(double v) {
  std::string out;
  if (!std::isfinite(v)) return "0.";
  appendPointed(out, shortestText(v));
  return out;
}

void appendStepReal(std::string& out, double v, int decimals) {
  char text[kNumberRoom];
  const char* end = writeFixed(text, std::isfinite(v) ? v : 0, decimals);
  appendPointed(out, {text, static_cast<size_t>(end - text)});
}

std::string stepGuid(uint64_t a, uint64_t b) {
  constexpr char kLetters[] = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$";
  uint64_t high = hashCombine(hashCombine(0x6761626c65, a), b), low = hashCombine(high, a ^ ~b);
  std::string out(22, '0');
  for (size_t i = out.size(); i > 0; --i) {
    out[i - 1] = kLetters[low & 63];
    low = low >> 6 | (high & 63) << 58;
    high >>= 6;
  }
  return out;
}

}  // namespace gable
