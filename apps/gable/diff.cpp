// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <cstdio>
#include <string>

#include "answer.h"
#include "commands.h"
#include "gable/compare.h"

namespace {

using gable::Comparison;
using gable::FaceSum;

/// The extension, where both of glTF are one: they hold the same triangles.
std::string formatOf(const std::string& path) {
  const std::string extension = extensionOf(path);
  return extension == "gltf" ? "glb" : extension;
}

int readModel(const std::string& path, const gable::FileLimits& limits, gable::Model& model) {
  if (!isModel(path)) {
    return fail(kExitUsage, "'" + path + "' is no model; name a .glb, .gltf or .obj file");
  }
  model = gable::Model::load(path, limits);
  print(model.diagnostics());
  if (!model.found()) return statusOf(model.diagnostics(), kExitFile);
  return model.ok() ? kExitDone : statusOf(model.diagnostics(), kExitWrong);
}

/// To a tenth of a millimetre, without trailing zeros.
std::string rounded(double v) {
  char text[64];
  std::snprintf(text, sizeof text, "%.4f", v);
  std::string out = text;
  out.erase(out.find_last_not_of('0') + 1);
  if (out.back() == '.') out.pop_back();
  return out == "-0" ? "0" : out;
}

void row(const char* name, double before, double after, const char* unit = "") {
  const std::string change = rounded(after - before);
  std::printf("%-10s %14s %14s %14s%s\n", name, rounded(before).c_str(), rounded(after).c_str(),
              (change == "0" || change[0] == '-' ? change : "+" + change).c_str(), unit);
}

void row(const char* name, uint64_t before, uint64_t after) {
  row(name, static_cast<double>(before), static_cast<double>(after));
}

std::string pointText(const gable::Triple& p) {
  return rounded(p[0]) + " " + rounded(p[1]) + " " + rounded(p[2]);
}

void faces(const char* name, const FaceSum& sum) {
  std::printf("%-10s %8llu faces %14s m2", name, static_cast<unsigned long long>(sum.faces),
              rounded(sum.area).c_str());
  if (sum.bounds) {
    std::printf("   from %s to %s", pointText(sum.bounds->min).c_str(),
                pointText(sum.bounds->max).c_str());
  }
  std::printf("\n");
}

void printText(const Comparison& c) {
  const auto& [a, b] = c.statistics;
  std::printf("%-10s %14s %14s %14s\n", "", "before", "after", "change");
  row("faces", a.faces, b.faces);
  row("vertices", a.vertices, b.vertices);
  row("triangles", a.triangles, b.triangles);
  row("materials", a.materials, b.materials);
  row("area", c.area.first, c.area.second, " m2");
  for (size_t i = 0; a.bounds && b.bounds && i < 3; ++i) {
    const char* const names[] = {"width x", "height y", "depth z"};
    row(names[i], a.bounds->max[i] - a.bounds->min[i], b.bounds->max[i] - b.bounds->min[i], " m");
  }
  std::printf("\n");
  faces("added", c.added);
  faces("removed", c.removed);
  faces("kept", c.kept);
  if (!c.materials.empty()) std::printf("\n");
  for (const gable::MaterialChange& m : c.materials) {
    const std::string name = m.name.empty() || m.name == m.color ? m.color : m.name + " " + m.color;
    std::printf("material %s: %s -> %s m2\n", name.c_str(), rounded(m.area.first).c_str(),
                rounded(m.area.second).c_str());
  }
  if (c.same()) std::printf("\nthe models are the same\n");
}

}  // namespace

int runDiff(const DiffArguments& arguments) {
  const RenderArguments& picture = arguments.picture;
  gable::PictureSettings settings;
  if (!picture.output.empty()) {
    if (const int status = checkExtension(picture.output, {"png"})) return status;
    if (const int status = pictureSettings(picture, settings)) return status;
  }
  if (formatOf(arguments.before) != formatOf(arguments.after)) {
    return fail(kExitUsage, "'" + arguments.before + "' and '" + arguments.after +
                                "' have different formats, which keep faces in different ways; "
                                "compare files of one format");
  }
  const gable::FileLimits limits = fileLimits(picture.derive.limits);
  gable::Model before(nullptr), after(nullptr);
  if (const int status = readModel(arguments.before, limits, before)) return status;
  if (const int status = readModel(arguments.after, limits, after)) return status;
  const Comparison c = gable::compare(before, after, limits);
  print(c.diagnostics);
  if (gable::hasErrors(c.diagnostics)) return statusOf(c.diagnostics, kExitWrong);
  if (terminal().json)
    answer().members(gable::comparisonJson(c));
  else
    printText(c);
  if (!picture.output.empty()) {
    if (const int status = drawPicture(c.picture, picture.output, settings)) return status;
  }
  return c.same() ? kExitDone : kExitWrong;
}
