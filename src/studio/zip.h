// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Several files as one zip archive, stored as they are.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace gable::studio {

/// Names with '/' between folders, and contents. The same files give the same bytes. Archives stay
/// below 4 GiB; the caller sees to it.
std::string zipped(const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace gable::studio
