// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
#include "engine/tile_plan.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "base/bytes.h"
#include "base/files.h"
#include "base/hash.h"
#include "base/json.h"
#include "engine/file_search.h"
#include "engine/project.h"
#include "gable/names.h"
#include "io/geo/geo_frames.h"

namespace gable {

namespace {

// Of the files of a plan; a program with another one cannot go on with it.
constexpr int kFormat = 5;
constexpr uint64_t kMostPlanBytes = 64 << 20;

std::string hex(uint64_t v) {
  std::array<char, 16> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), v, 16).ptr;
  return {digits.data(), end};
}

uint64_t ofHex(const std::string& text) {
  uint64_t v = 0;
  std::from_chars(text.data(), text.data() + text.size(), v, 16);
  return v;
}

uint64_t wholeOf(const JsonValue& v) {
  return static_cast<uint64_t>(std::clamp(v.number(0), 0.0, 9e15));
}

void writeOptional(JsonWriter& w, const char* name, const std::optional<std::string>& v) {
  if (v) w.field(name, *v);
}

std::optional<std::string> optionalOf(const JsonValue& v) {
  if (v.isText()) return v.text();
  return std::nullopt;
}

void writeLoad(JsonWriter& w, const TilePlan::Impl& plan) {
  const LoadSettings& load = plan.load;
  w.key("rules").beginObject().field("file", plan.rules);
  w.field("checksum", hex(plan.rulesChecksum));
  writeOptional(w, "project", load.project);
  writeOptional(w, "dialect", load.dialect);
  writeOptional(w, "style", load.style);
  writeOptional(w, "workspace", load.search.workspace);
  w.key("libraries").beginArray();
  for (const std::string& library : load.search.libraries) w.value(library);
  w.endArray().field("byName", load.search.byName).endObject();
}

void readLoad(const JsonValue& v, TilePlan::Impl& plan) {
  plan.rules = v["file"].text();
  plan.rulesChecksum = ofHex(v["checksum"].text());
  plan.load.project = optionalOf(v["project"]);
  plan.load.dialect = optionalOf(v["dialect"]);
  plan.load.style = optionalOf(v["style"]);
  plan.load.search.workspace = optionalOf(v["workspace"]);
  for (const JsonValue& library : v["libraries"].items()) {
    plan.load.search.libraries.push_back(library.text());
  }
  plan.load.search.byName = v["byName"].boolean(false);
}

// By name, each with the field that it is.
auto limitsOf(Limits& limits) {
  return std::pair{
      std::array{std::pair{"depth", &limits.depth},
                 std::pair{"functionDepth", &limits.functionDepth},
                 std::pair{"width", &limits.width}, std::pair{"arraySize", &limits.arraySize}},
      std::array{std::pair{"shapes", &limits.shapes}, std::pair{"vertices", &limits.vertices},
                 std::pair{"shapeVertices", &limits.shapeVertices},
                 std::pair{"steps", &limits.steps}}};
}

void writeTiles(JsonWriter& w, const TileSettings& tiles) {
  const DeriveSettings& derive = tiles.derive;
  w.field("triangles", tiles.triangles).field("compress", tiles.compress);
  w.field("instancing", instancingNames()[static_cast<size_t>(tiles.instancing)]);
  w.field("vertices", verticesNames()[static_cast<size_t>(tiles.vertices)]);
  writeOptional(w, "startRule", derive.startRule);
  w.field("seed", derive.seed).field("sharing", derive.sharing);
  w.key("attributes").beginArray();
  for (const auto& [name, value] : derive.attributes) {
    w.beginArray().value(name).value(value).endArray();
  }
  w.endArray().key("limits").beginObject();
  Limits limits = derive.limits;
  const auto [small, large] = limitsOf(limits);
  for (const auto& [name, value] : small) w.field(name, *value);
  for (const auto& [name, value] : large) w.field(name, *value);
  if (limits.bytes) w.field("bytes", *limits.bytes);
  w.endObject();
}

