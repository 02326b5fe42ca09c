// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "bindings.h"

namespace gable::python {

namespace {

const char* severityName(Diagnostic::Severity s) {
  switch (s) {
    case Diagnostic::Severity::Note: return "note";
    case Diagnostic::Severity::Warning: return "warning";
    case Diagnostic::Severity::Error: break;
  }
  return "error";
}

py::object objectOf(const RuleValue::Scalar& item) {
  if (const auto* number = std::get_if<double>(&item)) return py::float_(*number);
  if (const auto* flag = std::get_if<bool>(&item)) return py::bool_(*flag);
  return py::str(std::get<std::string>(item));
}

// Scalars of numpy are numbers, and its bools are bools.
RuleValue::Scalar scalarOf(const std::string& name, py::handle object) {
  if (py::isinstance<py::str>(object)) return object.cast<std::string>();
  if (py::isinstance<py::bool_>(object)) return object.cast<bool>();
  if (py::hasattr(object, "dtype") &&
      py::cast<std::string>(object.attr("dtype").attr("kind")) == "b") {
    return static_cast<bool>(py::bool_(py::reinterpret_borrow<py::object>(object)));
  }
  if (PyNumber_Check(object.ptr()) != 0) {
    const double number = PyFloat_AsDouble(object.ptr());
    if (PyErr_Occurred() == nullptr) return number;
    PyErr_Clear();
  }
  throw py::type_error("the value for '" + name + "' is no number, bool, str or list of those: " +
                       py::repr(object).cast<std::string>());
}

bool isList(py::handle object) {
  return !py::isinstance<py::str>(object) && py::isinstance<py::sequence>(object) &&
         !(py::hasattr(object, "ndim") && object.attr("ndim").cast<int>() == 0);
}

}  // namespace

py::list messagesOf(const DiagnosticList& diagnostics) {
  py::list out;
  for (const Diagnostic& d : diagnostics) {
    py::dict m;
    m["severity"] = severityName(d.severity);
    m["code"] = d.code;
    m["message"] = d.message;
    m["hint"] = d.hint;
    m["path"] = d.shapePath;
    m["text"] = d.rendered;
    if (d.range) {
      m["file"] = d.range->file;
      m["line"] = d.range->line;
      m["column"] = d.range->column;
    }
    out.append(std::move(m));
  }
  return out;
}

py::object objectOf(const RuleValue& value) {
  if (!value.array) return value.items.empty() ? py::none() : objectOf(value.items[0]);
  const auto row = [&](size_t r) {
    py::list list;
    for (size_t c = 0; c < value.array->columns; ++c)
      list.append(objectOf(value.items[r * value.array->columns + c]));
    return list;
  };
  if (value.array->rows == 1) return row(0);
  py::list rows;
  for (size_t r = 0; r < value.array->rows; ++r) rows.append(row(r));
  return rows;
}

RuleValue valueOf(const std::string& name, py::handle object) {
  RuleValue out;
  if (!isList(object)) {
    out.items.push_back(scalarOf(name, object));
    return out;
  }
  const auto list = py::reinterpret_borrow<py::sequence>(object);
  const bool nested = list.size() > 0 && isList(py::object(list[0]));
  out.array = RuleValue::Size{nested ? static_cast<uint32_t>(list.size()) : 1, 0};
  const auto add = [&](const py::sequence& row) {
    out.array->columns = static_cast<uint32_t>(row.size());
    for (size_t i = 0; i < row.size(); ++i) out.items.push_back(scalarOf(name, py::object(row[i])));
  };
  if (!nested) {
    add(list);
    return out;
  }
  for (size_t r = 0; r < list.size(); ++r) {
    const py::object row = list[r];
    if (!isList(row) || (r > 0 && py::len(row) != out.array->columns)) {
      throw py::type_error("the rows of the value for '" + name + "' have not the same length");
    }
    add(py::reinterpret_borrow<py::sequence>(row));
  }
  return out;
}

}  // namespace gable::python
