// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// From settings to pictures: they are checked, the sun is found by time and place, and what the
// renderer makes of the scene becomes a file or data.

#include "engine/picture.h"

#include <cmath>
#include <map>

#include "base/files.h"
#include "engine/picture_settings.h"
#include "engine/sun.h"
#include "io/image/image.h"
#include "render/render.h"

namespace gable {

namespace {

// Textures by the paths that materials name.
class ProjectTextures final : public TextureSource {
 public:
  // Draws what is built in at once, on all processors.
  ProjectTextures(Project* project, const Scene& scene) : project_(project) {
    if (project_) project_->drawPictures(texturesOf(scene));
  }

  const TextureImage* find(const std::string& path) const override {
    const auto [at, fresh] = images_.try_emplace(path);
    if (fresh && project_) at->second = held(project_->picture(path));
    return at->second && at->second->width > 0 ? at->second.get() : nullptr;
  }

 private:
  // Small files can be large pictures; beyond this, surfaces have their colour.
  TexturePicture held(TexturePicture image) const {
    constexpr uint64_t kMostBytes = 2ull << 30;
    if (image) held_ += image->rgba.size();
    return held_ > kMostBytes ? nullptr : image;
  }

  Project* project_;
  mutable std::map<std::string, TexturePicture> images_;
  mutable uint64_t held_ = 0;
};

Vec3 vec(const Triple& t) { return {t[0], t[1], t[2]}; }
Triple triple(const Vec3& v) { return {v.x, v.y, v.z}; }

// The first thing that no picture can be made of.
std::optional<Error> mistakeIn(const PictureSettings& s) {
  const int most = 1 << 15;
  if (s.width < 1 || s.height < 1 || s.width > most || s.height > most || s.samples < 1) {
    return Error{"picture-size", "a picture has 1 to 32768 pixels a side and a sample",
                 "correct the size or the samples"};
  }
  if (!isWithin(s.haziness, 0, 50)) {
    return wrongSetting("the air's haze is no number from 0 to 50", "1 is a clear day");
  }
  if (!isWithin(s.clouds, 0, 1)) {
    return wrongSetting("clouds are no share of the sky from 0 to 1", "0.25 is a fair day");
  }
  if (s.bounces < 0 || s.bounces > 32) {
    return wrongSetting("light is followed through 0 to 32 reflections", "3 are enough outdoors");
  }
  if (!isWithin(s.mist.value_or(1), 0, 1e9) || !isWithin(s.focus.value_or(1), 1e-3, 1e9)) {
    return wrongSetting("mist and focus are distances in metres", "correct them");
  }
  if (!isWithin(s.aperture.value_or(1), 1e-4, 1e4)) {
    return wrongSetting("the aperture is an f-number above 0", "2.8 blurs, 16 hardly does");
  }
  if (!isWithin(s.exposure.value_or(0), -30, 30) || !isWithin(s.lamps, 0, 1e6) ||
      !isWithin(s.litRooms.value_or(0), 0, 1) || !std::isfinite(s.turn)) {
    return wrongSetting("exposure, lamps, lit rooms or turn are out of their range",
                        "stops are -30 to 30, the share of lit rooms 0 to 1");
  }
  if (!isWithin(s.pitch.value_or(0), 0, 90)) {
    return wrongSetting("the camera's pitch is no number from 0 to 90", "38 is that of View::Iso");
  }
  if (s.cut && (!(length(vec(s.cut->normal)) > 1e-9) || !std::isfinite(s.cut->offset))) {
    return wrongSetting("the plane of the cut has no direction", "give it a normal");
  }
  return std::nullopt;
}

Result<RenderOptions> renderOptions(const PictureSettings& s, const Scene& scene) {
  if (const std::optional<Error> mistake = mistakeIn(s)) return *mistake;
  RenderOptions o;
  // The enumerations are in the same order.
  o.view = static_cast<PictureView>(s.view);
  o.look = static_cast<PictureLook>(s.look);
  o.lighting = static_cast<PictureLighting>(s.lighting);
  o.cutSide = static_cast<CutSide>(s.cutSide);
  o.width = static_cast<uint32_t>(s.width);
  o.height = static_cast<uint32_t>(s.height);
  o.samples = static_cast<uint32_t>(s.samples);
  o.bounces = static_cast<uint32_t>(s.bounces);
  std::optional<PictureSettings::Sun> sun = s.sun;
  if (s.sunTime) {
    const Result<PictureSettings::Sun> found = sunAt(*s.sunTime, scene.geoOrigin);
    if (!found.ok()) return found.error();
    sun = found.value();
  }
  if (sun) {
    o.sunElevation = sun->elevation;
    o.sunAzimuth = sun->azimuth;
  }
  if (s.camera) {
    o.eye = vec(s.camera->eye);
    o.target = vec(s.camera->target);
  }
  o.groundBlock = s.groundBlock;
  if (s.ground) o.groundColor = vec(*s.ground);
  o.fov = s.fieldOfView;
  o.pitch = s.pitch;
  o.haziness = s.haziness;
  o.clouds = s.clouds;
  o.hazeDistance = s.mist;
  o.adaptExposure = !s.exposure;
  o.exposureStops = s.exposure.value_or(0);
  o.lampPower = s.lamps;
  o.litRooms = s.litRooms;
  o.orbit = s.turn;
  o.aperture = s.aperture.value_or(0);
  o.focus = s.focus;
  if (s.cut) {
    const Vec3 n = vec(s.cut->normal);
    o.cut = CutPlane{normalized(n), s.cut->offset / length(n)};
  }
  o.denoise = s.denoise;
  o.layers = s.layers;
  o.threads = static_cast<unsigned>(std::max(0, s.jobs.value_or(0)));
  return o;
}

// What a limit ends, or the wish of the settings, is a picture all the same; the wish to stop of
// the limits leaves none, and nobody waits for one.
void watch(const PictureSettings& s, Allowance& allowance, RenderOptions& o) {
  const std::atomic<bool>* const cancel = s.cancel ? nullptr : s.limits.cancel;
  o.progress = [&s, &allowance, cancel](double share) {
    if (s.progress) s.progress(static_cast<size_t>(share * 1000), 1000);
    if (allowance.look(0, 0)) return true;
    if (cancel && *cancel) throw Unwinding(Status::failure(kWorkStopped, {}));
    return false;
  };
}

void tellOfPicture(const Picture& picture, const Task& task, DiagnosticList& diagnostics) {
  if (picture.cancelled) diagnostics.push_back(task.warning());
  if (picture.isCutAway) {
    diagnostics.push_back(diagnosticOf({Severity::Warning,
                                        "cut-away",
                                        Span{},
                                        "the cut leaves nothing of the model",
                                        "the plane leaves out what lies beyond it: turn its sign, "
                                        "or choose another place",
                                        {}},
                                       Sources{}));
  }
  if (!picture.lacksPanes) return;
  diagnostics.push_back(diagnosticOf(
      {Severity::Warning,
       "no-panes",
       Span{},
       "no room is lit: nothing in the model is a pane",
       "a pane is a smooth face that is no metal: give the windows material(\"glass\"), or "
       "set(material.roughness, 0.05)",
       {}},
      Sources{}));
}

void tellSeconds(const PictureSettings& settings, const Picture& picture) {
  if (!settings.timed) return;
  const auto& seconds = picture.stats.seconds;
  settings.timed("making triangles", seconds.triangles);
  settings.timed("making the tree", seconds.tree);
  settings.timed("placing camera and light", seconds.prepare);
  settings.timed("tracing", seconds.trace);
  settings.timed("smoothing", seconds.denoise);
}

// What was drawn until then is written however long that takes.
class Deaf final : public WorkMeter {
 public:
  bool look(uint64_t, uint64_t) override { return true; }
};

Result<std::string> pngOf(const Picture& picture) {
  // A fiftieth larger than by zlib's default, in less than half the time: a picture for a film or a
  // wall is waited for.
  constexpr int kLevel = 4;
  const Image image{picture.image.width, picture.image.height, toRgba8(picture.image)};
  if (!picture.cancelled) return encodePng(image, 3, kLevel);
  Deaf deaf;
  const WorkScope scope(deaf);
  return encodePng(image, 3, kLevel);
}

WriteResult writtenPicture(const Picture& picture, const std::string& path,
                           const PictureSettings& settings, const Task& task) {
  tellSeconds(settings, picture);
  const double begin = now();
  const Result<std::string> png = pngOf(picture);
  if (settings.timed) settings.timed("encoding", now() - begin);
  if (!png.ok()) return failed<WriteResult>(png.error());
  const Result<uint64_t> bytes = writeFile(path, png.value());
  if (!bytes.ok()) return failed<WriteResult>(bytes.error());
  WriteResult out;
  out.ok = !picture.cancelled;
  tellOfPicture(picture, task, out.diagnostics);
  out.triangles = picture.stats.triangles;
  out.bytes = bytes.value();
  return out;
}

// Numbers of sources by those of their rules, and the names of these in the order of first use.
void nameRules(const Scene& scene, std::vector<uint32_t>& sources, PictureLayers& layers) {
  std::map<std::string, uint32_t> known;
  std::vector<uint32_t> ruleOf(scene.sources.size() + 1, 0);
  for (size_t i = 0; i < scene.sources.size(); ++i) {
    const std::string& rule = scene.sources[i].rule;
    if (rule.empty()) continue;
    const auto [at, isNew] = known.try_emplace(rule, layers.ruleNames.size() + 1);
    if (isNew) layers.ruleNames.push_back(rule);
    ruleOf[i + 1] = at->second;
  }
  for (uint32_t& s : sources) s = s < ruleOf.size() ? ruleOf[s] : 0;
  layers.rules = std::move(sources);
}

PictureLayers layersOf(const Scene& scene, RawLayers&& data) {
  PictureLayers layers;
  layers.depth = std::move(data.depth);
  layers.normals = std::move(data.normals);
  layers.albedo = std::move(data.albedo);
  layers.objects = std::move(data.objects);
  layers.instances = std::move(data.instances);
  layers.materials = std::move(data.materials);
  nameRules(scene, data.sources, layers);
  for (const Root& root : scene.roots) {
    layers.objectNames.push_back(root.name < scene.names.size() ? scene.names[root.name] : "");
  }
  for (const Material& m : scene.materials) {
    layers.materialNames.push_back(m.name.empty() ? colorText(m.color) : m.name);
  }
  return layers;
}

PictureData::Pose poseOf(const Camera& c) {
  return {triple(c.eye), triple(c.right), triple(c.up), triple(c.forward),
          c.halfWidth,   c.horizon,       c.parallel};
}

PictureData dataOf(const Scene& scene, const RenderOptions& options, Picture&& picture,
                   const Task& task) {
  PictureData out;
  out.ok = !picture.cancelled;
  tellOfPicture(picture, task, out.diagnostics);
  out.width = static_cast<int>(picture.image.width);
  out.height = static_cast<int>(picture.image.height);
  out.rgba = toRgba8(picture.image);
  out.light = std::move(picture.image.rgb);
  out.pose = poseOf(picture.camera);
  out.sun = {picture.sun.elevation, picture.sun.azimuth};
  if (options.layers) out.layers = layersOf(scene, std::move(picture.layers));
  return out;
}

}  // namespace

WriteResult drawnPicture(const Model::Impl& model, const std::string& path,
                         const PictureSettings& settings, Task& task) {
  Result<RenderOptions> options = renderOptions(settings, model.scene());
  if (!options.ok()) return failed<WriteResult>(options.error());
  watch(settings, task.allowance(), options.value());
  const double begin = now();
  const ProjectTextures textures(model.project.get(), model.scene());
  if (settings.timed) settings.timed("drawing textures", now() - begin);
  options->textures = &textures;
  return writtenPicture(render(model.scene(), options.value()), path, settings, task);
}

struct PictureMaker::Impl {
  Model model;
  std::optional<ProjectTextures> textures;
  std::unique_ptr<Renderer> renderer;
  DiagnosticList diagnostics;

