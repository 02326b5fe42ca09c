// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// From rules and shapes to a model, and from a model to files and pictures.

#include <cmath>
#include <cstdint>
#include <map>

#include "base/files.h"
#include "base/json.h"
#include "base/text.h"
#include "engine/impl.h"
#include "io/exporters/draw_list.h"
#include "io/exporters/write_model.h"
#include "io/image/image.h"
#include "io/importers/asset.h"
#include "render/render.h"
#include "runtime/output.h"
#include "scene/dump.h"
#include "scene/flatten.h"

namespace gable {

namespace {

// Names of properties as rules can write them: "building:levels" is building_levels.
std::string identifier(std::string name) {
  for (char& c : name) {
    const bool fits = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      c == '_' || c == '.';
    if (!fits) c = '_';
  }
  return name;
}

std::vector<InitialShape> initialShapes(const Shapes::Impl& shapes, ValuePool& pool) {
  std::vector<InitialShape> out;
  out.reserve(shapes.footprints.size());
  for (const ShapeFootprint& f : shapes.footprints) {
    InitialShape s;
    s.name = f.name;
    s.mesh = f.mesh;
    s.origin = f.origin;
    s.identity = f.id;
    s.faceTags = f.faceTags;
    s.index = f.index;
    for (const AttributeValue& a : f.attributes) {
      s.attributes.emplace_back(identifier(a.name), valueOfAttribute(a, pool));
    }
    out.push_back(std::move(s));
  }
  return out;
}

Limits limitsOf(const Budget& b) {
  Limits l;
  l.depth = b.depth;
  l.width = b.width;
  l.shapes = b.shapes;
  l.vertices = b.vertices;
  l.steps = b.steps;
  l.bytes = b.bytes;
  l.seconds = b.seconds;
  return l;
}

// Textures by the paths that materials name, decoded once.
class ProjectTextures final : public TextureSource {
 public:
  explicit ProjectTextures(Project* project) : project_(project) {}

  const TextureImage* find(const std::string& path) const override {
    const auto [at, fresh] = images_.try_emplace(path);
    if (fresh) load(path, at->second);
    return at->second.width > 0 ? &at->second : nullptr;
  }

 private:
  void load(const std::string& path, TextureImage& out) const {
    if (!project_) return;
    const auto bytes = project_->texture(path);
    if (!bytes.ok()) return;
    auto image = decodeImage(bytes.value());
    if (!image.ok()) return;
    out = {image.value().width, image.value().height, std::move(image.value().rgba)};
  }

