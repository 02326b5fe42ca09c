// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Only strings and brackets are looked at. The list of features is what follows the key "features"
// of the outermost object.
#include "io/importers/feature_pieces.h"

#include "base/work.h"

namespace gable {
namespace {

constexpr size_t kPiece = 1 << 20;

bool isSpace(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

}  // namespace

Result<uint64_t> FeaturePieces::open(const std::string& path) {
  buffer_.resize(kPiece);
  rewind();
  return file_.open(path);
}

void FeaturePieces::rewind() {
  file_.rewind();
  used_ = filled_ = depth_ = 0;
  piece_.clear();
  rest_.clear();
  key_.clear();
  inString_ = escaped_ = inList_ = inFeature_ = isKey_ = false;
}

Result<std::string> FeaturePieces::next() {
  piece_.clear();
  for (;;) {
    for (; used_ < filled_; ++used_) {
      if (piece_.size() >= kPiece && !inFeature_) return std::move(piece_);
      take(buffer_[used_]);
    }
    const Result<size_t> more = file_.read(buffer_.data(), buffer_.size());
    if (!more.ok()) return more.error();
    used_ = 0;
    filled_ = more.value();
    workMemory(filled_);
    if (filled_ > 0) continue;
    // A feature without an end is for the reader of the rest to complain of.
    if (inFeature_) rest_ += piece_, piece_.clear();
    inFeature_ = false;
    return std::move(piece_);
  }
}

void FeaturePieces::take(char c) {
  if (!inFeature_) return takeOutside(c);
  piece_ += c;
  if (inString_) {
    inString_ = escaped_ || c != '"';
    escaped_ = !escaped_ && c == '\\';
  } else if (c == '"') {
    inString_ = true;
  } else if (c == '{' || c == '[') {
    ++depth_;
  } else if (c == '}' || c == ']') {
    inFeature_ = --depth_ > 0;
  }
}

void FeaturePieces::takeOutside(char c) {
  if (inString_) {
    rest_ += c;
    const bool ends = !escaped_ && c == '"';
    escaped_ = !escaped_ && c == '\\';
    inString_ = !ends;
    if (!ends && !escaped_) key_ += c;
    return;
  }
  if (inList_ && depth_ == 0 && c == '{') {
    inFeature_ = true;
    depth_ = 1;
    if (!piece_.empty()) piece_ += ',';
    piece_ += c;
    return;
  }
  if (inList_ && depth_ == 0 && (c == ',' || isSpace(c))) return;
  rest_ += c;
  if (c == '"') {
    inString_ = isKey_ = true;
    key_.clear();
  } else if (c == '{' || c == '[') {
    if (!inList_ && depth_ == 1 && c == '[' && isKey_ && key_ == "features") {
      inList_ = true;
      depth_ = 0;
    } else {
      ++depth_;
    }
    isKey_ = false;
  } else if (c == '}' || c == ']') {
    if (inList_ && depth_ == 0) {
      // The list ends; the outermost object goes on.
      inList_ = false;
      depth_ = 1;
    } else if (depth_ > 0) {
      --depth_;
    }
    isKey_ = false;
  } else if (c != ':' && !isSpace(c)) {
    isKey_ = false;
  }
}

}  // namespace gable
