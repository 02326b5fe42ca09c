// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The asset workshop's and the lot chooser's side of the server: a model as it is, a model prepared
// and saved, the outlines of initial shapes.
#pragma once

#include <string>

#include "base/json.h"
#include "gable/gable.h"
#include "studio/project_files.h"
#include "studio/session.h"

namespace gable::studio {

/// The answer to /api/model: "GBM1", JSON with bounds and the number that textures are asked by, a
/// draw list. Codes: those of ProjectFiles, model-unreadable.
Result<std::string> modelPreview(const ProjectFiles& files, Session& session,
                                 const std::string& path);

/// The answer to /api/asset: prepares `path` as the request says and writes it to `to`, a .glb of
/// the project; with what it covers of its volume. Codes: those of ProjectFiles, model-unreadable,
/// asset-volume, kind-refused.
Result<std::string> prepareAsset(ProjectFiles& files, const JsonValue& request);

/// Name, ring in plan and area of each shape, of kMostOutlines at most.
std::string outlinesJson(const Shapes& shapes);
constexpr size_t kMostOutlines = 20000;

}  // namespace gable::studio
