// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "city/country.h"

#include <algorithm>
#include <map>

#include "base/work.h"

namespace gable {
namespace {

struct CountryBox {
  const char* country;
  double west, south, east, north;
};
// The first that has the place counts: small countries before those around them, and several boxes
// for a country that one does not fit. The test lists the towns that they are made for.
constexpr CountryBox kBoxes[] = {
    {"MC", 7.408, 43.724, 7.440, 43.752}, {"VA", 12.445, 41.900, 12.458, 41.908},
    {"SM", 12.40, 43.89, 12.52, 43.99},   {"LI", 9.47, 47.05, 9.64, 47.27},
    {"AD", 1.41, 42.43, 1.79, 42.66},     {"MT", 14.1, 35.7, 14.7, 36.1},
    {"LU", 5.73, 49.45, 6.50, 50.18},     {"CY", 32.2, 34.5, 34.7, 35.7},
    {"BE", 2.9, 50.75, 5.65, 51.30},      {"BE", 3.6, 50.3, 5.65, 50.75},
    {"BE", 5.65, 50.3, 6.2, 50.70},       {"BE", 4.9, 49.6, 5.8, 50.3},
    {"NL", 3.3, 51.30, 6.2, 53.6},        {"NL", 5.9, 52.1, 6.95, 53.6},
    {"NL", 5.6, 50.75, 6.0, 51.30},       {"CH", 6.05, 46.1, 6.5, 46.6},
    {"CH", 6.5, 46.1, 7.5, 47.2},         {"CH", 7.5, 45.95, 9.4, 47.6},
    {"CH", 9.4, 46.3, 10.4, 47.1},        {"AT", 9.6, 46.85, 13.0, 47.5},
    {"AT", 12.9, 46.5, 16.0, 48.35},      {"AT", 15.0, 47.2, 16.7, 48.75},
    {"IT", 13.6, 45.6, 13.85, 45.75},     {"SI", 13.5, 45.5, 15.7, 46.65},
    {"CZ", 12.3, 49.75, 14.3, 50.7},      {"CZ", 13.6, 48.85, 16.8, 50.6},
    {"CZ", 16.2, 48.85, 18.5, 50.1},      {"SK", 16.95, 47.85, 19.0, 49.3},
    {"SK", 18.5, 48.3, 22.4, 49.4},       {"HU", 16.2, 45.9, 18.9, 47.85},
    {"HU", 18.5, 46.2, 22.3, 48.3},       {"DK", 8.0, 54.85, 11.0, 57.8},
    {"DK", 10.9, 54.5, 12.65, 56.2},      {"IE", -10.6, 51.4, -6.0, 54.4},
    {"PT", -9.6, 36.9, -7.0, 41.95},      {"GB", -8.2, 54.0, -5.5, 55.4},
    {"GB", -6.4, 50.0, 1.3, 51.15},       {"GB", -5.4, 51.0, 1.8, 53.5},
    {"GB", -8.7, 53.3, 0.5, 60.9},        {"ES", -9.3, 35.9, -1.8, 43.8},
    {"ES", -1.8, 36.0, 0.6, 42.9},        {"ES", 0.6, 38.6, 3.4, 42.4},
    {"FR", -5.2, 43.3, 6.6, 49.4},        {"FR", -2.0, 49.2, 1.7, 50.1},
    {"FR", 6.0, 43.0, 7.55, 44.2},        {"FR", 1.5, 49.4, 4.9, 51.1},
    {"FR", 5.8, 44.2, 7.0, 45.95},        {"FR", 6.0, 47.2, 7.79, 49.1},
    {"FR", 8.5, 41.3, 9.6, 43.1},         {"FR", 0.5, 42.3, 4.0, 43.4},
    {"IT", 6.6, 43.7, 13.6, 46.5},        {"IT", 8.1, 36.6, 15.0, 44.0},
    {"IT", 14.0, 37.0, 18.6, 42.0},       {"IT", 10.4, 46.2, 12.9, 47.0},
    {"BA", 16.6, 43.55, 19.2, 45.1},      {"BA", 17.5, 43.2, 18.9, 43.6},
    {"HR", 13.4, 44.0, 19.1, 46.5},       {"HR", 15.0, 42.4, 18.5, 44.0},
    {"ME", 18.4, 41.8, 20.2, 43.5},       {"AL", 19.2, 39.6, 20.6, 42.4},
    {"MK", 20.6, 40.9, 23.0, 42.35},      {"RS", 18.8, 42.2, 22.5, 45.0},
    {"RS", 18.8, 45.0, 20.9, 46.2},       {"GR", 19.3, 34.8, 26.6, 41.2},
    {"GR", 26.6, 34.8, 28.3, 37.6},       {"BG", 22.3, 41.2, 28.7, 43.95},
    {"MD", 28.0, 45.6, 29.7, 48.3},       {"RO", 20.2, 43.6, 29.8, 48.1},
    {"DE", 5.9, 47.5, 13.0, 54.9},        {"DE", 12.9, 50.6, 14.4, 54.7},
    {"DE", 14.4, 50.8, 14.95, 52.5},      {"PL", 14.1, 50.3, 23.6, 54.9},
    {"PL", 17.5, 49.2, 22.8, 50.3},       {"LT", 20.9, 53.9, 26.9, 56.3},
    {"LV", 20.9, 56.2, 28.3, 58.1},       {"EE", 21.7, 57.8, 28.3, 59.7},
    {"SE", 11.0, 55.3, 19.3, 60.0},       {"SE", 12.2, 60.0, 18.9, 64.0},
    {"SE", 14.5, 64.0, 24.2, 69.0},       {"FI", 19.3, 59.7, 31.6, 70.1},
    {"NO", 4.4, 57.9, 12.5, 64.5},        {"NO", 11.0, 64.0, 31.2, 71.3},
    {"IS", -24.6, 63.2, -13.4, 66.6},     {"BY", 23.6, 51.5, 32.8, 56.2},
    {"UA", 22.1, 44.3, 40.3, 52.4},       {"TR", 26.0, 35.8, 44.9, 42.1},
    {"US", -125.0, 24.4, -66.9, 49.0},    {"CA", -141.0, 41.7, -52.6, 70.0},
    {"JP", 129.4, 31.0, 145.9, 45.6}};

// ISO 3166-1, a space after each.
constexpr std::string_view kCountries =
    "AD AE AF AG AI AL AM AO AQ AR AS AT AU AW AX AZ BA BB BD BE BF BG BH BI BJ BL BM BN BO "
    "BQ BR BS BT BV BW BY BZ CA CC CD CF CG CH CI CK CL CM CN CO CR CU CV CW CX CY CZ DE DJ "
    "DK DM DO DZ EC EE EG EH ER ES ET FI FJ FK FM FO FR GA GB GD GE GF GG GH GI GL GM GN GP "
    "GQ GR GS GT GU GW GY HK HM HN HR HT HU ID IE IL IM IN IO IQ IR IS IT JE JM JO JP KE KG "
    "KH KI KM KN KP KR KW KY KZ LA LB LC LI LK LR LS LT LU LV LY MA MC MD ME MF MG MH MK ML "
    "MM MN MO MP MQ MR MS MT MU MV MW MX MY MZ NA NC NE NF NG NI NL NO NP NR NU NZ OM PA PE "
    "PF PG PH PK PL PM PN PR PS PT PW PY QA RE RO RS RU RW SA SB SC SD SE SG SH SI SJ SK SL "
    "SM SN SO SR SS ST SV SX SY SZ TC TD TF TG TH TJ TK TL TM TN TO TR TT TV TW TZ UA UG UM "
    "US UY UZ VA VC VE VG VI VN VU WF WS YE YT ZA ZM ZW ";

}  // namespace

bool isCountryCode(std::string_view code) {
  const bool isCode = code.size() == 2 && code.find(' ') == code.npos;
  return isCode && kCountries.find(std::string(code) + ' ') != kCountries.npos;
}

std::string countryAt(double longitude, double latitude) {
  for (const CountryBox& b : kBoxes) {
    const bool within =
        longitude >= b.west && longitude <= b.east && latitude >= b.south && latitude <= b.north;
    if (within) return b.country;
  }
  return {};
}

std::string countryOf(const MapFeatures& map) {
  std::map<std::string, size_t, std::less<>> said;
  for (const MapFeature& f : map.features) {
    work();
    const std::string_view country = f.tag("addr:country");
    if (country.size() == 2) ++said[std::string(country)];
  }
  const auto most = std::max_element(
      said.begin(), said.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  if (most != said.end()) return most->first;
  if (!map.geo) return {};
  const GeoPlace middle = map.geo->at(map.area.center());
  if (!middle.degrees) return {};
  return countryAt(middle.degrees->longitude, middle.degrees->latitude);
}

}  // namespace gable
