// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Tags of OpenStreetMap that GDAL has put together. Its reader gives the commonest tags columns of
// their own, and the rest as one text in the column "other_tags", in the notation of PostgreSQL's
// hstore: "building:levels"=>"5","roof:shape"=>"gabled", with \ before quotes and itself.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gable {

inline constexpr std::string_view kOtherTags = "other_tags";

/// The pairs of such a text in its order, NULL values left out. What is not written that way is
/// not read from there on. Linear in the length.
std::vector<std::pair<std::string, std::string>> otherTags(std::string_view text);

}  // namespace gable
