// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Several seeds in one run: what each gives goes to files of its own, named by the seed.

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>

#include "answer.h"
#include "commands.h"
#include "gable/files.h"

namespace {

/// Beyond it, numbers of type double leave whole numbers out.
constexpr double kLargestSeed = 9007199254740991;

}  // namespace

std::string withSeed(const std::string& path, const std::string& seed) {
  if (path.empty() || path == "-") return path;
  const size_t slash = path.find_last_of("/\\");
  const size_t name = slash == std::string::npos ? 0 : slash + 1;
  // Some formats have an ending of two parts: .city.json.
  size_t cut = path.rfind('.');
  for (const std::string& e : gable::modelExtensions()) {
    if (path.ends_with("." + e)) cut = std::min(cut, path.size() - e.size() - 1);
  }
  if (cut == std::string::npos || cut <= name) cut = path.size();
  return path.substr(0, cut) + "-" + seed + path.substr(cut);
}

int forSeeds(int count, const std::string& firstSeed,
             const std::function<int(const std::string& seed)>& once) {
  double first = 0;
  if (!parseSeed(firstSeed, first) || first != std::floor(first) || first < -kLargestSeed ||
      first + count > kLargestSeed) {
    return wrongOption("--seed", "with --count a whole number or the word random", firstSeed);
  }
  const int64_t begin = static_cast<int64_t>(first);
  const int digits = static_cast<int>(std::to_string(begin + count - 1).size());
  int status = kExitDone;
  for (int64_t seed = begin; seed < begin + count && !*cancelFlag(); ++seed) {
    char text[32];
    std::snprintf(text, sizeof text, "%0*" PRId64, seed < 0 ? 1 : digits, seed);
    status = once(text);
    printAnswer(status);
    if (status != kExitDone) return status;
  }
  return *cancelFlag() ? kExitLimit : status;
}
