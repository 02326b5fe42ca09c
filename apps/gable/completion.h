// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the completions of the shells share.
#pragma once

#include <string>

#include "describe.h"

/// As one word of a shell.
std::string shellQuoted(const std::string& text);

std::string zshText(const CommandDescription& program);
