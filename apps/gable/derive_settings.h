// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The steps of commands that derive a model and write it. Each tells what goes wrong.
#pragma once

#include <cstdio>

#include "common.h"
#include "json/answers.h"

/// What the arguments say about a derivation; an exit status other than kExitDone, with a message,
/// when an option is wrong.
int deriveSettings(const DeriveArguments& arguments, gable::DeriveSettings& settings);

/// Which features of a map the arguments name.
gable::FeatureSelection selectionOf(const DeriveArguments& arguments);

/// The rules that the arguments name; an exit status other than kExitDone when they are not usable.
int readRules(const DeriveArguments& arguments, gable::Rules& rules);

/// The model that is worked with. It lives to the end of the process, which frees it at once; piece
/// by piece a large one takes tenths of a second.
gable::Model& heldModel();

/// Makes heldModel(), with a line of progress.
void deriveHeld(const gable::Rules& rules, const gable::Shapes& shapes,
                gable::DeriveSettings settings);
/// The same, and prints its diagnostics. What the rules print goes to `prints`.
gable::Model deriveModel(const gable::Rules& rules, const gable::Shapes& shapes,
                         const gable::DeriveSettings& settings, std::FILE* prints);

/// How the arguments want a model written to a path; says what they have against a profile. An exit
/// status other than kExitDone when an option is wrong.
int writeSettings(const WriteArguments& arguments, const std::string& path,
                  const LimitArguments& limits, gable::WriteSettings& settings);

/// Writes the model to a file, with a line of progress; an exit status. The figures tell what
/// deriving and writing took.
int writeModel(const gable::Model& model, const std::string& path,
               const gable::WriteSettings& settings, gable::RunFigures& figures);
