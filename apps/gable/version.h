// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the program says of itself.
#pragma once

#include <string>

/// "gable 1.2.3", and below it what it was built with.
std::string versionText();

/// What each exit status means: "Exit status:" and a line each.
std::string exitText();
