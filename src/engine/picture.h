// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The door to pictures for the rest of the engine.
#pragma once

#include <string>

#include "engine/guard.h"
#include "engine/impl.h"

namespace gable {

/// A PNG. Where a limit ends the tracing, what was made is written, as when it is cancelled; where
/// one ends what comes before, there is no picture.
WriteResult drawnPicture(const Model::Impl& model, const std::string& path,
                         const PictureSettings& settings, Task& task);

}  // namespace gable
