// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The terrain of a place as bytes, by which one process hands it on to another (plans of tiles).
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "city/terrain_surface.h"

namespace gable {

/// The same terrain gives the same bytes.
std::string terrainBytes(const TerrainSurface& terrain);

/// Null where the bytes are no terrain.
std::shared_ptr<const TerrainSurface> terrainOf(std::string_view bytes);

}  // namespace gable
