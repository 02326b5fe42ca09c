// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The ellipsoid of WGS 84 (NGA.STND.0036): its two defining lengths.
#pragma once

namespace gable::wgs84 {

/// Half the equator's diameter, in metres.
inline constexpr double kSemiMajor = 6378137;
inline constexpr double kFlattening = 1 / 298.257223563;

}  // namespace gable::wgs84
