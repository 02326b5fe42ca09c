// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// file: addresses and paths, each way.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gable::lsp {

/// The absolute path of a file: address; none for other schemes and for what is no address.
std::optional<std::string> pathOfUri(std::string_view uri);
std::string uriOfPath(std::string_view path);

}  // namespace gable::lsp
