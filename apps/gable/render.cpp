// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>

#include "answer.h"
#include "commands.h"
#include "derive_settings.h"
#include "gable/builtins.h"
#include "gable/names.h"
#include "progress.h"
#include "watch.h"

namespace {

/// "#rrggbb" as shares of 1.
bool parseColor(const std::string& text, gable::Triple& rgb) {
  const bool digits = text.size() == 7 && text[0] == '#' &&
                      text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  for (size_t k = 0; digits && k < 3; ++k) {
    rgb[k] = std::stoi(text.substr(1 + 2 * k, 2), nullptr, 16) / 255.0;
  }
  return digits;
}

/// Splits at commas.
std::vector<std::string> partsOf(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

/// "2024-06-21".
bool parseDate(const std::string& text, gable::SunTime& time) {
  double n[3];
  const bool form = text.size() == 10 && text[4] == '-' && text[7] == '-';
  if (!form || !parseNumber(text.substr(0, 4), {1950, 2050, true}, n[0]) ||
      !parseNumber(text.substr(5, 2), {1, 12, true}, n[1]) ||
      !parseNumber(text.substr(8, 2), {1, 31, true}, n[2])) {
    return false;
  }
  time.year = static_cast<int>(n[0]);
  time.month = static_cast<int>(n[1]);
  time.day = static_cast<int>(n[2]);
  return true;
}

/// "18:30" or "18.5" as hours.
bool parseHour(const std::string& text, double most, double& hour) {
  const size_t colon = text.find(':');
  if (colon == std::string::npos) return parseNumber(text, {0, most}, hour);
  double minutes = 0;
  if (!parseNumber(text.substr(0, colon), {0, most, true}, hour) ||
      !parseNumber(text.substr(colon + 1), {0, 59, true}, minutes)) {
    return false;
  }
  hour += minutes / 60;
  return hour <= most;
}

/// "18:30", "18:30Z" or "18:30+02:00".
bool parseClock(std::string text, gable::SunTime& time) {
  if (!text.empty() && (text.back() == 'Z' || text.back() == 'z')) {
    text.pop_back();
    time.hoursEast = 0;
  } else if (const size_t sign = text.find_first_of("+-", 1); sign != std::string::npos) {
    double east = 0;
    if (!parseHour(text.substr(sign + 1), 14, east)) return false;
    time.hoursEast = text[sign] == '-' ? -east : east;
    text.resize(sign);
  }
  return parseHour(text, 24, time.hour);
}

bool parseSunAt(const std::string& text, gable::SunTime& time) {
  const std::vector<std::string> parts = partsOf(text);
  if (parts.size() != 2 && parts.size() != 4) return false;
  if (parts.size() == 4) {
    gable::SunTime::Place place;
    if (!parseNumber(parts[0], {-90, 90}, place.latitude) ||
        !parseNumber(parts[1], {-180, 180}, place.longitude)) {
      return false;
    }
    time.place = place;
  }
  return parseDate(parts[parts.size() - 2], time) && parseClock(parts.back(), time);
}

/// What to write for a place whose longitude stands first; empty where that is not what is wrong.
std::string unswappedSunAt(const std::string& text) {
  std::vector<std::string> parts = partsOf(text);
  if (parts.size() != 4) return {};
  std::swap(parts[0], parts[1]);
  const std::string out = parts[0] + "," + parts[1] + "," + parts[2] + "," + parts[3];
  gable::SunTime time;
  return parseSunAt(out, time) ? out : std::string();
}

/// "front", "side", "z=3" or "-z=3".
bool parseCut(const std::string& text, gable::PictureSettings& s) {
  using Side = gable::PictureSettings::CutSide;
  if (text == "front" || text == "side") {
    s.cutSide = text == "front" ? Side::Front : Side::Side;
    return true;
  }
  const bool back = !text.empty() && text[0] == '-';
  const size_t at = back ? 1 : 0;
  if (text.size() < at + 3 || text[at + 1] != '=' || text[at] < 'x' || text[at] > 'z') return false;
  double metres = 0;
  if (!parseNumber(text.substr(at + 2), kMetres, metres)) return false;
  gable::PictureSettings::Cut cut;
  cut.normal = {0, 0, 0};
  cut.normal[static_cast<size_t>(text[at] - 'x')] = back ? -1 : 1;
  cut.offset = back ? -metres : metres;
  s.cut = cut;
  return true;
}

/// What photographers set.
int lightSettings(const RenderArguments& a, gable::PictureSettings& s) {
  s.lighting = gable::lightingNamed(a.lighting).value_or(s.lighting);
  if (!a.look.empty()) s.look = gable::lookNamed(a.look).value_or(s.look);
  gable::SunTime time;
  if (!a.sunAt.empty() && !parseSunAt(a.sunAt, time)) {
    if (const std::string other = unswappedSunAt(a.sunAt); !other.empty()) {
      return wrongOption("--sun-at", "the latitude first: " + other, a.sunAt);
    }
    return wrongOption("--sun-at",
                       "latitude,longitude,date,hour, such as 48.86,2.35,2024-06-21,18:30 or "
                       "2024-06-21,16:30Z",
                       a.sunAt);
  }
  if (!a.sunAt.empty()) s.sunTime = time;
  double stops = 0;
  if (a.exposure != "auto") {
    if (!parseNumber(a.exposure, {-30, 30}, stops)) {
      return wrongOption("--exposure", "auto or stops from -30 to 30, such as 0.5", a.exposure);
    }
    s.exposure = stops;
  }
  if (!a.cut.empty() && !parseCut(a.cut, s)) {
    return wrongOption("--cut", "front, side, or a plane such as z=3, y=1.2 or -x=0", a.cut);
  }
  s.haziness = a.haze.value_or(s.haziness);
  s.clouds = a.clouds.value_or(s.clouds);
  s.mist = a.mist;
  s.aperture = a.aperture;
  s.focus = a.focus;
  s.lamps = a.lamps.value_or(s.lamps);
  s.litRooms = a.litRooms;
  s.bounces = a.bounces.value_or(s.bounces);
  s.denoise = !a.noDenoise;
  s.layers = !a.layers.empty();
  return kExitDone;
}

/// Paths a pixel where nobody says how many. On one screen a pixel of a larger picture is smaller,
/// and its noise is seen less: by the power of -2/3 of the pixels, pictures of all sizes err alike
/// once they are scaled down to one (docs/design/pictures.md).
int usualSamples(double pixels) {
  constexpr double kPixels = 1280 * 720, kSamples = 24, kLeast = 8, kMost = 48;
  const double samples = kSamples * std::pow(kPixels / pixels, 2.0 / 3);
  return static_cast<int>(std::lround(std::clamp(samples, kLeast, kMost)));
}

}  // namespace

int pictureSettings(const RenderArguments& a, gable::PictureSettings& s) {
  s.view = gable::viewNamed(a.view).value_or(s.view);
  double size[2];
  // A pixel takes about 60 bytes while it is drawn.
  constexpr double kMostPixels = 50e6;
  if (!parseExtent(a.size, {1, 16384, true}, size) || size[0] * size[1] > kMostPixels) {
    return wrongOption(
        "--size",
        "width x height in pixels, such as 1600x900, or one number for a square, each up to 16384 "
        "and 50 million pixels in all",
        a.size);
  }
  s.width = static_cast<int>(size[0]);
  s.height = static_cast<int>(size[1]);
  s.samples = a.samples.value_or(usualSamples(size[0] * size[1]));
  s.fieldOfView = a.fieldOfView;
  s.pitch = a.pitch;
  s.jobs = a.derive.jobs;
  s.limits = fileLimits(a.derive.limits);
  if (!a.derive.limits.maxSeconds) s.limits.seconds.reset();
  if (const int status = lightSettings(a, s)) return status;
  double sun[2];
  if (!a.sun.empty()) {
    if (!parseNumbers(a.sun, ',', kDegrees, sun, 2) || std::fabs(sun[0]) > 90 ||
        std::fabs(sun[1]) > 360) {
      return wrongOption("--sun",
                         "elevation,azimuth in degrees, from -90 to 90 and -360 to 360, such as "
                         "40,135",
                         a.sun);
    }
    s.sun = {sun[0], sun[1]};
  }
  s.groundBlock = a.block;
  if (!a.ground.empty()) {
    if (!parseColor(a.ground, s.ground.emplace())) {
      return wrongOption("--ground", "a colour such as #77766a", a.ground);
    }
  }
  if (a.eye.empty() != a.target.empty()) {
    return fail(kExitUsage,
                "--eye and --target are given together: where the camera is, and what it looks at");
  }
  if (!a.eye.empty()) {
    const char* const kForm = "x,y,z in metres, such as 10,1.7,25";
    gable::PictureSettings::Camera camera;
    auto& [eye, target] = camera;
    if (!parseNumbers(a.eye, ',', kMetres, eye.data(), 3)) {
      return wrongOption("--eye", kForm, a.eye);
    }
    if (!parseNumbers(a.target, ',', kMetres, target.data(), 3)) {
      return wrongOption("--target", kForm, a.target);
    }
    if (eye == target) return wrongOption("--target", "another place than --eye", a.target);
    s.camera = camera;
  }
  return kExitDone;
}

constexpr const char* kDrawn[] = {"glb", "gltf", "obj"};

bool isModel(const std::string& path) {
  return std::find(std::begin(kDrawn), std::end(kDrawn), extensionOf(path)) != std::end(kDrawn);
}

PictureProgress pixelsOf(const PictureProgress& shown, const gable::PictureSettings& settings,
                         size_t frame, size_t frames) {
  if (!shown) return {};
  const size_t pixels = static_cast<size_t>(settings.width) * static_cast<size_t>(settings.height);
  return [=](size_t done, size_t total) {
    shown(frame * pixels + pixels * done / total, frames * pixels);
  };
}

int drawPicture(const gable::Model& model, const std::string& path,
                gable::PictureSettings settings) {
  Progress progress("drawing", "pixels");
  settings.progress = pixelsOf(progress.callback(), settings);
  settings.timed = Progress::tellStep;
  const gable::WriteResult written = model.picture(path, settings);
  print(written.diagnostics);
  if (gable::hasErrors(written.diagnostics)) return statusOf(written.diagnostics, kExitFile);
  answer().wrote(path);
  return written.ok ? kExitDone : kExitLimit;
}

namespace {

/// The picture with its layers in a folder.
int drawWithLayers(const gable::Model& model, const RenderArguments& arguments,
                   gable::PictureSettings settings) {
  Progress progress("drawing", "pixels");
  settings.progress = pixelsOf(progress.callback(), settings);
  settings.timed = Progress::tellStep;
  const gable::PictureMaker maker(model, settings.limits);
  const gable::PictureData data = maker.draw(settings);
  print(data.diagnostics);
  if (!data.ok) return statusOf(data.diagnostics, kExitLimit);
  for (const gable::WriteResult& written : {gable::writePicture(data, arguments.output),
                                            gable::writePictureLayers(data, arguments.layers)}) {
    print(written.diagnostics);
    if (!written.ok) return statusOf(written.diagnostics, kExitFile);
  }
  answer().wrote(arguments.output);
  answer().wrote(arguments.layers);
  return kExitDone;
}

/// Rules and shapes. `--style clay` and the like are looks of the picture, unless the rules declare
/// a style of that name.
int readForPicture(RenderArguments& a, Inputs& inputs) {
  const std::string style = a.derive.style.value_or("");
  const bool oneWord = !style.empty() && style.find_first_of(".,") == std::string::npos;
  const bool mayBeLook = a.look.empty() && oneWord;
  if (mayBeLook) a.derive.style.reset();
  const int status = readInputs(a.derive, inputs);
  if (status || !mayBeLook) return status;
  const std::vector<std::string>& declared = inputs.rules.styles();
  if (std::find(declared.begin(), declared.end(), style) != declared.end()) {
    a.derive.style = style;
    return readInputs(a.derive, inputs);
  }
  if (gable::lookNamed(style)) {
    a.look = style;
    return kExitDone;
  }
  std::vector<std::string> known = declared;
  known.insert(known.end(), gable::lookNames().begin(), gable::lookNames().end());
  const std::string meant = gable::suggestion(style, known);
  std::string list;
  for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
  return fail(kExitUsage, "neither a style of the rules nor a look of pictures is named '" + style +
                              "'; " + (meant.empty() ? "there are " + list : meant));
}

/// Makes heldModel().
int makeModel(RenderArguments& arguments) {
  if (isModel(arguments.derive.rules)) {
    // A model has no styles of its own.
    if (arguments.look.empty() && gable::lookNamed(arguments.derive.style.value_or(""))) {
      arguments.look = *arguments.derive.style;
    }
    heldModel() = gable::Model(nullptr);
    heldModel() = gable::Model::load(arguments.derive.rules, fileLimits(arguments.derive.limits));
    return kExitDone;
  }
  Inputs inputs;
  if (const int status = readForPicture(arguments, inputs)) return status;
  deriveHeld(inputs.rules, inputs.shapes, inputs.settings);
  tellOfFace(heldModel().diagnostics(), arguments.derive);
  return kExitDone;
}

int renderOnce(RenderArguments arguments) {
  const bool moves = arguments.turntable > 0 || !arguments.walk.empty();
  const std::vector<std::string> endings =
      moves ? std::vector<std::string>{"png", "webm", "mp4"} : std::vector<std::string>{"png"};
  if (const int status = checkExtension(arguments.output, endings)) return status;
  if (moves && !arguments.layers.empty()) {
    return fail(kExitUsage, "--aov goes with one picture, not with --turntable or --walk");
  }
  gable::PictureSettings settings;
  if (const int status = pictureSettings(arguments, settings)) return status;
  if (const int status = makeModel(arguments)) return status;
  const gable::Model& model = heldModel();
  settings.look = gable::lookNamed(arguments.look).value_or(settings.look);
  print(model.diagnostics());
  if (!model.found()) return statusOf(model.diagnostics(), kExitFile);
  if (gable::hasErrors(model.diagnostics())) {
    return statusOf(model.diagnostics(), statusOf(model));
  }
  const int status = moves             ? drawFrames(model, arguments, settings)
                     : settings.layers ? drawWithLayers(model, arguments, settings)
                                       : drawPicture(model, arguments.output, settings);
  return status == kExitDone ? statusOf(model) : status;
}

}  // namespace

int runWatch(const RenderArguments& arguments) {
  if (extensionOf(arguments.output) == "png") {
    RenderArguments picture = arguments;
    picture.watch = true;
    return runRender(picture);
  }
  GenerateArguments model;
  model.derive = arguments.derive;
  model.output = arguments.output;
  model.watch = true;
  return runGenerate(model);
}

int runRender(const RenderArguments& arguments) {
  if (arguments.count > 0) {
    return forSeeds(arguments.count, arguments.derive.seed, [&](const std::string& seed) {
      RenderArguments each = arguments;
      each.derive.seed = seed;
      each.output = withSeed(each.output, seed);
      each.layers = withSeed(each.layers, seed);
      return renderOnce(each);
    });
  }
  if (!arguments.watch) return renderOnce(arguments);
  return watch({[&] { return inputTimes(arguments.derive); },
                [&] {
                  const int status = renderOnce(arguments);
                  if (status == kExitDone) tell(arguments.output + "\n");
                  return status;
                },
                {}});
}
