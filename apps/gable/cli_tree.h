// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What all commands have, added to each when they are declared; and the tree as data.
#pragma once

#include <CLI/CLI.hpp>

#include "describe.h"

/// The options of every command (--quiet, --verbose, --json, --color), the names of their values,
/// and the examples of their help.
void addCommon(CLI::App& program);

CommandDescription describe(const CLI::App& program);

/// The innermost command of what was parsed; the program itself before.
const CLI::App& chosenApp(const CLI::App& program);
/// "tiles plan" of what was parsed; empty before.
std::string chosenCommand(const CLI::App& program);
