#pragma once

#include <string>

#include "bindings.h"

namespace kinegraph::python {

/// Setters return the same Python object, so calls can be chained.
constexpr auto kChain = nb::rv_policy::none;

/// The path of a file: a str or any object accepted by os.fspath.
struct PathText {
  std::string text;
};

/// A frame argument; `toFrame` resolves it.
class FrameArgument : public nb::object {
  NB_OBJECT_DEFAULT(FrameArgument, nb::object, "str | int | Frame", isAnything)
  static bool isAnything(PyObject*) noexcept { return true; }  // toFrame reports errors
};

/// An array argument of any rank.
class ArrayArgument : public nb::object {
  NB_OBJECT_DEFAULT(ArrayArgument, nb::object, "numpy.typing.ArrayLike", isAnything)
  static bool isAnything(PyObject*) noexcept { return true; }  // numpy reports errors
};

/// Attributes of a scene or a frame: names and values.
using Attributes = nb::typed<nb::dict, nb::str, nb::any>;

}  // namespace kinegraph::python

namespace nanobind::detail {

template <>
struct type_caster<kinegraph::python::PathText> {
  NB_TYPE_CASTER(kinegraph::python::PathText, const_name("str | os.PathLike[str]"))

  bool from_python(handle source, uint8_t, cleanup_list*) noexcept {
    PyObject* path = nullptr;
    Py_ssize_t size = 0;
    const bool is_path = PyUnicode_FSDecoder(source.ptr(), &path) != 0;
    const char* text = is_path ? PyUnicode_AsUTF8AndSize(path, &size) : nullptr;
    if (text) value.text.assign(text, std::size_t(size));
    PyErr_Clear();
    Py_XDECREF(path);
    return text != nullptr;
  }
};

}  // namespace nanobind::detail
