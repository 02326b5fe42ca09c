// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// From rules and shapes to a folder of tiles.

#include "gable/tiles.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <tuple>

#include "base/files.h"
#include "base/json.h"
#include "base/number.h"
#include "engine/footprint.h"
#include "engine/guard.h"
#include "shape/edge_attributes.h"
#include "tiles/placement.h"
#include "tiles/tile_tree.h"

namespace gable {

namespace {

constexpr const char* kGenerator = "Gable";
// Says that the folder `tiles` is ours as long as there is no tileset.
constexpr const char* kUnfinished = "tiles/unfinished";
constexpr size_t kMostTold = 1000;

// ---- What a feature tells ----------------------------------------------------------------------

std::string textOf(const AttributeValue& a) {
  return a.values.empty() || a.values[0].kind != PlainValue::Kind::Text ? std::string()
                                                                        : a.values[0].text;
}

double numberOf(const AttributeValue& a) {
  if (a.values.empty()) return 0;
  if (a.values[0].kind == PlainValue::Kind::Number) return a.values[0].number;
  const std::string& text = a.values[0].text;
  double v = 0;
  return parseNumber(text, v) ? v : 0;
}

void writeValue(JsonWriter& w, const PlainValue& v) {
  if (v.kind == PlainValue::Kind::Text) {
    w.value(v.text);
  } else if (v.kind == PlainValue::Kind::Bool) {
    w.value(v.number != 0);
  } else {
    w.value(v.number);
  }
}

std::string attributesJson(const std::vector<AttributeValue>& attributes) {
  std::string out;
  JsonWriter w(out);
  w.beginObject();
  for (const AttributeValue& a : attributes) {
    // Those of edges say nothing of the whole.
    if (a.name == kStartRuleAttribute || a.rows > 0 || a.columns > 0 || a.values.empty()) continue;
    w.key(a.name);
    writeValue(w, a.values[0]);
  }
  w.endObject();
  return out;
}

TileFeature featureOf(const ShapeFootprint& f) {
  TileFeature out;
  out.id = f.id;
  out.shape = f.name;
  out.attributes = attributesJson(f.attributes);
  static const char* const kTypes[] = {"building:part", "building", "highway",  "railway",
                                       "waterway",      "natural",  "leisure",  "landuse",
                                       "amenity",       "barrier",  "man_made", "type"};
  size_t best = std::size(kTypes);
  for (const AttributeValue& a : f.attributes) {
    if (a.name == "name") out.name = textOf(a);
    for (size_t t = 0; t < best; ++t) {
      if (a.name != kTypes[t] || textOf(a).empty()) continue;
      out.type = textOf(a);
      best = t;
    }
  }
  // The map's own word goes before what is known or guessed of it.
  for (const char* name : {"building:levels", "known_levels", "guessed_levels"}) {
    for (const AttributeValue& a : f.attributes) {
      if (a.name == name && !(out.levels > 0) && numberOf(a) > 0) out.levels = numberOf(a);
    }
  }
  return out;
}

// ---- Deriving, a batch at a time ---------------------------------------------------------------

class ShapeSource final : public TileSource {
 public:
  ShapeSource(const Rules& rules, const Shapes& shapes, const DeriveSettings& settings,
              TileResult& result)
      : rules_(rules), shapes_(shapes), settings_(settings), result_(result), begin_(now()) {
    settings_.trace = settings_.remember = false;
    settings_.before = nullptr;
    settings_.progress = {};
  }

  size_t size() const override { return shapes_.size(); }

  Vec2 middle(size_t shape) const override {
    const ShapeFootprint& f = shapes_.impl().footprints[shape];
    const Box3 box = f.mesh.bounds();
    const Vec3 p = box.empty() ? f.origin.origin : f.origin.point(box.center());
    return isFinite(p) ? Vec2{p.x, p.z} : Vec2{};
  }

  TileFeature feature(size_t shape) const override {
    return featureOf(shapes_.impl().footprints[shape]);
  }

  Result<std::shared_ptr<const Scene>> derive(const std::vector<size_t>& batch) override {
    DeriveSettings settings = settings_;
    if (settings.limits.seconds) *settings.limits.seconds -= now() - begin_;
    seedsOf(batch, settings);
    if (progress_) {
      settings.progress = [this](size_t done, size_t) { progress_(done_ + done, size()); };
    }
    const Model model = gable::derive(rules_, shapes_.only(batch), settings);
    take(model);
    if (hasErrors(model.diagnostics())) return Error{};
    if (model.end() != End::Done) {
      result_.end = model.end();
      return Error{};
    }
    done_ += batch.size();
    const auto held = std::make_shared<const Model>(model);
    const Model::Impl& impl = held->impl();
    if (impl.project) impl.project->drawBuiltins(texturesOf(impl.scene()));
    return std::shared_ptr<const Scene>(held, &impl.scene());
  }