void readTiles(const JsonValue& v, TileSettings& tiles) {
  DeriveSettings& derive = tiles.derive;
  tiles.triangles = wholeOf(v["triangles"]);
  tiles.compress = v["compress"].boolean(false);
  tiles.instancing = instancingNamed(v["instancing"].text()).value_or(Instancing::Auto);
  tiles.vertices = verticesNamed(v["vertices"].text()).value_or(Vertices::Auto);
  derive.startRule = optionalOf(v["startRule"]);
  derive.seed = v["seed"].number(0);
  derive.sharing = v["sharing"].boolean(true);
  for (const JsonValue& pair : v["attributes"].items()) {
    derive.attributes.emplace_back(pair.at(0).text(), pair.at(1).text());
  }
  const JsonValue& limits = v["limits"];
  const auto [small, large] = limitsOf(derive.limits);
  for (const auto& [name, value] : small) {
    *value = static_cast<uint32_t>(std::min<uint64_t>(wholeOf(limits[name]), 0xffffffff));
  }
  for (const auto& [name, value] : large) *value = wholeOf(limits[name]);
  derive.limits.bytes.reset();
  if (limits["bytes"].isNumber()) derive.limits.bytes = wholeOf(limits["bytes"]);
}

Error planError(const std::string& folder, const std::string& what) {
  return {"tiles-plan", "there is no plan in '" + folder + "' that can be used: " + what,
          "make one with 'gable tiles plan'"};
}

}  // namespace

uint64_t checksumOf(const Rules& rules) {
  const Rules::Impl& impl = rules.impl();
  uint64_t h = hashBytes(impl.dialect ? impl.dialect->name : "cga");
  for (uint32_t i = 0; i < impl.sources.size(); ++i) h = hashBytes(impl.sources.text(i), h);
  constexpr uint64_t kLargestAsset = 1ull << 30;
  const FileSearch& files = impl.project->where();
  for (const AssetUse& use : impl.assets) {
    h = hashBytes(use.path, h);
    const std::string name = use.file.starts_with("/") ? use.file : "/" + use.file;
    const Result<std::string> bytes = files.read(files.locate(name, ""), kLargestAsset);
    h = hashCombine(h, bytes.ok() ? checksum(bytes.value()) : 0);
  }
  return h;
}

std::string settingsJson(const TilePlan::Impl& plan) {
  std::string out;
  JsonWriter w(out, 2);
  w.beginObject();
  w.field("generator", "Gable").field("version", version()).field("format", kFormat);
  if (plan.id != 0) w.field("id", hex(plan.id));
  writeLoad(w, plan);
  w.key("settings").beginObject();
  writeTiles(w, plan.tiles);
  w.endObject();
  w.key("square").beginArray();
  w.value(plan.square.low.x).value(plan.square.low.y).value(plan.square.side).endArray();
  w.field("geo", plan.geo ? plan.geo->text() : std::string());
  if (plan.terrainChecksum != 0) w.field("terrain", hex(plan.terrainChecksum));
  if (plan.ofMap) w.field("ofMap", true);
  if (plan.ofOneRun) w.field("ofOneRun", true);
  w.field("shapes", plan.shapes).field("jobs", plan.jobs).endObject();
  out += '\n';
  return out;
}

std::string jobJson(const TileJob& job, uint64_t plan) {
  std::string out;
  JsonWriter w(out, 1);
  w.beginObject().field("plan", hex(plan));
  w.field("bytes", job.bytes).field("checksum", hex(job.checksum));
  w.key("units").beginArray();
  for (const JobUnit& unit : job.units) {
    w.beginObject().field("name", unit.name);
    w.field("shapes", unit.shapes).field("bytes", unit.bytes).endObject();
  }
  w.endArray().endObject();
  out += '\n';
  return out;
}

