// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Bytes inside URIs.
#pragma once

#include <string>
#include <string_view>

namespace gable {

/// The bytes of "data:...;base64,...". False when it is no such URI or not base64 (RFC 4648;
/// missing padding is forgiven). `mime` gets what stands before ";base64".
bool readDataUri(std::string_view uri, std::string& mime, std::string& bytes);

}  // namespace gable
