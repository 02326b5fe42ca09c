// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#pragma once

/// Takes memory from the system in pages of two megabytes from now on, where mimalloc is installed:
/// the system gives out and takes back a tenth as many, for some more memory.
/// MIMALLOC_LARGE_OS_PAGES=0 keeps the small ones.
void useLargePages();

/// Keeps what is freed from now on for what comes next, where mimalloc is installed: for work that
/// asks for the same large blocks again and again, such as the pictures of a data set or the models
/// of a page. The system need not clear them each time. MIMALLOC_ALLOW_DECOMMIT=1 gives them back.
void keepMemory();