Result<TilePlan::Impl> readPlan(const std::string& folder) {
  const TileFolder place(folder);
  const std::string path = place.plan() + "plan.json";
  const Result<std::string> text = readFile(path, kMostPlanBytes);
  if (!text.ok()) return planError(folder, text.error().message);
  const Result<JsonValue> json = parseJson(text.value());
  if (!json.ok()) return planError(folder, "'" + path + "' is damaged: " + json.error().message);
  const JsonValue& v = json.value();
  if (v["version"].text() != version() || v["format"].number(0) != kFormat) {
    return Error{"tiles-plan",
                 "the plan in '" + folder + "' is of Gable " + v["version"].text() +
                     ", and this is Gable " + version(),
                 "use one version on all machines, or plan again"};
  }
  TilePlan::Impl plan;
  plan.folder = place.path();
  plan.id = ofHex(v["id"].text());
  readLoad(v["rules"], plan);
  readTiles(v["settings"], plan.tiles);
  const JsonValue& square = v["square"];
  plan.square = {{square.at(0).number(0), square.at(1).number(0)}, square.at(2).number(1)};
  plan.geo = geoFrameOf(v["geo"].text());
  plan.terrainChecksum = ofHex(v["terrain"].text());
  plan.ofMap = v["ofMap"].boolean(false);
  plan.ofOneRun = v["ofOneRun"].boolean(false);
  plan.shapes = wholeOf(v["shapes"]);
  plan.jobs = wholeOf(v["jobs"]);
  if (plan.id == 0) return planError(folder, "'" + path + "' is damaged: it has no id");
  if (plan.jobs == 0) return planError(folder, "'" + path + "' is damaged: it has no jobs");
  return plan;
}

std::optional<Error> planInUse(const TileFolder& folder) {
  const Result<std::string> text = readFile(folder.plan() + "plan.json", kMostPlanBytes);
  if (!text.ok()) return std::nullopt;
  const Result<JsonValue> json = parseJson(text.value());
  if (!json.ok() || json.value()["ofOneRun"].boolean(false)) return std::nullopt;
  return Error{"tiles-planned",
               "the folder '" + folder.path() + "' has a plan, whose jobs may be running",
               "finish it with 'gable tiles merge --mend', or give --replace-plan"};
}

Result<TileJob> readJob(const TilePlan::Impl& plan, uint64_t job) {
  if (job >= plan.jobs) {
    return Error{"tiles-job", "the plan in '" + plan.folder + "' has no job " + std::to_string(job),
                 "its jobs are 0 to " + std::to_string(plan.jobs - 1)};
  }
  const std::string path = jobPath(plan, job);
  const Result<std::string> text = readFile(path, kMostPlanBytes);
  if (!text.ok()) return planError(plan.folder, text.error().message);
  const Result<JsonValue> json = parseJson(text.value());
  if (!json.ok() || ofHex(json.value()["plan"].text()) != plan.id) {
    return planError(plan.folder, "'" + path + "' is damaged, or of another plan");
  }
  TileJob out;
  out.bytes = wholeOf(json.value()["bytes"]);
  out.checksum = ofHex(json.value()["checksum"].text());
  for (const JsonValue& unit : json.value()["units"].items()) {
    const std::string& name = unit["name"].text();
    // Names become paths.
    const bool isName =
        !name.empty() && name.size() <= kDeepestSquare + 1 &&
        std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '3'; });
    if (!isName) return planError(plan.folder, "'" + path + "' is damaged");
    out.units.push_back({name, wholeOf(unit["shapes"]), wholeOf(unit["bytes"])});
  }
  return out;
}

std::string jobPath(const TilePlan::Impl& plan, uint64_t job) {
  return TileFolder(plan.folder).plan() + "jobs/" + std::to_string(job) + ".json";
}

std::string shapesPath(const TilePlan::Impl& plan, uint64_t job) {
  return TileFolder(plan.folder).plan() + "shapes/" + std::to_string(job) + ".shapes";
}

std::string terrainPath(const TilePlan::Impl& plan) {
  return TileFolder(plan.folder).plan() + "terrain.bin";
}

std::string partPath(const TilePlan::Impl& plan, const std::string& unit) {
  return TileFolder(plan.folder).plan() + "done/" + squarePath(unit) + ".part";
}

}  // namespace gable
