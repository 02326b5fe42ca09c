// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What materials look like from far away: their colour, times the mean of their texture, and how
// rough they are.
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "io/exporters/write_model.h"
#include "tiles/finish.h"

namespace gable {

class TextureTints {
 public:
  /// The reader has to outlive it.
  explicit TextureTints(const TextureReader& read) : read_(read) {}
  /// A texture that cannot be read is white. Threads may call it at a time.
  Finish of(const Material& m);

 private:
  Vec3 meanLight(const std::string& path);
  double meanNumber(const std::string& path);
  /// Empty where it cannot be read.
  std::vector<uint8_t> rgbaOf(const std::string& path) const;

  /// What is known of a path; what is made for it where nothing is, by a thread or several.
  template <class Mean, class Make>
  Mean known(std::map<std::string, Mean>& means, const std::string& path, Make&& make);

  const TextureReader& read_;
  std::mutex knowing_;
  /// By path.
  std::map<std::string, Vec3> colors_;
  std::map<std::string, double> numbers_;
};

}  // namespace gable
