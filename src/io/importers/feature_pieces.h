// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A file of GeoJSON in pieces: its features some hundred at a time, as text, so that a map of any
// size is read in little memory. The rest of the file, which is short, is kept as it is.
#pragma once

#include <string>
#include <vector>

#include "base/file_pieces.h"
#include "base/result.h"

namespace gable {

class FeaturePieces {
 public:
  Result<uint64_t> open(const std::string& path);
  /// The next features with commas between them; empty at the end. What is no JSON is found by who
  /// reads the pieces, and what stands between features is part of rest().
  Result<std::string> next();
  /// next() begins again.
  void rewind();
  /// At the end: the file without its features, {"type":"FeatureCollection","features":[]}.
  const std::string& rest() const { return rest_; }

 private:
  void take(char c);
  void takeOutside(char c);

  FilePieces file_;
  std::vector<char> buffer_;
  size_t used_ = 0, filled_ = 0;
  std::string piece_, rest_;
  // Within strings, and after a backslash in one.
  bool inString_ = false, escaped_ = false;
  // Within the list of features, and within one of them.
  bool inList_ = false, inFeature_ = false;
  size_t depth_ = 0;
  // The last string of the outermost object, and whether nothing but a colon followed it.
  std::string key_;
  bool isKey_ = false;
};

}  // namespace gable
