// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Many pictures of one model: a turntable, or a walk along a path; numbered files, or a film.

#include <cstdio>
#include <filesystem>

#include "answer.h"
#include "commands.h"
#include "progress.h"

namespace {

/// Where the frames go: beside the output, or for a film into a folder of their own.
struct FrameFiles {
  std::string stem, folder;
  int digits = 3;

  FrameFiles(const std::string& output, bool film, size_t frames) {
    const std::filesystem::path path(output);
    for (size_t n = frames; n >= 1000; n /= 10) ++digits;
    const std::string name = path.stem().string();
    if (film) folder = (path.parent_path() / (name + "-frames")).string();
    stem = (film ? std::filesystem::path(folder) / name : path.parent_path() / name).string() + "-";
  }
  std::string path(size_t frame) const {
    char number[32];
    std::snprintf(number, sizeof number, "%0*zu", digits, frame + 1);
    return stem + number + ".png";
  }
  std::string pattern() const { return stem + "%0" + std::to_string(digits) + "d.png"; }
};

int makeFilm(const FrameFiles& files, double framesPerSecond, const std::string& output) {
  const gable::WriteResult film = gable::writeFilm(files.pattern(), framesPerSecond, output);
  print(film.diagnostics);
  if (!film.ok) {
    note("the frames are in " + files.folder);
    return kExitFile;
  }
  std::error_code code;
  std::filesystem::remove_all(files.folder, code);
  answer().wrote(output);
  return kExitDone;
}

}  // namespace

int drawFrames(const gable::Model& model, const RenderArguments& arguments,
               const gable::PictureSettings& settings) {
  gable::CameraPath path;
  size_t frames = static_cast<size_t>(arguments.turntable);
  double framesPerSecond = arguments.framesPerSecond;
  if (!arguments.walk.empty()) {
    path = gable::CameraPath::load(arguments.walk);
    print(path.diagnostics);
    if (!path.ok()) return kExitFile;
    frames = path.frames();
    framesPerSecond = path.framesPerSecond;
  }
  const bool film = extensionOf(arguments.output) != "png";
  if (film && !gable::canWriteFilm()) {
    return fail(kExitFile,
                "films are made by the program ffmpeg, which is not installed; name a "
                ".png instead, which gets a number for each frame");
  }
  const FrameFiles files(arguments.output, film, frames);
  std::error_code code;
  if (film) std::filesystem::create_directories(files.folder, code);

  Progress progress("drawing", "pixels");
  const auto callback = progress.callback();
  const gable::PictureMaker maker(model, settings.limits);
  print(maker.diagnostics());
  if (!maker.ok()) return statusOf(maker.diagnostics(), kExitLimit);
  for (size_t frame = 0; frame < frames; ++frame) {
    gable::PictureSettings each = settings;
    if (path.ok())
      path.place(frame, each);
    else
      each.turn = settings.turn + 360.0 * static_cast<double>(frame) / static_cast<double>(frames);
    each.progress = pixelsOf(callback, each, frame, frames);
    const gable::WriteResult written = maker.write(files.path(frame), each);
    // What is said of one frame is said of all.
    if (frame == 0 || !written.ok) print(written.diagnostics);
    if (!written.ok) return statusOf(written.diagnostics, kExitFile);
    if (!film) answer().wrote(files.path(frame));
  }
  return film ? makeFilm(files, framesPerSecond, arguments.output) : kExitDone;
}
