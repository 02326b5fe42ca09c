// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Seen tints: the look of a coarse part is that of what one sees of the finer model in its place.
//
// Much of what a rule makes is hidden: what lies behind a wall, the back of a frame, a pane under
// its bars. Depth images of both models from several directions tell what is not. Parts of one look
// that are seen from one direction keep one look, so that a front of one stone is not a patchwork.
#pragma once

#include <cstddef>
#include <vector>

#include "tiles/depth_image.h"

namespace gable {

class SeenTints {
 public:
  explicit SeenTints(double tolerance) : tolerance_(tolerance) {}

  /// Counts what a pair of images of equal cells shows, of `area` square metres each; `parts` are
  /// those of the coarse model that `coarse` shows, and stay in number from pair to pair.
  void add(const DepthImage& fine, const DepthImage& coarse, const std::vector<CoarsePart>& parts,
           double area);
  /// Gives the parts their looks; those that nothing was seen of keep theirs.
  void apply(std::vector<CoarsePart>& parts) const;

 private:
  // Of a part: what was seen in the place of its front, of its back where that alone is seen, and
  // the pair of images that shows most of it.
  struct Seen {
    Tint tint;
    bool isFront = false;
    double most = 0;
    size_t pair = 0;
  };

  void count(Seen& seen, const Tint& front, const Tint& back) const;

  double tolerance_;
  size_t pairs_ = 0;
  std::vector<Seen> seen_;
};

}  // namespace gable
