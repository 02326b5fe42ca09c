// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Source text to tokens. Never fails: bytes that belong to no token are reported and passed over.
// Time and memory are linear in the text; beyond kMaxTokens the rest of the file is not read and
// the diagnostic `file-too-large` says so.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/diagnostic.h"
#include "lang/token.h"

namespace gable::lang {

/// About 50 times the largest rule file seen in the field; bounds memory to some hundred MiB.
inline constexpr size_t kMaxTokens = 2'000'000;

/// `file` is the id that spans of diagnostics carry.
Tokens tokenize(std::string_view text, uint32_t file, Diagnostics& diagnostics);

/// The value of a string token, quotes removed and escapes replaced: \n \t \r \" \\ \uXXXX.
/// A backslash before anything else stands for itself (paths of old files).
std::string stringValue(std::string_view tokenText);

}  // namespace gable::lang
