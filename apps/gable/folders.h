// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What lies beside the program, in a build and installed.
#pragma once

#include <initializer_list>
#include <string>

/// The first folder that holds `file`, as seen from the program; empty where none does.
std::string folderWith(const char* file, const std::initializer_list<const char*>& folders);
/// The examples that come with Gable; empty where they are not there.
std::string examplesFolder();
/// The folder of the studio's page; empty where it is not built.
std::string studioPage();
