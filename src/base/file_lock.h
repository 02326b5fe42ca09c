// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A file with a lock, for a piece of work that several processes or threads could do. The lock goes
// with its process: a killed one leaves none behind.
#pragma once

#include <string>

namespace gable {

class FileLock {
 public:
  /// Takes the lock where nobody holds it. The file is made, its folder is not.
  explicit FileLock(std::string path);
  /// Gives it back. The file stays.
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  bool held() const { return file_ >= 0; }
  /// It is not held for another reason than that somebody else holds it; empty where there is none.
  const std::string& failure() const { return failure_; }
  /// Removes the file: the work is done, and nobody needs to lock it again. Whoever has it open
  /// must look whether the work is done.
  void finish() const;

 private:
  std::string path_, failure_;
  int file_ = -1;
};

}  // namespace gable
