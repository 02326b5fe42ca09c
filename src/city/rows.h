// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rows: buildings that stand wall to wall. Where the map says nothing of some of them, they get
// what lets the row look like one: storeys as those beside them have, one chance for what rules
// draw, and the roofs that others of the row have.
#pragma once

#include <vector>

#include "city/buildings.h"
#include "city/ground.h"

namespace gable {

/// Sets guessedLevels, rowChance and rowRoof of `facts`. Buildings of unknown storeys that touch
/// each other get one number: the middle of what their known neighbours in the row have where these
/// are a third of them at least, else of their own guesses. What is smaller than a house joins no
/// row. O(n log n).
void joinRows(const std::vector<GroundPiece>& ground, const std::vector<MapFeature>& features,
              std::vector<BuildingFacts>& facts);

}  // namespace gable
