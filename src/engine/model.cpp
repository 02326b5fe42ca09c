// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What can be asked of a model, and its way to files and pictures.

#include <algorithm>
#include <filesystem>

#include "base/files.h"
#include "base/temporary_folder.h"
#include "base/work.h"
#include "engine/city_labels.h"
#include "engine/game_scene.h"
#include "engine/guard.h"
#include "engine/impl.h"
#include "engine/picture.h"
#include "engine/told_once.h"
#include "gable/names.h"
#include "gable/writing.h"
#include "io/exporters/atlas.h"
#include "io/exporters/chunked_list.h"
#include "io/exporters/draw_list.h"
#include "io/exporters/write_model.h"
#include "io/importers/asset.h"
#include "runtime/output.h"
#include "scene/dump.h"
#include "scene/flatten.h"
#include "shape/losses.h"
#include "tiles/texture_tints.h"

namespace gable {

namespace {

// A model is a scene of one leaf; its textures are found beside it.
std::shared_ptr<Model::Impl> loaded(const std::string& path) {
  auto impl = std::make_shared<Model::Impl>();
  impl->project = std::make_shared<Project>(folderOf(path).empty() ? "." : folderOf(path));
  // The path as it was given, where there is no such file.
  Result<Asset> asset = fileExists(path) ? impl->project->load("/" + fileNameOf(path))
                                         : Result<Asset>(readFile(path, 0).error());
  if (!asset.ok()) {
    impl->found = false;
    impl->diagnostics.push_back(diagnosticOf(asset.error()));
    return impl;
  }
  if (!asset->warnings.empty()) {
    impl->diagnostics.push_back(diagnosticOf({Severity::Warning,
                                              "read-with-loss",
                                              Span{},
                                              lossesOf(fileNameOf(path), asset->warnings),
                                              kWithoutThem,
                                              {},
                                              {}},
                                             Sources{}));
  }
  Scene& scene = impl->result.scene;
  scene.names.push_back(fileNameOf(path));
  scene.materials = asset->materials;
  if (scene.materials.empty()) scene.materials.emplace_back();
  std::vector<uint32_t> slots;
  for (uint32_t m = 0; m < scene.materials.size(); ++m) slots.push_back(m);
  scene.materialLists.push_back(std::move(slots));
  scene.attributeSets.emplace_back();
  scene.sources.emplace_back();
  scene.meshes.push_back(asset->mesh);
  Leaf leaf;
  leaf.mesh = kFirstMesh;
  scene.leaves.push_back(leaf);
  Prototype prototype;
  prototype.leafCount = 1;
  prototype.shapes = 1;
  scene.prototypes.push_back(prototype);
  scene.roots.push_back({0, {}});
  impl->makeSound();
  return impl;
}

// Whether the format that a path names has textures.
bool carriesTextures(const std::string& path) {
  const std::string format = modelFormatOf(path);
  return format != "ply" && format != "stl" && format != "ifc" && !format.starts_with("city.");
}

// model.glb is model_LOD1.glb at the first level.
std::string levelPath(const std::string& path, size_t level) {
  if (level == 0) return path;
  const size_t end = path.size() - modelFormatOf(path).size() - 1;
  return path.substr(0, end) + "_LOD" + std::to_string(level) + path.substr(end);
}

// Makes the atlas of a scene, and lets its pictures be read.
class Atlas {
 public:
  std::optional<WriteResult::Atlas> counts;

  Scene of(const Scene& scene, WriteOptions& options) {
    AtlasScene made = withAtlas(scene, options.readTexture, side_);
    pictures_ = std::move(made.pictures);
    const AtlasCounts& c = made.counts;
    counts = WriteResult::Atlas{c.merged, c.into, c.repeating, c.special, c.large};
    options.readTexture = [this, read = options.readTexture](const std::string& path) {
      const auto own = pictures_.find(path);
      return own == pictures_.end() ? read(path) : Result<std::string>(own->second);
    };
    return std::move(made.scene);
  }

  explicit Atlas(uint32_t side) : side_(side) {}

