#include "arrays.h"

#define NPY_NO_DEPRECATED_API NPY_1_22_API_VERSION
#include <numpy/arrayobject.h>

#include <algorithm>
#include <cstring>

namespace kinegraph::python {

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Loads numpy's C interface once; creating an array with it takes a third of the time of numpy.empty.
void requireNumpy() {
  static const bool loaded = [] {
    if (_import_array() < 0) throw nb::python_error();
    return true;
  }();
  (void)loaded;
}

NewArray makeArray(int rank, npy_intp* shape) {
  requireNumpy();
  PyObject* array = PyArray_SimpleNew(rank, shape, NPY_DOUBLE);
  if (!array) throw nb::python_error();
  return {Array(nb::steal(array)), static_cast<double*>(PyArray_DATA(reinterpret_cast<PyArrayObject*>(array)))};
}

/// Returns the array if it contains contiguous doubles, else null.
PyArrayObject* asDoubles(PyObject* source) {
  requireNumpy();
  if (!PyArray_Check(source)) return nullptr;
  auto* array = reinterpret_cast<PyArrayObject*>(source);
  return PyArray_TYPE(array) == NPY_DOUBLE && PyArray_ISCARRAY_RO(array) ? array : nullptr;
}

/// Reads a contiguous buffer of doubles, the most common case.
bool readBuffer(PyObject* source, Numbers& target) {
  if (PyArrayObject* array = asDoubles(source)) {
    target.rank = PyArray_NDIM(array);
    target.rows = target.rank > 0 ? std::size_t(PyArray_DIM(array, 0)) : 1;
    target.values = Eigen::Map<const VectorXd>(static_cast<const double*>(PyArray_DATA(array)), PyArray_SIZE(array));
    return true;
  }
  if (PyArray_Check(source)) return false;
  Py_buffer buffer;
  if (PyObject_GetBuffer(source, &buffer, PyBUF_ND | PyBUF_FORMAT) != 0) {
    PyErr_Clear();
    return false;
  }
  const bool doubles = buffer.format && std::strcmp(buffer.format, "d") == 0;
  if (doubles) {
    target.rank = buffer.ndim;
    target.rows = buffer.ndim > 0 ? std::size_t(buffer.shape[0]) : 1;
    target.values = Eigen::Map<const VectorXd>(static_cast<const double*>(buffer.buf), buffer.len / 8);
  }
  PyBuffer_Release(&buffer);
  return doubles;
}

/// Reads a list or tuple of plain numbers.
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
  target.rank = 1;
  target.rows = std::size_t(size);
  return true;
}

}  // namespace

MatrixXd Numbers::matrix() const {
  return Eigen::Map<const RowMajor>(values.data(), rank < 2 ? 1 : Eigen::Index(rows), Eigen::Index(columns()));
}

NewArray newArray(std::size_t size) {
  npy_intp shape[] = {npy_intp(size)};
  return makeArray(1, shape);
}

NewArray newArray(std::size_t rows, std::size_t columns) {
  npy_intp shape[] = {npy_intp(rows), npy_intp(columns)};
  return makeArray(2, shape);
}

NewArray newArray(std::size_t layers, std::size_t rows, std::size_t columns) {
  npy_intp shape[] = {npy_intp(layers), npy_intp(rows), npy_intp(columns)};
  return makeArray(3, shape);
}

NewArray newArray(std::size_t blocks, std::size_t layers, std::size_t rows, std::size_t columns) {
  npy_intp shape[] = {npy_intp(blocks), npy_intp(layers), npy_intp(rows), npy_intp(columns)};
  return makeArray(4, shape);
}

NewArray ReusedArrays::get(std::size_t size) {
  const std::ptrdiff_t shape[] = {std::ptrdiff_t(size)};
  return get(1, shape);
}

