// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "io/exporters/usd_text.h"

#include <algorithm>
#include <array>

#include "base/number.h"

namespace gable {
namespace {

constexpr size_t kBuffer = 1 << 16;
// Deeper prims are not indented further: rules nest as deep as they like.
constexpr size_t kDeepest = 12;
constexpr uint64_t kAlignment = 64;
constexpr uint64_t kFileHead = 30;

constexpr std::array<uint32_t, 256> kSums = [] {
  std::array<uint32_t, 256> table{};
  for (uint32_t i = 0; i < 256; ++i) {
    uint32_t c = i;
    for (int k = 0; k < 8; ++k) c = (c & 1) != 0 ? 0xedb88320u ^ (c >> 1) : c >> 1;
    table[i] = c;
  }
  return table;
}();

uint32_t summed(uint32_t sum, std::string_view bytes) {
  for (const char b : bytes) sum = kSums[(sum ^ static_cast<unsigned char>(b)) & 0xff] ^ (sum >> 8);
  return sum;
}

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

void put16(std::string& out, uint64_t v) {
  out.push_back(static_cast<char>(v & 0xff));
  out.push_back(static_cast<char>(v >> 8 & 0xff));
}

void put32(std::string& out, uint64_t v) {
  put16(out, v & 0xffff);
  put16(out, v >> 16 & 0xffff);
}

}  // namespace

std::string UsdNames::unique(const std::string& wanted) {
  std::string name = wanted.empty() ? "part" : wanted;
  for (char& c : name) {
    if (!isLetter(c) && !isDigit(c)) c = '_';
  }
  if (isDigit(name[0])) name.insert(name.begin(), '_');
  if (taken_.insert(name).second) return name;
  uint64_t& number = last_[name];
  std::string other;
  do {
    other = name + "_" + std::to_string(++number);
  } while (!taken_.insert(other).second);
  return other;
}

std::string usdText(std::string_view text) {
  constexpr char kHex[] = "0123456789abcdef";
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20 || byte == 0x7f) {
      out += {'\\', 'x', kHex[byte >> 4], kHex[byte & 15]};
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string usdFileName(std::string name) {
  for (char& c : name) {
    if (c == '@' || static_cast<unsigned char>(c) < 0x20) c = '_';
  }
  return name;
}

std::string usdAsset(const std::string& path) { return "@" + usdFileName(path) + "@"; }

std::string usdVec(const Vec3& v) {
  std::string out = "(";
  for (size_t i = 0; i < 3; ++i) {
    char text[kNumberRoom];
    out.append(i ? ", " : "");
    out.append(text, writeShortest(text, static_cast<float>(v[i])));
  }
  return out + ")";
}

void UsdLayer::line(std::string_view text) {
  buffer_.append(4 * std::min(depth_, kDeepest), ' ');
  buffer_.append(text);
  buffer_ += '\n';
  if (buffer_.size() > kBuffer) flush();
}

void UsdLayer::open(std::string_view head) {
  if (!head.empty()) line(head);
  line("{");
  ++depth_;
}

void UsdLayer::close() {
  --depth_;
  line("}");
}

void UsdLayer::raw(std::string_view text) {
  buffer_.append(text);
  if (buffer_.size() > kBuffer) flush();
}

void UsdLayer::flush() {
  out_.append(buffer_);
  bytes_ += buffer_.size();
  sum_ = summed(sum_, buffer_);
  buffer_.clear();
}

// Version to the length of the name: what a file's head and its entry in the directory share.
std::string UsdArchive::headOf(const Entry& entry) const {
  constexpr uint32_t kVersion = 20, kUtf8Names = 1u << 11, kStored = 0;
  // The first day that the format knows.
  constexpr uint32_t kTime = 0, kDate = 1 << 5 | 1;
  std::string out;
  for (const uint32_t v : {kVersion, kUtf8Names, kStored, kTime, kDate}) put16(out, v);
  for (const uint64_t v : {uint64_t{entry.sum}, entry.bytes, entry.bytes}) put32(out, v);
  put16(out, entry.name.size());
  return out;
}

// The extra field, an unused kind of it, fills up to the alignment.
void UsdArchive::begin(const std::string& name) {
  Entry entry{name, out_.offset()};
  const uint64_t named = entry.at + kFileHead + name.size();
  uint64_t extra = (kAlignment - named % kAlignment) % kAlignment;
  if (extra > 0 && extra < 4) extra += kAlignment;
  std::string head = "PK\x03\x04" + headOf(entry);
  put16(head, extra);
  head += name;
  if (extra > 0) {
    put16(head, 0x1986);
    put16(head, extra - 4);
    head.append(extra - 4, '\0');
  }
  out_.append(head);
  entries_.push_back(std::move(entry));
}

void UsdArchive::end(uint64_t bytes, uint32_t checkSum) {
  Entry& entry = entries_.back();
  entry.bytes = bytes;
  entry.sum = checkSum;
  const std::string head = headOf(entry);
  out_.patch(entry.at + 4, head.data(), head.size());
}

void UsdArchive::add(const std::string& name, const std::string& content) {
  begin(name);
  out_.append(content);
  end(content.size(), ~summed(~uint32_t{0}, content));
}

void UsdArchive::finish() {
  std::string directory;
  for (const Entry& e : entries_) {
    directory += "PK\x01\x02";
    put16(directory, 20);
    directory += headOf(e);
    for (int i = 0; i < 4; ++i) put16(directory, 0);
    put32(directory, 0);
    put32(directory, e.at);
    directory += e.name;
  }
  const uint64_t start = out_.offset(), size = directory.size();
  directory += "PK\x05\x06";
  for (const uint64_t v :
       {uint64_t{0}, uint64_t{0}, uint64_t{entries_.size()}, uint64_t{entries_.size()}}) {
    put16(directory, v);
  }
  put32(directory, size);
  put32(directory, start);
  put16(directory, 0);
  out_.append(directory);
}

}  // namespace gable