  void showProgress(std::function<void(size_t, size_t)> progress) {
    progress_ = std::move(progress);
  }

 private:
  static std::vector<std::string> texturesOf(const Scene& scene) {
    std::vector<std::string> paths;
    for (const Material& m : scene.materials) {
      for (const TextureMap& map : m.maps) {
        if (!map.path.empty()) paths.push_back(map.path);
      }
    }
    return paths;
  }

  // Seeds are by number in the batch.
  void seedsOf(const std::vector<size_t>& batch, DeriveSettings& settings) const {
    settings.shapeSeeds.clear();
    for (const auto& [shape, seed] : settings_.shapeSeeds) {
      const auto at = std::lower_bound(batch.begin(), batch.end(), shape);
      if (at != batch.end() && *at == shape) {
        settings.shapeSeeds.emplace_back(static_cast<size_t>(at - batch.begin()), seed);
      }
    }
  }

  // Each batch tells the same of the rules; it is told once.
  void take(const Model& model) {
    result_.deriveSeconds += model.deriveSeconds();
    for (const Diagnostic& d : model.diagnostics()) {
      const bool fresh = told_.insert({d.code, d.rendered, d.shapePath}).second;
      if (fresh && (d.isError() || result_.diagnostics.size() < kMostTold)) {
        result_.diagnostics.push_back(d);
      }
    }
    const std::vector<std::string>& prints = model.prints();
    result_.prints.insert(result_.prints.end(), prints.begin(), prints.end());
  }

  const Rules& rules_;
  const Shapes& shapes_;
  DeriveSettings settings_;
  TileResult& result_;
  double begin_;
  size_t done_ = 0;
  std::function<void(size_t, size_t)> progress_;
  std::set<std::tuple<std::string, std::string, std::string>> told_;
};

// ---- The folder --------------------------------------------------------------------------------

// tiles/0123.glb
bool isTileName(const std::string& uri) {
  const std::string_view begin = "tiles/", end = ".glb";
  if (uri.size() <= begin.size() + end.size() || !uri.starts_with(begin) || !uri.ends_with(end)) {
    return false;
  }
  return std::all_of(uri.begin() + static_cast<std::ptrdiff_t>(begin.size()),
                     uri.end() - static_cast<std::ptrdiff_t>(end.size()),
                     [](char c) { return c >= '0' && c <= '3'; });
}

void collectNames(const JsonValue& tile, std::set<std::string>& out, int depth = 0) {
  constexpr int kDeepest = 190;
  const std::string& uri = tile["content"]["uri"].text();
  if (isTileName(uri)) out.insert(uri);
  if (depth >= kDeepest) return;
  for (const JsonValue& child : tile["children"].items()) collectNames(child, out, depth + 1);
}

void collectNames(const TileNode& node, std::set<std::string>& out) {
  if (!node.uri.empty()) out.insert(node.uri);
  for (const TileNode& child : node.children) collectNames(child, out);
}

uint64_t levelsOf(const TileNode& node) {
  uint64_t most = 0;
  for (const TileNode& child : node.children) most = std::max(most, levelsOf(child));
  return most + 1;
}

class TileFolder {
 public:
  explicit TileFolder(std::string path) : path_(std::move(path)) {
    if (!path_.ends_with('/')) path_ += '/';
  }
  const std::string& path() const { return path_; }

  /// Refuses a folder that is not ours to write to; else makes it and marks it as being written.
  std::optional<Error> open() {
    if (auto e = readBefore()) return e;
    std::error_code error;
    std::filesystem::create_directories(path_ + "tiles", error);
    if (error) {
      return Error{"tiles-folder", "the folder '" + path_ + "' cannot be made: " + error.message(),
                   "name another one, or see to its permissions"};
    }
    const Result<uint64_t> marked =
        writeFile(path_ + kUnfinished, "This folder is being written.\n");
    if (!marked.ok()) return marked.error();
    return std::nullopt;
  }

  /// The tileset comes last, then what an earlier one left behind goes.
  Result<uint64_t> close(const TileNode& root, const std::string& tileset) {
    const Result<uint64_t> bytes = writeFile(path_ + "tileset.json", tileset);
    if (!bytes.ok()) return bytes;
    std::set<std::string> names;
    collectNames(root, names);
    std::error_code ignored;
    for (const std::string& old : before_) {
      if (names.count(old) == 0) std::filesystem::remove(path_ + old, ignored);
    }
    std::filesystem::remove(path_ + kUnfinished, ignored);
    return bytes;
  }

