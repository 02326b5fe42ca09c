// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Maps in formats that other programs read for us, as GeoJSON: OpenStreetMap by gable-maps,
// GeoPackage, FlatGeobuf, shapefiles, KML and DXF by ogr2ogr of GDAL. Both run with limits; where
// one is not installed, an error names its package.
#pragma once

#include <string>
#include <string_view>

#include "base/result.h"
#include "io/importers/asset.h"

namespace gable {

/// By extension: .osm .pbf .gpkg .fgb .shp .kml .dxf.
bool isMap(const std::string& path);
/// Whether it is one of OpenStreetMap: a feature has its kind as a key there, in no layer.
bool isOpenStreetMap(const std::string& path);

/// The map, or the layer of it, in degrees; in the units of the file where that does not say what
/// they are. The parts of a shapefile (.dbf .prj .shx .cpg) are read by `options`. Codes: shapes-
/// reader, shapes-layer, shapes-broken, shapes-too-large.
Result<std::string> mapAsGeoJson(std::string_view bytes, const AssetOptions& options,
                                 const std::string& layer);

/// The same for a file on disk that GDAL reads, as a file in `folder`, for maps that do not fit
/// into memory. Gives its path.
Result<std::string> mapAsGeoJsonFile(const std::string& path, const std::string& layer,
                                     const std::string& folder);

}  // namespace gable
