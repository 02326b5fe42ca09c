// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Initial shapes as bytes, by which one process hands them on to another (plans of tiles).
#pragma once

#include <string>

#include "base/bytes.h"
#include "engine/impl.h"

namespace gable {

/// All of a footprint. The same footprint gives the same bytes.
void appendRecord(const ShapeFootprint& f, std::string& out);

/// False where the bytes are no footprint that can be derived.
bool readRecord(ByteReader& reader, ShapeFootprint& f);

}  // namespace gable