  Project* project_;
  mutable std::map<std::string, TextureImage> images_;
};

WriteResult failedWrite(const Error& e) {
  WriteResult r;
  r.messages.push_back(errorMessage(e));
  return r;
}

RenderOptions renderOptions(const PictureSettings& s) {
  RenderOptions o;
  o.view = static_cast<PictureView>(s.view);
  o.width = static_cast<uint32_t>(s.width);
  o.height = static_cast<uint32_t>(s.height);
  o.samples = static_cast<uint32_t>(s.samples);
  if (s.ownSun) {
    o.sunElevation = s.sunElevation;
    o.sunAzimuth = s.sunAzimuth;
  }
  if (s.ownCamera) {
    o.eye = Vec3{s.eye[0], s.eye[1], s.eye[2]};
    o.target = Vec3{s.target[0], s.target[1], s.target[2]};
  }
  if (s.ownGround) o.groundColor = Vec3{s.ground[0], s.ground[1], s.ground[2]};
  if (s.fieldOfView > 0) o.fov = s.fieldOfView;
  o.threads = static_cast<unsigned>(std::max(0, s.jobs));
  o.progress = [&s](double share) {
    if (s.progress) s.progress(static_cast<size_t>(share * 1000), 1000);
    return !(s.cancel && s.cancel->load(std::memory_order_relaxed));
  };
  return o;
}

// The nearest of the names, else the first few of them.
std::string hintFor(const std::string& name, const std::vector<std::string_view>& names,
                    const char* what) {
  constexpr size_t kShown = 8;
  std::string hint = didYouMean(name, names);
  if (!hint.empty()) return hint;
  if (names.empty()) return std::string("there are no ") + what;
  hint = std::string("the ") + what + " are ";
  for (size_t i = 0; i < names.size() && i < kShown; ++i) {
    hint += (i ? ", " : "") + std::string(names[i]);
  }
  return hint + (names.size() > kShown ? ", ..." : "");
}

std::string placeOf(const Scene& scene, const Leaf& leaf) {
  if (leaf.source >= scene.sources.size()) return {};
  const SourcePlace& s = scene.sources[leaf.source];
  std::string text = s.rule.empty() ? std::string() : ", made by rule '" + s.rule + "'";
  if (!s.file.empty()) text += " (" + s.file + ":" + std::to_string(s.line) + ")";
  return text;
}

// The attributes and the start rule that the caller names, by their numbers in the program.
void bindSettings(const Rules::Impl& rules, const DeriveSettings& settings, DeriveOptions& options,
                  Messages& messages) {
  const Program& program = rules.program;
  const auto complain = [&](Error e) { messages.push_back(errorMessage(e)); };
  for (const auto& [name, text] : settings.attributes) {
    const int32_t found = program.findAttribute(name);
    if (found < 0) {
      std::vector<std::string_view> names;
      for (const AttributeCode& a : program.attributes) {
        if (!a.constant) names.push_back(a.name);
      }
      complain({"unknown-attribute", "the rules have no attribute '" + name + "' to set",
                hintFor(name, names, "attributes")});
      continue;
    }
    if (rules.dialect && rules.dialect->hiddenReason &&
        program.attributes[static_cast<size_t>(found)].hidden) {
      complain({"not-settable", "'" + name + "' " + rules.dialect->hiddenReason,
                "change its range in the grammar"});
      continue;
    }
    Result<Value> value =
        settingOf(name, text, program.attributes[static_cast<size_t>(found)].type, *rules.pool);
    if (value.ok())
      options.attributes.emplace_back(name, value.value());
    else
      complain(value.error());
  }
  std::vector<std::string_view> starts;
  for (const RuleCode& rule : program.rules) {
    if (rule.parameters.empty()) starts.push_back(rule.qualifiedName);
  }
  if (!settings.startRule.empty()) {
    options.startRule = program.findRule(settings.startRule);
    if (options.startRule >= 0) return;
    complain(
        {"unknown-start-rule",
         "the rules have no rule '" + settings.startRule + "' without parameters to start with",
         hintFor(settings.startRule, starts, "such rules")});
  } else if (program.startRule < 0) {
    const std::string file = program.files.empty() ? std::string() : program.files[0];
    const bool blank = program.rules.empty();
    complain({"no-start-rule", "'" + file + "' has no rule to start with",
              blank ? "it holds no rule at all; the folder of examples has some to begin with"
                    : "write a rule without parameters, or name another file"});
  }
}

void checkWholeSeeds(const DeriveSettings& settings, Messages& messages) {
  std::vector<double> seeds = {settings.seed};
  for (const auto& [index, seed] : settings.shapeSeeds) seeds.push_back(seed);
  for (const double seed : seeds) {
    const bool whole = seed >= INT32_MIN && seed <= INT32_MAX && seed == std::trunc(seed);
    if (whole) continue;
    messages.push_back(
        errorMessage({"bad-seed", "the seed of a GBBG grammar is a signed whole number of 32 bits",
                      "write a whole number from -2147483648 to 2147483647"}));
    return;
  }
}

}  // namespace

void Model::Impl::makeSound() {
  sound = soundOf(result.scene);
  if (!sound.scene) return;
  std::string text;
  if (sound.leavesLeftOut > 0) {
    text = std::to_string(sound.leavesLeftOut) +
           (sound.leavesLeftOut == 1 ? " leaf is" : " leaves are") +
           " left out: the place or the size is not a number, or too large";
    if (sound.firstLeft < result.scene.leaves.size()) {
      const Leaf& first = result.scene.leaves[sound.firstLeft];
      text += "; the first is '" +
              (first.name < result.scene.names.size() ? result.scene.names[first.name] : "") + "'" +
              placeOf(result.scene, first);
    }
  }
  if (sound.valuesReplaced > 0) {
    text += text.empty() ? "" : "; ";
    text += std::to_string(sound.valuesReplaced) +
            " normals, texture coordinates or numbers of materials are replaced: they are not "
            "numbers, or too large";
  }
  messages.push_back(toMessage({Severity::Warning,
                                "model-not-finite",
                                Span{},
                                text,
                                "look for a division by zero, the root of a negative number, or a "
                                "size that grows from rule to rule",
                                {}},
                               Sources{}));
}

Model derive(const Rules& rules, const Shapes& shapes, const DeriveSettings& settings) {
  const double begin = now();
  auto impl = std::make_shared<Model::Impl>();
  const Rules::Impl& r = rules.impl();
  if (!r.ok) return Model(std::move(impl));
  impl->project = r.project;
  impl->rules = rules.shared();
  DeriveOptions options;
  options.remember = settings.remember || settings.before;
  if (settings.before) options.before = &settings.before->impl().result;
  options.seed = settings.seed;
  options.sharing = settings.sharing;
  options.trace = settings.trace;
  options.traceShapes = settings.trace && settings.traceShapes;
  options.jobs = settings.jobs;
  options.limits = limitsOf(settings.budget);
  options.progress = settings.progress;
  options.cancel = settings.cancel;
  options.sources = &r.sources;
  bindSettings(r, settings, options, impl->messages);
  if (r.dialect && r.dialect->wholeSeeds) checkWholeSeeds(settings, impl->messages);
  if (hasErrors(impl->messages)) return Model(std::move(impl));
  std::vector<InitialShape> initial = initialShapes(shapes.impl(), *r.pool);
  for (const auto& [index, seed] : settings.shapeSeeds) {
    if (index < initial.size()) initial[index].seed = seed;
  }
  const bool wasFull = r.tables->full;
  if (!wasFull) impl->result = gable::derive(r.program, initial, *r.tables, options);
  if (r.tables->full) {
    // Tables grow with each derivation; now this one has its own. Nothing can be taken over from
    // it.
    impl->result = {};
    Environment own(r.pool, *r.project);
    options.remember = false;
    options.before = nullptr;
    impl->result = gable::derive(r.program, initial, own, options);
  }
  impl->result.scene.geoOrigin = shapes.impl().geoOrigin;
  const Messages made = toMessages(inWordsOf(r.dialect, impl->result.diagnostics), r.sources);
  impl->messages.insert(impl->messages.end(), made.begin(), made.end());
  impl->makeSound();
  impl->seconds = now() - begin;
  return Model(std::move(impl));
}

bool Model::ok() const { return !hasErrors(impl_->messages); }
bool Model::found() const { return impl_->found; }
const Messages& Model::messages() const { return impl_->messages; }
double Model::deriveSeconds() const { return impl_->seconds; }
const std::vector<std::string>& Model::prints() const { return impl_->result.scene.prints; }
std::string Model::dump() const { return dumpText(impl_->scene()); }
End Model::end() const { return static_cast<End>(impl_->result.end); }

std::string Model::statsJson(const Times& times) const {
  return statsOf(impl_->result, impl_->scene(), impl_->messages, times);
}

std::string Model::traceJson() const {
  if (!impl_->rules) return "[]\n";
  return traceOf(impl_->result, impl_->rules->program, impl_->rules->sources);
}

std::string Model::attributesJson(size_t shape) const {
  std::string out;
  JsonWriter json(out);
  json.beginObject();
  if (shape < impl_->result.attributes.size()) {
    for (const EvaluatedAttribute& a : impl_->result.attributes[shape]) {
      const std::string& name = impl_->rules->program.attributes[a.attribute].name;
      json.key(name);
      writeAttribute(json, plainAttribute(name, a.value, *impl_->rules->pool));
    }
  }
  json.endObject();
  return out;
}

Tree Model::tree() const {
  return impl_->rules ? treeOf(impl_->result, impl_->rules->program, impl_->rules->sources)
                      : Tree{};
}

uint64_t Model::leafCount() const { return gable::leafCount(impl_->scene()); }

std::string Model::drawList() const { return gable::drawList(impl_->scene()); }

std::string Model::texture(const std::string& path) const {
  if (!impl_->project) return {};
  Result<std::string> bytes = impl_->project->texture(path);
  return bytes.ok() ? std::move(bytes.value()) : std::string();
}

WriteResult Model::write(const std::string& path, const WriteSettings& settings) const {
  if (extensionOf(path) == "png") return picture(path, {});
  WriteOptions options;
  options.gpuInstancing = settings.gpuInstancing;
  options.readTexture = [this](const std::string& texture) -> Result<std::string> {
    if (impl_->project) return impl_->project->texture(texture);
    return Error{"texture-not-found", "there is no picture '" + texture + "'", ""};
  };
  Result<WriteReport> report = writeModel(impl_->scene(), path, options);
  if (!report.ok()) return failedWrite(report.error());
  WriteResult out;
  out.ok = true;
  out.triangles = report->triangles;
  out.bytes = report->bytes;
  for (const std::string& w : report->warnings) {
    out.messages.push_back(
        toMessage({Severity::Warning, "written-with-loss", Span{}, w, {}, {}}, Sources{}));
  }
  return out;
}

Model Model::load(const std::string& path) {
  auto impl = std::make_shared<Impl>();
  impl->project = std::make_shared<Project>(folderOf(path).empty() ? "." : folderOf(path));
  Result<Asset> asset = impl->project->load("/" + fileNameOf(path));
  if (!asset.ok()) {
    impl->found = false;
    impl->messages.push_back(errorMessage(asset.error()));
    return Model(std::move(impl));
  }
  // A model is a scene of one leaf; its textures are found beside it.
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
  return Model(std::move(impl));
}

WriteResult Model::picture(const std::string& path, const PictureSettings& settings) const {
  RenderOptions options = renderOptions(settings);
  const ProjectTextures textures(impl_->project.get());
  options.textures = &textures;
  const Picture picture = render(impl_->scene(), options);
  const Result<std::string> png =
      encodePng({picture.image.width, picture.image.height, toRgba8(picture.image)}, 3);
  if (!png.ok()) return failedWrite(png.error());
  Result<uint64_t> written = writeFile(path, png.value());
  if (!written.ok()) return failedWrite(written.error());
  WriteResult out;
  out.ok = !picture.cancelled;
  out.triangles = picture.stats.triangles;
  out.bytes = written.value();
  return out;
}

const char* version() { return "0.1.0"; }

}  // namespace gable
