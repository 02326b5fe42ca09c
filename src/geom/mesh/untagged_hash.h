// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The hash of a mesh without its tags. Numbers of tag sets depend on who came first, so what is
// named by a hash outside of a derivation is named by this one.
#pragma once

#include <cstdint>

#include "geom/mesh/mesh.h"

namespace gable {

/// Equal for meshes that differ in tags alone; never 0. Uses Mesh::sharedHash(): for meshes that no
/// longer change. Linear in the tags.
uint64_t untaggedHash(const Mesh& mesh);

}  // namespace gable
