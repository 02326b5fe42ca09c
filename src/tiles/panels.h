// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Panels: rectangles of another look than the wall that they are in, such as windows.
//
// A rule makes a window of frames and panes. Each is narrow, while the window is what is seen of a
// front. So narrow parts in one plane that fill a rectangle together become one part of their mean
// look. A front is what lies in nearly one plane; the look that most of it has is that of its wall,
// which is left to plates (tiles/plates.h).
//
// All panels of a front stay or none, so that its windows look alike: they stay where at least half
// of their area, with that of large parts that are no wall, is in such as are as wide as half of
// the tolerance. What is narrower than a quarter of it is no panel.
#pragma once

#include "tiles/coarse.h"

namespace gable {

struct Panelled {
  /// The model with panels in the place of what they are made of; CoarsePart::isPanel says which of
  /// its parts stay, however narrow.
  CoarseModel model;
  /// How far the farthest of what a panel stands for is from it, in metres.
  double offset = 0;
};

/// O(n log n) in the parts where windows are apart from each other.
Panelled withPanels(const CoarseModel& model, double tolerance);

}  // namespace gable
