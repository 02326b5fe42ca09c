// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Pictures of models: settings, pictures in memory with what lies behind each pixel, many pictures
// of one model, and the camera's way through one (docs/guide/pictures.md).
//
//   gable::PictureMaker maker(town);
//   for (int i = 0; i < 1000; ++i) {
//     gable::PictureSettings settings;
//     settings.camera = placeOf(i);
//     settings.layers = true;
//     const gable::PictureData data = maker.draw(settings);
//     learn(data.rgba, data.layers.depth, data.layers.rules);
//   }
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gable/diagnostic.h"
#include "gable/limits.h"

namespace gable {

class Model;
struct WriteResult;

using Triple = std::array<double, 3>;

/// Where a picture is taken from. Iso: from above, with two fronts and the roofs in sight. Top: the
/// plan, north up. Front: the elevation of the main front, in parallel projection. Street: the eye
/// of somebody who stands outside.
enum class View : uint8_t { Iso, Top, Front, Street };

/// How a picture is made. Photo: by light. Clay: the same of one pale matter. Blueprint: white
/// lines on blue. Ink: pen on paper, hatched in the shade. Section: a model cut open, on paper.
enum class Look : uint8_t { Photo, Clay, Blueprint, Ink, Section };

/// How surfaces are lit. Paths: light is followed from surface to surface. Direct: by the sun and
/// by what a surface sees of the sky, with an even light where that is hidden; many times faster.
enum class Lighting : uint8_t { Paths, Direct };

/// A time at a place of the Earth, by which the sun is found.
struct SunTime {
  /// Degrees, north and east positive; absent: where the shapes lie on the Earth.
  struct Place {
    double latitude = 0, longitude = 0;
  };
  std::optional<Place> place;
  /// Gregorian, 1950 to 2050.
  int year = 2024, month = 6, day = 21;
  /// 0 to 24, of a clock that is `hoursEast` before Greenwich; absent: as the sun goes at that
  /// longitude on average.
  double hour = 12;
  std::optional<double> hoursEast;
};

struct PictureSettings {
  View view = View::Iso;
  int width = 1600, height = 900;
  int samples = 48;
  Look look = Look::Photo;
  /// Degrees: the elevation above the horizon, the azimuth clockwise from north.
  struct Sun {
    double elevation = 38, azimuth = 45;
  };
  /// Absent: the view's own.
  std::optional<Sun> sun;
  /// In place of `sun`.
  std::optional<SunTime> sunTime;
  /// Dust in the air: 1 on a clear day, 5 on a milky one.
  double haziness = 1;
  /// The share of the sky that clouds hide, 0 to 1. They are seen, and in mirrors, but cast no
  /// shadow.
  double clouds = 0;
  /// Metres over which mist takes 63 % of a thing's colour, 0 for none; absent: as on a clear day.
  std::optional<double> mist;
  /// Stops by which the picture is brightened, of an exposure for sunlit stone; absent: automatic,
  /// which moves it towards a middle grey picture.
  std::optional<double> exposure;
  /// How strongly what shines lights its surroundings; 0: not at all.
  double lamps = 1;
  /// The share of rooms behind glass with light in them; absent: 0.4 at night, none by day.
  std::optional<double> litRooms;
  /// The colour of the ground around the model, sRGB from 0 to 1.
  std::optional<Triple> ground;
  /// The ground is a block of soil under the model, cut at its sides.
  bool groundBlock = false;
  /// Metres.
  struct Camera {
    Triple eye{}, target{};
  };
  /// Absent: the view's own.
  std::optional<Camera> camera;
  /// Horizontal angle of view in degrees; absent: the view's own.
  std::optional<double> fieldOfView;
  /// Degrees that the camera of View::Iso looks down, 0 to 90; absent: 38.
  std::optional<double> pitch;
  /// Degrees that the model is turned under the camera, the sun standing with it unless it is
  /// given: a turntable.
  double turn = 0;
  /// The f-number of a lens that long for film of 36 mm; absent: all is sharp.
  std::optional<double> aperture;
  /// Metres to what is sharp; absent: to the camera's target, or to what is in the middle.
  std::optional<double> focus;
  /// What lies beyond a plane is left out: points p with normal . p > offset.
  struct Cut {
    Triple normal{0, 1, 0};
    double offset = 0;
  };
  std::optional<Cut> cut;
  /// A cut through the model's middle, in place of `cut`: its front or its right side is left out.
  /// A Section without either is cut at its front.
  enum class CutSide : uint8_t { None, Front, Side };
  CutSide cutSide = CutSide::None;
  /// Diffuse reflections that light is followed through, 0 to 32.
  int bounces = 3;
  /// Direct: `samples` are the most that a pixel has, and it has fewer where they agree.
  Lighting lighting = Lighting::Paths;
  /// Smooths what noise is left, guided by colour, normal and depth.
  bool denoise = true;
  /// PictureMaker::draw() gives PictureData::layers too.
  bool layers = false;
  /// Threads; absent: one a processor.
  std::optional<int> jobs;
  /// Called from any thread with the thousandths of the picture that are done, of 1000.
  std::function<void(size_t done, size_t total)> progress;
  /// Called with each step of the picture and the seconds that it took, once they are known.
  std::function<void(const char* step, double seconds)> timed;
  /// Ends the drawing soon after it becomes true; what was drawn until then is written. In place of
  /// limits.cancel. May be null.
  std::atomic<bool>* cancel = nullptr;
  /// By default it may take as long as its samples take.
  FileLimits limits{std::nullopt};
};

/// What lies behind the centre of each pixel, rows from the top. What is more than half clear is
/// looked through. Numbers count from 1, by the order of the lists here; 0 is the sky and the
/// ground around the model.
struct PictureLayers {
  /// Metres ahead of the eye along the direction of view; 0 where there is nothing.
  std::vector<float> depth;
  /// Three a pixel: unit normals in the world on the viewer's side, linear colours of surfaces.
  std::vector<float> normals, albedo;
  /// Initial shapes: houses of a town. Leaves, instances expanded: single windows, the same from
  /// every camera. Rules and materials: what things are.
  std::vector<uint32_t> objects, instances, rules, materials;
  std::vector<std::string> objectNames, ruleNames, materialNames;
};

/// A picture in memory.
struct PictureData {
  bool ok = false;
  int width = 0, height = 0;
  /// Rows from the top: four bytes a pixel, as a screen shows it; and linear light in three floats
  /// a pixel, 1 about white.
  std::vector<uint8_t> rgba;
  std::vector<float> light;
  PictureLayers layers;
  /// Of the camera: its place and unit axes, and half the width of what it shows at distance 1, or
  /// in metres without perspective. A point straight ahead lies at `horizon` of the height from
  /// below.
  struct Pose {
    Triple eye{}, right{}, up{}, forward{};
    double halfWidth = 0.5, horizon = 0.5;
    bool parallel = false;
  } pose;
  /// Where the sun stood, degrees.
  PictureSettings::Sun sun;
  DiagnosticList diagnostics;
};

/// A model made ready once for any number of pictures. Copies share; any number of threads may use
/// them at the same time.
class PictureMaker {
 public:
  explicit PictureMaker(const Model& model, const FileLimits& limits = {});