 private:
  uint32_t side_;
  std::map<std::string, std::string> pictures_;
};

// The model with all that stands beside it, a file after the other.
Result<WriteReport> writeGame(const Scene& scene, const std::string& path,
                              const WriteSettings& settings, WriteOptions& options, Atlas& atlas,
                              std::vector<std::string>& models) {
  TextureTints tints(options.readTexture);
  GameScene game = gameSceneOf(scene, settings, [&](const Material& m) { return tints.of(m); });
  if (settings.atlas > 0) game.scene = atlas.of(game.scene, options);
  options.apart = settings.instancing != Instancing::None;
  options.levels = std::move(game.levels);
  options.coverage = std::move(game.coverage);
  std::optional<WriteReport> whole;
  for (size_t i = 0; i < game.files.size(); ++i) {
    game.scene.roots = std::move(game.files[i]);
    const std::string file = levelPath(path, i);
    Result<WriteReport> report = writeModel(game.scene, file, options);
    if (!report.ok()) return report;
    models.push_back(file);
    if (whole)
      whole->bytes += report->bytes;
    else
      whole = std::move(report.value());
  }
  return *whole;
}

WriteResult written(const Model::Impl& impl, const std::string& path,
                    const WriteSettings& settings) {
  // Who has stopped the derivation wants no file of what there is.
  work(kWorkBetweenLooks + 1);
  WriteResult out;
  out.diagnostics = writeClashes(path, settings);
  if (hasErrors(out.diagnostics)) return out;
  WriteOptions options;
  // The enumerations are in the same order.
  options.instancing = static_cast<WriteOptions::Instancing>(settings.instancing);
  options.vertices = static_cast<WriteOptions::Vertices>(settings.vertices);
  options.detail = static_cast<WriteOptions::Detail>(settings.detail);
  options.bakedUv = settings.bakedUv;
  options.textureSize = settings.textureSize;
  options.geo = impl.geo.get();
  if (impl.from) {
    options.jobs = static_cast<unsigned>(std::max(0, impl.from->settings.jobs.value_or(0)));
  }
  options.attributesOf = [&impl](size_t root) { return knownOfRoot(impl, root); };
  std::optional<CityLabels> labels;
  options.labelsOf = [&](size_t root) {
    if (!labels) labels.emplace(impl, settings.limits.cancel);
    return labels->of(root);
  };
  options.readTexture = [&impl](const std::string& texture) -> Result<std::string> {
    if (impl.project) return impl.project->texture(texture);
    return Error{"texture-not-found", "there is no picture '" + texture + "'", ""};
  };
  if (impl.project && carriesTextures(path)) impl.project->drawBuiltins(texturesOf(impl.scene()));
  const bool game = asksForGameScene(settings) && !modelFormatOf(path).empty();
  Atlas atlas(settings.atlas);
  const auto write = [&] {
    if (game) return writeGame(impl.scene(), path, settings, options, atlas, out.models);
    if (settings.atlas == 0 || !carriesTextures(path)) {
      return writeModel(impl.scene(), path, options);
    }
    return writeModel(atlas.of(impl.scene(), options), path, options);
  };
  Result<WriteReport> report = write();
  if (!report.ok()) return failed<WriteResult>(report.error());
  if (!game) out.models.push_back(path);
  out.ok = true;
  out.triangles = report->triangles;
  out.bytes = report->bytes;
  out.savedBytes = report->savedBytes;
  out.atlas = atlas.counts;
  if (labels && labels->unread() > 0) {
    report->warnings.push_back(
        "parts go by their names and not by @Label and tags: the derivation that finds those came "
        "to another end; set cityPart instead");
  }
  ToldOnce told;
  if (impl.rules) told.add(impl.rules->diagnostics);
  told.add(impl.diagnostics);
  for (const std::string& w : report->warnings) {
    Diagnostic loss =
        diagnosticOf({Severity::Warning, "written-with-loss", Span{}, w, {}, {}, {}}, Sources{});
    if (!told.has(loss)) out.diagnostics.push_back(std::move(loss));
  }
  return out;
}

// Writers write files, so a file is made and read back.
EncodeResult encoded(const Model::Impl& impl, const std::string& format,
                     const WriteSettings& settings, Task& task) {
  EncodeResult out;
  const auto fail = [&](const Error& e) {
    out.diagnostics.push_back(diagnosticOf(e));
    return out;
  };
  const std::string formats[] = {"glb", "ply", "stl", "png"};
  if (std::find(std::begin(formats), std::end(formats), format) == std::end(formats)) {
    return fail({"format-unknown", "'" + format + "' is no format of one file",
                 "name glb, ply, stl or png; write the others to a path"});
  }
  if (format == "glb" && settings.levels > 0 && settings.levelForm == LevelForm::Files) {
    return fail({"write-options-clash", "one file has no room for levels of detail in files",
                 "choose the form 'names' or 'msft', or write to a path"});
  }
  const TemporaryFolder folder;
  if (folder.path().empty()) return fail({"file-unwritable", "there is no room for files", ""});
  const std::string file = folder.path() + "/model." + format;
  WriteResult made =
      format == "png" ? drawnPicture(impl, file, {}, task) : written(impl, file, settings);
  out.diagnostics = std::move(made.diagnostics);
  if (!made.ok) return out;
  Result<std::string> bytes = readFile(file);
  if (!bytes.ok()) return fail(bytes.error());
  out.ok = true;
  out.bytes = std::move(bytes.value());
  return out;
}

// Of names in the order of the enumeration.
template <class Enumeration>
std::optional<Enumeration> named(const std::vector<std::string>& names, const std::string& name) {
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end()) return std::nullopt;
  return static_cast<Enumeration>(at - names.begin());
}

}  // namespace

