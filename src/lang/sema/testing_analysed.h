// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What the tests of the analysis share: a text analysed against the small catalogue.
#pragma once

#include <algorithm>
#include <map>

#include "lang/parser.h"
#include "lang/sema/analyse.h"
#include "lang/sema/testing_catalogue.h"

namespace gable::lang {

class MapLoader : public FileLoader {
 public:
  std::map<std::string, std::string> files;
  Result<File> load(const std::string& path, const std::string&) override {
    const auto at = files.find(path);
    if (at == files.end()) return missingImport(path);
    return File{path, at->second};
  }
};

struct Analysed {
  MapLoader loader;
  Sources sources;
  Diagnostics diagnostics;
  ValuePool values;
  ResolvedProgram program;

  explicit Analysed(const std::string& text, std::map<std::string, std::string> files = {},
                    std::string style = "") {
    loader.files = std::move(files);
    const uint32_t file = sources.add("main.cga", text);
    AnalysisInput input{std::make_shared<const Tree>(parse(sources, file, diagnostics)), "main.cga",
                        std::move(style)};
    program = analyse(std::move(input), testCatalogue(), values, &loader, sources, diagnostics);
    diagnostics.sortByPlace();
  }

  std::string problems() const {
    std::string out;
    for (const Diagnostics::Entry& d : diagnostics.all()) {
      if (d.span.valid()) {
        const LineColumn at = sources.locate(d.span.file, d.span.begin);
        if (d.span.file > 0) out += sources.path(d.span.file) + ":";
        out += std::to_string(at.line) + ":" + std::to_string(at.column) + " ";
      }
      out += d.code + (d.severity == Severity::Warning ? " (warning)\n" : "\n");
    }
    return out;
  }
  std::string messages() const {
    std::string out;
    for (const Diagnostics::Entry& d : diagnostics.all()) out += format(d, sources);
    return out;
  }
  /// The main file with all remedies carried out that are edits, from its end on.
  std::string mended() const {
    std::string out(sources.text(0));
    uint32_t last = static_cast<uint32_t>(out.size());
    for (size_t i = diagnostics.all().size(); i-- > 0;) {
      const std::optional<Replacement>& fix = diagnostics.all()[i].fix;
      if (!fix || fix->span.file != 0 || fix->span.end > last) continue;
      out.replace(fix->span.begin, fix->span.end - fix->span.begin, fix->text);
      last = fix->span.begin;
    }
    return out;
  }
  std::string hint(size_t index = 0) const {
    return index < diagnostics.all().size() ? diagnostics.all()[index].hint : "";
  }

  // What the nodes with this text mean, in a module, in the order of the text.
  std::string meaning(std::string_view name, ModuleId module = 0) const {
    const Tree& t = program.tree(module);
    std::vector<NodeId> nodes;
    for (NodeId id = 1; id < t.size(); ++id) {
      if (t.text(id) == name && program.modules[module].at(id).kind != RefKind::None) {
        nodes.push_back(id);
      }
    }
    std::sort(nodes.begin(), nodes.end(),
              [&](NodeId a, NodeId b) { return t.span(a).begin < t.span(b).begin; });
    std::string out;
    for (const NodeId id : nodes) {
      out += (out.empty() ? "" : " ") + describe(program.modules[module].at(id));
    }
    return out;
  }

  std::string describe(const Resolution& r) const {
    const auto at = [&](const auto& list) {
      const auto& info = list[r.index];
      return info.qualifiedName + "@" + std::to_string(info.module);
    };
    switch (r.kind) {
      case RefKind::Rule: return "rule:" + at(program.rules);
      case RefKind::Function: return "function:" + at(program.functions);
      case RefKind::Attribute: return "attr:" + at(program.attributes);
      case RefKind::Leaf: return "leaf";
      case RefKind::Operation:
        return "op:" + std::string(r.spec.operation->name) + "/" + std::to_string(r.signature);
      case RefKind::BuiltinFunction:
        return "builtin:" + std::string(r.spec.function->name) + "/" + std::to_string(r.signature);
      case RefKind::ShapeAttribute: return "shape:" + std::string(r.spec.attribute->name);
      case RefKind::Slot: return "slot:" + std::to_string(r.index);
      case RefKind::Selector: return "selector";
      case RefKind::None: break;
    }
    return "none";
  }

  const AttributeInfo& attribute(std::string_view name) const {
    return program.attributes.at(program.findAttribute(name));
  }
  const RuleInfo& rule(std::string_view name, uint32_t params = 0) const {
    return program.rules.at(program.findRule(name, params));
  }
  const FunctionInfo& function(std::string_view name) const {
    return *std::find_if(program.functions.begin(), program.functions.end(),
                         [&](const FunctionInfo& f) { return f.qualifiedName == name; });
  }
};

}  // namespace gable::lang
