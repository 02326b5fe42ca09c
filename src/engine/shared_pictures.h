// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Work on the pictures of several seeds: who has no seed of his own left helps with the pictures of
// others.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

namespace gable {

class SharedPictures {
 public:
  using Draw = std::function<void(uint32_t picture)>;

  /// While it lives, pictures may come of what its owner does.
  class Coming {
   public:
    explicit Coming(SharedPictures& shared);
    ~Coming();
    Coming(const Coming&) = delete;
    Coming& operator=(const Coming&) = delete;

   private:
    SharedPictures& shared_;
  };

  /// Calls draw(0) to draw(count - 1), each once, here and on the threads that help. Returns when
  /// all have ended; what `draw` throws here ends the others first.
  void drawAll(uint32_t count, const Draw& draw);
  /// Draws for others until nothing is coming any more. What `draw` throws is thrown here.
  void help();

 private:
  struct Seed {
    uint32_t count = 0;
    const Draw* draw = nullptr;
    uint32_t next = 0, busy = 0;
  };
  struct Drawing;
  struct Offer;

  /// Takes the next picture of a seed, with the lock held.
  static bool take(Seed& seed, uint32_t& picture);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Seed*> seeds_;
  uint32_t coming_ = 0;
};

}  // namespace gable
