// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "city/country.h"

#include <gtest/gtest.h>

namespace gable {
namespace {

struct Town {
  const char *name, *country;
  double longitude, latitude;
};

TEST(Country, ACodeIsOneOfIso3166) {
  for (const char* code : {"AD", "CZ", "GB", "MC", "ZW"}) EXPECT_TRUE(isCountryCode(code)) << code;
  for (const char* code : {"", " ", "C", "XX", "UK", "mc", "D ", " M", "DA", "CZ ", "CZE", "AD AE"})
    EXPECT_FALSE(isCountryCode(code)) << code;
}

TEST(Country, TownsLieInTheirCountries) {
  const Town towns[] = {{"Monaco", "MC", 7.424, 43.738},     {"Nice", "FR", 7.266, 43.70},
                        {"Ventimiglia", "IT", 7.607, 43.79}, {"Praha", "CZ", 14.44, 50.08},
                        {"Brno", "CZ", 16.61, 49.20},        {"Wien", "AT", 16.37, 48.21},
                        {"Bratislava", "SK", 17.11, 48.15},  {"Budapest", "HU", 19.04, 47.50},
                        {"Paris", "FR", 2.35, 48.86},        {"Lille", "FR", 3.06, 50.63},
                        {"Le Havre", "FR", 0.11, 49.49},     {"Strasbourg", "FR", 7.75, 48.57},
                        {"Toulouse", "FR", 1.44, 43.60},     {"Freiburg", "DE", 7.85, 47.99},
                        {"Berlin", "DE", 13.40, 52.52},      {"Hamburg", "DE", 9.99, 53.55},
                        {"Duisburg", "DE", 6.76, 51.43},     {"Muenchen", "DE", 11.58, 48.14},
                        {"Amsterdam", "NL", 4.90, 52.37},    {"Delft", "NL", 4.36, 52.01},
                        {"Maastricht", "NL", 5.69, 50.85},   {"Bruxelles", "BE", 4.35, 50.85},
                        {"London", "GB", -0.13, 51.51},      {"Glasgow", "GB", -4.25, 55.86},
                        {"Belfast", "GB", -5.93, 54.60},     {"Dublin", "IE", -6.26, 53.35},
                        {"Lisboa", "PT", -9.14, 38.72},      {"Madrid", "ES", -3.70, 40.42},
                        {"Barcelona", "ES", 2.17, 41.39},    {"Roma", "IT", 12.50, 41.89},
                        {"Trieste", "IT", 13.77, 45.65},     {"Zuerich", "CH", 8.54, 47.37},
                        {"Geneve", "CH", 6.14, 46.20},       {"Besancon", "FR", 6.02, 47.24},
                        {"Ljubljana", "SI", 14.51, 46.05},   {"Zagreb", "HR", 15.98, 45.81},
                        {"Split", "HR", 16.44, 43.51},       {"Sarajevo", "BA", 18.41, 43.86},
                        {"Beograd", "RS", 20.46, 44.82},     {"Athina", "GR", 23.73, 37.98},
                        {"Sofia", "BG", 23.32, 42.70},       {"Bucuresti", "RO", 26.10, 44.43},
                        {"Timisoara", "RO", 21.23, 45.75},   {"Warszawa", "PL", 21.01, 52.23},
                        {"Szczecin", "PL", 14.55, 53.43},    {"Krakow", "PL", 19.94, 50.06},
                        {"Kobenhavn", "DK", 12.57, 55.68},   {"Goeteborg", "SE", 11.97, 57.71},
                        {"Stockholm", "SE", 18.07, 59.33},   {"Oslo", "NO", 10.75, 59.91},
                        {"Helsinki", "FI", 24.94, 60.17},    {"Tallinn", "EE", 24.75, 59.44},
                        {"Riga", "LV", 24.11, 56.95},        {"Vilnius", "LT", 25.28, 54.69},
                        {"Lviv", "UA", 24.03, 49.84},        {"Istanbul", "TR", 28.98, 41.01}};
  for (const Town& t : towns) EXPECT_EQ(countryAt(t.longitude, t.latitude), t.country) << t.name;
  EXPECT_EQ(countryAt(0, -60), "");
}

TEST(Country, AddressesGoBeforeTheTable) {
  MapFeatures map;
  map.features.resize(2);
  EXPECT_EQ(countryOf(map), "");
  map.features[1].tags = {{"addr:country", "CH"}};
  EXPECT_EQ(countryOf(map), "CH");
}

}  // namespace
}  // namespace gable
