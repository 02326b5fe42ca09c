// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What is told of a file of which something is left out: one message a file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gable {

/// By the sentences that the file's reader gave; code read-with-loss.
std::string lossesOf(std::string_view path, const std::vector<std::string>& losses);
/// The hint of such a message.
inline constexpr const char* kWithoutThem = "the rest of the file is used as it is";

}  // namespace gable
