# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Checks over the text of the repository. Each module has check(tree), which returns findings."""
