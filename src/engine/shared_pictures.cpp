// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "engine/shared_pictures.h"

#include <algorithm>

namespace gable {

SharedPictures::Coming::Coming(SharedPictures& shared) : shared_(shared) {
  const std::lock_guard lock(shared_.mutex_);
  ++shared_.coming_;
}

SharedPictures::Coming::~Coming() {
  const std::lock_guard lock(shared_.mutex_);
  --shared_.coming_;
  shared_.changed_.notify_all();
}

/// A picture that was taken, until it is drawn or left.
struct SharedPictures::Drawing {
  SharedPictures& shared;
  Seed& seed;

  ~Drawing() {
    const std::lock_guard lock(shared.mutex_);
    --seed.busy;
    shared.changed_.notify_all();
  }
};

/// A seed that others may help with. In the end nobody is at it.
struct SharedPictures::Offer {
  SharedPictures& shared;
  Seed& seed;

  Offer(SharedPictures& s, Seed& of) : shared(s), seed(of) {
    const std::lock_guard lock(shared.mutex_);
    shared.seeds_.push_back(&seed);
    shared.changed_.notify_all();
  }
  Offer(const Offer&) = delete;
  Offer& operator=(const Offer&) = delete;
  ~Offer() {
    std::unique_lock lock(shared.mutex_);
    std::erase(shared.seeds_, &seed);
    shared.changed_.wait(lock, [this] { return seed.busy == 0; });
  }
};

bool SharedPictures::take(Seed& seed, uint32_t& picture) {
  if (seed.next >= seed.count) return false;
  picture = seed.next++;
  ++seed.busy;
  return true;
}

void SharedPictures::drawAll(uint32_t count, const Draw& draw) {
  Seed seed{count, &draw};
  const Offer offer(*this, seed);
  for (;;) {
    uint32_t picture = 0;
    {
      const std::lock_guard lock(mutex_);
      if (!take(seed, picture)) return;
    }
    const Drawing drawing{*this, seed};
    draw(picture);
  }
}

void SharedPictures::help() {
  for (;;) {
    Seed* seed = nullptr;
    uint32_t picture = 0;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] {
        const auto at =
            std::find_if(seeds_.begin(), seeds_.end(), [&](Seed* s) { return take(*s, picture); });
        seed = at == seeds_.end() ? nullptr : *at;
        return seed || coming_ == 0;
      });
    }
    if (!seed) return;
    const Drawing drawing{*this, *seed};
    (*seed->draw)(picture);
  }
}

}  // namespace gable
