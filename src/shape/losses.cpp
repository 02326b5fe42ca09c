// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "shape/losses.h"

namespace gable {

std::string lossesOf(std::string_view path, const std::vector<std::string>& losses) {
  constexpr size_t kMost = 4;
  std::string text = "'" + std::string(path) + "' is read with losses: ";
  for (size_t i = 0; i < losses.size() && i < kMost; ++i) text += (i > 0 ? "; " : "") + losses[i];
  if (losses.size() > kMost) text += "; and " + std::to_string(losses.size() - kMost) + " more";
  return text;
}

}  // namespace gable
