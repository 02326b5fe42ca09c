// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Sheets: parts of coarse models that are thin across a plane, of which walls and windows are made.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "tiles/coarse.h"

namespace gable {

/// The axis along which a box is thinnest, the first of equal ones.
size_t thinnestOf(const Vec3& size);

/// Of the largest side, in square metres; the second as a weight, of at most 1e12: rules can make
/// larger ones.
double faceArea(const Box3& box);
double weightOf(const Box3& box);

/// A unit axis of a frame, in the world.
Vec3 axisOf(const Frame& frame, size_t axis);

/// Of the box of a part, in the world.
std::array<Vec3, 8> cornersOf(const CoarsePart& p);

/// Behind the last part of the feature whose parts begin there.
size_t endOfFeature(const std::vector<CoarsePart>& parts, size_t begin);

/// Gives a part whose box is flat across its z the triangles of that rectangle, which looks along
/// z.
void addFlat(CoarseModel& model, CoarsePart& p);

/// Of the triangles of a part, in square metres.
double shownOf(const CoarseModel& model, const CoarsePart& p);

struct Sheet {
  /// Of the model.
  size_t part = 0;
  /// Of the axis across it, in steps within which directions are equal; the sign is such that both
  /// sides of a wall have one plane.
  std::array<int64_t, 3> direction{};
  Vec3 normal;
  /// Where the plane lies along the normal, in metres.
  double offset = 0;
};

/// A part as a sheet; none where it is thicker than `most` metres or not finite.
std::optional<Sheet> sheetOf(const CoarseModel& model, size_t part, double most);

/// By direction and place along it.
bool liesBefore(const Sheet& a, const Sheet& b);

/// The square metres of a sheet that look along its normal, negative where they look against it.
/// Faces know where they look by the z of their scope; what has a thickness does not.
double facingOf(const CoarseModel& model, const Sheet& s);

/// The axes of a sheet, at its middle; z is along its normal, or against it where `facing`, summed
/// over a wall, is below 0.
Frame frameOf(const CoarseModel& model, const Sheet& s, double facing);

}  // namespace gable
