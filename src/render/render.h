// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Pictures of scenes: a path tracer for the processor, with one sun, a physical sky and a ground
// plane; and drawings of the same scenes in lines. It needs no display, and the defaults give an
// architectural photograph of whatever the rules made: camera, sun side, ground height and exposure
// follow from the scene. A Renderer draws one scene any number of times.
//
//   RenderOptions options;
//   options.view = PictureView::Street;
//   Picture picture = render(scene, options);
//   std::vector<uint8_t> rgba = toRgba8(picture.image);
//
// Promises:
// 1. The same scene and options give the same bytes, whatever `threads` says, on one kind of
//    machine.
// 2. No pixel is NaN, infinite or negative, whatever the scene holds; degenerate and non-finite
//    triangles are left out.
// 3. An empty scene gives a picture of sky and ground.
// Lengths are metres, angles degrees, azimuths clockwise from north (-z). Does not read files:
// textures come decoded from the caller's TextureSource.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "math/vec.h"
#include "scene/scene.h"

namespace gable {

/// A decoded picture: rows from the top, 4 bytes a pixel, straight alpha, colours in sRGB.
struct TextureImage {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> rgba;
};

/// Gives the pictures that materials name. Asked once a path, from the thread that calls render();
/// the image must stay until render() returns. Null means there is none: the layer is ignored.
class TextureSource {
 public:
  virtual ~TextureSource() = default;
  virtual const TextureImage* find(const std::string& path) const = 0;
};

enum class PictureView : uint8_t {
  /// From above with a long lens, 38 degrees down, two fronts and the roofs in sight.
  Iso,
  /// The plan: north up, no perspective.
  Top,
  /// The elevation of the main front: level, no perspective.
  Front,
  /// The eye of somebody who stands outside in the street, verticals upright.
  Street,
};

enum class PictureLook : uint8_t {
  Photo,
  /// Everything of one pale matter.
  Clay,
  /// White lines on blue.
  Blueprint,
  /// Pen on paper, hatched in the shade.
  Ink,
  /// A model cut open, on paper.
  Section,
};

/// Paths: light is followed from surface to surface. Direct: surfaces have the light of the sun and
/// of the sky that they see, and an even light where it is hidden. Then `samples` are the most that
/// a pixel has; it has fewer where they agree.
enum class PictureLighting : uint8_t { Paths, Direct };

/// Cuts away what lies beyond: the points p with dot(normal, p) > offset.
struct CutPlane {
  /// Unit.
  Vec3 normal{0, 1, 0};
  double offset = 0;
};
/// The planes through the middle of what is built that cut away its front, or its right side as
/// seen from there.
enum class CutSide : uint8_t { None, Front, Side };

struct RenderOptions {
  PictureView view = PictureView::Iso;
  uint32_t width = 1600, height = 900;
  /// Paths a pixel; 16 for a preview, 64 for a final picture.
  uint32_t samples = 32;
  /// Diffuse reflections after the first hit.
  uint32_t bounces = 3;
  uint32_t seed = 1;
  PictureLighting lighting = PictureLighting::Paths;
  /// Smooths what noise is left, guided by colour, normal and depth.
  bool denoise = true;

  /// Height of the sun above the horizon; absent: 38, for Top 50.
  std::optional<double> sunElevation;
  /// Where the sun stands; absent: 45 degrees to the left of the main front's normal.
  std::optional<double> sunAzimuth;
  /// Dust in the air: 1 on a clear day, 5 on a milky one.
  double haziness = 1;
  /// The share of the sky that clouds hide, 0 to 1. They are seen by the camera and in mirrors, and
  /// stand as they do about the sun wherever that is.
  double clouds = 0;
  /// Replaces sun and sky by light of this radiance from everywhere (for tests and for models of
  /// materials); the ground stays as asked for.
  std::optional<Vec3> uniformSky;

  /// Replace the view's camera in part or whole. `target` alone turns the view's camera; `eye`
  /// without `target` looks at the scene's centre.
  std::optional<Vec3> eye, target;
  /// Horizontal opening angle; absent: the view's lens.
  std::optional<double> fov;
  /// The way from the scene's centre that its main front faces; absent: found from the walls, the
  /// wall direction nearest to south.
  std::optional<double> frontAzimuth;
  /// Degrees that the camera of Iso looks down; absent: 38.
  std::optional<double> pitch;
  /// Turns the camera that was chosen about the vertical through the scene's middle, and the sun
  /// with it unless it is given: the scene stands on a turntable.
  double orbit = 0;
  /// The f-number of a lens as long as `fov` says, for film of 36 mm; 0: all is sharp.
  double aperture = 0;
  /// Metres to what is sharp; absent: to the target, or to what is in the picture's middle.
  std::optional<double> focus;