  /// False where the model could not be made ready; then all pictures fail with these diagnostics.
  bool ok() const;
  const DiagnosticList& diagnostics() const;
  PictureData draw(const PictureSettings& settings = {}) const;
  /// The camera that a picture would have; absent where the settings are wrong.
  std::optional<PictureData::Pose> pose(const PictureSettings& settings = {}) const;
  /// A PNG.
  WriteResult write(const std::string& path, const PictureSettings& settings = {}) const;

  struct Impl;

 private:
  std::shared_ptr<const Impl> impl_;
};

/// Writes a picture as a PNG.
WriteResult writePicture(const PictureData& picture, const std::string& path);

/// Writes the layers of a picture into a folder, which is made: depth.pfm and depth.png
/// (centimetres), normal.png (16 bits), albedo.png, object.png, instance.png, rule.png and
/// material.png (numbers as red + 256 green + 65536 blue), and layers.json with the names and the
/// camera. Codes: picture-layers, file-unwritable.
WriteResult writePictureLayers(const PictureData& picture, const std::string& folder);

/// A camera's way: places with times, between which it moves smoothly.
struct CameraPath {
  struct Stop {
    PictureSettings::Camera camera;
    /// Absent: as the path's settings have it.
    std::optional<double> fieldOfView;
    /// Seconds from the start; absent everywhere: by `speed`.
    double time = 0;
  };
  std::vector<Stop> stops;
  double framesPerSecond = 24;
  /// Seconds of all of it; 0: up to the last stop.
  double duration = 0;
  /// Ends where it began: `duration` is longer than the time of the last stop.
  bool closed = false;
  DiagnosticList diagnostics;

  bool ok() const { return !stops.empty(); }
  /// At least 1 for a path that is ok.
  size_t frames() const;
  /// The camera of a frame, in `settings`.
  void place(size_t frame, PictureSettings& settings) const;

  /// A JSON file: {"fps": 24, "speed": 1.4, "closed": false, "stops": [{"eye": [x, y, z],
  /// "target": [x, y, z], "time": s, "fov": degrees}, ..]}; all but eye and target may be left out.
  /// Codes: camera-path, and those of files and JSON.
  static CameraPath load(const std::string& file);
};

/// Whether the program ffmpeg is installed.
bool canWriteFilm();

/// Makes a film of frames by the program ffmpeg: .webm or .mp4. `frames`: their path with the
/// number as ffmpeg knows it, "frames/walk-%04d.png", from 1. Codes: film-program (it is not
/// installed), film-failed.
WriteResult writeFilm(const std::string& frames, double framesPerSecond, const std::string& path);

}  // namespace gable