  explicit Impl(const Model& m) : model(m) {}
  void makeReady() {
    const Model::Impl& m = model.impl();
    textures.emplace(m.project.get(), m.scene());
    renderer = std::make_unique<Renderer>(m.scene(), &*textures);
  }
};

PictureMaker::PictureMaker(const Model& model, const FileLimits& limits) {
  auto impl = std::make_shared<Impl>(model);
  struct Made {
    DiagnosticList diagnostics;
  };
  impl->diagnostics = guardedResult<Made>(Task("making ready", "the model", limits), [&] {
                        impl->makeReady();
                        return Made{};
                      }).diagnostics;
  impl_ = impl;
}

bool PictureMaker::ok() const { return impl_->renderer != nullptr; }
const DiagnosticList& PictureMaker::diagnostics() const { return impl_->diagnostics; }

namespace {

FileLimits limitsOf(const PictureSettings& settings) {
  FileLimits limits = settings.limits;
  if (settings.cancel) limits.cancel = settings.cancel;
  return limits;
}

}  // namespace

PictureData PictureMaker::draw(const PictureSettings& settings) const {
  PictureData none;
  none.diagnostics = impl_->diagnostics;
  if (!ok()) return none;
  return guardedResult<PictureData>(
      Task("drawing", "the model", limitsOf(settings)), [&](Task& task) {
        const Scene& scene = impl_->model.impl().scene();
        Result<RenderOptions> options = renderOptions(settings, scene);
        if (!options.ok()) return failed<PictureData>(options.error());
        watch(settings, task.allowance(), options.value());
        Picture picture = impl_->renderer->render(options.value());
        tellSeconds(settings, picture);
        return dataOf(scene, options.value(), std::move(picture), task);
      });
}

std::optional<PictureData::Pose> PictureMaker::pose(const PictureSettings& settings) const {
  if (!ok()) return std::nullopt;
  return guardedValue<std::optional<PictureData::Pose>>([&]() -> std::optional<PictureData::Pose> {
    const Result<RenderOptions> options = renderOptions(settings, impl_->model.impl().scene());
    if (!options.ok()) return std::nullopt;
    return poseOf(impl_->renderer->cameraOf(options.value()));
  });
}

WriteResult PictureMaker::write(const std::string& path, const PictureSettings& settings) const {
  WriteResult none;
  none.diagnostics = impl_->diagnostics;
  if (!ok()) return none;
  return guardedResult<WriteResult>(Task("drawing", path, limitsOf(settings)), [&](Task& task) {
    Result<RenderOptions> options = renderOptions(settings, impl_->model.impl().scene());
    if (!options.ok()) return failed<WriteResult>(options.error());
    watch(settings, task.allowance(), options.value());
    return writtenPicture(impl_->renderer->render(options.value()), path, settings, task);
  });
}

}  // namespace gable
