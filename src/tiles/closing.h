// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Closing: nobody looks into a house through what a coarse model leaves out, and what is left looks
// like what one sees of it.
//
// A narrow part can be the only thing that is in its place, such as the pane of a window in its
// reveal. So a coarse model is held against the finer one that it was made of, feature by feature,
// in depth images from the directions that its surfaces face. Where the finer one shows a front and
// the coarse one a back that lies deeper, or nothing between what it shows to both sides, there is
// a hole. Holes are covered with rectangles in the depth and the colour of what the finer one
// shows. The same images tell the looks of all parts (tiles/seen_tints.h).
#pragma once

#include "tiles/coarse.h"

namespace gable {

/// A feature is left as it is from where it looks longer than so many times the tolerance.
constexpr double kLongestClosed = 256;

/// Adds what closes `coarse`, whose parts count the features of `fine`, from above and all sides,
/// and gives all parts their looks.
/// Holes narrower than a quarter of the tolerance may stay. Returns how far the farthest of what a
/// rectangle stands for is from its plane. O(triangles + 256 * 256) for each feature and direction,
/// of which there are eight at most.
double closeHoles(const CoarseModel& fine, double tolerance, CoarseModel& coarse);

}  // namespace gable
