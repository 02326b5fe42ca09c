// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Models that the program gable-convert reads for us: FBX and COLLADA.
#pragma once

#include <string>
#include <string_view>

#include "io/importers/asset.h"

namespace gable {

/// By the extension.
bool isConvertible(const std::string& path);

/// What a failure of gable-convert (base/child_process.h) means for a file.
Error converterFailed(const Error& why, const std::string& path);

struct ConvertedModel {
  std::string obj, mtl;
  /// For the reader of OBJ: the materials are read from `mtl`.
  AssetOptions options;
};
/// Codes: asset-converter (the program is missing), asset-broken, asset-too-large.
Result<ConvertedModel> convertModel(std::string_view bytes, const AssetOptions& options);

}  // namespace gable