  /// An endless ground below the scene.
  bool ground = true;
  /// Absent: the scene's lowest point, single things that reach deeper (roots, posts) left out.
  std::optional<double> groundHeight;
  /// sRGB.
  Vec3 groundColor{0x77 / 255.0, 0x76 / 255.0, 0x6a / 255.0};
  /// The ground is a block of soil that the scene stands on, cut at its sides, instead of endless.
  bool groundBlock = false;
  /// Metres over which haze takes 63 % of a thing's colour; 0 for none; absent: by the view.
  std::optional<double> hazeDistance;
  /// Moves the exposure by up to a third of a stop where the picture would be too bright or too
  /// dark.
  bool adaptExposure = true;
  /// Brightens (or darkens) the picture by so many stops.
  double exposureStops = 0;
  /// How strongly emissive materials light their surroundings; 0: not at all.
  double lampPower = 1;
  /// The share of rooms behind glass with light in them; absent: 0.4 at night, none by day.
  std::optional<double> litRooms;

  PictureLook look = PictureLook::Photo;
  std::optional<CutPlane> cut;
  /// Used where there is no `cut`; a Section without either is cut at its front.
  CutSide cutSide = CutSide::None;
  /// Fills Picture::layers as well.
  bool layers = false;

  /// 0: as many as the machine has.
  unsigned threads = 0;
  const TextureSource* textures = nullptr;
  /// Called with the share done, in [0, 1], from one thread at a time; false ends the rendering.
  std::function<bool(double)> progress;
};

/// Linear light in sRGB primaries, rows from the top, three floats a pixel; 1 at the camera's
/// white, before the tone curve.
struct LinearImage {
  uint32_t width = 0, height = 0;
  std::vector<float> rgb;
};

/// The camera that took a picture. Image coordinates run from 0 to 1, from left and from below; the
/// point at `horizon` of the height lies straight ahead.
struct Camera {
  Vec3 eye, right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};
  /// Half the picture's width at distance 1; with `parallel`, half the width in metres.
  double halfWidth = 0.5;
  double horizon = 0.5;
  bool parallel = false;
};

/// What lies behind the centre of each pixel, rows from the top: what pictures are made of, for
/// programs that learn from them or go on with them. What is more than half clear is looked
/// through.
struct RawLayers {
  /// Metres ahead of the eye, along the direction of view; 0 where there is nothing.
  std::vector<float> depth;
  /// Three numbers a pixel: unit, in the world, on the viewer's side; linear colours.
  std::vector<float> normals, albedo;
  /// 0 where there is nothing or the picture's own ground; else a number from 1: of the initial
  /// shape; of the leaf, instances expanded; of the entry of Scene::sources; of the material.
  std::vector<uint32_t> objects, instances, sources, materials;
};

struct RenderStats {
  /// Instances expanded, and as held in memory.
  uint64_t triangles = 0, storedTriangles = 0;
  uint64_t instances = 0;
  uint64_t rays = 0;
  /// The first two of what the renderer has made once for all pictures.
  struct {
    double triangles = 0, tree = 0, prepare = 0, trace = 0, denoise = 0;
  } seconds;
};

struct Picture {
  LinearImage image;
  /// Empty unless asked for.
  RawLayers layers;
  Camera camera;
  /// Degrees above the horizon, and clockwise from north.
  struct {
    double elevation = 0, azimuth = 0;
  } sun;
  RenderStats stats;
  /// Rooms were asked to be lit, but no face of the scene is a pane.
  bool lacksPanes = false;
  /// The cut leaves nothing.
  bool isCutAway = false;
  /// True when `progress` ended it; the rows that were not reached are black.
  bool cancelled = false;
};

/// A scene made ready once, for any number of pictures. Keeps references to the scene and to the
/// images of the textures. Any number of threads may call at a time.
class Renderer {
 public:
  explicit Renderer(const Scene& scene, const TextureSource* textures = nullptr);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// RenderOptions::textures has no effect here.
  Picture render(const RenderOptions& options) const;
  /// The camera that a picture with these options has.
  Camera cameraOf(const RenderOptions& options) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// One picture.
Picture render(const Scene& scene, const RenderOptions& options);

/// Tone curve, sRGB encoding and dither: rows from the top, 4 bytes a pixel, opaque.
std::vector<uint8_t> toRgba8(const LinearImage& image);

}  // namespace gable
