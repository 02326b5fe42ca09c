// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// gable generate: the map of the program. Rules are read, initial shapes are read, the rules are
// derived on the shapes, the model is written.

#include <array>
#include <cstdio>

#include "answer.h"
#include "commands.h"
#include "derive_settings.h"
#include "gable/files.h"
#include "watch.h"

namespace {

/// Says why a model is empty: as a rule another start rule was meant.
void tellEmpty(const gable::Model& model, const Inputs& inputs) {
  if (model.leafCount() > 0 || model.end() != gable::End::Done) return;
  const bool chosen = inputs.settings.startRule.has_value();
  const std::string start =
      chosen ? *inputs.settings.startRule : inputs.rules.startRule().value_or(std::string());
  gable::Diagnostic d;
  d.severity = gable::Diagnostic::Severity::Warning;
  d.code = "empty-model";
  d.message = "the model is empty: the start rule '" + start + "' made nothing";
  d.rendered = "warning: " + d.message + " [" + d.code + "]\n";
  if (!chosen) {
    d.hint = "it is the one with @StartRule, else the first of the file; --start takes another";
    d.rendered += "  hint: " + d.hint + "\n";
  }
  print({d});
}

// Leaves the shapes of the part of the map that --box names.
int takeBox(const std::string& text, gable::Shapes& shapes) {
  if (text.empty()) return kExitDone;
  std::array<double, 4> box{};
  if (!parseNumbers(text, ',', {-1e9, 1e9}, box.data(), box.size())) {
    return wrongOption("--box", kBoxForm, text);
  }
  gable::Shapes part = shapes.within(box);
  if (part.size() == 0) {
    print({part.diagnostics().back()});
    return statusOf(part.diagnostics(), kExitWrong);
  }
  shapes = std::move(part);
  return kExitDone;
}

int generateOnce(const GenerateArguments& arguments) {
  const double begin = secondsNow();
  hasWarned();
  std::vector<std::string> formats = gable::modelExtensions();
  formats.emplace_back("png");
  if (const int status = checkExtension(arguments.output, formats)) return status;
  gable::WriteSettings write;
  if (const int status =
          writeSettings(arguments.write, arguments.output, arguments.derive.limits, write)) {
    return status;
  }
  Inputs inputs;
  if (const int status = readInputs(arguments.derive, inputs)) return status;
  if (const int status = takeBox(arguments.box, inputs.shapes)) return status;
  // JSON on the standard output is that and nothing else; what was printed is part of it.
  std::FILE* const prints = arguments.stats == "-" || terminal().json ? stderr : stdout;
  const gable::Model model = deriveModel(inputs.rules, inputs.shapes, inputs.settings, prints);
  tellOfFace(model.diagnostics(), arguments.derive);
  if (gable::hasErrors(model.diagnostics())) return statusOf(model);
  tellEmpty(model, inputs);

  gable::RunFigures figures;
  figures.before = inputs.rules.diagnostics();
  const gable::DiagnosticList& ofShapes = inputs.shapes.diagnostics();
  figures.before.insert(figures.before.end(), ofShapes.begin(), ofShapes.end());
  if (const int status = writeModel(model, arguments.output, write, figures)) return status;

  if (const int status = writeReportTables(model, arguments.reports)) return status;
  figures.parseSeconds = inputs.rules.parseSeconds();
  figures.totalSeconds = secondsNow() - begin;
  figures.peakBytes = peakBytes();
  if (terminal().json) answer().members(gable::statisticsMembers(model, figures));
  if (!arguments.stats.empty()) {
    const std::string text = gable::statisticsJson(model, figures);
    if (const int status = writeCounts(arguments.stats, text)) return status;
  }
  return strictStatus(statusOf(model), arguments.strict);
}

}  // namespace

int runGenerate(const GenerateArguments& arguments) {
  if (arguments.count > 0) {
    return forSeeds(arguments.count, arguments.derive.seed, [&](const std::string& seed) {
      GenerateArguments each = arguments;
      each.derive.seed = seed;
      for (std::string* path : {&each.output, &each.stats, &each.reports.all, &each.reports.byShape,
                                &each.reports.rows}) {
        *path = withSeed(*path, seed);
      }
      return generateOnce(each);
    });
  }
  if (!arguments.watch) return generateOnce(arguments);
  return watch({[&] { return inputTimes(arguments.derive); },
                [&] {
                  const int status = generateOnce(arguments);
                  if (status == kExitDone) tell(arguments.output + "\n");
                  return status;
                },
                {}});
}
