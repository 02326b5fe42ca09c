// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The page that shows tiles, beside them.
#pragma once

#include <string>

class ViewerPage {
 public:
  /// Before what takes long: whether the page is built, and may be put into the folder. An exit
  /// status, with a message.
  int find(const std::string& folder);
  /// The same for tiles, which are worth having without a page: one that is not built is told.
  int findOrTell(const std::string& folder);
  /// Writes it; nothing where none was found.
  int write() const;

 private:
  std::string from_, folder_;
};

/// gable tiles viewer.
int runTilesViewer(const std::string& folder);
