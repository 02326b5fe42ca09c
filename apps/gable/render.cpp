// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <cstdio>
#include <cstdlib>

#include "commands.h"

namespace {

bool endsWith(const std::string& text, const char* end) {
  const std::string e(end);
  return text.size() >= e.size() && text.compare(text.size() - e.size(), e.size(), e) == 0;
}

bool isModel(const std::string& path) {
  return endsWith(path, ".glb") || endsWith(path, ".gltf") || endsWith(path, ".obj");
}

int usage(const char* option, const char* form) {
  std::fprintf(stderr, "gable: %s takes %s\n", option, form);
  return kExitUsage;
}

/// "#rrggbb" as shares of 1.
bool parseColor(const std::string& text, double (&rgb)[3]) {
  const bool digits = text.size() == 7 && text[0] == '#' &&
                      text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  for (size_t k = 0; digits && k < 3; ++k) {
    rgb[k] = std::stoi(text.substr(1 + 2 * k, 2), nullptr, 16) / 255.0;
  }
  return digits;
}

int pictureSettings(const RenderArguments& a, gable::PictureSettings& s) {
  const std::pair<const char*, gable::View> views[] = {{"iso", gable::View::Iso},
                                                       {"top", gable::View::Top},
                                                       {"front", gable::View::Front},
                                                       {"street", gable::View::Street}};
  for (const auto& [name, view] : views) {
    if (a.view == name) s.view = view;
  }
  double width = 0, height = 0;
  if (!parsePair(a.size, width, height) || width > 16384 || height > 16384) {
    return usage("--size", "width x height in pixels, such as 1600x900");
  }
  s.width = static_cast<int>(width);
  s.height = static_cast<int>(height);
  s.samples = a.samples;
  s.fieldOfView = a.fieldOfView;
  s.jobs = a.derive.jobs;
  s.cancel = cancelFlag();
  double sun[2];
  if (!a.sun.empty()) {
    if (!parseNumbers(a.sun, sun, 2)) return usage("--sun", "elevation,azimuth in degrees");
    s.ownSun = true;
    s.sunElevation = sun[0];
    s.sunAzimuth = sun[1];
  }
  if (!a.ground.empty()) {
    if (!parseColor(a.ground, s.ground)) return usage("--ground", "a colour such as #77766a");
    s.ownGround = true;
  }
  if (a.eye.empty() != a.target.empty()) return usage("--eye", "a --target as well");
  if (!a.eye.empty()) {
    if (!parseNumbers(a.eye, s.eye, 3) || !parseNumbers(a.target, s.target, 3)) {
      return usage("--eye and --target", "x,y,z in metres");
    }
    s.ownCamera = true;
  }
  return kExitDone;
}

}  // namespace

int runRender(const RenderArguments& arguments) {
  gable::PictureSettings settings;
  if (const int status = pictureSettings(arguments, settings)) return status;
  gable::Model model(nullptr);
  if (isModel(arguments.derive.rules)) {
    model = gable::Model::load(arguments.derive.rules);
  } else {
    Inputs inputs;
    if (const int status = readInputs(arguments.derive, inputs)) return status;
    model = gable::derive(inputs.rules, inputs.shapes, inputs.settings);
  }
  printMessages(model.messages());
  if (!model.found()) return kExitFile;
  if (gable::hasErrors(model.messages())) return kExitWrong;
  ProgressLine progress("drawing");
  settings.progress = progress.callback();
  const gable::WriteResult written = model.picture(arguments.output, settings);
  printMessages(written.messages);
  if (gable::hasErrors(written.messages)) return kExitFile;
  return written.ok ? statusOf(model) : kExitLimit;
}
