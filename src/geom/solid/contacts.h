// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Contacts: where facets meet. Each facet gets the edges and points along which others cut or touch
// it; two facets get the same ones. Facets in one plane share all that lies on either.
#pragma once

#include "geom/solid/facets.h"

namespace gable::solid {

/// O(n log n) for the search, and a pass over both facets for each pair whose boxes meet.
void findContacts(Facets& facets);

}  // namespace gable::solid
