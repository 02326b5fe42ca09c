// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Files that rules name: models, pictures, tables. A path that is written out is looked for while
// the rules are read; one that is computed is looked for when it is used.

#include <algorithm>

#include "lang/sema/analysis.h"

namespace gable::lang {

namespace {

// Parameters with this name are files that must be there.
constexpr std::string_view kFileParameter = "filePath";
// Texts of this form name a material: one that comes with Gable, or a folder of the project.
constexpr std::string_view kMaterialForm = "a material";
// The folder of what comes with Gable.
constexpr const char* kBundled = "/gable/";
// No file has an empty path.
constexpr std::string_view kAnyFile;

std::string_view withoutFolders(std::string_view path) {
  return path.substr(std::min(path.find_last_of("/\\"), path.size() - 1) + 1);
}

// The file of that name in another folder, else one with nearly that path or that name.
std::string nearestFile(std::string_view path, const std::vector<std::string>& files) {
  const std::string_view name =
      path.find_last_of("/\\") == std::string_view::npos ? path : withoutFolders(path);
  std::vector<std::string_view> paths, names;
  for (const std::string& f : files) {
    paths.push_back(f);
    names.push_back(f.find('/') == std::string::npos ? std::string_view(f) : withoutFolders(f));
    if (names.back() == name) return f;
  }
  if (std::string nearest = nearestName(path, paths); !nearest.empty()) return nearest;
  const std::string nearest = nearestName(name, names);
  const auto at = std::find(names.begin(), names.end(), nearest);
  return nearest.empty() || at == names.end() ? std::string()
                                              : files[static_cast<size_t>(at - names.begin())];
}

}  // namespace

// A text, or the name of a constant that is one; kNoNode where the value is computed.
NodeId Analysis::writtenText(NodeId node) const {
  if (tree().kind(node) == NodeKind::String) return node;
  const Resolution& r = program_.modules[body_.module].at(node);
  if (tree().kind(node) != NodeKind::Name || r.kind != RefKind::Attribute) return kNoNode;
  const AttributeInfo& a = program_.attributes[r.index];
  const bool here = a.constant && a.source == ValueSource::Own && a.valueModule == body_.module;
  return here && tree().kind(a.valueNode) == NodeKind::String ? a.valueNode : kNoNode;
}

// Rules that ask whether there is such a file know what to do without it. They ask by its path, by
// the name of a constant, or by a path that is computed and so may be any.
bool Analysis::asksForFile(NodeId argument, std::string_view path) {
  const uint32_t unit = module().unit;
  const auto [at, fresh] = askedFiles_.try_emplace(unit);
  if (fresh) {
    const Tree& t = tree();
    for (NodeId id = 1; id < t.size(); ++id) {
      if (t.kind(id) != NodeKind::Call || t.text(id) != "fileExists") continue;
      for (const NodeId a : arguments(t.child(id, 0))) {
        const bool named = t.kind(a) == NodeKind::String || t.kind(a) == NodeKind::Name;
        at->second.emplace(named ? t.text(a) : kAnyFile);
      }
    }
  }
  const auto& asked = at->second;
  return asked.count(path) != 0 || asked.count(text(argument)) != 0 || asked.count(kAnyFile) != 0;
}

// A path such as "/gable/rules/x.cga" names a project: what is meant lies there before all others.
std::string Analysis::nearFile(const std::string& path, const std::string& from) {
  if (missedFiles_.size() + missingImports_.size() > kMaxFileHints) return {};
  std::string nearest;
  const size_t second = path.starts_with('/') ? path.find('/', 1) : std::string::npos;
  if (second != std::string::npos) {
    nearest = nearestFile(path, loader_->filesIn(path.substr(0, second + 1), from));
  }
  if (nearest.empty()) {
    if (!projectFiles_) projectFiles_ = loader_->assets(from);
    nearest = nearestFile(path, *projectFiles_);
  }
  if (nearest.empty()) nearest = bundledFile(path, from);
  if (!nearest.empty()) meant_ = {path, nearest};
  return nearest;
}

std::string Analysis::bundledFile(std::string_view path, const std::string& from) {
  if (!loader_) return {};
  const std::string_view name = path.substr(path.find_last_of("/\\") + 1);
  if (!bundledFiles_) bundledFiles_ = loader_->filesIn(kBundled, from);
  for (const std::string& f : *bundledFiles_) {
    if (withoutFolders(f) == name) return f;
  }
  return {};
}

void Analysis::checkMaterial(NodeId node) {
  if (!loader_ || module().original != module().id) return;
  const NodeId written = writtenText(node);
  // Nothing is written yet.
  if (written == kNoNode || text(written).empty() || isMute()) return;
  const std::string name(text(written)), file = "materials/" + name + "/material.mtl";
  const std::string& from = program_.units[module().unit].path;
  if (loader_->exists("builtin:" + file, from) || loader_->exists(file, from)) return;
  if (!missedFiles_.insert(file).second) return;
  error("unknown-material", tree().span(written), "there is no material " + quote(name),
        loader_->materialHint(name));
}

// A material that is written out with a tint.
void Analysis::checkTint(NodeId material, NodeId tint) {
  if (!loader_ || module().original != module().id) return;
  const NodeId name = writtenText(material), color = writtenText(tint);
  if (name == kNoNode || color == kNoNode || isMute()) return;
  const Status taken = loader_->takesTint(std::string(text(name)), std::string(text(color)));
  if (!taken) warning(taken.code(), tree().span(tint), taken.message(), taken.hint());
}

void Analysis::checkFile(NodeId node) {
  if (!loader_ || module().original != module().id) return;
  const NodeId written = writtenText(node);
  if (written == kNoNode || text(written).empty() || isMute()) return;
  const std::string path(text(written));
  const std::string& from = program_.units[module().unit].path;
  if (loader_->exists(path, from) || asksForFile(node, path)) return;
  if (!missedFiles_.insert(path).second) return;
  if (path.starts_with("builtin:")) {
    warning("missing-file", tree().span(written), quote(path) + " does not come with Gable",
            "the pages of texture() and i() list what does");
    return;
  }
  const std::string nearest = nearFile(path, from);
  warning("missing-file", tree().span(written), "there is no file " + quote(path),
          nearest.empty()
              ? "paths start at the assets folder, at the root of the project or beside "
                "the rule file"
              : "did you mean " + quote(nearest) + "?");
}

// The arguments of a call for which there must be a file.
void Analysis::checkFiles(const Signature& s, std::span<const NodeId> args) {
  for (size_t i = 0; i < args.size(); ++i) {
    const size_t p = parameterOf(s, args, i);
    if (p == kNoParameter || !s.paramAt(p)) continue;
    const ParamSpec& param = *s.paramAt(p);
    const NodeId value = argumentValue(tree(), args[i]);
    if (param.name == kFileParameter) checkFile(value);
    if (param.form && param.form->name == kMaterialForm) {
      checkMaterial(value);
      for (size_t other = 0; other < args.size(); ++other) {
        if (parameterOf(s, args, other) == p + 1)
          checkTint(value, argumentValue(tree(), args[other]));
      }
    }
  }
}

}  // namespace gable::lang
