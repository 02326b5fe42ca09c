// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "known_faults.h"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace gable {

KnownFaults::KnownFaults(std::string path) : path_(std::move(path)) {
  std::ifstream file(path_);
  bool reason = false;
  for (std::string text; std::getline(file, text);) {
    Line line{text, {}, {}, 0};
    if (text.empty() || text[0] == '#') {
      reason = !text.empty();
    } else {
      std::istringstream words(text);
      std::string kind, rest;
      words >> line.example >> kind >> line.count >> std::ws;
      std::getline(words, rest);
      line.what = kind + " " + rest;
      if (rest.empty() || line.count == 0) complaints_ += "not understood: " + text + "\n";
      if (!reason) complaints_ += "without a reason above it: " + text + "\n";
    }
    lines_.push_back(line);
  }
  if (lines_.empty()) complaints_ += "there is nothing in " + path_ + "\n";
}

std::string KnownFaults::compare(const std::string& example, const FaultCounts& found) const {
  std::string text;
  FaultCounts known;
  for (const Line& line : lines_) {
    if (line.example != example) continue;
    known[line.what] = line.count;
    if (found.count(line.what) == 0) text += "no longer there: " + line.text + "\n";
  }
  for (const auto& [what, count] : found) {
    const auto at = known.find(what);
    const size_t most = at == known.end() ? 0 : at->second;
    if (count > most) {
      text += what + ": " + std::to_string(count) + ", known are " + std::to_string(most) + "\n";
    }
  }
  return text;
}

void KnownFaults::lower(const std::string& example, const FaultCounts& found) {
  std::vector<Line> left;
  for (Line line : lines_) {
    if (line.example == example) {
      const auto at = found.find(line.what);
      if (at == found.end()) continue;
      const size_t split = line.what.find(' ');
      line.count = std::min(line.count, at->second);
      line.text = example + " " + line.what.substr(0, split) + " " + std::to_string(line.count) +
                  line.what.substr(split);
    }
    left.push_back(line);
  }
  lines_ = std::move(left);
  std::ofstream file(path_);
  for (const Line& line : lines_) file << line.text << "\n";
}

}  // namespace gable
