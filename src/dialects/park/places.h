// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Where a word of an argument stands. Arguments are rewritten before they are understood; what is
// wrong in one is found again in the text by its words.
#pragma once

#include <string_view>

#include "base/diagnostic.h"

namespace gable::park {

/// The first place in the span that says `text`, whatever its capitals, and is no part of a longer
/// word; the whole span where there is none.
Span placeOf(std::string_view source, Span span, std::string_view text);

}  // namespace gable::park
