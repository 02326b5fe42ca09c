// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "studio/workshop.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "base/files.h"
#include "json/answers.h"

namespace gable::studio {

namespace {

// A request's three numbers.
std::optional<Triple> tripleOf(const JsonValue& v) {
  if (v.size() != 3) return std::nullopt;
  return Triple{v.at(0).number(0), v.at(1).number(0), v.at(2).number(0)};
}

Result<Model> loaded(const ProjectFiles& files, const std::string& path) {
  const Result<std::string> place = files.place(path);
  if (!place.ok()) return place.error();
  Model model = Model::load(place.value());
  if (model.found() && model.ok()) return model;
  const DiagnosticList& why = model.diagnostics();
  if (why.empty()) return Error{"model-unreadable", "'" + path + "' could not be read", ""};
  return Error{"model-unreadable", why[0].message, why[0].hint};
}

void writeBounds(JsonWriter& json, const Model& model) {
  json.key("bounds").beginArray();
  const BoundingBox box = model.bounds().value_or(BoundingBox{});
  for (const Triple& corner : {box.min, box.max}) {
    for (const double v : corner) json.value(v);
  }
  json.endArray();
}

}  // namespace

Result<std::string> modelPreview(const ProjectFiles& files, Session& session,
                                 const std::string& path) {
  const Result<Model> model = loaded(files, path);
  if (!model.ok()) return model.error();
  std::string text;
  JsonWriter json(text);
  json.beginObject().key("derivation").value(session.adopt(model.value()));
  writeBounds(json, model.value());
  json.key("stats").raw(statisticsJson(model.value())).endObject();
  text.append((4 - text.size() % 4) % 4, ' ');
  const auto size = static_cast<uint32_t>(text.size());
  std::string out = "GBM1";
  out.append(reinterpret_cast<const char*>(&size), sizeof size);
  return out + text + model.value().drawList();
}

Result<std::string> prepareAsset(ProjectFiles& files, const JsonValue& request) {
  const std::string& to = request["to"].text();
  if (extensionOf(to) != "glb") {
    return Error{"kind-refused", "prepared assets are .glb files", "name the asset like wall.glb"};
  }
  const Result<Model> model = loaded(files, request["path"].text());
  if (!model.ok()) return model.error();
  PrepareSettings s;
  s.pivot = tripleOf(request["pivot"]);
  s.volume = tripleOf(request["size"]);
  s.rotate = tripleOf(request["rotate"]).value_or(Triple{});
  s.zUp = request["zUp"].boolean(false);
  if (!request["name"].text().empty()) s.name = request["name"].text();
  const Model ready = model.value().prepared(s);
  if (!ready.ok()) {
    const Diagnostic& why = ready.diagnostics().back();
    return Error{why.code, why.message, why.hint};
  }
  std::string folder = (std::filesystem::temp_directory_path() / "gable-XXXXXX").string();
  if (!mkdtemp(folder.data())) return Error{"file-unwritable", "there is no room for files", ""};
  const WriteResult written = ready.write(folder + "/asset.glb", {});
  const Result<std::string> bytes = readFile(folder + "/asset.glb");
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
  if (!written.ok && !written.diagnostics.empty()) {
    const Diagnostic& why = written.diagnostics[0];
    return Error{why.code, why.message, why.hint};
  }
  if (!bytes.ok()) return bytes.error();
  const Result<std::string> version = files.write(to, bytes.value(), request["expected"].text());
  if (!version.ok()) return version.error();
  std::string out;
  JsonWriter json(out);
  json.beginObject().key("version").value(version.value());
  writeBounds(json, ready);
  json.endObject();
  return out;
}

std::string outlinesJson(const Shapes& shapes) {
  std::string out;
  JsonWriter json(out);
  json.beginObject().key("count").value(static_cast<uint64_t>(shapes.size()));
  json.key("shapes").beginArray();
  for (size_t i = 0; i < std::min(shapes.size(), kMostOutlines); ++i) {
    const Shapes::Outline outline = shapes.outline(i);
    json.beginObject().key("name").value(outline.name).key("area").value(outline.area);
    json.key("ring").beginArray();
    for (const auto& [x, y] : outline.ring) json.beginArray().value(x).value(y).endArray();
    json.endArray().endObject();
  }
  json.endArray().key("diagnostics").raw(diagnosticsJson(shapes.diagnostics())).endObject();
  return out;
}

}  // namespace gable::studio
