// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What is told of a command line that cannot be read.
#pragma once

#include "cli_tree.h"

/// Tells it, with the nearest word that there is, and gives the exit status. Help and the version
/// are no mistakes.
int wrongLine(const CLI::App& app, const CLI::ParseError& e, int argc, char** argv);
