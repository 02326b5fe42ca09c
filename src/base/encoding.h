// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Encodings of text files. Rule files of many years were written by Windows programs.
#pragma once

#include <string>
#include <string_view>

namespace gable {

/// Whether all of a text is UTF-8.
bool isUtf8(std::string_view text);

/// The bytes of a text file as UTF-8: UTF-8 stays as it is, UTF-16 is known by its byte order mark,
/// and all else is read as Windows-1252, in which every byte is a character.
std::string utf8Of(std::string bytes);

}  // namespace gable
