// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// gable city: a map is planned, the rules for cities are derived on its plan, the model is written.

#include "city.h"

#include <filesystem>
#include <optional>

#include "answer.h"
#include "derive_settings.h"
#include "folders.h"
#include "gable/city.h"
#include "gable/files.h"
#include "json/city_json.h"
#include "progress.h"

namespace {

/// Where city.cga lies: in the folder of the user's rules, or with the examples. Rules of the
/// user's find what they import there as well.
int findRules(DeriveArguments& arguments) {
  const std::string examples = examplesFolder();
  if (!examples.empty()) arguments.search.libraries.push_back(examples);
  if (arguments.rules.empty()) {
    if (examples.empty()) {
      return fail(kExitFile,
                  "the rules for cities, examples/rules/city.cga, do not lie beside the program; "
                  "name the folder of a city.cga with --rules");
    }
    arguments.rules = examples + "/rules/city.cga";
  } else if (std::filesystem::is_directory(arguments.rules)) {
    const std::string folder = arguments.rules;
    arguments.rules += "/city.cga";
    if (!std::filesystem::exists(arguments.rules)) {
      return fail(kExitFile, "there is no city.cga in '" + folder + "'; copy it there" +
                                 (examples.empty() ? "" : " from '" + examples + "/rules'"));
    }
  }
  return kExitDone;
}

int readBox(const std::string& text, gable::CitySettings& settings) {
  if (text.empty()) return kExitDone;
  settings.box.emplace();
  if (parseNumbers(text, ',', {-1e9, 1e9}, settings.box->data(), 4)) return kExitDone;
  return wrongOption("--box", kBoxForm, text);
}

int readCountry(std::string text, gable::CitySettings& settings) {
  for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  settings.country = text;
  if (text.empty() || gable::City::isCountry(text)) return kExitDone;
  return wrongOption("--country", "a country's two letters, such as MC, CZ or GB", text);
}

int checkPicture(const CityArguments& arguments, gable::PictureSettings& settings) {
  if (const int status = checkExtension(arguments.picture.output, {"png"})) return status;
  if (!tileFolder(arguments.output).empty()) {
    return fail(kExitUsage, "--picture draws a model, and -o asks for tiles; give one of the two");
  }
  return pictureSettings(arguments.picture, settings);
}

// Options of tiles without tiles.
int checkTileOptions(const CityArguments& arguments) {
  if (!tileFolder(arguments.output).empty()) return kExitDone;
  const TileArguments& t = arguments.tiles;
  const char* const given = t.onlyPlan      ? "--plan-jobs"
                            : t.viewer      ? "--viewer"
                            : t.compress    ? "--compress"
                            : t.triangles   ? "--tile-triangles"
                            : t.replacePlan ? "--replace-plan"
                                            : nullptr;
  if (!given) return kExitDone;
  return fail(kExitUsage, std::string(given) + " is for tiles: give -o a folder, such as monaco/");
}

// How the model is drawn and written.
struct Making {
  gable::PictureSettings picture;
  gable::WriteSettings write;
};

int checkMaking(const CityArguments& arguments, Making& making) {
  if (!arguments.picture.output.empty()) {
    if (const int status = checkPicture(arguments, making.picture)) return status;
  }
  const std::string folder = tileFolder(arguments.output);
  return writeSettings(arguments.write, folder.empty() ? arguments.output : folder,
                       arguments.derive.limits, making.write);
}

// Whoever has no rules of their own does not know where those lie that --set is for.
void tellNames(const gable::Model& model, const DeriveArguments& derive) {
  for (const gable::Diagnostic& d : model.diagnostics()) {
    if (d.code != "unknown-attribute") continue;
    note("gable info --all " + derive.rules + " lists what --set takes");
    return;
  }
}

// What is known of a place when it is made.
struct Made {
  gable::RunFigures figures;
  gable::TileResult tiles;
  /// Of a model.
  std::optional<std::vector<gable::ReportSummary>> reports;
};

int buildModel(const gable::City& city, CityArguments& arguments, const Making& making,
               Made& made) {
  gable::DeriveSettings settings;
  if (const int status = deriveSettings(arguments.derive, settings)) return status;
  gable::Rules rules(nullptr);
  if (const int status = readRules(arguments.derive, rules)) return status;
  const std::string folder = tileFolder(arguments.output);
  if (!folder.empty()) {
    const int status = makeTiles(arguments.derive, arguments.tiles,
                                 {rules, city.shapes(), settings}, folder, made.tiles);
    made.figures.deriveSeconds = made.tiles.deriveSeconds;
    made.figures.writeSeconds = made.tiles.writeSeconds;
    made.figures.triangles = made.tiles.triangles;
    return status;
  }
  const gable::Model model = deriveModel(rules, city.shapes(), settings, stderr);
  if (gable::hasErrors(model.diagnostics())) {
    tellNames(model, arguments.derive);
    return statusOf(model);
  }
  if (!arguments.output.empty()) {
    if (const int status = writeModel(model, arguments.output, making.write, made.figures))
      return status;
  }
  if (!arguments.picture.output.empty()) {
    if (const int status = drawPicture(model, arguments.picture.output, making.picture))
      return status;
  }
  made.reports = model.statistics().reports;
  if (const int status = writeReportTables(model, arguments.reports)) return status;
  return statusOf(model);
}

int makeCity(const CityArguments& given) {
  CityArguments arguments = given;
  const double begin = secondsNow();
  const bool draws = !arguments.picture.output.empty();
  const bool builds = draws || !arguments.output.empty() || arguments.reports.any();
  if (!builds && arguments.plan.empty() && arguments.stats.empty()) {
    return fail(
        kExitUsage,
        "say what to write: a model with -o, a picture with --picture, the ground with --plan, "
        "what the rules report with --reports");
  }
  if (!arguments.output.empty() && tileFolder(arguments.output).empty()) {
    std::vector<std::string> formats = gable::modelExtensions();
    formats.emplace_back("png");
    if (const int status = checkExtension(arguments.output, formats)) return status;
  }
  if (arguments.reports.any() && !tileFolder(arguments.output).empty()) {
    return fail(
        kExitUsage,
        "--reports is for a model: tiles are derived in parts; leave -o out to have the table "
        "alone");
  }
  if (const int status = checkTileOptions(arguments)) return status;
  arguments.picture.derive = arguments.derive;
  arguments.tiles.instancing = arguments.write.options["instancing"];
  arguments.tiles.vertices = arguments.write.options["vertices"];
  Making making;
  if (const int status = checkMaking(arguments, making)) return status;
  if (builds) {
    if (const int status = findRules(arguments.derive)) return status;
  }
  gable::CitySettings settings;
  settings.layer = arguments.derive.layer;
  settings.terrain = arguments.terrain;
  settings.soil = arguments.soil;
  if (const int status = readBox(arguments.box, settings)) return status;
  if (const int status = readCountry(arguments.country, settings)) return status;
  // Who has stopped the work does not wait until a city is freed: it lasts until the process ends.
  static std::optional<gable::City> held;
  {
    const Progress progress("planning " + arguments.derive.shapes);
    held =
        gable::City::load(arguments.derive.shapes, settings, fileLimits(arguments.derive.limits));
  }
  const gable::City& city = *held;
  print(city.diagnostics());
  if (!city.found()) return kExitFile;
  if (!city.ok()) return statusOf(city.diagnostics(), kExitWrong);
  Made made;
  made.figures.parseSeconds = secondsNow() - begin;
  if (!arguments.plan.empty()) {
    if (const int status = writeText(arguments.plan, city.groundGeoJson(), "plan")) {
      return status;
    }
  }
  int status = kExitDone;
  if (builds) status = buildModel(city, arguments, making, made);
  if (status == kExitDone || status == kExitLimit) {
    made.figures.totalSeconds = secondsNow() - begin;
    made.figures.peakBytes = peakBytes();
    const std::string text =
        gable::cityJson(city.statistics(), made.figures, made.tiles.ok ? &made.tiles : nullptr,
                        made.reports ? &*made.reports : nullptr);
    answer().members(text);
    if (const int written = writeCounts(arguments.stats, text)) return written;
  }
  return status;
}

}  // namespace

int runCity(const CityArguments& arguments) {
  hasWarned();
  return strictStatus(makeCity(arguments), arguments.strict);
}
