// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The command line: options to arguments, one command each.

#include <CLI/CLI.hpp>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "answer.h"
#include "city.h"
#include "cli_tree.h"
#include "commands.h"
#include "folders.h"
#include "gable/files.h"
#include "gable/names.h"
#include "gable/writing.h"
#include "memory.h"
#include "tiles.h"
#include "tiles_viewer.h"
#include "version.h"
#include "wrong_line.h"

namespace {

/// A check of an option that is a number; CLI11 reads what it lets pass.
CLI::Validator number(NumberRange range) {
  return CLI::Validator(
      [range](std::string& text) {
        double value = 0;
        if (parseNumber(text, range, value)) return std::string();
        return "'" + text + "' is not " + rangeText(range);
      },
      "");
}

/// ".glb .gltf .png": what models are written as.
std::string modelEndings() {
  std::string out;
  for (const std::string& extension : gable::modelExtensions()) out += "." + extension + " ";
  return out + ".png";
}

/// What pictures from any camera have; the defaults are those of the arguments.
void addLookOptions(CLI::App* app, RenderArguments& a) {
  app->add_option("--size", a.size, "Pixels (default " + a.size + ")");
  app->add_option(
         "--samples", a.samples,
         "Paths per pixel (default " +
             (a.samples ? std::to_string(*a.samples)
                        : std::string("24 at 1280x720, fewer in larger pictures, 8 to 48")) +
             ")")
      ->check(number({1, 65536, true}));
  app->add_option("--look", a.look,
                  "photo, clay, blueprint, ink or section (a model cut open); --style takes these "
                  "words too")
      ->check(CLI::IsMember(gable::lookNames()));
  app->add_option("--lighting", a.lighting,
                  "paths (light from surface to surface, default) or direct (sun and sky alone, "
                  "many times faster)")
      ->check(CLI::IsMember(gable::lightingNames()));
  auto* sun = app->add_option("--sun", a.sun, "elevation,azimuth in degrees (azimuth from north)");
  app->add_option(
         "--sun-at", a.sunAt,
         "The sun by place and time: latitude,longitude,YYYY-MM-DD,HH:MM, the time with +02:00 "
         "or Z\nwhere a clock is meant; without the place that of the shapes")
      ->excludes(sun);
  app->add_option("--haze", a.haze, "Dust in the air: 1 on a clear day, 5 on a milky one")
      ->check(number({0, 50}));
  app->add_option("--clouds", a.clouds, "Share of the sky that clouds hide, 0 to 1 (default 0)")
      ->check(number({0, 1}));
  app->add_option("--mist", a.mist, "Metres over which mist takes 63 % of a colour, 0 for none")
      ->check(number({0, 1e9}));
  app->add_option("--exposure", a.exposure,
                  "auto, or stops by which the picture is brightened (default auto)");
  app->add_option("--lit", a.litRooms,
                  "Share of rooms with light behind their windows (default 0.4 at night)")
      ->check(number({0, 1}));
  app->add_option("--lamps", a.lamps,
                  "How strongly what shines lights its surroundings (default 1)")
      ->check(number({0, 1e6}));
  app->add_option("--aperture", a.aperture,
                  "Blur what is out of focus: the lens's f-number, such as 2.8")
      ->check(number({1e-4, 1e4}));
  app->add_option("--focus", a.focus, "Metres to what is sharp (default: to the target)")
      ->check(number({1e-3, 1e9}));
  app->add_option("--cut", a.cut,
                  "Leave out a part: front, side, or what lies beyond x=, y= or z= METRES (-z= for "
                  "before)");
  app->add_option("--bounces", a.bounces, "Reflections that light is followed through (default 3)")
      ->check(number({0, 32, true}));
  app->add_flag("--no-denoise", a.noDenoise, "Leave the noise of few samples in the picture");
  app->add_option("--ground", a.ground,
                  "Colour of the ground around the model: #rrggbb (default #77766a)");
  app->add_flag("--block", a.block,
                "A block of soil under the model, cut at its sides, in place of endless ground");
  app->add_option("--fov", a.fieldOfView, "Horizontal angle of view in degrees, 1 to 170")
      ->check(number({1, 170}));
}

void addPictureOptions(CLI::App* app, RenderArguments& a) {
  app->add_option(
         "--view", a.view,
         "iso, top (the plan), front (the elevation: both in parallel projection) or street")
      ->check(CLI::IsMember(gable::viewNames()));
  addLookOptions(app, a);
  app->add_option("--pitch", a.pitch, "Degrees that the camera of iso looks down (default 38)")
      ->check(number({0, 90}));
  app->add_option("--eye", a.eye, "The camera's place: x,y,z in metres");
  app->add_option("--target", a.target, "What it looks at: x,y,z in metres");
}

void addLimits(CLI::App* app, LimitArguments& a, const char* seconds) {
  app->add_option("--max-seconds", a.maxSeconds, seconds)->check(number({0, 1e9}));
  app->add_option("--max-memory", a.maxMegabytes,
                  "Stop when it takes so many megabytes (default 4096, 0: no limit)")
      ->check(number({0, 1e9, true}));
}

/// How long commands may take that derive nothing.
constexpr const char* kFileSeconds = "Stop after so many seconds a file (default 600, 0: no limit)";

void addSearch(CLI::App* app, gable::SearchSettings& search) {
  if (std::string examples = examplesFolder(); !examples.empty()) search.bundled = examples;
  app->add_option("--workspace", search.workspace,
                  "A folder of projects: rules may name files of others as /Project/rules/x.cga");
  app->add_option("--lib", search.libraries,
                  "A further project that the rules may read from: a folder or NAME=FOLDER; may be "
                  "repeated")
      ->type_size(1)
      ->expected(1)
      ->take_all();
  app->add_flag("--find-by-name", search.byName,
                "Look for what is not under its path by its file name alone");
}

void addDeriveOptions(CLI::App* app, DeriveArguments& a) {
  auto* shapes = app->add_option(
      "--shapes", a.shapes,
      "Footprints: .geojson .json .city.json .osm .pbf .gpkg .fgb .shp .kml\n.dxf .obj .gltf .glb");
  auto* lot =
      app->add_option("--lot", a.lot, "A rectangular lot in metres, such as 30x40 (default 20x20)")
          ->excludes(shapes);
  app->add_option(
         "--face", a.face,
         "An upright face in metres, width x height, such as 12x9: for the rules of a wall")
      ->excludes(shapes)
      ->excludes(lot);
  app->add_option("--only", a.only,
                  "Only features of --shapes with this property: building, or landuse=grass\n"
                  "(default for OpenStreetMap: building)")
      ->needs(shapes)
      ->check([](const std::string& text) {
        return text.empty() || text[0] == '='
                   ? "'" + text + "' names no property: write building or landuse=grass"
                   : std::string();
      });
  app->add_option("--layer", a.layer, "The layer of --shapes, where it has several")->needs(shapes);
  app->add_flag("--cut-nested", a.cutNested, "Cut footprints out of larger ones that they lie in");
  app->add_option(
      "--style", a.style,
      "A style that the rule file declares, or IMPORT.STYLE; several with commas between");
  app->add_option("--start", a.start,
                  "The rule to start with (default: the one with @StartRule, else the first)");
  app->add_option("--set", a.set, "An attribute's value: NAME=VALUE; may be repeated")
      ->type_size(1)
      ->expected(1)
      ->take_all();
  app->add_option("--seed", a.seed, "The seed of all random numbers (default 0); random draws one");
  app->add_option("--project", a.project, "The folder that the rules may read from");
  addSearch(app, a.search);
  app->add_option("--jobs", a.jobs, "Threads (default: one per processor)")
      ->check(number({0, 4096, true}));
  app->add_flag("--no-sharing", a.noSharing, "Derive equal parts again instead of sharing them");
  app->add_option("--dialect", a.dialect, "The rules' notation, when the extension does not tell");
  addLimits(app, a.limits,
            "Stop reading, deriving, writing and drawing after so many seconds each (default: 600 "
            "for files, no limit else)");
  app->add_option("--max-shapes", a.maxShapes, "Stop after so many shapes (default 50000000)")
      ->check(number({0, 1e12, true}));
  app->add_option("--max-steps", a.maxSteps,
                  "Stop after so many operations and calls, each weighed\n"
                  "by what it works on (default 4000000000)")
      ->check(number({0, 1e18, true}));
  app->add_option("--max-vertices", a.maxVertices,
                  "Stop when leaves have so many vertices (default 200000000)")
      ->check(number({0, 1e12, true}));
  app->add_option("--max-width", a.maxWidth, "Parts or turns of one shape (default 100000)")
      ->check(number({0, 1e6, true}));
  app->add_option("--max-depth", a.maxDepth, "Rule calls within rule calls (default 1024)")
      ->check(number({0, 4294967295.0, true}));
}

void addLsp(CLI::App& app, LspArguments& a, int& status) {
  auto* lsp = app.add_subcommand("lsp", "Run the language server for editors, on stdin and stdout");
  // What editors add by themselves.
  lsp->add_flag_callback(
      "--stdio", [] {}, "Use stdin and stdout, which is the only way");
  addSearch(lsp, a.search);
  lsp->callback([&a, &status] { status = runLsp(a); });
}

void addCheck(CLI::App& app, CheckArguments& a, int& status) {
  auto* check = app.add_subcommand("check", "Report all mistakes of rule files");
  check->add_option("rules", a.rules, "Rule files")->required();
  check->add_option("--project", a.project, "The folder that the rules may read from");
  addSearch(check, a.search);
  check->add_option("--dialect", a.dialect, "The rules' notation");
  check->add_flag("--strict", a.strict, "Exit with status 1 where there are warnings as well");
  check->add_flag("--disassemble", a.disassemble, "List the compiled program as well");
  addLimits(check, a.limits, kFileSeconds);
  check->callback([&a, &status] { status = runCheck(a); });
}

void addWriting(CLI::App* app, WriteArguments& a) {
  std::string programs;
  std::vector<std::string> names;
  for (const gable::WriteProfile& p : gable::writeProfiles()) {
    programs += (names.empty() ? "" : ", ") + p.name + " (" + p.title + ")";
    names.push_back(p.name);
  }
  app->add_option("--for", a.profile,
                  "glTF: choose the options below as a program wants them: " + programs +
                      ";\nan option that is given holds all the same")
      ->check(CLI::IsMember(names));
  for (const gable::WriteOption& o : gable::writeOptions()) {
    CLI::Option* option = app->add_option("--" + o.name, a.options[o.name], o.help);
    if (o.words.empty())
      option->check(number({0, static_cast<double>(o.most), true}));
    else
      option->check(CLI::IsMember(o.words));
  }
}

// How often it runs.
void addRuns(CLI::App* app, int& count, bool& watch) {
  auto* seeds = app->add_option("--count", count,
                                "So many seeds, from that of --seed on: NAME-0, NAME-1 and so on")
                    ->check(number({1, 1e6, true}));
  app->add_flag("--watch", watch, "Run again whenever a file that is read changes, until Ctrl-C")
      ->excludes(seeds);
}

void addReports(CLI::App* app, ReportArguments& a) {
  app->add_option("--reports", a.all, "Write reports as CSV to a file, or - for stdout");
  app->add_option("--reports-by-shape", a.byShape,
                  "The same with lines of its own for each initial shape");
  app->add_option("--report-rows", a.rows,
                  "Write one row for each initial shape, with its id and a column for each report");
}

void addStrict(CLI::App* app, bool& strict) {
  app->add_flag("--strict", strict,
                "Exit with status 1 where there are warnings; the model is written all the same");
}

void addGenerate(CLI::App& app, GenerateArguments& a, int& status) {
  auto* generate = app.add_subcommand("generate", "Derive rules and write a model");
  generate->add_option("rules", a.derive.rules, "The rule file or package")->required();
  addDeriveOptions(generate, a.derive);
  generate->add_option("-o,--output", a.output, "The model: " + modelEndings())->required();
  generate->add_option("--stats", a.stats, "Write counts as JSON to a file, or - for stdout");
  addReports(generate, a.reports);
  generate
      ->add_option("--box", a.box,
                   "Only those of --shapes with their middle in west,south,east,north, in degrees\n"
                   "or in the metres of the file")
      ->needs("--shapes");
  addWriting(generate, a.write);
  addRuns(generate, a.count, a.watch);
  addStrict(generate, a.strict);
  generate->callback([&a, &status] { status = runGenerate(a); });
}

void addTileOptions(CLI::App* app, TileArguments& a) {
  app->add_option("--tile-triangles", a.triangles,
                  "Triangles of a tile at most (default 49152 with --compress, else 16384)")
      ->check(number({100, 10'000'000, true}));
  app->add_flag(
      "--compress", a.compress,
      "Compress tiles (EXT_meshopt_compression): a quarter of the bytes, as near as 2 mm");
  app->add_flag("--viewer", a.viewer, "Put a page beside the tiles that shows them (index.html)");
}

// Cities have them among the options of models.
void addTileForm(CLI::App* app, TileArguments& a) {
  app->add_option("--instancing", a.instancing,
                  "How parts that occur several times in a tile are shown: auto and gpu (by\n"
                  "EXT_mesh_gpu_instancing), nodes (by a node each), none (not at all)")
      ->check(CLI::IsMember(std::vector<std::string>{"auto", "nodes", "gpu", "none"}));
  app->add_option(
         "--vertices", a.vertices,
         "What a vertex takes: auto and compact (integers of KHR_mesh_quantization, moved\n"
         "by half a millimetre at most), float (single precision)")
      ->check(CLI::IsMember(std::vector<std::string>{"auto", "compact", "float"}));
}

void addJobShapes(CLI::App* app, TileArguments& a) {
  app->add_option("--job-shapes", a.jobShapes, "About how many shapes a job has (default 16384)")
      ->check(number({1, 1e9, true}));
}

void addReplacePlan(CLI::App* app, TileArguments& a) {
  app->add_flag("--replace-plan", a.replacePlan,
                "Write into a folder with a plan, none of whose jobs may run; what is done stays");
}

void addCity(CLI::App& app, CityArguments& a, int& status) {
  auto* city = app.add_subcommand("city", "Make a place from its map: streets, ground, buildings");
  city->add_option("map", a.derive.shapes,
                   "The map: .osm .pbf .geojson .city.json .gpkg .fgb .shp .kml .dxf")
      ->required();
  city->add_option(
      "--rules", a.derive.rules,
      "A rule file, or a folder with city.cga (default: the rules that come with Gable)");
  city->add_option("--box", a.box,
                   "The part of the map: west,south,east,north in degrees, or in the map's metres\n"
                   "(default: the box around its buildings)");
  city->add_option("--terrain", a.terrain,
                   "Heights: a GeoTIFF (.tif) or a tile of SRTM (.hgt) (default: a flat place)");
  city->add_option("--soil", a.soil,
                   "On terrain: metres of soil below the lowest ground, with sides; 0: none\n"
                   "(default: 2 % of the place, 4 to 40 metres)")
      ->check(number({0, 10'000}));
  city->add_option("--country", a.country,
                   "How houses look: two letters, such as FR (default: by addresses and place)");
  city->add_option("--layer", a.derive.layer, "The layer of the map, where it has several");
  city->add_option("-o,--output", a.output,
                   "The model: " + modelEndings() + "; a folder/ for 3D Tiles");
  addWriting(city, a.write);
  addTileOptions(city, a.tiles);
  city->add_flag("--plan-jobs", a.tiles.onlyPlan,
                 "Plan the tiles alone: gable tiles job, submit and merge make them");
  addJobShapes(city, a.tiles);
  addReplacePlan(city, a.tiles);
  city->add_option("--picture", a.picture.output, "Draw the place as well: .png");
  addPictureOptions(city, a.picture);
  city->add_option("--plan", a.plan,
                   "Write the ground to a file as GeoJSON: a polygon a piece, its surface");
  addReports(city, a.reports);
  city->add_option("--stats", a.stats, "Write areas and counts as JSON to a file, or - for stdout");
  addStrict(city, a.strict);
  city->add_option("--set", a.derive.set,
                   "An attribute's value: NAME=VALUE; may be repeated. Names of imported files\n"
                   "have the import's before them: houses.roof_shape; gable info --all lists them")
      ->type_size(1)
      ->expected(1)
      ->take_all();
  city->add_option("--seed", a.derive.seed, "The seed of all random numbers (default 0)");
  addSearch(city, a.derive.search);
  city->add_option("--jobs", a.derive.jobs, "Threads (default: one per processor)")
      ->check(number({0, 4096, true}));
  addLimits(city, a.derive.limits,
            "Stop reading, deriving and writing after so many seconds each (default: 600 for\n"
            "files, no limit else)");
  city->callback([&a, &status] { status = runCity(a); });
}

struct AllTilesArguments {
  TilesArguments whole;
  PlanArguments plan;
  JobArguments job;
  MergeArguments merge;
  SubmitArguments submit;
  /// The folder that gets the page.
  std::string viewer;
  /// To join, and where.
  std::vector<std::string> places;
  std::string land;
};

void addTileRun(CLI::App* app, std::string& folder, LimitArguments& limits) {
  app->add_option("folder", folder, "The folder of the plan")->required();
  addLimits(app, limits, "Stop after so many seconds (default: no limit)");
}

void addTileJobs(CLI::App* tiles, AllTilesArguments& a, int& status) {
  const NumberRange threads{0, 4096, true};
  auto* plan =
      tiles->add_subcommand("plan", "Divide the work into jobs, for any number of machines");
  plan->add_option("rules", a.plan.derive.rules, "The rule file or package")->required();
  addDeriveOptions(plan, a.plan.derive);
  plan->add_option("-o,--output", a.plan.output, "The folder of the tiles")->required();
  addJobShapes(plan, a.plan.tiles);
  addTileOptions(plan, a.plan.tiles);
  addTileForm(plan, a.plan.tiles);
  plan->callback([&a, &status] { status = runTilesPlan(a.plan); });

  auto* job = tiles->add_subcommand("job", "Make the tiles of a job that are not there yet");
  addTileRun(job, a.job.folder, a.job.limits);
  job->add_option("jobs", a.job.jobs, "A number, or several: 3-17")->required();
  job->add_option("--threads", a.job.threads, "Threads (default: one per processor)")
      ->check(number(threads));
  job->add_option("--stats", a.job.stats, "Write counts as JSON to a file, or - for stdout");
  job->callback([&a, &status] { status = runTilesJob(a.job); });

  auto* merge = tiles->add_subcommand("merge", "Check the tiles of all jobs and write the tileset");
  addTileRun(merge, a.merge.folder, a.merge.limits);
  merge->add_flag("--mend", a.merge.mend, "Run jobs whose tiles are missing or damaged, here");
  merge->add_flag("--viewer", a.merge.viewer,
                  "Put a page beside the tiles that shows them (index.html)");
  merge->add_option("--threads", a.merge.threads, "Threads (default: one per processor)")
      ->check(number(threads));
  merge->add_option("--stats", a.merge.stats, "Write counts as JSON to a file, or - for stdout");
  merge->callback([&a, &status] { status = runTilesMerge(a.merge); });

  auto* submit = tiles->add_subcommand("submit", "Run all jobs of a plan, and the merge");
  submit->add_option("folder", a.submit.folder, "The folder of the plan")->required();
  auto* slurm = submit->add_flag("--slurm", a.submit.slurm, "As a job array of Slurm");
  submit->add_flag("--parallel", a.submit.parallel, "With GNU parallel, on this machine")
      ->excludes(slurm);
  submit->add_option("--tries", a.submit.tries, "How often a job is tried (default 3)")
      ->check(number({1, 100, true}));
  submit->add_option("--options", a.submit.options,
                     "Further options of sbatch or parallel, a text");
  submit->add_flag("--dry-run", a.submit.dry, "Write the scripts, and run nothing");
  submit->callback([&a, &status] { status = runTilesSubmit(a.submit); });
}

void addTilesViewer(CLI::App* tiles, std::string& folder, int& status) {
  auto* viewer = tiles->add_subcommand("viewer", "Put a page beside tiles that shows them");
  viewer->add_option("folder", folder, "The folder of the tiles")->required();
  viewer->callback([&folder, &status] { status = runTilesViewer(folder); });
}

void addTilesJoin(CLI::App* tiles, AllTilesArguments& a, int& status) {
  auto* join = tiles->add_subcommand("join", "Write one tileset above those of several places");
  join->add_option("places", a.places, "Folders of tiles, in the folder of the output")->required();
  join->add_option("-o,--output", a.land, "The folder of the tileset of all")->required();
  join->callback([&a, &status] { status = runTilesJoin(a.places, a.land); });
}

void addTiles(CLI::App& app, AllTilesArguments& a, int& status) {
  auto* tiles = app.add_subcommand("tiles", "Derive rules and write 3D Tiles for browsers");
  tiles->add_option("rules", a.whole.derive.rules, "The rule file or package");
  addDeriveOptions(tiles, a.whole.derive);
  tiles->add_option("-o,--output", a.whole.output, "The folder of the tiles");
  tiles->add_option("--stats", a.whole.stats, "Write counts as JSON to a file, or - for stdout");
  addTileOptions(tiles, a.whole.tiles);
  addTileForm(tiles, a.whole.tiles);
  addReplacePlan(tiles, a.whole.tiles);
  addTileJobs(tiles, a, status);
  addTilesJoin(tiles, a, status);
  addTilesViewer(tiles, a.viewer, status);
  tiles->callback([tiles, &a, &status] {
    if (!tiles->get_subcommands().empty()) return;
    // Required, unless a command follows.
    if (a.whole.derive.rules.empty()) throw CLI::RequiredError("rules");
    if (a.whole.output.empty()) throw CLI::RequiredError("--output");
    status = runTiles(a.whole);
  });
}

void addPack(CLI::App& app, PackArguments& a, int& status) {
  auto* pack = app.add_subcommand("pack", "Write rules with all that they use to one file");
  pack->add_option("rules", a.rules, "The rule file")->required();
  pack->add_option("-o,--output", a.output, "The package: .rpk .7z .zip")->required();
  pack->add_option("--project", a.project, "The folder that the rules may read from");
  addSearch(pack, a.search);
  pack->add_option("--dialect", a.dialect, "The rules' notation");
  addLimits(pack, a.limits, kFileSeconds);
  pack->callback([&a, &status] { status = runPack(a); });
}

void addInfo(CLI::App& app, InfoArguments& a, int& status) {
  auto* info = app.add_subcommand(
      "info", "Show start rules, attributes with their values, imports and assets of rules");
  info->add_option("rules", a.derive.rules, "The rule file or package")->required();
  info->add_flag("--all", a.all, "List the start rules and attributes of imported files as well");
  addDeriveOptions(info, a.derive);
  info->callback([&a, &status] { status = runInfo(a); });
}

void addFormat(CLI::App& app, FormatArguments& a, int& status) {
  auto* format = app.add_subcommand("format", "Format rule files");
  format->add_option("files", a.files, "Rule files")->required();
  format->add_flag("--check", a.check, "Change nothing; fail if a file would change");
  format->add_flag("--stdout", a.toStdout, "Print instead of writing back");
  addLimits(format, a.limits, kFileSeconds);
  format->callback([&a, &status] { status = runFormat(a); });
}

void addTraceFilter(CLI::App* app, TraceArguments& a) {
  app->add_option("--rule", a.rule, "Only the shapes of this rule, with what comes of them");
  app->add_option("--path", a.path,
                  "Only what these rules make one after the other, from the start rule down: "
                  "Lot/House/Roof");
  app->add_option("--depth", a.depth, "Only so many levels below the topmost shapes shown")
      ->check(number({0, 4294967295.0, true}));
}

void addDiff(CLI::App& app, DiffArguments& a, int& status) {
  auto* diff = app.add_subcommand("diff", "Say what differs between two models");
  diff->add_option("before", a.before, "A model: .glb .gltf .obj")->required();
  diff->add_option("after", a.after, "Another of the same format")->required();
  diff->add_option("-o,--output", a.picture.output,
                   "A picture: what is added in green, removed in red, kept in grey");
  addPictureOptions(diff, a.picture);
  addLimits(diff, a.picture.derive.limits,
            "Stop reading and comparing after so many seconds each (default 600, 0: no limit)");
  diff->callback([&a, &status] { status = runDiff(a); });
}

void addFrameOptions(CLI::App* app, RenderArguments& a) {
  app->add_option("--aov", a.layers,
                  "A folder for what lies behind each pixel: depth, normals, colours, objects, "
                  "instances, rules, materials");
  auto* turntable =
      app->add_option("--turntable", a.turntable,
                      "So many pictures once around the model, NAME-001.png and so on, or a film")
          ->check(number({1, 100000, true}));
  app->add_option("--walk", a.walk, "Pictures along the path of a JSON file, or a film")
      ->excludes(turntable);
  app->add_option("--fps", a.framesPerSecond,
                  "Pictures a second of a turntable's film (default 24)")
      ->check(number({1, 240}));
}

void addRender(CLI::App& app, RenderArguments& a, int& status) {
  auto* command = app.add_subcommand("render", "Render rules or a model as a picture");
  command->add_option("input", a.derive.rules, "A rule file or a model (.glb .gltf .obj)")
      ->required();
  addDeriveOptions(command, a.derive);
  command->add_option("-o,--output", a.output, "The picture: .png; or a film: .webm .mp4")
      ->required();
  addPictureOptions(command, a);
  addFrameOptions(command, a);
  addRuns(command, a.count, a.watch);
  command->callback([&a, &status] { status = runRender(a); });
}

void addDataset(CLI::App& app, DatasetArguments& a, int& status) {
  auto* command = app.add_subcommand(
      "dataset", "Make a data set for learning: labelled pictures of many seeds and cameras");
  command->add_option("rules", a.picture.derive.rules, "The rule file or package")->required();
  addDeriveOptions(command, a.picture.derive);
  command->add_option("-o,--output", a.output, "The folder; what is there goes on")->required();
  command->add_option("--count", a.count, "Seeds, from that of --seed on (default 1)")
      ->check(number({1, 1e6, true}));
  command->add_option("--cameras", a.cameras, "Pictures of each seed (default 4)")
      ->check(number({1, 100'000, true}));
  command
      ->add_option("--placing", a.placing,
                   "orbit (cameras evenly around the model, default) or sampled (each by chance)")
      ->check(CLI::IsMember(gable::datasetCamerasNames()));
  command
      ->add_option("--zoom", a.zoom,
                   "How much nearer than the whole, by the lens: 2 shows half of its width "
                   "(default 1)")
      ->check(number({0.1, 100}));
  command
      ->add_option("--labels", a.labels,
                   "What pixels are: rule (that made them, default), label (the @Label of the "
                   "nearest rule above), or tag (the last that a shape above was given)")
      ->check(CLI::IsMember(gable::datasetLabelsNames()));
  command
      ->add_option("--tags", a.tags,
                   "The tags that --labels tag goes by, in the order in which they count (default: "
                   "all that the rules give by name)")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--format", a.format,
                   "The list of all: coco (coco.json, default) or json (items.json)")
      ->check(CLI::IsMember(gable::datasetFormatNames()));
  std::vector<std::string> models = gable::modelExtensions();
  models.emplace_back("none");
  command->add_option("--model", a.model, "The mesh of each seed: glb (default), obj, .., or none")
      ->check(CLI::IsMember(models));
  command->add_option(
      "--shard", a.shard,
      "Only a part of the seeds: NUMBER/COUNT (default: what nobody else is making)");
  addLookOptions(command, a.picture);
  command
      ->add_option("--pitch", a.picture.pitch,
                   "Degrees that cameras look down (default: drawn, 15 to 45 in an orbit, 8 to "
                   "60 sampled)")
      ->check(number({0, 90}));
  addWriting(command, a.write);
  command->callback([&a, &status] { status = runDataset(a); });
}

void addWatchCommand(CLI::App& app, RenderArguments& a, int& status) {
  auto* command =
      app.add_subcommand("watch", "Make a picture or a model again whenever a file changes");
  command->add_option("rules", a.derive.rules, "The rule file or package")->required();
  addDeriveOptions(command, a.derive);
  command->add_option("-o,--output", a.output, "The picture or the model: " + modelEndings())
      ->required();
  addPictureOptions(command, a);
  command->callback([&a, &status] { status = runWatch(a); });
}

void addNew(CLI::App& app, NewArguments& a, int& status) {
  auto* command = app.add_subcommand("new", "Begin a project: rules, a test, a place for assets");
  command->add_option("folder", a.folder, "The folder to make")->required();
  command->callback([&a, &status] { status = runNew(a); });
}

void addTest(CLI::App& app, TestArguments& a, int& status) {
  auto* test = app.add_subcommand("test", "Run rule tests: the cases of .test files");
  test->add_option("paths", a.paths, "Test files, and folders to search (default: this folder)");
  test->add_option("--filter", a.filter, "Only cases with this text in their name");
  test->add_option("--format", a.format, "text (default), tap or junit")
      ->check(CLI::IsMember({"text", "tap", "junit"}));
  test->add_option("-o,--output", a.output, "Where the results go (default: -, stdout)");
  test->add_flag("--update", a.update, "Write dumps, scenes and pictures that differ anew")
      ->envname("GABLE_UPDATE");
  test->add_flag("--watch", a.watch, "Run again whenever a file changes, until Ctrl-C");
  test->add_option("--project", a.project, "The folder that the rules may read from");
  addSearch(test, a.search);
  test->add_option("--jobs", a.jobs, "Threads (default: one per processor)")
      ->check(number({0, 4096, true}));
  addLimits(test, a.limits, "Stop a derivation after so many seconds (default 600, 0: no limit)");
  test->callback([&a, &status] { status = runTest(a); });
}

void addCompletion(CLI::App& app, CompletionArguments& a, int& status) {
  auto* command =
      app.add_subcommand("completion", "Write what completes commands in a shell: bash, zsh, fish");
  command->add_option("shell", a.shell, "The shell")
      ->required()
      ->check(CLI::IsMember(completionShells()));
  command->callback([&app, &a, &status] { status = runCompletion(describe(app), a); });
}

void addMan(CLI::App& app, ManArguments& a, int& status) {
  auto* command = app.add_subcommand("man", "Write the man page of a command, or all pages");
  command->add_option("command", a.command, "The command (default: the page of the program)");
  command->add_option("-o,--output", a.output, "A folder that gets all pages");
  command->callback([&app, &a, &status] { status = runMan(describe(app), a); });
}

void addAsset(CLI::App& app, AssetArguments& asset, MaterialArguments& material, int& status) {
  auto* assetApp = app.add_subcommand("asset", "Prepare models and materials for use as assets");
  assetApp->require_subcommand(1);
  auto* prepareApp =
      assetApp->add_subcommand("prepare", "Map the volume of a model to the unit cube");
  prepareApp->add_option("model", asset.model, "The model: .glb .gltf .obj")->required();
  prepareApp->add_option("--pivot", asset.pivot,
                         "The point that becomes the origin: x,y,z (default: its lower corner)");
  prepareApp->add_option("--rotate", asset.rotate, "Degrees about x, y and z, around the pivot");
  prepareApp->add_option("--size", asset.volume,
                         "What fills a scope, from the pivot: x,y,z (default: its box)");
  prepareApp->add_option("--name", asset.name, "The name of the model in the file");
  prepareApp->add_flag("--z-up", asset.zUp, "The up axis of the file is z");
  prepareApp->add_option("-o,--output", asset.output, "The asset: .glb .gltf .obj")->required();
  addLimits(prepareApp, asset.limits, kFileSeconds);
  prepareApp->callback([&] { status = runAssetPrepare(asset); });

  auto* materialApp = assetApp->add_subcommand(
      "material", "Write the pictures of a material of the library, or list all materials");
  materialApp->add_option("name", material.name, "The material; without it, all are listed");
  materialApp->add_option("-o,--output", material.folder,
                          "A folder for color.jpg, normal.jpg, surface.jpg and material.mtl");
  materialApp->callback([&] { status = runAssetMaterial(material); });
}

void addStudio(CLI::App& app, StudioArguments& a, int& status) {
  auto* studio = app.add_subcommand(
      "studio", "Start the studio: write rules in the browser and see the model");
  studio->add_option("folder", a.folder,
                     "The project, or a rule file of it (default: this folder)");
  addSearch(studio, a.search);
  studio
      ->add_option("--port", a.port, "The port (default: that of the last start, or any free one)")
      ->check(number({0, 65535, true}));
  studio->callback([&a, &status] { status = runStudioCommand(a); });
}

// `gable help tiles plan` is `gable tiles plan --help`, as people know it from other programs.
std::vector<char*> withHelpBehind(int argc, char** argv) {
  static char option[] = "--help";
  std::vector<char*> out(argv, argv + argc);
  if (argc > 1 && std::string_view(argv[1]) == "help") {
    out.erase(out.begin() + 1);
    out.push_back(option);
  }
  return out;
}

}  // namespace

int main(int argumentCount, char** arguments) {
  useLargePages();
  std::vector<char*> line = withHelpBehind(argumentCount, arguments);
  const int argc = static_cast<int>(line.size());
  char** const argv = line.data();
  CLI::App app("Gable turns rules into places: shape grammars (CGA) in, 3D models out.", "gable");
  app.set_version_flag("--version", versionText());
  app.footer(exitText() +
             "\n\n'gable COMMAND --help' tells the options of a command, with examples.");
  app.require_subcommand(1);
  int status = kExitDone;

  cancelFlag();
  // A file that becomes too large is an error of writing, which is told and leaves nothing behind.
  std::signal(SIGXFSZ, SIG_IGN);

  GenerateArguments generate;
  addGenerate(app, generate, status);
  CityArguments city;
  addCity(app, city, status);
  AllTilesArguments tiles;
  addTiles(app, tiles, status);
  CheckArguments check;
  addCheck(app, check, status);
  InfoArguments info;
  addInfo(app, info, status);
  NewArguments fresh;
  addNew(app, fresh, status);
  PackArguments pack;
  addPack(app, pack, status);
  FormatArguments format;
  addFormat(app, format, status);

  ConvertArguments convert;
  auto* convertApp =
      app.add_subcommand("convert", "Rewrite a grammar of another notation in Gable's language");
  convertApp->add_option("rules", convert.rules, "The grammar: .grammar .pg3d .gbbg .park")
      ->required();
  convertApp->add_option("--project", convert.project, "The folder that the rules may read from");
  addSearch(convertApp, convert.search);
  convertApp->add_option("--dialect", convert.dialect,
                         "Its notation, when the extension does not tell");
  convertApp->add_option("-o,--output", convert.output, "A file, or - for stdout (default)");
  addLimits(convertApp, convert.limits, kFileSeconds);
  convertApp->callback([&] { status = runConvert(convert); });

  RenderArguments render;
  addRender(app, render, status);
  DatasetArguments dataset;
  addDataset(app, dataset, status);
  RenderArguments watched;
  addWatchCommand(app, watched, status);
  TraceArguments trace;
  auto* traceApp = app.add_subcommand("trace", "Write the derivation tree as JSON");
  traceApp->add_option("rules", trace.derive.rules, "The rule file")->required();
  addDeriveOptions(traceApp, trace.derive);
  traceApp->add_option("-o,--output", trace.output, "A file, or - for stdout (default)");
  addTraceFilter(traceApp, trace);
  traceApp->callback([&] { status = runTrace(trace); });

  AssetArguments asset;
  MaterialArguments material;
  addAsset(app, asset, material, status);

  OpsArguments ops;
  auto* opsApp =
      app.add_subcommand("ops", "List the operations, functions and attributes, or explain one");
  opsApp->add_option("name", ops.name, "An operation, function or attribute");
  opsApp->callback([&] { status = runOps(ops); });

  LspArguments lsp;
  addLsp(app, lsp, status);
  DiffArguments diff;
  addDiff(app, diff, status);
  TestArguments test;
  addTest(app, test, status);
  StudioArguments studio;
  addStudio(app, studio, status);
  CompletionArguments completion;
  addCompletion(app, completion, status);
  ManArguments man;
  addMan(app, man, status);
  addCommon(app);
  app.parse_complete_callback([&app] { answer().begin(chosenCommand(app)); });
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    status = wrongLine(app, e, argc, argv);
  }
  // --watch has answered for each run.
  if (!answer().given()) printAnswer(status);
  status = finishOutput(status);
  // What is still held the system frees at once.
  if (*cancelFlag()) std::_Exit(status);
  return status;
}
