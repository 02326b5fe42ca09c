// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#pragma once

#include "common.h"

/// What the arguments say about a derivation; an exit status other than kExitDone, with a message,
/// when an option is wrong.
int deriveSettings(const DeriveArguments& arguments, gable::DeriveSettings& settings);