std::vector<std::string> texturesOf(const Scene& scene) {
  std::vector<std::string> paths;
  for (const Material& m : scene.materials) {
    for (const TextureMap& map : m.maps) {
      if (!map.path.empty()) paths.push_back(map.path);
    }
  }
  return paths;
}

const std::vector<std::string>& viewNames() {
  static const std::vector<std::string> names{"iso", "top", "front", "street"};
  return names;
}

std::optional<View> viewNamed(const std::string& name) { return named<View>(viewNames(), name); }

const std::vector<std::string>& lookNames() {
  static const std::vector<std::string> names{"photo", "clay", "blueprint", "ink", "section"};
  return names;
}

std::optional<Look> lookNamed(const std::string& name) { return named<Look>(lookNames(), name); }

const std::vector<std::string>& instancingNames() {
  static const std::vector<std::string> names{"auto", "nodes", "gpu", "none", "shapes"};
  return names;
}

std::optional<Instancing> instancingNamed(const std::string& name) {
  return named<Instancing>(instancingNames(), name);
}

const std::vector<std::string>& verticesNames() {
  static const std::vector<std::string> names{"auto", "float", "compact", "bare"};
  return names;
}

std::optional<Vertices> verticesNamed(const std::string& name) {
  return named<Vertices>(verticesNames(), name);
}

const std::vector<std::string>& detailNames() {
  static const std::vector<std::string> names{"all", "1", "2", "3"};
  return names;
}

std::optional<Detail> detailNamed(const std::string& name) {
  return named<Detail>(detailNames(), name);
}

const std::vector<std::string>& lightingNames() {
  static const std::vector<std::string> names{"paths", "direct"};
  return names;
}

std::optional<Lighting> lightingNamed(const std::string& name) {
  return named<Lighting>(lightingNames(), name);
}

const std::vector<std::string>& datasetCamerasNames() {
  static const std::vector<std::string> names{"orbit", "sampled"};
  return names;
}

std::optional<DatasetCameras> datasetCamerasNamed(const std::string& name) {
  return named<DatasetCameras>(datasetCamerasNames(), name);
}

const std::vector<std::string>& datasetLabelsNames() {
  static const std::vector<std::string> names{"rule", "label", "tag"};
  return names;
}

std::optional<DatasetLabels> datasetLabelsNamed(const std::string& name) {
  return named<DatasetLabels>(datasetLabelsNames(), name);
}

const std::vector<std::string>& datasetFormatNames() {
  static const std::vector<std::string> names{"coco", "json"};
  return names;
}

std::optional<DatasetFormat> datasetFormatNamed(const std::string& name) {
  return named<DatasetFormat>(datasetFormatNames(), name);
}

Model derive(const Rules& rules, const Shapes& shapes, const DeriveSettings& settings) {
  return Model(guarded<Model::Impl>([&] { return derived(rules, shapes, settings); }));
}

Model Model::load(const std::string& path, const FileLimits& limits) {
  return Model(guarded<Impl>(Task("reading", path, limits), [&] { return loaded(path); }));
}

Model Model::prepared(const PrepareSettings& settings) const {
  return Model(guarded<Impl>([&] { return preparedOf(*impl_, settings); }));
}

bool Model::ok() const { return !hasErrors(impl_->diagnostics); }
bool Model::found() const { return impl_->found; }
End Model::end() const { return impl_->result.end; }
const DiagnosticList& Model::diagnostics() const { return impl_->diagnostics; }
double Model::deriveSeconds() const { return impl_->seconds; }
const std::vector<std::string>& Model::prints() const { return impl_->result.scene.prints; }
uint64_t Model::leafCount() const { return gable::leafCount(impl_->scene()); }

