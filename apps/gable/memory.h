// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#pragma once

/// Takes memory from the system in pages of two megabytes from now on, where mimalloc is installed:
/// for commands that make much anew, or look here and there in much. They take a little more of it.
/// MIMALLOC_LARGE_OS_PAGES=0 keeps the small ones.
void useLargePages();
