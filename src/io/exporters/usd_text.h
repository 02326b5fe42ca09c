// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Text of a USD layer: prims that open and close, names that are identifiers, numbers and texts as
// the format has them; and the zip of a .usdz, which stores its files at multiples of 64 bytes.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/files.h"
#include "math/vec.h"

namespace gable {

/// Names of prims within one parent: identifiers, each once.
class UsdNames {
 public:
  /// `wanted` with underscores for what no identifier has, and a number where it is taken.
  std::string unique(const std::string& wanted);

 private:
  std::set<std::string> taken_;
  std::map<std::string, uint64_t> last_;
};

/// A text in quotes.
std::string usdText(std::string_view text);
/// Without what the path of an asset cannot hold: files to which a layer refers are called so.
std::string usdFileName(std::string name);
/// The path of a file between at signs, as usdFileName.
std::string usdAsset(const std::string& path);
/// "(0.5, 1, 2)" in single precision.
std::string usdVec(const Vec3& v);

/// Writes lines to a file; knows how many bytes they are and their check sum.
class UsdLayer {
 public:
  explicit UsdLayer(FileWriter& out) : out_(out) {}
  /// Indented by what is open.
  void line(std::string_view text);
  /// A line and a brace.
  void open(std::string_view head);
  void close();
  /// As it is, for parts of long lines.
  void raw(std::string_view text);
  /// Hands everything on to the file.
  void flush();
  /// Of all that was handed on.
  uint64_t bytes() const { return bytes_; }
  uint32_t checkSum() const { return ~sum_; }

 private:
  FileWriter& out_;
  std::string buffer_;
  size_t depth_ = 0;
  uint64_t bytes_ = 0;
  uint32_t sum_ = ~uint32_t{0};
};

/// A zip without compression, as .usdz wants it. The same files give the same bytes.
class UsdArchive {
 public:
  explicit UsdArchive(FileWriter& out) : out_(out) {}
  /// Begins a file whose content follows; end() tells what it was.
  void begin(const std::string& name);
  void end(uint64_t bytes, uint32_t checkSum);
  void add(const std::string& name, const std::string& content);
  /// The directory behind all files.
  void finish();
  static constexpr uint64_t kMostBytes = 0xffffffff;

 private:
  struct Entry {
    std::string name;
    uint64_t at = 0, bytes = 0;
    uint32_t sum = 0;
  };
  std::string headOf(const Entry& entry) const;
  FileWriter& out_;
  std::vector<Entry> entries_;
};

}  // namespace gable
