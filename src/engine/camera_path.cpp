// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A camera's way through a model: cubic Hermite curves through the stops, whose tangents are those
// of Catmull and Rom with uneven times, so that a camera passes each stop without a jerk.

#include <algorithm>
#include <cmath>

#include "base/child_process.h"
#include "base/files.h"
#include "base/json.h"
#include "engine/guard.h"
#include "engine/impl.h"

namespace gable {

namespace {

constexpr size_t kMostStops = 10000, kMostFrames = 1'000'000;
constexpr double kWalking = 1.4;

Vec3 vec(const Triple& t) { return {t[0], t[1], t[2]}; }
Triple triple(const Vec3& v) { return {v.x, v.y, v.z}; }

bool readPoint(const JsonValue& value, Triple& to) {
  if (value.size() != 3) return false;
  for (size_t k = 0; k < 3; ++k) {
    to[k] = value.at(k).number(std::nan(""));
    if (!(std::abs(to[k]) <= 1e7)) return false;
  }
  return true;
}

Error wrong(const std::string& file, const std::string& what) {
  return {"camera-path", "'" + fileNameOf(file) + "' is no camera path: " + what,
          R"(write {"stops": [{"eye": [0, 1.7, 20], "target": [0, 3, 0]}, ...]})"};
}

// The number of a member; `fallback` where there is none.
bool readNumber(const JsonValue& object, const char* name, double least, double most,
                double& value) {
  const JsonValue* const member = object.find(name);
  if (!member) return true;
  value = member->number(std::nan(""));
  return value >= least && value <= most;
}

// Times by the distances between eyes, where the file has none.
void timeBySpeed(CameraPath& path, double speed) {
  double time = 0;
  for (size_t i = 0; i < path.stops.size(); ++i) {
    path.stops[i].time = time;
    const size_t next = (i + 1) % path.stops.size();
    const double way = length(vec(path.stops[next].camera.eye) - vec(path.stops[i].camera.eye));
    // Who only turns the head takes a moment as well.
    time += std::max(way / speed, 0.5);
  }
  path.duration = path.closed ? time : path.stops.back().time;
}

Result<CameraPath> read(const std::string& file) {
  const Result<std::string> text = readFile(file, 1 << 24);
  if (!text.ok()) return text.error();
  const Result<JsonValue> parsed = parseJson(text.value());
  if (!parsed.ok()) return parsed.error();
  const JsonValue& tree = parsed.value();
  CameraPath path;
  double speed = kWalking;
  path.closed = tree["closed"].boolean(false);
  if (!readNumber(tree, "fps", 1, 240, path.framesPerSecond)) {
    return wrong(file, "'fps' is no number from 1 to 240");
  }
  if (!readNumber(tree, "speed", 1e-3, 1e4, speed)) {
    return wrong(file, "'speed' is no number of metres a second");
  }
  const JsonValue& stops = tree["stops"];
  if (stops.size() == 0 || stops.size() > kMostStops) {
    return wrong(file, "'stops' is no list of 1 to 10000 places");
  }
  bool timed = false;
  for (size_t i = 0; i < stops.size(); ++i) {
    const JsonValue& from = stops.at(i);
    const std::string which = "stop " + std::to_string(i + 1);
    CameraPath::Stop stop;
    if (!readPoint(from["eye"], stop.camera.eye) ||
        !readPoint(from["target"], stop.camera.target) || stop.camera.eye == stop.camera.target) {
      return wrong(file, which + " lacks an 'eye' and another place as 'target', [x, y, z] each");
    }
    double angle = 0;
    if (from.find("fov") && !readNumber(from, "fov", 1, 170, angle)) {
      return wrong(file, "'fov' of " + which + " is no angle from 1 to 170 degrees");
    }
    if (angle > 0) stop.fieldOfView = angle;
    if (i == 0) timed = from.find("time") != nullptr;
    const double before = i == 0 ? 0 : path.stops.back().time + 1e-6;
    const bool hasTime = from.find("time") != nullptr;
    if (hasTime != timed || !readNumber(from, "time", before, 1e6, stop.time)) {
      return wrong(file, "'time' of " + which +
                             " is not later than that of the stop before, or "
                             "only some stops have one");
    }
    path.stops.push_back(stop);
  }
  if (!timed) timeBySpeed(path, speed);
  if (timed && path.closed) {
    const double way = length(vec(path.stops[0].camera.eye) - vec(path.stops.back().camera.eye));
    path.duration = path.stops.back().time + std::max(way / speed, 0.5);
  }
  if (path.frames() > kMostFrames) return wrong(file, "it has more than a million frames");
  return path;
}

// One quantity between stops b and c, whose neighbours are a and d, at times ta to td.
Vec3 smooth(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double ta, double tb,
            double tc, double td, double t) {
  const double span = tc - tb;
  const double s = (t - tb) / span;
  const Vec3 mb = (c - a) * (span / std::max(1e-9, tc - ta));
  const Vec3 mc = (d - b) * (span / std::max(1e-9, td - tb));
  const double s2 = s * s, s3 = s2 * s;
  return b * (2 * s3 - 3 * s2 + 1) + mb * (s3 - 2 * s2 + s) + c * (3 * s2 - 2 * s3) +
         mc * (s3 - s2);
}

}  // namespace

CameraPath CameraPath::load(const std::string& file) {
  return guardedResult<CameraPath>([&] {
    Result<CameraPath> path = read(file);
    if (path.ok()) return std::move(path.value());
    return failed<CameraPath>(path.error());
  });
}

size_t CameraPath::frames() const {
  if (stops.empty()) return 0;
  const double seconds = duration > 0 ? duration : stops.back().time;
  const double count = std::floor(std::min(seconds * framesPerSecond, 1e9) + 0.5);
  return std::max<size_t>(1, static_cast<size_t>(count) + (closed ? 0 : 1));
}

void CameraPath::place(size_t frame, PictureSettings& settings) const {
  if (stops.empty()) return;
  const double end = duration > 0 ? duration : stops.back().time;
  const double t = std::min(end, static_cast<double>(frame) / framesPerSecond + stops[0].time);
  const int n = static_cast<int>(stops.size());
  int i = 0;
  while (i + 1 < n && stops[static_cast<size_t>(i) + 1].time <= t) ++i;
  // Beyond the ends a closed path begins again, and an open one stands.
  const auto stop = [&](int k) -> const Stop& {
    const int at = closed ? (k % n + n) % n : std::clamp(k, 0, n - 1);
    return stops[static_cast<size_t>(at)];
  };
  const auto timeOf = [&](int k) {
    const int rounds = closed ? (k < 0 ? -1 : k >= n ? 1 : 0) : 0;
    return stop(k).time + rounds * (end - stops[0].time);
  };
  const Stop &b = stop(i), &c = stop(i + 1);
  const double tb = timeOf(i), tc = timeOf(i + 1);
  settings.camera = b.camera;
  if (b.fieldOfView) settings.fieldOfView = b.fieldOfView;
  if (!(tc > tb)) return;
  const Stop &a = stop(i - 1), &d = stop(i + 2);
  const double ta = timeOf(i - 1), td = timeOf(i + 2);
  const auto between = [&](const Triple& pa, const Triple& pb, const Triple& pc, const Triple& pd) {
    return triple(smooth(vec(pa), vec(pb), vec(pc), vec(pd), ta, tb, tc, td, t));
  };
  settings.camera->eye = between(a.camera.eye, b.camera.eye, c.camera.eye, d.camera.eye);
  settings.camera->target =
      between(a.camera.target, b.camera.target, c.camera.target, d.camera.target);
  if (b.fieldOfView && c.fieldOfView) {
    const double s = (t - tb) / (tc - tb);
    settings.fieldOfView = *b.fieldOfView + (*c.fieldOfView - *b.fieldOfView) * s * s * (3 - 2 * s);
  }
}

bool canWriteFilm() {
  return guardedValue<bool>([] { return !programBeside("ffmpeg").empty(); });
}

WriteResult writeFilm(const std::string& frames, double framesPerSecond, const std::string& path) {
  return guardedResult<WriteResult>([&] {
    WriteResult out;
    const auto fail = [&](const Error& e) {
      out.diagnostics.push_back(diagnosticOf(e));
      return out;
    };
    const std::string program = programBeside("ffmpeg");
    if (program.empty()) {
      return fail({"film-program",
                   "'" + path +
                       "' is not written: films are made by the program "
                       "ffmpeg, which is not installed",
                   "install ffmpeg, or name a .png, which gets a number for each frame"});
    }
    char rate[32];
    std::snprintf(rate, sizeof rate, "%.3f", framesPerSecond);
    std::vector<std::string> arguments{"-nostdin", "-loglevel", "error", "-y",       "-framerate",
                                       rate,       "-i",        frames,  "-pix_fmt", "yuv420p"};
    if (extensionOf(path) == "webm") {
      for (const char* a : {"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0"})
        arguments.push_back(a);
    }
    arguments.push_back(path);
    ChildLimits limits;
    limits.seconds = 3600;
    const Result<std::string> made = runChild(program, arguments, {}, limits);
    if (!made.ok()) {
      return fail({"film-failed", "ffmpeg did not make '" + path + "' of the frames",
                   "run it by hand on the frames to see why"});
    }
    out.ok = true;
    return out;
  });
}

}  // namespace gable