Statistics Model::statistics() const {
  return guardedValue<Statistics>([&] {
    Statistics out = statisticsOf(impl_->scene());
    out.recalled = impl_->result.recalled;
    for (const auto& r : impl_->result.rooms) out.rooms.push_back({r.group, r.kept, r.dropped});
    return out;
  });
}

std::vector<ShapeReports> Model::reportsByShape() const {
  return guardedValue<std::vector<ShapeReports>>([&] { return reportsByShapeOf(*impl_); });
}

std::vector<NamedValue> Model::attributes(size_t shape) const {
  return guardedValue<std::vector<NamedValue>>([&] {
    std::vector<NamedValue> out;
    if (shape >= impl_->result.attributes.size()) return out;
    const Rules::Impl& rules = *impl_->rules;
    for (const EvaluatedAttribute& a : impl_->result.attributes[shape]) {
      const std::string& name = rules.program.attributes[a.attribute].name;
      out.push_back({name, ruleValueOf(plainAttribute(name, a.value, *rules.pool))});
    }
    return out;
  });
}

std::string Model::dump() const {
  return guardedValue<std::string>([&] { return dumpText(impl_->scene()); });
}

DerivationTrace Model::trace() const {
  return guardedValue<DerivationTrace>([&] {
    if (!impl_->rules) return DerivationTrace{};
    return traceOf(impl_->result, impl_->rules->program, impl_->rules->sources);
  });
}

std::optional<LeafInfo> Model::leaf(uint64_t number) const {
  return guardedValue<std::optional<LeafInfo>>([&] { return leafOf(impl_->scene(), number); });
}

ModelParts Model::parts(uint64_t leaf, size_t level, uint64_t most) const {
  return guardedValue<ModelParts>([&] { return partsOf(impl_->scene(), leaf, level, most); });
}

ModelGeometry Model::geometry(uint64_t mostLeaves) const {
  return guardedValue<ModelGeometry>([&] { return geometryOf(impl_->scene(), mostLeaves); });
}

std::string Model::drawList(const FileLimits& limits) const {
  return guardedValue<std::string>([&] {
    Task task("showing the model", {}, limits);
    const WorkScope scope(task.allowance());
    return gable::drawList(impl_->scene());
  });
}

DrawUpdate Model::drawUpdate(const DrawnChunks* before, const FileLimits& limits,
                             std::vector<std::string> room) const {
  return guardedValue<DrawUpdate>([&] {
    Task task("showing the model", {}, limits);
    const WorkScope scope(task.allowance());
    ChunkedList list = chunkedList(impl_->scene(), before, 0, std::move(room));
    return DrawUpdate{std::move(list.bytes), std::move(list.drawn)};
  });
}

void Model::prepareNext() const {
  if (!impl_->result.recall || !impl_->rules) return;
  if (impl_->result.recall->tables != impl_->rules->tables.get()) return;
  guardedValue<bool>([&] {
    impl_->rules->tables->spare.prepare(impl_->result);
    return true;
  });
}

std::optional<std::string> Model::texture(const std::string& path) const {
  return guardedValue<std::optional<std::string>>([&]() -> std::optional<std::string> {
    if (!impl_->project) return std::nullopt;
    Result<std::string> bytes = impl_->project->texture(path);
    if (!bytes.ok()) return std::nullopt;
    return std::move(bytes.value());
  });
}

WriteResult Model::write(const std::string& path, const WriteSettings& settings) const {
  return guardedResult<WriteResult>(Task("writing", path, settings.limits), [&](Task& task) {
    return extensionOf(path) == "png" ? drawnPicture(*impl_, path, {}, task)
                                      : written(*impl_, path, settings);
  });
}

EncodeResult Model::encode(const std::string& format, const WriteSettings& settings) const {
  return guardedResult<EncodeResult>(Task("writing", format, settings.limits), [&](Task& task) {
    return encoded(*impl_, format, settings, task);
  });
}

WriteResult Model::picture(const std::string& path, const PictureSettings& settings) const {
  FileLimits limits = settings.limits;
  if (settings.cancel) limits.cancel = settings.cancel;
  return guardedResult<WriteResult>(Task("drawing", path, limits), [&](Task& task) {
    return drawnPicture(*impl_, path, settings, task);
  });
}

const char* version() { return GABLE_VERSION; }

}  // namespace gable
