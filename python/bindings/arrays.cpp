#include "arrays.h"

#include <cstring>

namespace kinegraph::python {

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// numpy functions, looked up once and kept for the life of the interpreter.
PyObject* numpyFunction(const char* name) { return nb::object(nb::module_::import_("numpy").attr(name)).release().ptr(); }

PyObject* numpyEmpty() {
  static PyObject* const function = numpyFunction("empty");
  return function;
}

PyObject* numpyAsArray() {
  static PyObject* const function = numpyFunction("ascontiguousarray");
  return function;
}

double* arrayData(PyObject* array) {
  Py_buffer buffer;
  if (PyObject_GetBuffer(array, &buffer, PyBUF_SIMPLE | PyBUF_WRITABLE) != 0) throw nb::python_error();
  double* data = static_cast<double*>(buffer.buf);
  PyBuffer_Release(&buffer);
  return data;
}

/// A contiguous buffer of doubles, as most arrays are.
bool readBuffer(PyObject* source, Numbers& target) {
  Py_buffer buffer;
  if (PyObject_GetBuffer(source, &buffer, PyBUF_ND | PyBUF_FORMAT) != 0) {
    PyErr_Clear();
    return false;
  }
  const bool doubles = buffer.format && std::strcmp(buffer.format, "d") == 0;
  if (doubles) {
    target.shape.assign(buffer.shape, buffer.shape + buffer.ndim);
    target.values = Eigen::Map<const VectorXd>(static_cast<const double*>(buffer.buf), buffer.len / 8);
  }
  PyBuffer_Release(&buffer);
  return doubles;
}

/// A list or tuple of plain numbers.
bool readFlatSequence(PyObject* source, Numbers& target) {
  if (!PyList_Check(source) && !PyTuple_Check(source)) return false;
  const Py_ssize_t size = PySequence_Fast_GET_SIZE(source);
  PyObject** items = PySequence_Fast_ITEMS(source);
  target.values.resize(size);
  for (Py_ssize_t i = 0; i < size; ++i) {
    if (PyFloat_Check(items[i])) {
      target.values[i] = PyFloat_AS_DOUBLE(items[i]);
    } else if (PyLong_Check(items[i])) {
      target.values[i] = PyLong_AsDouble(items[i]);
      if (PyErr_Occurred()) return PyErr_Clear(), false;
    } else {
      return false;
    }
  }
  target.shape = {std::size_t(size)};
  return true;
}

}  // namespace

MatrixXd Numbers::matrix() const {
  const Eigen::Index rows = shape.size() == 2 ? Eigen::Index(shape[0]) : 1;
  const Eigen::Index columns = shape.size() == 2 ? Eigen::Index(shape[1]) : values.size();
  return Eigen::Map<const RowMajor>(values.data(), rows, columns);
}

NewArray newArray(std::size_t size) {
  PyObject* length = PyLong_FromSize_t(size);
  PyObject* array = PyObject_CallOneArg(numpyEmpty(), length);
  Py_DECREF(length);
  if (!array) throw nb::python_error();
  return {nb::steal(array), arrayData(array)};
}

NewArray newArray(std::size_t rows, std::size_t columns) {
  PyObject* shape = PyTuple_Pack(2, nb::int_(rows).ptr(), nb::int_(columns).ptr());
  PyObject* array = PyObject_CallOneArg(numpyEmpty(), shape);
  Py_DECREF(shape);
  if (!array) throw nb::python_error();
  return {nb::steal(array), arrayData(array)};
}

nb::object toNumpy(const double* values, std::size_t size) {
  NewArray array = newArray(size);
  std::copy_n(values, size, array.data);
  return std::move(array.array);
}

nb::object toNumpy(const VectorXd& vector) { return toNumpy(vector.data(), std::size_t(vector.size())); }

nb::object toNumpy(const RowMajor& matrix) {
  NewArray array = newArray(std::size_t(matrix.rows()), std::size_t(matrix.cols()));
  std::copy_n(matrix.data(), matrix.size(), array.data);
  return std::move(array.array);
}

nb::object toNumpy(const MatrixXd& matrix) { return toNumpy(RowMajor(matrix)); }

bool readNumbers(nb::handle source, Numbers& target) {
  PyObject* object = source.ptr();
  if (object == Py_None || PyUnicode_Check(object) || PyBytes_Check(object)) return false;
  if (PyFloat_Check(object) || PyLong_Check(object)) {
    const double number = PyFloat_AsDouble(object);
    if (PyErr_Occurred()) return PyErr_Clear(), false;
    target.shape.clear();
    target.values = VectorXd::Constant(1, number);
    return true;
  }
  if (readFlatSequence(object, target) || readBuffer(object, target)) return true;
  PyObject* array = PyObject_CallFunction(numpyAsArray(), "Os", object, "f8");
  if (!array) return PyErr_Clear(), false;
  const bool read = readBuffer(array, target);
  Py_DECREF(array);
  return read;
}

}  // namespace kinegraph::python