NewArray ReusedArrays::get(std::size_t rows, std::size_t columns) {
  const std::ptrdiff_t shape[] = {std::ptrdiff_t(rows), std::ptrdiff_t(columns)};
  return get(2, shape);
}

NewArray ReusedArrays::get(int rank, const std::ptrdiff_t* shape) {
  for (const Kept& kept : kept_) {
    auto* array = reinterpret_cast<PyArrayObject_fields*>(kept.array.ptr());
    if (!array || Py_REFCNT(array) != 1) continue;
    // The array has no other owner, but a previous owner may have changed its shape, or may watch it by a weak
    // reference.
    const bool as_made = array->nd == rank && std::equal(shape, shape + rank, array->dimensions) &&
                         array->flags == kept.flags && array->descr == kept.type && !array->base && !array->weakreflist;
    if (as_made) return {Array(kept.array), reinterpret_cast<double*>(array->data)};
  }
  npy_intp extents[] = {shape[0], rank > 1 ? npy_intp(shape[1]) : 1};
  NewArray made = makeArray(rank, extents);
  constexpr Py_ssize_t kMost = 4096;  // numbers; larger arrays take longer to fill than to allocate
  if (extents[0] * extents[1] > kMost) return made;
  const auto* array = reinterpret_cast<const PyArrayObject_fields*>(made.array.ptr());
  kept_[next_] = {made.array, array->flags, array->descr};
  next_ = 1 - next_;
  return made;
}

NewFlags newFlags(std::size_t size) {
  requireNumpy();
  npy_intp shape[] = {npy_intp(size)};
  PyObject* array = PyArray_SimpleNew(1, shape, NPY_BOOL);
  if (!array) throw nb::python_error();
  return {FlagArray(nb::steal(array)), static_cast<bool*>(PyArray_DATA(reinterpret_cast<PyArrayObject*>(array)))};
}

Array toNumpy(const double* values, std::size_t size) {
  NewArray array = newArray(size);
  std::copy_n(values, size, array.data);
  return std::move(array.array);
}

Array toNumpy(const VectorXd& vector) { return toNumpy(vector.data(), std::size_t(vector.size())); }

Array toNumpy(const RowMajor& matrix) {
  NewArray array = newArray(std::size_t(matrix.rows()), std::size_t(matrix.cols()));
  std::copy_n(matrix.data(), matrix.size(), array.data);
  return std::move(array.array);
}

Array toNumpy(const MatrixXd& matrix) { return toNumpy(RowMajor(matrix)); }

bool readNumbers(nb::handle source, Numbers& target) {
  PyObject* object = source.ptr();
  if (object == Py_None || PyUnicode_Check(object) || PyBytes_Check(object)) return false;
  if (PyFloat_Check(object) || PyLong_Check(object)) {
    const double number = PyFloat_AsDouble(object);
    if (PyErr_Occurred()) return PyErr_Clear(), false;
    target.rank = 0;
    target.values = VectorXd::Constant(1, number);
    return true;
  }
  if (readFlatSequence(object, target) || readBuffer(object, target)) return true;
  requireNumpy();
  PyObject* array = PyArray_FROM_OTF(object, NPY_DOUBLE, NPY_ARRAY_C_CONTIGUOUS);
  if (!array) return PyErr_Clear(), false;
  const bool read = readBuffer(array, target);
  Py_DECREF(array);
  return read;
}

bool readNumbers(nb::handle source, NumbersView& target) {
  if (PyArrayObject* array = asDoubles(source.ptr())) {
    target.rank = PyArray_NDIM(array);
    new (&target.values)
        Eigen::Map<const VectorXd>(static_cast<const double*>(PyArray_DATA(array)), PyArray_SIZE(array));
    return true;
  }
  if (!readNumbers(source, target.copy)) return false;
  target.rank = target.copy.rank;
  new (&target.values) Eigen::Map<const VectorXd>(target.copy.values.data(), target.copy.values.size());
  return true;
}

}  // namespace kinegraph::python
