// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Colours as "#RRGGBB" and "#RRGGBBOO", and their components: sRGB, and hue (degrees), saturation
// and value of the hexcone (A. R. Smith, 1978). Hue wraps around, the rest is clamped to 0..1.

#include <algorithm>
#include <cmath>
#include <span>

#include "builtins/lists.h"
#include "builtins/shared/text_forms.h"
#include "material/material.h"
#include "shape/op_call.h"

namespace gable {

namespace {

void appendByte(std::string& out, double component) {
  static constexpr char kDigits[] = "0123456789ABCDEF";
  const double c = component >= 0 ? std::min(component, 1.0) : 0;
  const auto v = static_cast<unsigned>(std::floor(c * 255 + 0.5));
  out += kDigits[v / 16];
  out += kDigits[v % 16];
}

std::string hexOf(const Vec3& rgb) {
  std::string out = "#";
  for (size_t i = 0; i < 3; ++i) appendByte(out, rgb[i]);
  return out;
}

Vec3 rgbOf(double hue, double saturation, double value) {
  const auto unit = [](double v) { return v >= 0 ? std::min(v, 1.0) : 0.0; };
  const double s = unit(saturation), v = unit(value);
  double h = std::fmod(hue, 360.0);
  if (!(h >= 0)) h = h < 0 ? h + 360 : 0;
  const double sector = h / 60, chroma = v * s;
  const double second = chroma * (1 - std::fabs(std::fmod(sector, 2.0) - 1));
  const double low = v - chroma;
  const double c = chroma + low, x = second + low;
  switch (static_cast<int>(sector)) {
    case 0: return {c, x, low};
    case 1: return {x, c, low};
    case 2: return {low, c, x};
    case 3: return {low, x, c};
    case 4: return {x, low, c};
    default: return {c, low, x};
  }
}

Vec3 hsvOf(const Vec3& rgb) {
  const double high = std::max({rgb.x, rgb.y, rgb.z}), low = std::min({rgb.x, rgb.y, rgb.z});
  const double range = high - low;
  double hue = 0;
  if (range > 0) {
    if (high == rgb.x)
      hue = 60 * ((rgb.y - rgb.z) / range);
    else if (high == rgb.y)
      hue = 60 * ((rgb.z - rgb.x) / range + 2);
    else
      hue = 60 * ((rgb.x - rgb.y) / range + 4);
    if (hue < 0) hue += 360;
  }
  return {hue, high > 0 ? range / high : 0, high};
}

// Three components of a colour in one of the two spaces, and perhaps its opacity.
struct Components {
  double a, b, c;
  std::optional<double> opacity;
};

Value withOpacity(FunctionCall& call, std::string color, const Components& args) {
  if (args.opacity) appendByte(color, *args.opacity);
  return call.result(color);
}

Value fromRgb(FunctionCall& call, const Components& args) {
  return withOpacity(call, hexOf({args.a, args.b, args.c}), args);
}

Value fromHsv(FunctionCall& call, const Components& args) {
  return withOpacity(call, hexOf(rgbOf(args.a, args.b, args.c)), args);
}

struct Color {
  std::string_view hex;
};

// Red, green, blue and the opacity.
std::pair<Vec3, double> componentsOf(const Color& color) {
  std::pair<Vec3, double> out;
  parseColor(color.hex, out.first, out.second);
  return out;
}

template <size_t component>
Value rgbComponent(FunctionCall&, const Color& args) {
  return Value::of(componentsOf(args).first[component]);
}

template <size_t component>
Value hsvComponent(FunctionCall&, const Color& args) {
  return Value::of(hsvOf(componentsOf(args).first)[component]);
}

Value opacityOf(FunctionCall&, const Color& args) { return Value::of(componentsOf(args).second); }

// Ramps as evenly spaced colours, in our own choice of tones.
struct Ramp {
  const char* name;
  std::span<const Vec3> stops;
};
constexpr Vec3 kWhiteToBlack[] = {{1, 1, 1}, {0, 0, 0}};
constexpr Vec3 kGreenToRed[] = {{0, 1, 0}, {1, 1, 0}, {1, 0, 0}};
constexpr Vec3 kYellowToRed[] = {{1, 1, 0}, {1, 0, 0}};
constexpr Vec3 kRedToBlue[] = {{1, 0, 0}, {1, 1, 1}, {0, 0, 1}};
constexpr Vec3 kOrangeToBlue[] = {{1, 0.5, 0}, {1, 1, 1}, {0, 0.25, 1}};
constexpr Vec3 kBrownToBlue[] = {{0.55, 0.3, 0.1}, {1, 1, 1}, {0, 0.25, 1}};
constexpr Vec3 kSpectrum[] = {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
constexpr Ramp kRamps[] = {
    {"whiteToBlack", kWhiteToBlack}, {"greenToRed", kGreenToRed},     {"yellowToRed", kYellowToRed},
    {"redToBlue", kRedToBlue},       {"orangeToBlue", kOrangeToBlue}, {"brownToBlue", kBrownToBlue},
    {"spectrum", kSpectrum},
};

struct PlaceOnRamp {
  std::string_view name;
  double place;
};

Value colorRamp(FunctionCall& call, const PlaceOnRamp& args) {
  const auto ramp = std::find_if(std::begin(kRamps), std::end(kRamps),
                                 [&](const Ramp& r) { return r.name == args.name; });
  if (ramp == std::end(kRamps)) {
    return call.fail("bad-argument", "there is no colour ramp '" + std::string(args.name) + "'",
                     "use whiteToBlack, greenToRed, yellowToRed, redToBlue, orangeToBlue, "
                     "brownToBlue or spectrum",
                     call.result("#FFFFFF"));
  }
  const double last = static_cast<double>(ramp->stops.size() - 1);
  const double v = args.place;
  const double at = v > 0 ? std::min(v, 1.0) * last : 0;
  const auto i = static_cast<size_t>(std::min(at, last - 1));
  const double share = at - static_cast<double>(i);
  return call.result(hexOf(ramp->stops[i] * (1 - share) + ramp->stops[i + 1] * share));
}

constexpr ParamSpec kRed = param<&Components::a>("red", "Red, 0 to 1.");
constexpr ParamSpec kGreen = param<&Components::b>("green", "Green, 0 to 1.");
constexpr ParamSpec kBlue = param<&Components::c>("blue", "Blue, 0 to 1.");
constexpr ParamSpec kOpacity = param<&Components::opacity>("opacity", "Opacity, 0 to 1.");
constexpr ParamSpec kHue =
    param<&Components::a>("hue", "Hue in degrees; red 0, green 120, blue 240.");
constexpr ParamSpec kSaturation = param<&Components::b>("saturation", "Saturation, 0 to 1.");
constexpr ParamSpec kValue =
    param<&Components::c>("value", "Value (lightness of the purest tone), 0 to 1.");
constexpr ParamSpec kRgbParams[] = {kRed, kGreen, kBlue};
constexpr ParamSpec kRgboParams[] = {kRed, kGreen, kBlue, kOpacity};
constexpr ParamSpec kHsvParams[] = {kHue, kSaturation, kValue};
constexpr ParamSpec kHsvoParams[] = {kHue, kSaturation, kValue, kOpacity};
constexpr ParamSpec kHexParams[] = {
    param<&Color::hex>("hexValue", "A colour as \"#rrggbb\" or \"#rrggbboo\".").of(kColourText)};
constexpr ParamSpec kRampParams[] = {
    param<&PlaceOnRamp::name>(
        "gradient", "The name of the ramp.", nullptr,
        "whiteToBlack greenToRed yellowToRed redToBlue orangeToBlue brownToBlue spectrum"),
    param<&PlaceOnRamp::place>("value", "The place on the ramp, 0 to 1.")};
constexpr Signature kRgb[] = {{kRgbParams, ValueType::String}};
constexpr Signature kRgbo[] = {{kRgboParams, ValueType::String}};
constexpr Signature kHsv[] = {{kHsvParams, ValueType::String}};
constexpr Signature kHsvo[] = {{kHsvoParams, ValueType::String}};
constexpr Signature kOfHex[] = {{kHexParams, ValueType::Float}};
constexpr Signature kOfRamp[] = {{kRampParams, ValueType::String}};

constexpr const char* kFamily = "colors";
constexpr FunctionSpec kFunctions[] = {
    {"colorRGBToHex", kFamily, "A colour from red, green and blue.", kRgb, typed<fromRgb>},
    {"colorRGBOToHex", kFamily, "A colour from red, green, blue and opacity.", kRgbo,
     typed<fromRgb>},
    {"colorHSVToHex", kFamily, "A colour from hue, saturation and value.", kHsv, typed<fromHsv>},
    {"colorHSVOToHex", kFamily, "A colour from hue, saturation, value and opacity.", kHsvo,
     typed<fromHsv>},
    {"colorHexToR", kFamily, "The red of a colour, 0 to 1.", kOfHex, typed<rgbComponent<0>>},
    {"colorHexToG", kFamily, "The green of a colour, 0 to 1.", kOfHex, typed<rgbComponent<1>>},
    {"colorHexToB", kFamily, "The blue of a colour, 0 to 1.", kOfHex, typed<rgbComponent<2>>},
    {"colorHexToO", kFamily, "The opacity of a colour, 0 to 1; 0 when it has none.", kOfHex,
     typed<opacityOf>},
    {"colorHexToH", kFamily, "The hue of a colour in degrees.", kOfHex, typed<hsvComponent<0>>},
    {"colorHexToS", kFamily, "The saturation of a colour, 0 to 1.", kOfHex, typed<hsvComponent<1>>},
    {"colorHexToV", kFamily, "The value of a colour, 0 to 1.", kOfHex, typed<hsvComponent<2>>},
    {"colorRamp", kFamily, "The colour at a place of a ramp.", kOfRamp, typed<colorRamp>},
};

}  // namespace

extern const FunctionList kFunctions_colors;
const FunctionList kFunctions_colors = {kFunctions, {}};

}  // namespace gable
