// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "bindings.h"

namespace gable::python {

namespace {

py::list annotationsOf(const std::vector<AttributeInfo::Annotation>& annotations) {
  py::list out;
  for (const auto& a : annotations) {
    py::dict arguments;
    py::list unnamed;
    for (const auto& [name, value] : a.arguments) {
      if (name.empty()) {
        unnamed.append(value);
      } else {
        arguments[py::str(name)] = value;
      }
    }
    if (!unnamed.empty()) arguments[py::str()] = unnamed;
    out.append(py::make_tuple(a.name, arguments));
  }
  return out;
}

py::list attributesOf(const Rules& rules) {
  py::list out;
  for (const AttributeInfo& a : rules.attributes()) {
    py::dict d;
    d["name"] = a.name;
    d["type"] = a.type;
    d["hidden"] = a.hidden;
    d["annotations"] = annotationsOf(a.annotations);
    out.append(std::move(d));
  }
  return out;
}

py::list rulesOf(const Rules& rules) {
  py::list out;
  for (const RuleInfo& r : rules.rules()) {
    py::dict d;
    d["name"] = r.name;
    d["parameters"] = r.parameters;
    d["start"] = r.start;
    d["hidden"] = r.hidden;
    d["file"] = r.file;
    d["line"] = r.line;
    d["annotations"] = annotationsOf(r.annotations);
    out.append(std::move(d));
  }
  return out;
}

using Text = std::optional<std::string>;

LoadSettings settingsOf(Text project, Text workspace, std::vector<std::string> libraries,
                        Text bundled, Text notation, Text style) {
  LoadSettings s;
  s.project = std::move(project);
  s.search.workspace = std::move(workspace);
  s.search.libraries = std::move(libraries);
  s.search.bundled = std::move(bundled);
  s.dialect = std::move(notation);
  s.style = std::move(style);
  return s;
}

}  // namespace

void bindRules(py::module_& m) {
  using Folders = std::vector<std::string>;
  py::class_<Rules>(m, "Rules")
      .def_static(
          "load",
          [](const std::string& path, Text project, Text workspace, Folders libraries, Text bundled,
             Text notation, Text style) {
            const py::gil_scoped_release released;
            return Rules::load(path,
                               settingsOf(project, workspace, libraries, bundled, notation, style));
          },
          py::arg("path"), py::arg("project"), py::arg("workspace"), py::arg("libraries"),
          py::arg("bundled"), py::arg("notation"), py::arg("style"))
      .def_static(
          "parse",
          [](const std::string& text, const std::string& path, Text project, Text workspace,
             Folders libraries, Text bundled, Text notation, Text style) {
            const py::gil_scoped_release released;
            return Rules::parse(
                text, path, settingsOf(project, workspace, libraries, bundled, notation, style));
          },
          py::arg("text"), py::arg("path"), py::arg("project"), py::arg("workspace"),
          py::arg("libraries"), py::arg("bundled"), py::arg("notation"), py::arg("style"))
      .def("ok", &Rules::ok)
      .def("messages", [](const Rules& r) { return messagesOf(r.diagnostics()); })
      .def("attributes", &attributesOf)
      .def("rules", &rulesOf)
      .def("styles", &Rules::styles)
      .def("start_rule", &Rules::startRule);
}

}  // namespace gable::python
