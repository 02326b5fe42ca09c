// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "studio/gallery.h"

#include <filesystem>

#include "base/files.h"
#include "base/json.h"
#include "base/text.h"

namespace gable::studio {

namespace fs = std::filesystem;

namespace {

constexpr const char* kNotations[] = {"cga", "gbbg", "grammar", "park"};

// The heading of a page and the first sentence below it.
void readHead(std::string_view page, std::string& title, std::string& text) {
  for (std::string_view line; takeLine(page, line);) {
    if (line.starts_with("# ")) {
      title = line.substr(2);
    } else if (line.starts_with("![")) {
      continue;  // The picture has a place of its own.
    } else if (!title.empty() && !line.empty()) {
      if (!text.empty()) text += ' ';
      text += line;
    } else if (!text.empty()) {
      break;
    }
  }
  const size_t end = text.find(". ");
  if (end != std::string::npos) text.resize(end);
  if (!text.empty() && text.back() == '.') text.pop_back();
}

// The first parts of the paths that a rule file imports: folders beside its own.
std::vector<std::string> foldersImported(std::string_view rules) {
  std::vector<std::string> out;
  for (std::string_view line; takeLine(rules, line);) {
    const size_t from = line.find('"') + 1, to = line.find('/', from);
    if (!line.starts_with("import ") || from == 0 || to == std::string_view::npos) continue;
    out.emplace_back(line.substr(from, to - from));
  }
  return out;
}

// Pages, pictures' arguments and scripts tell of an example; its copy is what rules need.
bool belongs(const std::string& path) {
  return ProjectFiles::writes(path) && extensionOf(path) != "md";
}

}  // namespace

Gallery::Gallery(const std::string& folder)
    : folder_(folder.empty() ? "/nonexistent" : folder), present_(folder_.ok()) {}

std::string Gallery::rulesOf(const std::string& name) const {
  if (!present_ || !plainPath(name) || name.find('/') != std::string::npos) return {};
  for (const char* notation : kNotations) {
    const std::string file = std::string(name).append("/").append(name).append(".") + notation;
    const Result<std::string> place = folder_.place(file);
    if (place.ok() && fileExists(place.value())) return file;
  }
  return {};
}

std::string Gallery::list() const {
  std::string out;
  JsonWriter json(out);
  json.beginArray();
  std::string last;
  const std::vector<ProjectFile> files = present_ ? folder_.list() : std::vector<ProjectFile>();
  for (const ProjectFile& f : files) {
    const std::string name = f.path.substr(0, f.path.find('/'));
    if (name == last || name == f.path) continue;
    last = name;
    const std::string rules = rulesOf(name);
    if (rules.empty()) continue;
    std::string title = name, text;
    if (const auto page = folder_.read(name + "/README.md"); page.ok()) {
      title.clear();
      readHead(page.value(), title, text);
    }
    const auto has = [&](const std::string& file) {
      const auto place = folder_.place(name + "/" + file);
      return place.ok() && fileExists(place.value());
    };
    json.beginObject().key("name").value(name).key("title").value(title);
    json.key("text").value(text).key("notation").value(extensionOf(rules));
    json.key("picture").value(has(name + ".png"));
    json.key("shapes").value(has("buildings.geojson"));
    const auto arguments = folder_.read(name + "/generate.args");
    json.key("arguments").value(arguments.ok() ? arguments.value() : std::string());
    const auto view = folder_.read(name + "/picture.args");
    json.key("view").value(view.ok() ? view.value() : std::string());
    json.endObject();
  }
  json.endArray();
  return out;
}

Result<std::string> Gallery::picture(const std::string& name) const {
  if (rulesOf(name).empty()) return Error{"file-missing", "there is no such example", ""};
  return folder_.read(std::string(name).append("/").append(name).append(".png"));
}

Result<std::string> Gallery::copyTo(ProjectFiles& files, const std::string& name) const {
  if (rulesOf(name).empty()) return Error{"file-missing", "there is no such example", ""};
  std::string target = name;
  for (int i = 2; i < 1000; ++i) {
    const auto place = files.place(target);
    if (!place.ok()) return place.error();
    if (!fs::exists(place.value())) break;
    target = name + "-" + std::to_string(i);
  }
  // All of it is read before the first file is written: a copy is whole or not there.
  std::vector<std::pair<std::string, std::string>> copied;
  for (const ProjectFile& f : folder_.list()) {
    if (f.path.compare(0, name.size() + 1, name + "/") != 0) continue;
    const std::string inner = f.path.substr(name.size() + 1);
    if (!belongs(inner)) continue;
    // Pictures of an example describe it; rules do not need them.
    if (inner.find('/') == std::string::npos && extensionOf(inner) == "png") continue;
    auto content = folder_.read(f.path);
    if (!content.ok()) return content.error();
    copied.emplace_back(target + "/" + inner, std::move(content.value()));
  }
  // What examples import together, and the examples that this one imports.
  std::vector<std::string> folders = {"rules"};
  const auto rules = folder_.read(rulesOf(name));
  for (std::string& f : foldersImported(rules.ok() ? rules.value() : std::string())) {
    if (f != name && !rulesOf(f).empty()) folders.push_back(std::move(f));
  }
  for (const std::string& folder : folders) {
    const Result<bool> added = addMissing(files, folder + "/", copied);
    if (!added.ok()) return added.error();
  }
  const Result<uint64_t> written = files.create(copied);
  if (!written.ok()) return written.error();
  return target;
}

Result<bool> Gallery::addMissing(const ProjectFiles& files, const std::string& folder,
                                 std::vector<std::pair<std::string, std::string>>& to) const {
  for (const ProjectFile& f : folder_.list()) {
    if (f.path.compare(0, folder.size(), folder) != 0 || !belongs(f.path)) continue;
    const Result<std::string> place = files.place(f.path);
    if (!place.ok()) return place.error();
    if (fs::exists(place.value())) continue;
    auto content = folder_.read(f.path);
    if (!content.ok()) return content.error();
    to.emplace_back(f.path, std::move(content.value()));
  }
  return true;
}

}  // namespace gable::studio
