#include "call_errors.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

namespace kinegraph::python {

namespace nb = nanobind;

namespace {

/// Nanobind has a few call entries shared by all functions, by the number and kind of their arguments.
constexpr std::size_t kMaxEntries = 8;

vectorcallfunc& entry(std::size_t number) {
  static std::array<vectorcallfunc, kMaxEntries> entries{};
  return entries[number];
}

/// Returns whether the error says that no overload takes the arguments, or that `self` has the wrong class.
bool isAboutArguments(const nb::python_error& error) {
  const char* text = error.what();
  if (Py_TYPE(error.value().ptr()) == reinterpret_cast<PyTypeObject*>(PyExc_TypeError))
    return std::strstr(text, "incompatible function arguments") != nullptr;
  return Py_TYPE(error.value().ptr()) == reinterpret_cast<PyTypeObject*>(PyExc_RuntimeError) &&
         std::strstr(text, "std::bad_cast") != nullptr;
}

/// Replaces the current error by one that explains the mismatch of the arguments.
void explain(PyObject* function, PyObject* const* arguments, std::size_t count, PyObject* names) {
  nb::python_error raised;  // takes the error
  if (!isAboutArguments(raised)) return raised.restore();
  try {
    nb::list positional;
    for (std::size_t i = 0; i < count; ++i) positional.append(nb::handle(arguments[i]));
    nb::dict named;
    for (std::size_t i = 0; names && i < std::size_t(PyTuple_GET_SIZE(names)); ++i)
      named[nb::handle(PyTuple_GET_ITEM(names, Py_ssize_t(i)))] = nb::handle(arguments[count + i]);
    const nb::object error =
        nb::module_::import_("kinegraph.call_errors").attr("explain")(nb::handle(function), positional, named);
    PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(error.ptr())), error.ptr());
  } catch (const std::exception&) {  // for example at interpreter shutdown
    raised.restore();
  }
}

template <std::size_t number>
PyObject* call(PyObject* function, PyObject* const* arguments, std::size_t flags, PyObject* names) {
  PyObject* result = entry(number)(function, arguments, flags, names);
  if (!result && PyErr_Occurred())
    explain(function, arguments, std::uint32_t(flags), names);  // flags are in the bits above the count
  return result;
}

template <std::size_t... numbers>
constexpr std::array<vectorcallfunc, kMaxEntries> calls(std::index_sequence<numbers...>) {
  return {call<numbers>...};
}

/// CPython finds the call entry of an object at an offset given by its type (PEP 590).
void explainFunction(nb::handle function) {
  static constexpr std::array<vectorcallfunc, kMaxEntries> explained = calls(std::make_index_sequence<kMaxEntries>());
  const Py_ssize_t offset = Py_TYPE(function.ptr())->tp_vectorcall_offset;
  auto& slot = *reinterpret_cast<vectorcallfunc*>(reinterpret_cast<char*>(function.ptr()) + offset);
  for (std::size_t i = 0; i < kMaxEntries; ++i) {
    if (slot == explained[i]) return;  // the same function under another name
    if (entry(i) && entry(i) != slot) continue;
    entry(i) = slot;
    slot = explained[i];
    return;
  }
}

bool isFunction(nb::handle object) { return nb::hasattr(object, "__nb_signature__"); }

void explainMembers(nb::handle type) {
  for (nb::handle value : nb::list(type.attr("__dict__").attr("values")())) {
    if (PyObject_TypeCheck(value.ptr(), &PyProperty_Type)) {
      for (const char* part : {"fget", "fset"})
        if (const nb::object function = value.attr(part); isFunction(function)) explainFunction(function);
    } else if (Py_TYPE(value.ptr()) == &PyStaticMethod_Type) {
      if (const nb::object function = value.attr("__func__"); isFunction(function)) explainFunction(function);
    } else if (isFunction(value)) {
      explainFunction(value);
    }
  }
}

}  // namespace

void explainWrongArguments(nb::module_& m) {
  for (nb::handle value : nb::list(m.attr("__dict__").attr("values")())) {
    if (isFunction(value))
      explainFunction(value);
    else if (PyType_Check(value.ptr()))
      explainMembers(value);
  }
}

}  // namespace kinegraph::python
