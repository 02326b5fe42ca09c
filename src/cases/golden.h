// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Expected results in files of their own: scenes as text, pictures as PNG. Paths count from the
// test file.
#pragma once

#include <string>
#include <vector>

#include "cases/case_file.h"
#include "gable/limits.h"
#include "gable/model.h"

namespace gable::cases {

class GoldenFiles {
 public:
  GoldenFiles(std::string folder, bool update, const FileLimits& limits)
      : folder_(std::move(folder)), update_(update), limits_(limits) {}

  /// The statement `scene FILE`: the file holds the dump. Empty when it holds, else what differs.
  std::string checkScene(const Statement& s, const std::string& dump);
  /// The statement `picture FILE [VIEW] [WIDTHxHEIGHT]`: the file shows the model.
  std::string checkPicture(const Statement& s, const Model& model);

  /// What an update has written.
  const std::vector<std::string>& written() const { return written_; }

 private:
  std::string write(const std::string& path, const std::string& bytes);

  std::string folder_;
  bool update_;
  FileLimits limits_;
  std::vector<std::string> written_;
};

}  // namespace gable::cases
