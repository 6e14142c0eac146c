// What the generated bindings share: Status as Python's exceptions, parameters that are made from keywords.
#pragma once
#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <luxel/plan.h>
#include <luxel/status.h>

namespace luxel::python {

namespace nb = nanobind;

/// Throws the Python exception of a Status: ValueError for invalid_argument, else luxel.Error; with the same text.
void check(const Status& status);

template <class T>
T value_of(Result<T> result) {
  check(result.status());
  return std::move(result).value();
}
template <class T>
T value_of(T value) {
  return value;
}

/// A class of fields, made from keywords (luxel/_fields.py says what they may be).
template <class T>
nb::class_<T> fields(nb::class_<T> type) {
  type.def("__init__", [](nb::pointer_and_handle<T> at, const nb::kwargs& given) {
    new (at.p) T();
    nb::inst_mark_ready(at.h);
    const nb::module_ module = nb::module_::import_("luxel._fields");
    for (const auto& [name, value] : given) module.attr("set_field")(at.h, name, value);
  });
  type.def("__setattr__", [](nb::handle self, nb::handle name, nb::handle value) {
    nb::module_::import_("luxel._fields").attr("set_field")(self, name, value);
  });
  type.def("__repr__", [](nb::handle self) { return nb::module_::import_("luxel._fields").attr("text")(self); });
  return type;
}

void bind_kernels(nb::module_& m);

}  // namespace luxel::python
