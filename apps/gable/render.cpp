// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <algorithm>
#include <cstdlib>
#include <iterator>

#include "answer.h"
#include "commands.h"
#include "derive_settings.h"
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

}  // namespace

int pictureSettings(const RenderArguments& a, gable::PictureSettings& s) {
  s.view = gable::viewNamed(a.view).value_or(s.view);
  double size[2];
  // A pixel takes about 60 bytes while it is drawn.
  constexpr double kMostPixels = 50e6;
  if (!parseNumbers(a.size, 'x', {1, 16384, true}, size, 2) || size[0] * size[1] > kMostPixels) {
    return wrongOption(
        "--size",
        "width x height in pixels, such as 1600x900, each up to 16384 and 50 million "
        "pixels in all",
        a.size);
  }
  s.width = static_cast<int>(size[0]);
  s.height = static_cast<int>(size[1]);
  s.samples = a.samples;
  s.fieldOfView = a.fieldOfView;
  s.jobs = a.derive.jobs;
  s.limits = fileLimits(a.derive.limits);
  if (!a.derive.limits.maxSeconds) s.limits.seconds.reset();
  s.cancel = cancelFlag();
  double sun[2];
  if (!a.sun.empty()) {
    if (!parseNumbers(a.sun, ',', kDegrees, sun, 2)) {
      return wrongOption("--sun", "elevation,azimuth in degrees, such as 40,135", a.sun);
    }
    s.sun = {sun[0], sun[1]};
  }
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
    auto& [eye, target] = s.camera.emplace();
    if (!parseNumbers(a.eye, ',', kMetres, eye.data(), 3)) {
      return wrongOption("--eye", kForm, a.eye);
    }
    if (!parseNumbers(a.target, ',', kMetres, target.data(), 3)) {
      return wrongOption("--target", kForm, a.target);
    }
    if (eye == target) return wrongOption("--target", "another place than --eye", a.target);
  }
  return kExitDone;
}

constexpr const char* kDrawn[] = {"glb", "gltf", "obj"};

bool isModel(const std::string& path) {
  return std::find(std::begin(kDrawn), std::end(kDrawn), extensionOf(path)) != std::end(kDrawn);
}

int drawPicture(const gable::Model& model, const std::string& path,
                gable::PictureSettings settings) {
  Progress progress("drawing");
  settings.progress = progress.callback();
  const gable::WriteResult written = model.picture(path, settings);
  print(written.diagnostics);
  if (gable::hasErrors(written.diagnostics)) return statusOf(written.diagnostics, kExitFile);
  answer().wrote(path);
  return written.ok ? kExitDone : kExitLimit;
}

namespace {

int renderOnce(const RenderArguments& arguments) {
  gable::PictureSettings settings;
  if (const int status = checkExtension(arguments.output, {"png"})) return status;
  if (const int status = pictureSettings(arguments, settings)) return status;
  gable::Model model(nullptr);
  if (isModel(arguments.derive.rules)) {
    model = gable::Model::load(arguments.derive.rules, fileLimits(arguments.derive.limits));
  } else {
    Inputs inputs;
    if (const int status = readInputs(arguments.derive, inputs)) return status;
    model = gable::derive(inputs.rules, inputs.shapes, inputs.settings);
  }
  print(model.diagnostics());
  if (!model.found()) return statusOf(model.diagnostics(), kExitFile);
  if (gable::hasErrors(model.diagnostics())) {
    return statusOf(model.diagnostics(), statusOf(model));
  }
  const int status = drawPicture(model, arguments.output, settings);
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
  if (!arguments.watch) return renderOnce(arguments);
  return watch({[&] { return inputTimes(arguments.derive); },
                [&] {
                  const int status = renderOnce(arguments);
                  if (status == kExitDone) tell(arguments.output + "\n");
                  return status;
                },
                {}});
}
