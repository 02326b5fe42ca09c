// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The module gable._gable: the C++ interface as Python sees it, flat. What users import is written
// in Python over it (python/gable/__init__.py), with names, defaults and documentation.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <utility>
#include <vector>

#include "gable/gable.h"

namespace gable::python {

namespace py = pybind11;

/// Dictionaries with severity, code, message, hint, text and, where known, file, line, column and
/// path.
py::list messagesOf(const DiagnosticList& diagnostics);

/// A number, a bool, a str, or an array: a list, or a list of lists where it has several rows.
py::object objectOf(const RuleValue& value);
/// The other way; numpy arrays and scalars as well. Raises TypeError, which names the attribute.
RuleValue valueOf(const std::string& name, py::handle object);

/// A numpy array that owns the vector: nothing is copied. `columns` of 0 for one dimension.
template <class T>
py::array arrayOf(std::vector<T>&& values, size_t columns = 0) {
  auto owner = new std::vector<T>(std::move(values));
  const py::capsule base(owner, [](void* p) { delete static_cast<std::vector<T>*>(p); });
  std::vector<py::ssize_t> shape;
  if (columns > 0) {
    shape = {static_cast<py::ssize_t>(owner->size() / columns), static_cast<py::ssize_t>(columns)};
  } else {
    shape = {static_cast<py::ssize_t>(owner->size())};
  }
  return py::array_t<T>(shape, owner->data(), base);
}

/// Of the rules, by name, as DeriveSettings takes them.
void setAttributes(DeriveSettings& settings, const py::dict& attributes);

void bindRules(py::module_& m);
void bindShapes(py::module_& m);
void bindModel(py::module_& m);
void bindDerive(py::module_& m);
void bindDataset(py::module_& m);

}  // namespace gable::python