 private:
  std::optional<Error> readBefore() {
    std::error_code error;
    const std::string tileset = path_ + "tileset.json";
    if (std::filesystem::exists(tileset, error)) {
      const Result<std::string> text = readFile(tileset);
      if (!text.ok()) return text.error();
      const Result<JsonValue> json = parseJson(text.value());
      if (!json.ok() || json.value()["asset"]["generator"].text() != kGenerator) {
        return Error{"tiles-folder", "'" + tileset + "' is a tileset that Gable has not made",
                     "name another folder, or remove the file"};
      }
      collectNames(json.value()["root"], before_);
      return std::nullopt;
    }
    const bool begun = std::filesystem::exists(path_ + kUnfinished, error);
    const std::string tiles = path_ + "tiles";
    if (!begun && std::filesystem::exists(tiles, error) &&
        !std::filesystem::is_empty(tiles, error)) {
      return Error{"tiles-folder", "the folder '" + tiles + "' has files that Gable has not made",
                   "name another folder"};
    }
    if (begun) {
      for (const auto& entry : std::filesystem::directory_iterator(tiles, error)) {
        const std::string name = "tiles/" + entry.path().filename().string();
        if (isTileName(name)) before_.insert(name);
      }
    }
    return std::nullopt;
  }

  std::string path_;
  std::set<std::string> before_;
};

void fail(TileResult& result, const Error& e) {
  // Without a code the reason has been told.
  if (!e.code.empty()) result.diagnostics.push_back(diagnosticOf(e));
}

// Whether a rule asks about other shapes, which a batch does not have.
bool asksOthers(const Program& program) {
  return std::any_of(program.rules.begin(), program.rules.end(),
                     [](const RuleCode& r) { return (r.reads.effects & kReadsContext) != 0; });
}

void tile(const Rules& rules, const Shapes& shapes, const std::string& path,
          const TileSettings& settings, Task& task, TileResult& result) {
  const double begin = now();
  TileFolder folder(path);
  if (auto e = folder.open()) return fail(result, *e);
  ShapeSource source(rules, shapes, settings.derive, result);
  source.showProgress(settings.derive.progress);
  Project* const project = rules.impl().project.get();
  TileTreeOptions options;
  options.triangles = std::max<uint64_t>(settings.triangles, 1);
  options.jobs = static_cast<unsigned>(std::max(0, settings.derive.jobs.value_or(0)));
  options.together = asksOthers(rules.impl().program);
  options.folder = folder.path();
  options.meter = &task.allowance();
  options.readTexture = [project](const std::string& texture) -> Result<std::string> {
    if (project) return project->texture(texture);
    return Error{"texture-not-found", "there is no picture '" + texture + "'", ""};
  };
  if (options.together) {
    result.diagnostics.push_back(diagnosticOf(
        {Severity::Warning,
         "tiles-together",
         Span{},
         "the rules ask about other shapes, so all shapes are derived at once",
         "it takes as much memory as one model; without inside, touches and the like it takes less",
         {},
         {}},
        Sources{}));
  }
  Result<TileTree> tree = writeTileTree(source, options);
  if (!tree.ok()) return fail(result, tree.error());
  for (const std::string& w : tree->warnings) {
    result.diagnostics.push_back(
        diagnosticOf({Severity::Warning, "written-with-loss", Span{}, w, {}, {}, {}}, Sources{}));
  }
  if (!tree->root) {
    return fail(result, {"tiles-empty", "nothing is built on the shapes, so there are no tiles",
                         "see that the shapes are where you look, and what the rules begin with"});
  }
  const std::string json = tilesetJson(*tree->root, placementOf(shapes.impl().geo.get()));
  const Result<uint64_t> bytes = folder.close(*tree->root, json);
  if (!bytes.ok()) return fail(result, bytes.error());
  result.ok = true;
  result.tiles = tree->tiles;
  result.levels = levelsOf(*tree->root);
  result.shapes = shapes.size();
  result.triangles = tree->triangles;
  result.coarseTriangles = tree->coarseTriangles;
  result.bytes = tree->bytes + bytes.value();
  result.writeSeconds = now() - begin - result.deriveSeconds;
}

}  // namespace

TileResult writeTiles(const Rules& rules, const Shapes& shapes, const std::string& folder,
                      const TileSettings& settings) {
  return guardedResult<TileResult>(Task("writing", folder, settings.limits), [&](Task& task) {
    TileResult result;
    if (rules.ok()) tile(rules, shapes, folder, settings, task, result);
    return result;
  });
}

}  // namespace gable
