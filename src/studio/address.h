// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The address that a project's studio had last. One that is started again takes it up, so that the
// pages that are still open find it. Kept in the project's `.gable`, for its owner's eyes alone.
#pragma once

#include <cstdint>
#include <string>

#include "studio/project_files.h"

namespace gable::studio {

struct Address {
  /// 0 and empty where nothing is known.
  uint16_t port = 0;
  std::string token;
};

/// What was kept; nothing where others could have read or written it.
Address addressBefore(const ProjectFiles& files);
/// A folder that cannot be written is no failure: pages then need the new address.
void keepAddress(const ProjectFiles& files, const Address& address);

}  // namespace gable::studio
