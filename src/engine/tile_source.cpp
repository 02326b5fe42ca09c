// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "engine/tile_source.h"

#include <algorithm>

#include "base/json.h"
#include "base/number.h"
#include "engine/footprint.h"
#include "tiles/compress.h"

namespace gable {

namespace {

constexpr size_t kMostTold = 1000;
// A unit is what can be made anew on its own. Its tiles are not joined with those of others, so it
// has far more shapes than a tile.
constexpr size_t kUnitShapes = 4096;
// See docs/design/tiles.md: a plain tile has five times the bytes, which the main thread copies.
constexpr uint64_t kCompressedTriangles = 49'152, kPlainTriangles = 16'384;

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

}  // namespace

Vec2 middleOf(const ShapeFootprint& f) {
  const Box3 box = f.mesh.bounds();
  const Vec3 p = box.empty() ? f.origin.origin : f.origin.point(box.center());
  return isFinite(p) ? Vec2{p.x, p.z} : Vec2{};
}

ShapeSource::ShapeSource(const Rules& rules, const Shapes& shapes, const DeriveSettings& settings,
                         Told& told, TileResult& result)
    : rules_(rules),
      shapes_(shapes),
      settings_(settings),
      told_(told),
      result_(result),
      begin_(now()) {
  settings_.trace = settings_.remember = false;
  settings_.before = nullptr;
  settings_.progress = {};
}

Vec2 ShapeSource::middle(size_t shape) const { return middleOf(shapes_.impl().footprints[shape]); }

TileFeature ShapeSource::feature(size_t shape) const {
  return featureOf(shapes_.impl().footprints[shape]);
}

Result<std::shared_ptr<const Scene>> ShapeSource::derive(const std::vector<size_t>& batch) {
  DeriveSettings settings = settings_;
  if (settings.limits.seconds) *settings.limits.seconds -= now() - begin_;
  seedsOf(batch, settings);
  if (progress_) settings.progress = [this](size_t done, size_t) { progress_(done_ + done); };
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

// Seeds are by number in the batch.
void ShapeSource::seedsOf(const std::vector<size_t>& batch, DeriveSettings& settings) const {
  settings.shapeSeeds.clear();
  for (const auto& [shape, seed] : settings_.shapeSeeds) {
    const auto at = std::lower_bound(batch.begin(), batch.end(), shape);
    if (at != batch.end() && *at == shape) {
      settings.shapeSeeds.emplace_back(static_cast<size_t>(at - batch.begin()), seed);
    }
  }
}

// Each batch tells the same of the rules; it is told once.
void ShapeSource::take(const Model& model) {
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

TileForm formOf(const TileSettings& settings) {
  TileForm form;
  form.compressed = settings.compress;
  form.floats = settings.vertices == Vertices::Float;
  if (settings.instancing == Instancing::Nodes) form.instancing = TileInstancing::Nodes;
  if (settings.instancing == Instancing::None) form.instancing = TileInstancing::None;
  return form;
}

uint64_t mostTriangles(const TileSettings& settings) {
  if (settings.triangles > 0) return settings.triangles;
  return settings.compress ? kCompressedTriangles : kPlainTriangles;
}

TileTreeOptions tileOptions(const Rules& rules, const TileSettings& settings,
                            const std::string& folder) {
  TileTreeOptions options;
  options.triangles = mostTriangles(settings);
  options.threads = static_cast<unsigned>(std::max(0, settings.derive.jobs.value_or(0)));
  options.together = unitShapes(rules) == 0;
  options.folder = folder;
  options.form = formOf(settings);
  Project* const project = rules.impl().project.get();
  options.readTexture = [project](const std::string& texture) -> Result<std::string> {
    if (project) return project->texture(texture);
    return Error{"texture-not-found", "there is no picture '" + texture + "'", ""};
  };
  return options;
}

size_t unitShapes(const Rules& rules) {
  // A batch does not have the others.
  return asksOthers(rules.impl().program.effects) ? 0 : kUnitShapes;
}

void warnTogether(DiagnosticList& diagnostics) {
  diagnostics.push_back(
      diagnosticOf({Severity::Warning,
                    "tiles-together",
                    Span{},
                    "the rules ask about other shapes, so all shapes are derived at once",
                    "it takes as much memory as one model; without inside, touches, ifFree and the "
                    "like it takes less",
                    {},
                    {}},
                   Sources{}));
}

std::optional<Error> formMistake(const TileSettings& settings) {
  if (settings.instancing == Instancing::Shapes) {
    return Error{"tiles-form", "tiles are divided by their size, and not by initial shapes",
                 "choose the instancing 'auto', 'gpu', 'nodes' or 'none'"};
  }
  if (settings.vertices == Vertices::Bare) {
    return Error{"tiles-form", "tiles have normals, as not all viewers of tiles make them",
                 "choose the vertices 'auto', 'compact' or 'float'"};
  }
  if (!settings.compress || canCompress()) return std::nullopt;
  return Error{"tiles-compress", "this program cannot compress tiles",
               "install libmeshoptimizer-dev and build it again, or leave out --compress"};
}

void fail(TileResult& result, const Error& e) {
  // Without a code the reason has been told.
  if (!e.code.empty()) result.diagnostics.push_back(diagnosticOf(e));
}

void takeCounts(const TilePart& all, TileResult& result) {
  for (const std::string& w : all.warnings) {
    result.diagnostics.push_back(
        diagnosticOf({Severity::Warning, "written-with-loss", Span{}, w, {}, {}, {}}, Sources{}));
  }
  result.tiles = all.tiles;
  result.levels = all.root ? all.root->levels : 0;
  result.triangles = all.triangles;
  result.coarseTriangles = all.coarseTriangles;
  result.bytes = all.bytes;
  for (const TileFile& image : all.images) result.bytes += image.bytes;
}

bool canCompressTiles() { return canCompress(); }

}  // namespace gable
