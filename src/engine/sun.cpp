// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "gable/sun.h"

#include "engine/impl.h"
#include "engine/picture_settings.h"
#include "engine/sun.h"
#include "math/sun_position.h"

namespace gable {

Result<PictureSettings::Sun> sunAt(const SunTime& time, const GeoOrigin& origin) {
  double latitude = origin.latitude, longitude = origin.longitude;
  if (time.place) {
    latitude = time.place->latitude;
    longitude = time.place->longitude;
  } else if (!origin.present) {
    return wrongSetting("the sun's place is not known: the shapes do not say where they lie",
                        "give latitude and longitude with the date and the hour");
  }
  if (!isWithin(latitude, -90, 90) || !isWithin(longitude, -180, 180)) {
    return wrongSetting("there is no such latitude and longitude on the Earth",
                        "latitudes are -90 to 90 degrees, longitudes -180 to 180");
  }
  const bool date = isWithin(time.year, 1950, 2050) && isWithin(time.month, 1, 12) &&
                    isWithin(time.day, 1, 31) && isWithin(time.hour, 0, 24) &&
                    isWithin(time.hoursEast.value_or(0), -14, 14);
  if (!date) {
    return wrongSetting("the sun is not known at that date and hour",
                        "years are 1950 to 2050, hours 0 to 24");
  }
  const SunPosition sun = sunPosition(
      latitude, longitude,
      {time.year, time.month, time.day, time.hour, time.hoursEast.value_or(longitude / 15)});
  return PictureSettings::Sun{sun.elevation, sun.azimuth};
}

std::optional<PictureSettings::Sun> sunOver(const Model& model, const SunTime& time) {
  const Result<PictureSettings::Sun> sun = sunAt(time, model.impl().scene().geoOrigin);
  if (!sun.ok()) return std::nullopt;
  return sun.value();
}

}  // namespace gable
