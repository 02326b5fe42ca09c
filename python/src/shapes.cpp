// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "bindings.h"

namespace gable::python {

namespace {

Shapes withAttributes(const Shapes& shapes, const std::vector<py::dict>& byShape) {
  std::vector<std::vector<NamedValue>> all;
  all.reserve(byShape.size());
  for (const py::dict& values : byShape) {
    std::vector<NamedValue>& own = all.emplace_back();
    for (const auto& [key, value] : values) {
      const auto name = key.cast<std::string>();
      own.push_back({name, valueOf(name, value)});
    }
  }
  const py::gil_scoped_release released;
  return shapes.withAttributes(all);
}

py::tuple outlineOf(const Shapes& shapes, size_t i) {
  Shapes::Outline outline = shapes.outline(i);
  std::vector<double> ring;
  ring.reserve(2 * outline.ring.size());
  for (const auto& [x, y] : outline.ring) {
    ring.push_back(x);
    ring.push_back(y);
  }
  return py::make_tuple(outline.name, arrayOf(std::move(ring), 2), outline.area);
}

}  // namespace

void bindShapes(py::module_& m) {
  py::class_<Shapes>(m, "Shapes")
      .def_static("lot", &Shapes::lot)
      .def_static("polygon", &Shapes::polygon)
      .def_static("mesh", &Shapes::mesh)
      .def_static("load",
                  [](const std::string& path, const std::string& layer, const std::string& key,
                     const std::string& value) {
                    const py::gil_scoped_release released;
                    return Shapes::load(path, {}, {layer, key, value});
                  })
      .def_static("parse",
                  [](const std::string& content, const std::string& name) {
                    const py::gil_scoped_release released;
                    return Shapes::parse(content, name);
                  })
      .def_static("joined", &Shapes::joined)
      .def("with_attributes", &withAttributes)
      .def("with_nested_cut",
           [](const Shapes& s) {
             const py::gil_scoped_release released;
             return s.withNestedCut();
           })
      .def("only", &Shapes::only)
      .def("outline", &outlineOf)
      .def("size", &Shapes::size)
      .def("ok", &Shapes::ok)
      .def("messages", [](const Shapes& s) { return messagesOf(s.diagnostics()); });
}

}  // namespace gable::python
