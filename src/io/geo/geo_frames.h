// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The frames that files of shapes have (shape/geo_frame.h): local metres about a point of the
// Earth, and metres of a map projection.
#pragma once

#include <memory>
#include <string_view>

#include "io/geo/transverse_mercator.h"
#include "shape/geo_frame.h"

namespace gable {

/// Local metres about a point.
std::shared_ptr<const GeoFrame> localGeoFrame(const LonLat& center);

/// Metres of the map projection that `system` names ("EPSG:32632", "urn:ogc:def:crs:EPSG::3857");
/// the world's origin lies at `origin` on the map. Degrees are known of UTM on WGS 84 (EPSG 326xx
/// and 327xx), of UTM on ETRS89 (258xx) and of the web's Mercator (3857), and of no other.
std::shared_ptr<const GeoFrame> mapGeoFrame(std::string_view system, Vec2 origin);

/// The frame of a GeoFrame::text(); null for any other text.
std::shared_ptr<const GeoFrame> geoFrameOf(std::string_view text);

}  // namespace gable
